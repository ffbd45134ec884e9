//! The method `conjugate`: nonlinear conjugate gradients with the step length of Gauss-Newton
//! and the stiffness of stretched lengths. Needs no coefficient.

use super::{Limits, Outcome, Pose, Workspace};
use crate::solve::island::Island;
use crate::solve::report::{Counters, Status};
use crate::solve::settings::Settings;

/// A step longer than this part of the size is no longer a small change.
const LONGEST_STEP: f64 = 0.1;
/// A direction that is this far from down, relative to steepest, leads nowhere.
const LEAST_FACTOR: f64 = 1e-10;

/// A gain below this part of the energy is lost in its rounding.
const INVISIBLE: f64 = 1e-17;

/// Descends along conjugate directions in one round.
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
pub(crate) fn solve(
    workspace: &mut Workspace,
    pose: &mut Pose,
    limits: &Limits,
    work: &mut Counters,
) -> Outcome {
    workspace.evaluate(pose, work);
    workspace.update_slope();
    let restart = 2 * workspace.slope.len() as u32;
    let mut before = vec![0.0; workspace.slope.len()];
    // What the step is shortened by after a restart that went up.
    let mut factor = 1.0;
    let mut n_since = 0;
    steepest(workspace);
    for n in 0..limits.n_iterations {
        if workspace.is_met(limits) {
            return workspace.outcome(Status::Converged, n);
        }
        if limits.budget.is_spent() {
            return workspace.outcome(Status::Stalled, n);
        }
        if factor < LEAST_FACTOR {
            return workspace.outcome(Status::BestFit, n);
        }
        let mut along: f64 = dot(&workspace.step, &workspace.slope);
        if along >= 0.0 || n_since > restart {
            steepest(workspace);
            along = -dot(&workspace.slope, &workspace.slope);
            n_since = 0;
        }
        let curvature = workspace.rows.curvature(&workspace.equations, &workspace.step);
        if !(along < 0.0 && curvature > 0.0) {
            return workspace.outcome(Status::BestFit, n);
        }
        let longest = workspace.longest_step(LONGEST_STEP, limits)
            / workspace.equations.reach(&workspace.step);
        let t = factor * (-along / curvature).min(longest);
        let start = workspace.rows.energy;
        if -along * t < INVISIBLE * start {
            return workspace.outcome(Status::BestFit, n);
        }
        workspace.remember(pose);
        if workspace.try_step(pose, t, work) > start {
            workspace.reject(pose, work);
            steepest(workspace);
            factor *= 0.5;
            n_since = 0;
            continue;
        }
        factor = (2.0 * factor).min(1.0);
        before.copy_from_slice(&workspace.slope);
        workspace.update_slope();
        // Polak and Ribiere, restarted where it would turn round.
        let square = dot(&before, &before);
        let beta =
            (dot(&workspace.slope, &workspace.slope) - dot(&workspace.slope, &before)) / square;
        let beta = if beta > 0.0 { beta } else { 0.0 };
        let Workspace { step, slope, .. } = workspace;
        step.iter_mut().zip(&*slope).for_each(|(p, g)| *p = beta * *p - g);
        n_since += 1;
    }
    let status = if workspace.is_met(limits) { Status::Converged } else { Status::Stalled };
    workspace.outcome(status, limits.n_iterations)
}

/// Aims straight down.
fn steepest(workspace: &mut Workspace) {
    let Workspace { step, slope, .. } = workspace;
    step.iter_mut().zip(&*slope).for_each(|(p, g)| *p = -g);
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
