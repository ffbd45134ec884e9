//! A pose that does not follow from the one before: a first solve, a place out of reach, or
//! the way back from there.

use super::nearest::{self, Held};
use crate::constraint::{Point, Vector};
use crate::solve::island::Island;
use crate::solve::method::coefficient::Coefficient;
use crate::solve::method::relaxation;
use crate::solve::method::spectrum::{Spectrum, noise};
use crate::solve::method::{Limits, Outcome, Pose, Workspace};
use crate::solve::method::{conjugate_gradient, newton};
use crate::solve::report::{Counters, Status};

/// A start this far off, relative to the size, is far: first-order steps first.
const FAR: f64 = 1e-3;
/// How many of them.
const FIRST_ORDER_STEPS: u32 = 300;
/// How far points are pushed to leave a saddle, relative to the size.
const PUSH: f64 = 1e-4;
/// The same where a solution is looked for before it is said that none is found: off a stop, and
/// over to another branch.
const FAR_PUSHES: [f64; 4] = [1e-2, -1e-2, 0.3, -0.3];
/// So many constraints that hang together at most: each push takes a way down.
const MOST_PUSHED: usize = 200;
/// Constraints swept over by relaxation before a solve is given up, some milliseconds, and sweeps
/// between two looks at what they reached.
const MOST_SWEPT: u32 = 200_000;
const SWEEPS_A_ROUND: u32 = 1_000;
/// The paper's coefficient, for relaxation as a first step.
const GENTLE: f64 = 0.5;
/// Rounds of a solve that may take as long as it likes: nearly parallel lines and far places take
/// some hundred.
const MOST_ROUNDS: u32 = 300;
/// So many in a row that do not gain this part of the energy lead nowhere. One may: what makes an
/// angle a distance changes on the way.
const MOST_IDLE: u32 = 5;
const PROGRESS: f64 = 1e-3;
/// An energy below this part of that at the last push is of another scene: a chain that was pulled
/// straight and is let back by a hair has a saddle where it had a best fit.
const MUCH_LESS: f64 = 1e-2;
/// Where what moves is smaller than this part of the size, as on an arc of a radius of a million,
/// solutions are refined beyond the tolerance.
const SMALL_PART: f64 = 1e-3;
/// The part of the energy a push has to gain to count.
const WORTHWHILE: f64 = 1e-6;

/// Solves an island while time stands still, however long that takes as long as it gets on.
pub(crate) fn settle_at_last(island: &mut Island, limits: &Limits, work: &mut Counters) -> Outcome {
    let start: Box<[Point]> = island.x[..island.n_free].into();
    let mut outcome = settle(island, limits, work);
    let (mut least, mut n_idle) = (outcome.energy, 0);
    for _ in 0..MOST_ROUNDS {
        if outcome.status != Status::Stalled || n_idle == MOST_IDLE || limits.budget.is_spent() {
            break;
        }
        let n_iterations = outcome.n_iterations;
        outcome = settle(island, limits, work);
        outcome.n_iterations = outcome.n_iterations.saturating_add(n_iterations);
        n_idle = if outcome.energy < (1.0 - PROGRESS) * least { 0 } else { n_idle + 1 };
        least = least.min(outcome.energy);
    }
    if !outcome.is_converged() && !limits.budget.is_spent() {
        let n_sweeps = MOST_SWEPT / island.constraints.len() as u32;
        let mut workspace = island.take_workspace();
        outcome = relax_first(island, &mut workspace, &start, outcome, n_sweeps, limits, work);
        if !outcome.is_converged() && island.constraints.len() <= MOST_PUSHED {
            outcome = from_elsewhere(island, &mut workspace, &start, outcome, limits, work);
        }
        island.put_workspace(workspace);
        if outcome.is_converged() {
            mark_converged(island);
        }
    }
    outcome
}

/// Everything holds, at a pose that counts.
fn mark_converged(island: &mut Island) {
    island.feasible = None;
    island.probed_at = 0.0;
    island.accept_pose();
    island.update_sides();
    island.drop_workspace();
}

