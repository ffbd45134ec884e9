//! Motions followed in tiny steps, each as small as it takes to be sure of the branch.

use super::dense::{Factors, norm};
use super::plane::Place;
use super::scene::Scene;
use super::solve::SOLVED;

/// A mechanism on its way, with as many equations as coordinates.
pub struct Motion<'a> {
    scene: &'a Scene,
    pub x: Vec<Place>,
    pub time: f64,
    /// The time that the next step is to take.
    step: f64,
    /// The velocity before, and how long ago that was.
    before: Option<(Vec<f64>, f64)>,
    /// The smallest step that had to be taken.
    pub least_step: f64,
}

/// The longest step, time units, and the shortest before the motion counts as at its end.
const LONGEST: f64 = 0.05;
const SHORTEST: f64 = 1e-8;
/// A step has to end where its velocity and the one before expect it, to this part of its length.
const EXPECTED: f64 = 0.01;

impl<'a> Motion<'a> {
    /// From a solution at time 0.
    pub fn new(scene: &'a Scene, x: &[Place]) -> Self {
        let step = LONGEST;
        Self { scene, x: x.to_vec(), time: 0.0, step, before: None, least_step: LONGEST }
    }

    /// The velocities of the columns; none at a dead point.
    pub fn velocity(&self) -> Option<Vec<f64>> {
        let rows = self.scene.rows(&self.x, self.time);
        if rows.f.len() != self.scene.n_columns() {
            return None;
        }
        let wanted: Vec<f64> = rows.rate.iter().map(|rate| -rate).collect();
        let velocity = Factors::new(&rows.jacobian)?.solve(&wanted);
        velocity.iter().all(|v| v.is_finite()).then_some(velocity)
    }

    /// Follows the motion up to a time; false where it ends before, at a dead point.
    pub fn advance(&mut self, to: f64) -> bool {
        while self.time < to {
            let rest = to - self.time;
            // No step so short at the end that it says nothing.
            let h = if self.step > 0.7 * rest && self.step < rest {
                0.5 * rest
            } else {
                self.step.min(rest)
            };
            let Some(velocity) = self.velocity() else { return false };
            let mut way: Vec<f64> = velocity.iter().map(|v| v * h).collect();
            if let Some((before, ago)) = &self.before {
                for ((way, v), before) in way.iter_mut().zip(&velocity).zip(before) {
                    *way += 0.5 * h * h * (v - before) / ago;
                }
            }
            let expected = self.scene.moved(&self.x, &way);
            let end = if h < rest { self.time + h } else { to };
            let next = solved(self.scene, &expected, end);
            let is_expected = |next: &Vec<Place>| {
                let off = norm(&self.scene.way(&expected, next));
                off <= EXPECTED * norm(&way) + 1e-12 * self.scene.size(&self.x)
            };
            if let Some(next) = next.filter(is_expected) {
                self.before = Some((velocity, end - self.time));
                (self.x, self.time) = (next, end);
                self.least_step = self.least_step.min(h);
                self.step = (1.5 * h.max(self.step.min(rest))).min(LONGEST);
            } else {
                self.step = 0.4 * h;
                if self.step < SHORTEST {
                    return false;
                }
            }
        }
        true
    }
}

/// Newton's steps with a square matrix, as long as they arrive.
fn solved(scene: &Scene, x: &[Place], time: f64) -> Option<Vec<Place>> {
    let mut x = x.to_vec();
    let size = scene.size(&x);
    for _ in 0..8 {
        let rows = scene.rows(&x, time);
        if rows.f.len() != scene.n_columns() {
            return None;
        }
        let wanted: Vec<f64> = rows.f.iter().map(|f| -f).collect();
        let step = Factors::new(&rows.jacobian)?.solve(&wanted);
        x = scene.moved(&x, &step);
        if norm(&step) <= 1e-13 * size {
            break;
        }
    }
    (scene.violation(&x, time) <= SOLVED * size).then_some(x)
}
