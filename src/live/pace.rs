//! How many frames are to pass between two looks at the clock on the wall.

/// Time that passes, so many seconds of the mechanism a second.
#[derive(Debug, Clone, Copy)]
pub struct Pace {
    /// Seconds of the mechanism a second.
    pub speed: f64,
    /// When the clock was looked at last, seconds.
    last: Option<f64>,
    /// Time that is due and has not passed, seconds of the mechanism.
    due: f64,
    /// Frames that may pass at once.
    most: u32,
    /// How many did, the last time.
    n_last: u32,
}

/// What is due longer than that is let go: a mechanism that takes long to solve runs slower.
const LONGEST: f64 = 0.1;
/// Frames that may pass at once, at most.
const MOST: u32 = 64;
/// Between two looks there should be less time than this, seconds.
const SLOW: f64 = 0.04;
/// Frames that take about so long pass at once, seconds: no display shows more of them.
const TOGETHER: f64 = 0.008;

impl Pace {
    /// From the next look on.
    pub const fn new(speed: f64) -> Self {
        Self { speed, last: None, due: 0.0, most: 4, n_last: 0 }
    }

    /// How many frames of `dt` are due; `now` is what the clock shows.
    pub fn due(&mut self, now: f64, dt: f64) -> u32 {
        let Some(last) = self.last.replace(now) else { return 0 };
        let gone = (now - last).max(0.0);
        // Where frames took too long fewer pass at once.
        if gone > SLOW {
            if self.n_last > 1 {
                self.most = (self.most / 2).max(1);
            }
        } else {
            self.most = (self.most + 1).min(MOST);
        }
        self.due = (self.due + gone * self.speed).min((LONGEST * self.speed).max(dt));
        let n = ((self.due / dt) as u32).min(self.most);
        let n = if f64::from(n) < self.together(dt).min(self.most.into()) { 0 } else { n };
        self.due -= f64::from(n) * dt;
        self.n_last = n;
        n
    }

    /// How long it is until frames of `dt` are due, seconds; `now` is what the clock shows.
    pub fn until_due(&self, now: f64, dt: f64) -> f64 {
        let Some(last) = self.last else { return 0.0 };
        let left = self.together(dt).min(self.most.into()) * dt - self.due;
        (left / self.speed - (now - last)).clamp(0.0, LONGEST)
    }

    /// How many frames pass at once, if time passes as it should.
    fn together(&self, dt: f64) -> f64 {
        (TOGETHER * self.speed / dt).round().max(1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_are_those_of_the_time_that_went_by() {
        let mut pace = Pace::new(1.0);
        let dt = 1.0 / 60.0;
        let n: u32 = (0..=240).map(|k| pace.due(f64::from(k) / 120.0, dt)).sum();
        assert!((119..=120).contains(&n), "{n}");
        let mut slow = Pace::new(0.25);
        let n: u32 = (0..=240).map(|k| slow.due(f64::from(k) / 120.0, dt)).sum();
        assert!((29..=30).contains(&n), "{n}");
    }

    #[test]
    fn who_waits_until_frames_are_due_sees_them_at_even_times() {
        for (speed, dt, every) in
            [(1.0, 1.0 / 60.0, 1.0 / 60.0), (4.0, 0.001, 0.008), (0.5, 0.01, 0.02)]
        {
            let mut pace = Pace::new(speed);
            let (mut now, mut passed) = (0.0, Vec::new());
            while now < 1.0 {
                if pace.due(now, dt) > 0 {
                    passed.push(now);
                }
                // Now and then something else is heard meanwhile.
                let wait = pace.until_due(now, dt);
                now += if wait > 0.005 { 0.3 * wait } else { wait.max(1e-9) };
            }
            let even = passed.windows(2).all(|pair| (pair[1] - pair[0] - every).abs() < 1e-6);
            assert!(even && passed.len() as f64 > 0.9 / every, "{passed:?}");
        }
    }

    #[test]
    fn time_that_nobody_can_keep_up_with_is_let_go() {
        let mut pace = Pace::new(1.0);
        // A look takes a second: one frame of a sixtieth each.
        let n: u32 = (0..100).map(|k| pace.due(f64::from(k), 1.0 / 60.0)).sum();
        assert!(n < 110, "{n}");
        // A clock that is set back lets no time pass.
        assert_eq!(pace.due(0.0, 1.0), 0);
    }

    #[test]
    fn a_long_frame_passes_when_its_time_has_come() {
        let mut pace = Pace::new(1.0);
        let n: u32 = (0..=100).map(|k| pace.due(f64::from(k) / 50.0, 0.5)).sum();
        assert!((3..=4).contains(&n), "{n}");
    }
}