/// Solves an island from where it stands, or from its last feasible pose.
pub(crate) fn settle(island: &mut Island, limits: &Limits, work: &mut Counters) -> Outcome {
    let n_free = island.n_free;
    if island.status == Status::Converged && !island.inputs.is_disturbed {
        island.feasible = Some(island.x[..n_free].into());
    }
    island.history.forget();
    let start: Box<[Point]> = island.x[..n_free].into();
    let is_elsewhere = island.feasible.as_ref().is_some_and(|pose| *pose != start);
    let mut workspace = island.take_workspace();
    let mut best_is_from_feasible = false;
    let mut best = first_descent(island, &mut workspace, &start, limits, work);
    // What is reached from the last feasible pose does not depend on the way since then. It
    // counts unless it is worse: there and back ends where it began.
    if let Some(feasible) = island.feasible.take() {
        if is_elsewhere {
            let here: Box<[Point]> = island.x[..n_free].into();
            island.x[..n_free].copy_from_slice(&feasible);
            let from_feasible = descend(island, &mut workspace, limits, work);
            if is_better(&best, &from_feasible) {
                island.x[..n_free].copy_from_slice(&here);
            } else {
                best = from_feasible;
                best_is_from_feasible = true;
            }
        }
        island.feasible = Some(feasible);
    }
    // Pushing once is enough as long as nothing drives the island and it is about as wrong as then.
    let is_probed = island.inputs.is_empty()
        && island.probed_at > 0.0
        && best.energy >= MUCH_LESS * island.probed_at;
    if !best.is_converged() && !is_probed && !limits.budget.is_spent() {
        island.probed_at = best.energy.min(f64::MAX);
        best = escape_saddle(island, &mut workspace, best, limits, work);
        if !best.is_converged() {
            let n_sweeps = limits.n_iterations;
            best = relax_first(island, &mut workspace, &start, best, n_sweeps, limits, work);
        }
    }
    if best.is_converged() && !island.plan.is_linear() {
        let from = if best_is_from_feasible { island.feasible.take() } else { None };
        nearest::approach(island, &mut workspace, from.as_deref().unwrap_or(&start), limits, work);
        let width = extent(&island.x[..n_free]);
        if width > 0.0 && width <= SMALL_PART * limits.size {
            let mut pose = Pose { constraints: &island.constraints, x: &mut island.x };
            newton::refine(&mut workspace, &mut pose, limits, work);
        }
        best.worst = workspace.rows.worst;
        best.energy = workspace.rows.energy;
    }
    island.put_workspace(workspace);
    if best.is_converged() {
        mark_converged(island);
    }
    best
}

/// The larger of width and height of some points.
fn extent(points: &[Point]) -> f64 {
    let extent = |of: fn(&Point) -> f64| {
        let ends = |(lo, hi): (f64, f64), v: f64| (lo.min(v), hi.max(v));
        let (lo, hi) = points.iter().map(of).fold((f64::INFINITY, f64::NEG_INFINITY), ends);
        hi - lo
    };
    extent(|p| p.x).max(extent(|p| p.y))
}

/// The way down from the start; ranges that it begins outside of hold it to their stops if that
/// can be.
fn first_descent(
    island: &mut Island,
    workspace: &mut Workspace,
    start: &[Point],
    limits: &Limits,
    work: &mut Counters,
) -> Outcome {
    let held = Held::new(island);
    if held.is_empty() {
        return descend(island, workspace, limits, work);
    }
    let on_stops = {
        let mut pose = Pose { constraints: &island.constraints, x: &mut island.x };
        newton::solve_near(workspace, &mut pose, limits, work)
    };
    held.release(island);
    if on_stops.is_converged() {
        return on_stops;
    }
    island.x[..start.len()].copy_from_slice(start);
    let outcome = descend(island, workspace, limits, work);
    Outcome { n_iterations: on_stops.n_iterations + outcome.n_iterations, ..outcome }
}

/// Whether one ending is better than another, by more than rounding.
fn is_better(one: &Outcome, other: &Outcome) -> bool {
    match (one.is_converged(), other.is_converged()) {
        (true, other) => !other,
        (false, true) => false,
        (false, false) => one.energy < other.energy * (1.0 - WORTHWHILE),
    }
}

