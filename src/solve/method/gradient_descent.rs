//! The method `descent`: steepest descent on the normalised rows, with a line search.

use super::{Limits, Outcome, Pose, Workspace};
use crate::solve::island::Island;
use crate::solve::report::{Counters, Status};
use crate::solve::settings::Settings;

/// How often the parabola through what is known of the line is fitted anew.
const REFINEMENTS: u32 = 3;
/// Halvings before a direction counts as leading nowhere.
const MOST_HALVINGS: u32 = 40;

/// Descends in one round.
pub(crate) fn round(
    island: &mut Island,
    _: &Settings,
    limits: &Limits,
    work: &mut Counters,
) -> (Outcome, Option<f64>) {
    let outcome = island.with_workspace(|workspace, pose, _| solve(workspace, pose, limits, work));
    (outcome, None)
}

/// Improves a pose; gives how it ended.
fn solve(
    workspace: &mut Workspace,
    pose: &mut Pose,
    limits: &Limits,
    work: &mut Counters,
) -> Outcome {
    workspace.evaluate(pose, work);
    for n in 0..limits.n_iterations {
        if workspace.is_met(limits) {
            return workspace.outcome(Status::Converged, n);
        }
        if limits.budget.is_spent() {
            return workspace.outcome(Status::Stalled, n);
        }
        workspace.update_slope();
        let Workspace { step, slope, .. } = workspace;
        step.iter_mut().zip(&*slope).for_each(|(s, g)| *s = -g);
        if !search(workspace, pose, limits, work) {
            return workspace.outcome(Status::BestFit, n);
        }
    }
    let status = if workspace.is_met(limits) { Status::Converged } else { Status::Stalled };
    workspace.outcome(status, limits.n_iterations)
}

/// Goes to the lowest place along the step of the room; false if no place is lower.
pub(crate) fn search(
    workspace: &mut Workspace,
    pose: &mut Pose,
    limits: &Limits,
    work: &mut Counters,
) -> bool {
    workspace.remember(pose);
    let start = workspace.rows.energy;
    let along: f64 = workspace.step.iter().zip(&workspace.slope).map(|(s, g)| s * g).sum();
    let curvature = workspace.rows.curvature(&workspace.equations, &workspace.step);
    if along >= 0.0 || along.is_nan() {
        return false;
    }
    let longest = 0.1 * limits.size / workspace.equations.reach(&workspace.step);
    let mut t = if curvature > 0.0 { (-along / curvature).min(longest) } else { longest };
    let mut best = (0.0, start);
    for _ in 0..REFINEMENTS {
        let energy = workspace.try_step(pose, t, work);
        if energy < best.1 {
            best = (t, energy);
        }
        // The parabola through the start, its slope there, and this place.
        let bend = energy - start - along * t;
        let next = if bend > 0.0 && energy.is_finite() {
            (-0.5 * along * t * t / bend).min(longest)
        } else {
            0.25 * t
        };
        if (next - t).abs() <= 1e-3 * t {
            break;
        }
        t = next;
    }
    for _ in 0..MOST_HALVINGS {
        if best.0 > 0.0 {
            break;
        }
        t *= 0.5;
        let energy = workspace.try_step(pose, t, work);
        if energy < start {
            best = (t, energy);
        }
    }
    if best.0 == 0.0 {
        workspace.reject(pose, work);
        return false;
    }
    workspace.try_step(pose, best.0, work);
    true
}
