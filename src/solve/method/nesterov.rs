//! The method `nesterov`: descent with momentum, restarted whenever it turns against itself.

use super::spectrum::Spectrum;
use super::{Limits, Outcome, Pose, Workspace};
use crate::constraint::{Point, Vector};
use crate::solve::island::Island;
use crate::solve::report::{Counters, Status};
use crate::solve::settings::Settings;
use crate::world::PointId;

/// A pose that moves by less, relative to the size, has come to rest.
const STILL: f64 = 1e-15;

/// A step of descent longer than this part of the size is no longer a small change.
const LONGEST_STEP: f64 = 0.1;

/// Descends with momentum in one round.
pub(crate) fn round(
    island: &mut Island,
    _: &Settings,
    limits: &Limits,
    work: &mut Counters,
) -> (Outcome, Option<f64>) {
    let outcome = island
        .with_workspace(|workspace, pose, points| solve(workspace, points, pose, limits, work));
    (outcome, None)
}

/// Improves a pose; gives how it ended.
fn solve(
    workspace: &mut Workspace,
    points: &[PointId],
    pose: &mut Pose,
    limits: &Limits,
    work: &mut Counters,
) -> Outcome {
    workspace.evaluate(pose, work);
    let mut spectrum = Spectrum::new(points);
    let mut here: Vec<Point> = Vec::new();
    workspace.equations.gather(pose.x, &mut here);
    let energy_at_start = workspace.rows.energy;
    // Momentum may lead up for as long as it likes: the distance that belongs to an angle grows
    // with the way out. It then ends at the best pose on its way.
    let (mut best, mut energy_at_best) = (here.clone(), energy_at_start);
    let mut last = here.clone();
    let mut momentum = 1.0_f64;
    for n in 0..limits.n_iterations {
        if workspace.is_met(limits) {
            return workspace.outcome(Status::Converged, n);
        }
        let largest = spectrum.largest(&workspace.equations, &workspace.rows, |_| 1.0);
        if limits.budget.is_spent() || largest <= 0.0 {
            return workspace.outcome(Status::Stalled, n);
        }
        // A step of descent from the extrapolated pose.
        workspace.update_slope();
        workspace.remember(pose);
        let Workspace { step, slope, .. } = workspace;
        step.iter_mut().zip(&*slope).for_each(|(s, g)| *s = -g / largest);
        let longest = workspace.longest_step(LONGEST_STEP, limits);
        let t = (longest / workspace.equations.reach(&workspace.step)).min(1.0);
        if !workspace.equations.displace(pose.x, &workspace.before, &workspace.step, t) {
            workspace.reject(pose, work);
            return workspace.outcome(Status::Stalled, n);
        }
        workspace.equations.gather(pose.x, &mut here);
        // Uphill of where momentum carries us: stop and begin anew.
        let moved = |k: usize| -> Vector { here[k] - last[k] };
        let stepped = |k: usize| -> Vector { here[k] - workspace.before[k] };
        let uphill: f64 = (0..here.len()).map(|k| -stepped(k).dot(moved(k))).sum();
        let longest = (0..here.len()).fold(0.0_f64, |most, k| most.max(moved(k).norm()));
        if longest <= STILL * limits.size {
            workspace.evaluate(pose, work);
            return workspace.outcome(Status::BestFit, n + 1);
        }
        let next = if uphill > 0.0 { 1.0 } else { 0.5 + (0.25 + momentum * momentum).sqrt() };
        let beta = if uphill > 0.0 { 0.0 } else { (momentum - 1.0) / next };
        momentum = next;
        for (k, &p) in workspace.equations.points().iter().enumerate() {
            pose.x[p as usize] = here[k] + moved(k) * beta;
        }
        std::mem::swap(&mut last, &mut here);
        workspace.evaluate(pose, work);
        if workspace.rows.energy < energy_at_best {
            energy_at_best = workspace.rows.energy;
            workspace.equations.gather(pose.x, &mut best);
        }
    }
    // The pose it stands for is the one without the momentum, if that is better.
    let extrapolated = workspace.rows.worst;
    workspace.equations.gather(pose.x, &mut here);
    workspace.equations.scatter(&last, pose.x);
    workspace.evaluate(pose, work);
    if extrapolated < workspace.rows.worst {
        workspace.equations.scatter(&here, pose.x);
        workspace.evaluate(pose, work);
    }
    if workspace.rows.energy.is_nan() || workspace.rows.energy > energy_at_start {
        workspace.equations.scatter(&best, pose.x);
        workspace.evaluate(pose, work);
    }
    let status = if workspace.is_met(limits) { Status::Converged } else { Status::Stalled };
    workspace.outcome(status, limits.n_iterations)
}