/// Newton steps; where they do not arrive from afar, first-order steps and then again.
fn descend(
    island: &mut Island,
    workspace: &mut Workspace,
    limits: &Limits,
    work: &mut Counters,
) -> Outcome {
    let mut pose = Pose { constraints: &island.constraints, x: &mut island.x };
    let first = newton::solve(workspace, &mut pose, limits, work);
    if first.status != Status::Stalled
        || first.worst <= FAR * limits.size
        || limits.budget.is_spent()
    {
        return first;
    }
    let many = Limits { n_iterations: FIRST_ORDER_STEPS, ..*limits };
    let second = conjugate_gradient::solve(workspace, &mut pose, &many, work);
    let last = newton::solve(workspace, &mut pose, limits, work);
    let n_iterations = first.n_iterations + second.n_iterations + last.n_iterations;
    Outcome { n_iterations, ..last }
}

/// Pushes the points a little, one way and then the other, and lets go: a saddle is left for a
/// better place, which may lie on one side only.
fn escape_saddle(
    island: &mut Island,
    workspace: &mut Workspace,
    before: Outcome,
    limits: &Limits,
    work: &mut Counters,
) -> Outcome {
    let n_free = island.n_free;
    let here: Box<[Point]> = island.x[..n_free].into();
    // At the end of a glider only one of two opposite ways leads anywhere.
    for way in [PUSH, -PUSH] {
        push(&mut island.x[..n_free], way * limits.size);
        let after = descend(island, workspace, limits, work);
        if is_better(&after, &before) {
            return Outcome { n_iterations: before.n_iterations + after.n_iterations, ..after };
        }
        island.x[..n_free].copy_from_slice(&here);
    }
    before
}

/// Looks for a solution from poses that the points are pushed to from the start; the pose stays as
/// it is where there is none.
fn from_elsewhere(
    island: &mut Island,
    workspace: &mut Workspace,
    start: &[Point],
    before: Outcome,
    limits: &Limits,
    work: &mut Counters,
) -> Outcome {
    let here: Box<[Point]> = island.x[..start.len()].into();
    for far in FAR_PUSHES {
        if limits.budget.is_spent() {
            break;
        }
        island.x[..start.len()].copy_from_slice(start);
        push(&mut island.x[..start.len()], far * limits.size);
        let after = descend(island, workspace, limits, work);
        if after.is_converged() {
            nearest::approach(island, workspace, start, limits, work);
            let n_iterations = before.n_iterations.saturating_add(after.n_iterations);
            return workspace.outcome(after.status, n_iterations);
        }
    }
    island.x[..start.len()].copy_from_slice(&here);
    before
}

/// Moves each point in a direction of its own by up to this much.
fn push(points: &mut [Point], most: f64) {
    // By place and not by handle, which a saved session gives anew.
    for (k, x) in (0..).zip(points) {
        *x += Vector::new(noise(2 * k), noise(2 * k + 1)) * most;
    }
}

/// Relaxes from the start, in so many sweeps, before the Newton steps: of the many best fits of a
/// scene that contradicts itself the one taken is no worse than the one the paper's method finds.
fn relax_first(
    island: &mut Island,
    workspace: &mut Box<Workspace>,
    start: &[Point],
    before: Outcome,
    n_sweeps: u32,
    limits: &Limits,
    work: &mut Counters,
) -> Outcome {
    let n_free = island.n_free;
    let here: Box<[Point]> = island.x[..n_free].into();
    island.x[..n_free].copy_from_slice(start);
    workspace.rows.evaluate(&workspace.equations, &island.constraints, &island.x, work);
    let mut spectrum = Spectrum::new(&island.points[..n_free]);
    let largest = spectrum.largest(&workspace.equations, &workspace.rows, |_| 1.0);
    let mut coefficient = Coefficient::at_most(GENTLE, largest);
    let mut left = n_sweeps;
    while left > 0 {
        let n_iterations = left.min(SWEEPS_A_ROUND);
        left -= n_iterations;
        let round = Limits { n_iterations, ..*limits };
        let relaxed = relaxation::solve(island, &mut coefficient, &round, work);
        if relaxed.status != Status::Stalled || limits.budget.is_spent() {
            break;
        }
    }
    let after = descend(island, workspace, limits, work);
    if is_better(&after, &before) {
        return Outcome { n_iterations: before.n_iterations + after.n_iterations, ..after };
    }
    island.x[..n_free].copy_from_slice(&here);
    before
}
