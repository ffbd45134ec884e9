//! When the time of something is up.

use std::rc::Rc;

use super::host::Host;
use crate::interrupt::Wish;

/// A moment by the clock of a host, or never.
#[derive(Debug, Clone, Copy, Default)]
pub struct Deadline(Option<f64>);

impl Deadline {
    /// In so many seconds, where it is said how many and the host has a clock.
    pub fn after(seconds: Option<f64>, host: &dyn Host) -> Self {
        Self(seconds.and_then(|seconds| Some(host.seconds()? + seconds)))
    }

    /// Whether there will be such a moment.
    pub const fn exists(self) -> bool {
        self.0.is_some()
    }

    /// Whether it has passed.
    pub fn has_passed(self, host: &dyn Host) -> bool {
        self.0.is_some_and(|deadline| host.seconds().is_some_and(|now| now >= deadline))
    }

    /// What says within a long piece of work that it is to be left: the user wants that, or the
    /// moment has passed.
    pub fn wish(self, host: &dyn Host) -> Option<Wish> {
        let asked = host.wish_to_stop();
        let Some(deadline) = self.0 else { return asked };
        let Some(now) = host.clock() else { return asked };
        Some(Rc::new(move || asked.as_ref().is_some_and(|asked| asked()) || now() >= deadline))
    }
}
