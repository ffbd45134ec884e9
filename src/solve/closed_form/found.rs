//! What running the list of steps came to.

use crate::solve::frame::branch::SENSITIVE;

/// What a frame came to.
#[derive(Clone, Copy)]
pub(crate) struct Found {
    /// The largest distance to satisfaction.
    pub worst: f64,
    /// How near the pose is to a singular one, as the square of the sine of an angle.
    pub least_side_squared: f64,
}

impl Found {
    /// What no step has added to.
    pub const NOTHING: Self = Self { worst: 0.0, least_side_squared: 1.0 };

    /// Whether errors grow at the pose, so that they are to be looked at.
    pub fn is_sensitive(&self) -> bool {
        self.least_side_squared < SENSITIVE * SENSITIVE
    }

    /// Takes in a distance to satisfaction, which may have a sign.
    #[inline]
    pub fn add(&mut self, off: f64) {
        let off = off.abs();
        // What is not a number stays: it meets nothing.
        if off > self.worst || off.is_nan() {
            self.worst = off;
        }
    }

    /// Takes in the square of the sine of an angle.
    #[inline]
    pub fn add_side(&mut self, squared: f64) {
        if squared < self.least_side_squared {
            self.least_side_squared = squared;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_a_number_meets_nothing() {
        for places in [[f64::NAN, 1e-20], [1e-20, f64::NAN]] {
            let mut found = Found::NOTHING;
            places.into_iter().for_each(|off| found.add(off));
            assert!(found.worst.is_nan());
        }
    }
}
