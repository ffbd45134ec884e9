//! What drives a motor, and where that leads.

use std::f64::consts::TAU;
use std::sync::Arc;

use super::content::add_all;
use super::geometry::{Vector, wrap, wrap_near};
use super::heading::Heading;
use super::sines::sines_and_cosines;
use super::turns::Turns;

/// The values of a motor: a radius, a phase in radians, speeds in radians per time unit.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Drive {
    pub radius: f64,
    pub phase: f64,
    pub speed: f64,
    /// The mean of the speed over the present frame, where it changes in time.
    pub mean_speed: f64,
    /// The angle that the last step of time made at this speed, and the same in turns.
    step: (f64, Turns),
}

impl Drive {
    /// One whose speed is its mean.
    pub fn new(radius: f64, phase: f64, speed: f64) -> Self {
        Self { radius, phase, speed, mean_speed: speed, step: (0.0, Turns::default()) }
    }

    /// Whether it turns.
    pub fn turns(&self) -> bool {
        self.mean_speed != 0.0
    }

    /// Whether its last frame was as long as that.
    pub fn is_under_way(&self, dt: f64) -> bool {
        let step = self.mean_speed * dt;
        !self.turns() || step != 0.0 && step == self.step.0
    }

    /// How far it turns in `dt`; none if it stands still.
    pub fn step(self: &mut Arc<Self>, dt: f64) -> Option<Turns> {
        let step = self.mean_speed * dt;
        if step == 0.0 {
            return None;
        }
        if step != self.step.0 {
            Arc::make_mut(self).step = (step, Turns::from_radians(step));
        }
        Some(self.step.1)
    }

    /// The angle without whole turns once it has turned so far, radians.
    pub fn angle_at(&self, turned: Turns) -> f64 {
        wrap(self.phase + turned.angle())
    }

    /// Where it points once it has turned so far.
    pub fn heading_at(&self, turned: Turns) -> Heading {
        Heading { turned, target: Vector::polar(self.radius, self.angle_at(turned)) }
    }

    /// All that matters of it: the mean speed and the step of time are made anew where they differ.
    pub fn content(&self, word: &mut impl FnMut(u64)) {
        let Self { radius, phase, speed, mean_speed: _, step: _ } = self;
        add_all([*radius, *speed, *phase], word);
    }

    /// Where it points after each of so many equal steps: the coordinates of its targets.
    #[allow(clippy::inline_always, reason = "it becomes part of who calls it, with its vectors")]
    #[inline(always)]
    #[allow(clippy::needless_range_loop, reason = "one loop over all, that vectors are made of")]
    pub fn targets<const N: usize>(&self, from: Turns, step: Turns) -> [[f64; N]; 2] {
        let mut angles = [0.0; N];
        for l in 0..N {
            angles[l] = self.phase + from.plus_times(step, l + 1).angle();
        }
        if self.phase.abs() <= 0.9 * TAU {
            angles = angles.map(wrap_near);
        } else {
            angles = angles.map(wrap);
        }
        let [sines, cosines] = sines_and_cosines(&angles);
        [cosines, sines].map(|parts| parts.map(|part| self.radius * part))
    }
}
