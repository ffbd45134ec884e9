//! Whether a pose is where a motion was expected to lead.

/// A correction of the expected pose larger than this part of the motion means that the
/// motion was not understood; measured on mechanisms at 1 to 60 degrees a frame.
pub(crate) const SURPRISE: f64 = 0.3;
/// A motion that is smaller than this part of the size is not worth a second look.
pub(crate) const NO_MOTION: f64 = 1e-6;
/// How many poses before the present one an expectation of full degree is made from.
pub(crate) const WELL_KNOWN: usize = 3;
/// A point is where it was expected if it was corrected by no more than this part of the way to the
/// other place where its constraints hold, and if that place is so near that it might be there, by
/// no more than the second.
const DOUBT: f64 = 0.25;
pub(crate) const NEAR_DOUBT: f64 = 1e-2;
/// That place is near if it is no more than so many times as far away as a point went.
const FAR: f64 = 4.0;

/// Whether a pose that crossed nothing is the one that a motion leads to: `doubt_squared` is how large a
/// part of the way to the other place where its constraints hold the correction of a point is at most, and
/// `nearest_squared` how far away the nearest of these is, both squared; it was expected from the last pose
/// and `n_past` before it.
pub(crate) fn is_clear(
    correction: f64,
    motion: f64,
    doubt_squared: f64,
    nearest_squared: f64,
    n_past: usize,
) -> bool {
    if nearest_squared < (FAR * motion) * (FAR * motion) {
        n_past == WELL_KNOWN
            && doubt_squared <= NEAR_DOUBT * NEAR_DOUBT
            && correction <= NEAR_DOUBT * motion
    } else {
        doubt_squared <= DOUBT * DOUBT
    }
}
