//! Whether a few constraints can hold by themselves.

use super::projector::Projector;
use super::scene::Scene;
use crate::constraint::{Point, Relation};

const N_STEPS: usize = 40;

/// A step that promises no more than this part of the energy leads nowhere: a best fit. Near a
/// pose where all holds, a step promises nearly all of it.
const NOWHERE: f64 = 1e-6;

/// Whether these constraints can hold, from this pose, when all others are forgotten: damped
/// Gauss-Newton steps bring their distances below `tolerance`.
pub fn can_hold_alone(scene: &Scene, constraints: &[usize], tolerance: f64) -> bool {
    let mut points: Vec<_> =
        constraints.iter().flat_map(|&c| scene.constraints[c].points()).copied().collect();
    points.sort_unstable();
    points.dedup();
    points.retain(|&p| scene.w[p as usize] > 0.0);
    let mut x = scene.x.to_vec();
    let mut here = Scene { x: &x, ..*scene }.rows_over(points.clone(), constraints);
    let mut mu = 1e-6;
    for _ in 0..N_STEPS {
        if here.worst() <= tolerance {
            return true;
        }
        let mut downhill = vec![0.0; here.n_unknowns()];
        here.rows.iter().for_each(|row| row.add_to(-row.f, &mut downhill));
        let mut step = downhill.clone();
        Projector::of(&here).solve_damped(mu, &mut step);
        let promised: f64 = 0.5 * step.iter().zip(&downhill).map(|(s, d)| s * d).sum::<f64>();
        if promised <= NOWHERE * here.energy() {
            return false;
        }
        let moves = scene.displacements(&points, &step);
        let moved: Vec<Point> = x.iter().zip(&moves).map(|(x, d)| *x + *d).collect();
        let there = Scene { x: &moved, ..*scene }.rows_over(points.clone(), constraints);
        if there.energy() < here.energy() {
            (x, here) = (moved, there);
            mu = (0.1 * mu).max(1e-12);
        } else {
            mu = (10.0 * mu).min(1.0);
        }
    }
    false
}
