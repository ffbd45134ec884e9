//! What a study asks of whoever runs it: the clock, and when to stop.

use super::report::Why;

/// What a study asks of whoever runs it.
pub struct StudyHost<'a> {
    /// Seconds since some fixed moment.
    pub now: &'a dyn Fn() -> f64,
    /// Whether to come to an end with what there is.
    pub stop: &'a dyn Fn() -> bool,
    /// Told how much is done, from 0 to 1.
    pub progress: &'a dyn Fn(f64),
    /// How long it may take, roughly, seconds.
    pub seconds: f64,
}

impl StudyHost<'_> {
    /// Why a run that is over is over.
    pub(super) fn why_over(&self) -> Why {
        if (self.stop)() { Why::Stopped } else { Why::TooSlow }
    }
}
