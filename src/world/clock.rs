//! Simulated time, counted in frames so that it does not drift.

/// The clock: time is a base plus a whole number of frames of `dt`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Clock {
    /// Frames since the world began.
    pub frame: u64,
    /// Time of one frame.
    pub dt: f64,
    /// The frame at which `dt` took its present value.
    pub base_frame: u64,
    /// The time at `base_frame`.
    pub base_time: f64,
}

impl Default for Clock {
    fn default() -> Self {
        Self { frame: 0, dt: 1.0 / 60.0, base_frame: 0, base_time: 0.0 }
    }
}

impl Clock {
    /// The time now.
    pub fn time(&self) -> f64 {
        self.time_after(0)
    }

    /// The time so many frames from now.
    pub fn time_after(&self, n_frames: u64) -> f64 {
        self.base_time + (self.frame + n_frames - self.base_frame) as f64 * self.dt
    }

    /// Goes one frame on.
    pub fn tick(&mut self) {
        self.frame += 1;
    }

    /// The same instant with another length of frame.
    #[must_use]
    pub fn with_dt(self, dt: f64) -> Self {
        Self { dt, base_time: self.time(), base_frame: self.frame, ..self }
    }

    /// Time 0 with the same length of frame.
    #[must_use]
    pub fn at_start(self) -> Self {
        Self { dt: self.dt, ..Self::default() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_turns_of_frames_are_whole_times() {
        let mut clock = Clock::default().with_dt(1.0 / 360.0);
        (0..360_000).for_each(|_| clock.tick());
        assert_eq!(clock.time(), 1000.0);
    }

    #[test]
    fn a_new_frame_length_keeps_the_instant() {
        let mut clock = Clock::default().with_dt(0.1);
        (0..7).for_each(|_| clock.tick());
        let before = clock.time();
        assert_eq!(clock.with_dt(0.3).time(), before);
    }
}
