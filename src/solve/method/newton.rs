//! The method `newton`: Levenberg-Marquardt on normalised rows, with the stiffness that a
//! stretched length has across its direction.

use super::{Limits, Outcome, Pose, Workspace};
use crate::constraint::Point;
use crate::solve::island::Island;
use crate::solve::report::{Counters, Status};
use crate::solve::settings::Settings;

/// The damping, relative to the distance to satisfaction, that a solve begins with; measured
/// best among powers of ten on mechanisms. Larger is slower, smaller overshoots more often.
const FIRST_DAMPING: f64 = 1e-2;
/// Damping never falls below this share of the distance to satisfaction.
const LEAST_DAMPING: f64 = 1e-6;
/// What is added to the matrix even at the solution. Rank-deficient systems need it to have
/// a factor; it is far below the smallest square of a singular value that matters.
const FLOOR: f64 = 1e-11;
/// A step longer than this part of the size is no longer a small change.
const LONGEST_STEP: f64 = 0.5;
/// Steps that gain less of what they promise are taken in part, or back.
const LEAST_GAIN: f64 = 1e-4;
/// A part of a step is taken where all of it leads up, if it gains at least this much of what that
/// part promises.
const WORTHWHILE: f64 = 0.25;
/// With this much damping steps vanish in rounding: there is no way down.
const MOST_DAMPING: f64 = 1e8;
/// A step that lowers the energy by less than this part makes us ask for a best fit.
const SLOW: f64 = 1e-2;
/// The energy that the undamped model could still gain, relative to what there is, at a best
/// fit. The gradient's norm would not tell: it is small on any ill-conditioned slope too.
const FLAT: f64 = 1e-8;
/// Steps taken at a best fit for the last digits; convergence is quadratic there.
const POLISHES: u32 = 2;

/// Takes damped Gauss-Newton steps in one round.
pub(crate) fn round(
    island: &mut Island,
    _: &Settings,
    limits: &Limits,
    work: &mut Counters,
) -> (Outcome, Option<f64>) {
    let outcome = island.with_workspace(|workspace, pose, _| solve(workspace, pose, limits, work));
    (outcome, None)
}

/// Improves a pose until it is solved, a best fit, or the limits are reached.
pub(crate) fn solve(
    workspace: &mut Workspace,
    pose: &mut Pose,
    limits: &Limits,
    work: &mut Counters,
) -> Outcome {
    let mut nu = FIRST_DAMPING;
    let mut n = 0;
    loop {
        let left = Limits { n_iterations: limits.n_iterations - n, ..*limits };
        let end = descend(workspace, pose, &left, &mut nu, &mut n, work);
        let status = match end {
            End::Met => Status::Converged,
            _ if is_best_fit(workspace, pose, work) => Status::BestFit,
            End::Slow => continue,
            End::Stuck | End::Spent => Status::Stalled,
        };
        return workspace.outcome(status, n);
    }
}

/// Improves a pose as long as that goes fast: no question is asked about why it does not.
pub(crate) fn solve_near(
    workspace: &mut Workspace,
    pose: &mut Pose,
    limits: &Limits,
    work: &mut Counters,
) -> Outcome {
    let (mut nu, mut n) = (FIRST_DAMPING, 0);
    let end = descend(workspace, pose, limits, &mut nu, &mut n, work);
    let status = if end == End::Met { Status::Converged } else { Status::Stalled };
    workspace.outcome(status, n)
}

/// A step from an expected pose that also takes back whatever way from `origin` the rows do
/// not ask for; `workspace` holds the rows at that pose. False, and the pose is to be thrown away,
/// if it ends above `energy`.
///
/// The damping mu y pulls toward the origin here, mu (y + x - origin), and not toward the
/// expected pose: no matter how small mu is, what the rows leave open follows it entirely.
pub(crate) fn project_prediction(
    workspace: &mut Workspace,
    pose: &mut Pose,
    origin: &[Point],
    energy: f64,
    limits: &Limits,
    work: &mut Counters,
) -> bool {
    workspace.assemble();
    workspace.update_slope();
    workspace.remember(pose);
    let rms = (2.0 * workspace.rows.energy / workspace.rows.n_active().max(1) as f64).sqrt();
    let mu = FIRST_DAMPING * (rms / limits.size).min(1.0) + FLOOR;
    let mut way = std::mem::take(&mut workspace.trial_step);
    workspace.equations.way(origin, &workspace.before, &mut way);
    workspace.slope.iter_mut().zip(&way).for_each(|(g, y)| *g += mu * y);
    workspace.trial_step = way;
    solve_step(workspace, mu, work).is_some() && workspace.try_step(pose, 1.0, work) <= energy
}

/// Why a descent ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum End {
    /// Everything holds.
    Met,
    /// The last step gained next to nothing.
    Slow,
    /// No step gains anything.
    Stuck,
    /// The limits are reached.
    Spent,
}

