//! The method `newton`: Levenberg-Marquardt on normalised rows, with the stiffness that a
//! stretched length has across its direction.

use super::minimum::{self, Finding};
use super::{Limits, Outcome, Pose, Stiffness, Workspace};
use crate::constraint::Point;
use crate::solve::island::Island;
use crate::solve::report::{Counters, Status};
use crate::solve::settings::Settings;

/// The damping, relative to the distance to satisfaction, that a solve begins with; measured
/// best among powers of ten on mechanisms. Larger is slower, smaller overshoots more often.
const FIRST_DAMPING: f64 = 1e-2;
/// Damping never falls below this share of the distance to satisfaction: rounding of the slope,
/// divided by the damping, is what a step does to what the rows leave open.
const LEAST_DAMPING: f64 = 1e-3;
/// The same where stretched lengths leave little open.
const LEAST_DAMPING_STRETCHED: f64 = 1e-6;
/// What is added to the matrix even at the solution. Rank-deficient systems need it to have
/// a factor; it is far below the smallest square of a singular value that matters.
const FLOOR: f64 = 1e-11;
/// The same where a solution is refined: it is near, and so is the rounding of its slope.
const REFINED_FLOOR: f64 = 1e-14;
/// What is off by no more than this part of the size, and yet comes nearer slowly, has rows that
/// become dependent at the solution: their singular values are the roots of what they are off.
const NEAR: f64 = 1e-8;
/// How many steps a refinement takes at most; it converges quadratically.
const MOST_REFINED: u32 = 8;
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
/// How many saddles are left in one solve.
const MOST_LEFT: u32 = 20;

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
    let mut way = Way::new();
    let mut n_left = MOST_LEFT;
    loop {
        let end = descend(workspace, pose, limits, &mut way, work);
        let status = match end {
            End::Met => Status::Converged,
            _ if !is_flat(workspace, work) => match end {
                End::Slow => continue,
                _ => Status::Stalled,
            },
            _ => match minimum::examine(workspace, pose, limits, work) {
                Finding::Minimum => Status::BestFit,
                Finding::Left if n_left > 0 && !limits.budget.is_spent() => {
                    n_left -= 1;
                    // What comes now is another way down, with its own limits.
                    way.begin_anew();
                    continue;
                }
                Finding::Left | Finding::Unclear => Status::Stalled,
            },
        };
        return workspace.outcome(status, way.n_iterations);
    }
}

/// Improves a pose as long as that goes fast: no question is asked about why it does not.
pub(crate) fn solve_near(
    workspace: &mut Workspace,
    pose: &mut Pose,
    limits: &Limits,
    work: &mut Counters,
) -> Outcome {
    let mut way = Way::new();
    let end = descend(workspace, pose, limits, &mut way, work);
    let status = if end == End::Met { Status::Converged } else { Status::Stalled };
    workspace.outcome(status, way.n_iterations)
}

/// Takes steps that are hardly damped from a solution, as long as each is less than half as long as
/// the one before. The tolerance is a part of the whole; what moves may be so small a part of it
/// that residuals far below still leave it open, and are less than the rounding of others: it is
/// the steps that tell, as long as everything still holds.
pub(crate) fn refine(
    workspace: &mut Workspace,
    pose: &mut Pose,
    limits: &Limits,
    work: &mut Counters,
) {
    workspace.evaluate(pose, work);
    let mut before = f64::INFINITY;
    for _ in 0..MOST_REFINED {
        workspace.assemble(Stiffness::None);
        workspace.update_slope();
        workspace.remember(pose);
        if solve_step(workspace, REFINED_FLOOR, work).is_none() {
            return;
        }
        let reach = workspace.equations.reach(&workspace.step);
        let is_nearer = reach < 0.5 * before && workspace.try_step(pose, 1.0, work).is_finite();
        if !is_nearer || !workspace.is_met(limits) {
            workspace.reject(pose, work);
            return;
        }
        before = reach;
    }
}

/// How long the shortest step is that meets the rows, if these go on as they are at a pose; `workspace` holds
/// them there.
pub(crate) fn shortest_step(workspace: &mut Workspace, work: &mut Counters) -> f64 {
    workspace.assemble(Stiffness::None);
    workspace.update_slope();
    // Rows that ask for nothing are met by no step at all.
    solve_step(workspace, FLOOR, work);
    workspace.step.iter().map(|s| s * s).sum::<f64>().sqrt()
}

/// How far a solve has come.
struct Way {
    stiffness: Stiffness,
    /// What is added to the matrix in any case.
    floor: f64,
    /// The damping, relative to the distance to satisfaction.
    nu: f64,
    n_iterations: u32,
    /// The iterations before the present way down.
    n_before: u32,
}

impl Way {
    /// A way begins with the shortest steps that meet the rows.
    fn new() -> Self {
        let (stiffness, floor) = (Stiffness::None, FLOOR);
        Self { stiffness, floor, nu: FIRST_DAMPING, n_iterations: 0, n_before: 0 }
    }

