//! What running the list of steps came to.

use crate::constraint::Vector;
use crate::solve::frame::branch::SENSITIVE;

/// What a frame came to.
#[derive(Clone, Copy)]
pub(crate) struct Found {
    /// The largest distance to satisfaction; not a number where the pose was not found.
    pub worst: f64,
    /// How near the pose is to a singular one, as the square of the sine of an angle.
    pub least_side_squared: f64,
}

impl Found {
    /// What no step has added to.
    pub const NOTHING: Self = Self { worst: 0.0, least_side_squared: 1.0 };

    /// How near the pose is to a singular one, as the sine of an angle.
    pub fn least_side(&self) -> f64 {
        self.least_side_squared.sqrt()
    }

    /// Whether errors grow at the pose, so that they are to be looked at.
    pub fn is_sensitive(&self) -> bool {
        self.least_side_squared < SENSITIVE * SENSITIVE
    }
}

/// The larger of two distances to satisfaction, the second of which may have a sign. What is not a
/// number stays: it meets nothing.
#[inline(always)]
pub(super) fn larger(worst: f64, off: f64) -> f64 {
    let off = off.abs();
    if (worst >= off) | worst.is_nan() { worst } else { off }
}

/// One over the sine of an angle whose square is that, or a little more; infinite where it may be 0, and not a
/// number where it is the square of no sine. Numbers of half the length do for how far something went at most, and
/// take half the time.
#[inline(always)]
pub(super) fn over_sine(sine_squared: f64) -> f64 {
    const MORE: f64 = 1.0 + 1e-6;
    let over = MORE * f64::from(1.0 / (sine_squared as f32).sqrt());
    if sine_squared <= MORE { over } else { f64::NAN }
}

/// How long a vector is, with the bits of [`Vector::norm`]; not a number where its square is none that can be held.
#[inline(always)]
pub(super) fn plain_length(v: Vector) -> f64 {
    let squared = v.norm_squared();
    if (squared > 1e-280) & (squared < 1e280) { squared.sqrt() } else { f64::NAN }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_over_a_sine_is_no_less_than_that() {
        for k in 1..=100_000 {
            let sine = f64::from(k) / 100_000.0;
            let over = over_sine(sine * sine) * sine;
            assert!((1.0..1.0 + 2e-6).contains(&over), "{sine}: {over}");
        }
        assert_eq!(over_sine(0.0), f64::INFINITY);
        for none in [-1e-9, 1.1, 1e50, f64::INFINITY, f64::NAN] {
            assert!(over_sine(none).is_nan(), "{none}");
        }
    }

    #[test]
    fn what_is_not_a_number_meets_nothing() {
        for places in [[f64::NAN, 1e-20], [1e-20, f64::NAN]] {
            assert!(places.into_iter().fold(0.0, larger).is_nan());
        }
        assert_eq!([1e-20, -3.0, 2.0].into_iter().fold(0.0, larger), 3.0);
    }
}
