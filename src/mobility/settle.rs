//! Solving a few constraints by themselves, some of them counted less than others.

use super::projector::Projector;
use super::system::{ConstraintSystem, UnitRows};
use crate::constraint::{ConstraintKind, Point, PointIdx};

const N_STEPS: usize = 40;

/// A step that promises no more than this part of the energy leads nowhere: a best fit. Near a
/// pose where all holds, a step promises nearly all of it.
const NOWHERE: f64 = 1e-6;
/// The same where something that counts little keeps nearly all of the energy.
const NOWHERE_NEARLY: f64 = 1e-15;

/// Some constraints of a scene and the points of theirs that move.
pub struct Subset<'a> {
    scene: ConstraintSystem<'a>,
    constraints: &'a [usize],
    points: Vec<PointIdx>,
}

/// A pose that was reached, and how far it is from satisfying each constraint alike.
pub struct Reached {
    /// The positions of all points of the scene.
    pub x: Vec<Point>,
    /// The largest distance to satisfaction of what was counted, length units.
    pub worst: f64,
}

impl<'a> Subset<'a> {
    /// These constraints of a scene, given by their places in it, ascending.
    pub fn new(scene: ConstraintSystem<'a>, constraints: &'a [usize]) -> Self {
        let held = constraints.iter().flat_map(|&c| scene.constraints[c].points());
        let mut points: Vec<_> = held.copied().collect();
        points.sort_unstable();
        points.dedup();
        points.retain(|&p| scene.w[p as usize] > 0.0);
        Self { scene, constraints, points }
    }

    /// Moves the points from `x` towards where all constraints hold, by damped Gauss-Newton
    /// steps. Those of `light` count as that part of the others; 0: not at all.
    pub fn settle(&self, mut x: Vec<Point>, light: (usize, f64), tolerance: f64) -> Reached {
        let mut here = self.rows(&x, light);
        let mut mu = 1e-6;
        for _ in 0..N_STEPS {
            if here.worst() <= tolerance {
                break;
            }
            let mut downhill = vec![0.0; here.n_unknowns()];
            here.rows.iter().for_each(|row| row.add_to(-row.f, &mut downhill));
            let mut step = downhill.clone();
            Projector::of(&here).solve_damped(mu, &mut step);
            let promised: f64 = 0.5 * step.iter().zip(&downhill).map(|(s, d)| s * d).sum::<f64>();
            let nowhere = if light.1 == 1.0 { NOWHERE } else { NOWHERE_NEARLY };
            if promised <= nowhere * here.energy() {
                break;
            }
            let moves = self.scene.displacements(&self.points, &step);
            let moved: Vec<Point> = x.iter().zip(&moves).map(|(x, d)| *x + *d).collect();
            let there = self.rows(&moved, light);
            if there.energy() < here.energy() {
                (x, here) = (moved, there);
                mu = (0.1 * mu).max(1e-12);
            } else {
                mu = (10.0 * mu).min(1.0);
            }
        }
        Reached { x, worst: here.worst() }
    }

    fn rows(&self, x: &[Point], (which, counts): (usize, f64)) -> UnitRows {
        let here = ConstraintSystem { x, ..self.scene };
        let mut rows = here.rows_over(self.points.clone(), self.constraints);
        if counts == 0.0 {
            rows.rows.retain(|row| row.source.0 != which);
        } else {
            rows.rows.iter_mut().filter(|row| row.source.0 == which).for_each(|r| r.count(counts));
        }
        rows
    }
}

/// Whether these constraints can hold, from this pose, when all others are forgotten.
pub fn can_hold_alone(scene: &ConstraintSystem, constraints: &[usize], tolerance: f64) -> bool {
    let subset = Subset::new(*scene, constraints);
    subset.settle(scene.x.to_vec(), (usize::MAX, 1.0), tolerance).worst <= tolerance
}