    fn least_damping(&self) -> f64 {
        match self.stiffness {
            Stiffness::None => LEAST_DAMPING,
            Stiffness::Stretched => LEAST_DAMPING_STRETCHED,
        }
    }

    fn begin_anew(&mut self) {
        *self =
            Self { n_iterations: self.n_iterations, n_before: self.n_iterations, ..Self::new() };
    }
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
    workspace.assemble(Stiffness::None);
    workspace.update_slope();
    workspace.remember(pose);
    let rms = (2.0 * workspace.rows.energy / workspace.rows.n_active().max(1) as f64).sqrt();
    let mu = FIRST_DAMPING * (rms / limits.size).min(1.0) + FLOOR;
    let mut way = std::mem::take(&mut workspace.trial_step);
    workspace.equations.way(origin, &workspace.before, &mut way);
    workspace.slope.iter_mut().zip(&way).for_each(|(g, y)| *g += mu * y);
    if solve_step(workspace, mu, work).is_none() {
        return false;
    }
    if workspace.equations.is_affine() {
        // An expectation may be exact, and mu next to nothing then.
        workspace.step.iter_mut().zip(&way).for_each(|(step, y)| *step += y);
        workspace.keep_to_rows();
        workspace.step.iter_mut().zip(&way).for_each(|(step, y)| *step -= y);
    }
    workspace.trial_step = way;
    workspace.try_step(pose, 1.0, work) <= energy
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

/// Takes damped steps until there is a reason to stop: the shortest that meet the rows, and where
/// those gain next to nothing such as know the stiffness of stretched lengths.
fn descend(
    workspace: &mut Workspace,
    pose: &mut Pose,
    limits: &Limits,
    way: &mut Way,
    work: &mut Counters,
) -> End {
    let is_slow = |end| matches!(end, End::Slow | End::Stuck);
    let mut end = descend_by(workspace, pose, limits, way, work);
    if is_slow(end) && way.floor == FLOOR && workspace.rows.worst <= NEAR * limits.size {
        way.floor = REFINED_FLOOR;
        way.nu = LEAST_DAMPING;
        end = descend_by(workspace, pose, limits, way, work);
    }
    if is_slow(end) && way.stiffness == Stiffness::None {
        way.stiffness = Stiffness::Stretched;
        way.nu = FIRST_DAMPING;
        return descend_by(workspace, pose, limits, way, work);
    }
    end
}

/// The same with one kind of steps.
fn descend_by(
    workspace: &mut Workspace,
    pose: &mut Pose,
    limits: &Limits,
    way: &mut Way,
    work: &mut Counters,
) -> End {
    workspace.evaluate(pose, work);
    let most = way.n_before.saturating_add(limits.n_iterations);
    let is_affine = workspace.equations.is_affine();
    loop {
        // Linear rows are met by one step, and to the last digits by a second.
        if workspace.is_met(limits) && !(is_affine && way.n_iterations == 1) {
            return End::Met;
        }
        if way.n_iterations >= most
            || !workspace.rows.energy.is_finite()
            || limits.budget.is_spent()
        {
            return End::Spent;
        }
        let before = workspace.rows.energy;
        workspace.assemble(way.stiffness);
        workspace.update_slope();
        workspace.remember(pose);
        let rms = (2.0 * before / workspace.rows.n_active().max(1) as f64).sqrt();
        let unit = (rms / limits.size).min(1.0);
        loop {
            let damping = if is_affine { REFINED_FLOOR } else { way.nu * unit + way.floor };
            let Some(promised) = solve_step(workspace, damping, work) else {
                // Linear rows may be met to the last bit by the first step.
                return if workspace.is_met(limits) { End::Met } else { End::Stuck };
            };
            if is_affine {
                workspace.keep_to_rows();
            }
            way.n_iterations += 1;
            let longest = workspace.longest_step(LONGEST_STEP, limits);
            let is_near = is_affine || workspace.equations.reach(&workspace.step) <= longest;
            let energy = if is_near { workspace.try_step(pose, 1.0, work) } else { f64::INFINITY };
            let gain = (before - energy) / promised;
            if gain > LEAST_GAIN {
                if gain > 0.75 {
                    way.nu = (way.nu / 4.0).max(way.least_damping());
                } else if gain < 0.25 {
                    way.nu = (way.nu * 4.0).max(1e-3);
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
            if is_affine && workspace.is_met(limits) {
                return End::Met;
            }
            way.nu = (way.nu * 4.0).max(1e-3);
            if way.nu > MOST_DAMPING || is_affine {
                return End::Stuck;
            }
            if way.n_iterations >= most {
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

/// Whether no small move would lower the energy any further, as far as the slope tells.
fn is_flat(workspace: &mut Workspace, work: &mut Counters) -> bool {
    let energy = workspace.rows.energy;
    if !energy.is_finite() {
        return false;
    }
    workspace.assemble(Stiffness::Stretched);
    workspace.update_slope();
    solve_step(workspace, FLOOR, work).is_none_or(|gain| gain <= FLAT * energy)
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
