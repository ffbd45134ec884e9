//! Whether a pose that no step improves is a best fit: a minimum of the energy, and not a saddle.
//!
//! A compressed rod is soft across its direction, so where the constraints are not met the
//! curvature of the energy is that of all its rows: `J^T J + sum f hess f`. On the line of
//! centres of two rods that overlap it is negative across the line, though the slope is 0.

use super::limits::Limits;
use super::workspace::{Pose, Workspace};
use crate::solve::method::spectrum::noise;
use crate::solve::report::Counters;

/// What a pose without a way down turned out to be.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Finding {
    /// A minimum, to the last digits.
    Minimum,
    /// A saddle, or nearly one: the pose is a lower one now.
    Left,
    /// Neither could be shown.
    Unclear,
}

/// The slope at a minimum, relative to the root of twice the energy, is below this.
const LEVEL: f64 = 1e-10;
/// What may be left of it where rounding keeps it from falling further.
const NEARLY_LEVEL: f64 = 1e-9;
/// The energy that the model of second order could still gain, relative to what there is. The
/// slope alone is small on any slope that is only long, as where two lines nearly are one.
const FLAT: f64 = 1e-8;
/// A curvature that is negative by less than this part of what the rows can have is 0.
const ROUND: f64 = 1e-6;
/// The same in absolute terms: rounding.
const ROUNDING: f64 = 1e-13;
/// What is added to a curvature that is 0 where there is freedom left.
const FLOOR: f64 = 1e-11;
/// A step longer than this part of the size is taken that far.
const LONGEST_STEP: f64 = 0.1;
/// Newton steps for the last digits. They converge quadratically but for angles, whose distance
/// changes with the pose.
const MOST_STEPS: u32 = 40;
/// Inverse iterations for the most negative curvature; each gains about two digits.
const INVERSE_ITERATIONS: u32 = 6;
/// Where the search along it begins, and where it ends, relative to the size.
const SEARCH: std::ops::RangeInclusive<f64> = 1e-6..=0.5;

/// Examines a pose from which no step of first order leads down; its rows are those evaluated
/// last.
pub(crate) fn examine(
    workspace: &mut Workspace,
    pose: &mut Pose,
    limits: &Limits,
    work: &mut Counters,
) -> Finding {
    for _ in 0..MOST_STEPS {
        let energy = workspace.rows.energy;
        if !energy.is_finite() || energy == 0.0 {
            return Finding::Unclear;
        }
        let rms = (2.0 * energy / workspace.rows.n_active().max(1) as f64).sqrt();
        let negligible = (ROUND * rms / limits.size).max(ROUNDING);
        workspace.assemble_curvature(pose);
        workspace.update_slope();
        work.factorisations += 1;
        if workspace.matrix().factor(negligible).n_negative > 0 {
            return leave(workspace, pose, negligible, limits, work);
        }
        let steep = workspace.steepness();
        let gain = newton_step(workspace, work);
        let is_flat = gain <= FLAT * energy;
        if is_flat && steep <= LEVEL * (2.0 * energy).sqrt() {
            return Finding::Minimum;
        }
        workspace.remember(pose);
        // In a valley of little curvature the model leads too far, or to and fro between the walls.
        let reach = workspace.equations.reach(&workspace.step);
        let part = if is_flat { 1.0 } else { (LONGEST_STEP * limits.size / reach).min(1.0) };
        let lower = workspace.try_step(pose, part, work);
        workspace.update_slope();
        let is_downhill = !is_flat && lower < energy || workspace.steepness() <= 0.5 * steep;
        if lower > energy * (1.0 + FLAT) || !is_downhill {
            workspace.reject(pose, work);
            let is_level = steep <= NEARLY_LEVEL * (2.0 * energy).sqrt();
            return if is_flat && is_level { Finding::Minimum } else { Finding::Unclear };
        }
    }
    Finding::Unclear
}

/// The step to the minimum of the model; gives the energy it promises to gain.
fn newton_step(workspace: &mut Workspace, work: &mut Counters) -> f64 {
    work.factorisations += 1;
    let mut step = std::mem::take(&mut workspace.step);
    step.iter_mut().zip(&workspace.slope).for_each(|(s, g)| *s = -g);
    workspace.matrix().factor(FLOOR);
    workspace.matrix().solve(&mut step);
    workspace.step = step;
    0.5 * workspace.step.iter().zip(&workspace.slope).map(|(s, g)| -s * g).sum::<f64>()
}

/// Leaves a saddle along its most negative curvature, whichever way leads lower.
fn leave(
    workspace: &mut Workspace,
    pose: &mut Pose,
    negligible: f64,
    limits: &Limits,
    work: &mut Counters,
) -> Finding {
    let energy = workspace.rows.energy;
    most_negative(workspace, negligible, work);
    workspace.remember(pose);
    let along: f64 = workspace.step.iter().zip(&workspace.slope).map(|(s, g)| s * g).sum();
    let reach = workspace.equations.reach(&workspace.step);
    if reach <= 0.0 {
        return Finding::Unclear;
    }
    // Down the slope where there is one: a saddle left exactly has two ways that are as good.
    let way = if along > 0.0 { -1.0 } else { 1.0 };
    let (mut best, mut best_t) = (energy, 0.0);
    for way in [way, -way] {
        let mut far = *SEARCH.start() * limits.size;
        let mut last = energy;
        while far <= *SEARCH.end() * limits.size {
            let t = way * far / reach;
            let there = workspace.try_step(pose, t, work);
            if there < best {
                (best, best_t) = (there, t);
            }
            if there > last * (1.0 + FLAT) {
                break;
            }
            last = there;
            far *= 4.0;
        }
    }
    if best_t == 0.0 {
        workspace.reject(pose, work);
        return Finding::Unclear;
    }
    workspace.try_step(pose, best_t, work);
    Finding::Left
}

/// Puts the direction of the most negative curvature in the step.
fn most_negative(workspace: &mut Workspace, negligible: f64, work: &mut Counters) {
    // As far below 0 as the curvature is, to a factor of 2: just beyond it the matrix is
    // positive definite, and its inverse is large along that direction alone.
    let mut shift = 2.0 * negligible;
    for _ in 0..64 {
        work.factorisations += 1;
        if workspace.matrix().factor(shift).n_negative == 0 {
            break;
        }
        shift *= 2.0;
    }
    let mut y = std::mem::take(&mut workspace.step);
    for (k, y) in (0..).zip(&mut y) {
        *y = noise(k);
    }
    for _ in 0..INVERSE_ITERATIONS {
        workspace.matrix().solve(&mut y);
        let norm = y.iter().map(|y| y * y).sum::<f64>().sqrt();
        if norm > 0.0 && norm.is_finite() {
            y.iter_mut().for_each(|y| *y /= norm);
        }
    }
    workspace.step = y;
}