/// Takes damped steps until there is a reason to stop; adds up their number in `n`.
fn descend(
    workspace: &mut Workspace,
    pose: &mut Pose,
    limits: &Limits,
    nu: &mut f64,
    n: &mut u32,
    work: &mut Counters,
) -> End {
    workspace.evaluate(pose, work);
    let most = *n + limits.n_iterations;
    loop {
        if workspace.is_met(limits) {
            return End::Met;
        }
        if *n >= most || !workspace.rows.energy.is_finite() || limits.budget.is_spent() {
            return End::Spent;
        }
        let before = workspace.rows.energy;
        workspace.assemble();
        workspace.update_slope();
        workspace.remember(pose);
        let rms = (2.0 * before / workspace.rows.n_active().max(1) as f64).sqrt();
        let unit = (rms / limits.size).min(1.0);
        loop {
            let Some(promised) = solve_step(workspace, *nu * unit + FLOOR, work) else {
                return End::Stuck;
            };
            *n += 1;
            let longest = workspace.longest_step(LONGEST_STEP, limits);
            let is_near = workspace.equations.reach(&workspace.step) <= longest;
            let energy = if is_near { workspace.try_step(pose, 1.0, work) } else { f64::INFINITY };
            let gain = (before - energy) / promised;
            if gain > LEAST_GAIN {
                if gain > 0.75 {
                    *nu = (*nu / 4.0).max(LEAST_DAMPING);
                } else if gain < 0.25 {
                    *nu = (*nu * 4.0).max(1e-3);
                }
                break;
            }
            if is_near && energy.is_finite() {
                let part = shorter(before, promised, energy);
                let shortened = part * (2.0 - part) * promised;
                if before - workspace.try_step(pose, part, work) > WORTHWHILE * shortened {
                    break;
                }
            }
            if is_near {
                workspace.reject(pose, work);
            }
            *nu = (*nu * 4.0).max(1e-3);
            if *nu > MOST_DAMPING {
                return End::Stuck;
            }
            if *n >= most {
                return End::Spent;
            }
        }
        if before - workspace.rows.energy < SLOW * before && !workspace.is_met(limits) {
            return End::Slow;
        }
    }
}

/// The part of a step that is best taken, if all of it leads from an energy to a higher one
/// instead of gaining what it promises.
///
/// What the rows leave out grows with the square of the step, its energy c t^4 with the fourth
/// power: E(t) = before - promised t (2 - t) + c t^4, least where promised (1 - t) = 2 c t^3.
fn shorter(before: f64, promised: f64, energy: f64) -> f64 {
    let c = energy - (before - promised);
    let ratio = 2.0 * c / promised;
    // From above, where the cubic is convex.
    let mut t = libm::cbrt(ratio).recip().min(1.0);
    for _ in 0..4 {
        t -= (ratio * t * t * t + t - 1.0) / (3.0 * ratio * t * t + 1.0);
    }
    t
}

/// Works out the step for a damping; gives the energy it promises to gain, none if the rows
/// ask for nothing.
fn solve_step(workspace: &mut Workspace, mu: f64, work: &mut Counters) -> Option<f64> {
    work.factorisations += 1;
    let Workspace { step, slope, .. } = workspace;
    step.iter_mut().zip(&*slope).for_each(|(s, g)| *s = -g);
    let mut step = std::mem::take(&mut workspace.step);
    let matrix = workspace.matrix();
    matrix.factor(mu);
    matrix.solve(&mut step);
    workspace.step = step;
    // From (H + mu) y = -g: -g y - y H y / 2 = (-g y + mu y y) / 2.
    let along: f64 = workspace.step.iter().zip(&workspace.slope).map(|(s, g)| -s * g).sum();
    let square: f64 = workspace.step.iter().map(|s| s * s).sum();
    let promised = 0.5 * (along + mu * square);
    (promised > 0.0).then_some(promised)
}

/// Whether no small move would lower the energy any further. If so, the last digits of the
/// pose are got too: what they gain is too little to show in the energy, but the slope shows it.
fn is_best_fit(workspace: &mut Workspace, pose: &mut Pose, work: &mut Counters) -> bool {
    let energy = workspace.rows.energy;
    if !energy.is_finite() {
        return false;
    }
    workspace.assemble();
    workspace.update_slope();
    for _ in 0..=POLISHES {
        let Some(gain) = solve_step(workspace, FLOOR, work) else { return true };
        if gain > FLAT * energy {
            return false;
        }
        let before = steepness(workspace);
        workspace.remember(pose);
        if workspace.try_step(pose, 1.0, work) > energy * (1.0 + FLAT) {
            workspace.reject(pose, work);
            return true;
        }
        workspace.assemble();
        workspace.update_slope();
        if steepness(workspace) >= before {
            workspace.reject(pose, work);
            return true;
        }
    }
    true
}

/// The squared norm of the slope.
fn steepness(workspace: &Workspace) -> f64 {
    workspace.slope.iter().map(|g| g * g).sum()
}

#[cfg(test)]
mod tests {
    use super::shorter;

    #[test]
    fn a_step_is_shortened_to_where_the_energy_is_least() {
        let (before, promised, energy) = (1.0, 0.9, 70.0);
        let c = energy - (before - promised);
        let at = |t: f64| before - promised * t * (2.0 - t) + c * (t * t) * (t * t);
        let best = shorter(before, promised, energy);
        assert!((at(1.0) - energy).abs() < 1e-12);
        assert!(at(best) < before && at(best) < at(0.999 * best) && at(best) < at(1.001 * best));
    }
}
