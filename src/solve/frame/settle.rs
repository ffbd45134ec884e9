//! A pose that does not follow from the one before: a first solve, a place out of reach, or
//! the way back from there.

use super::attempt::motion_since;
use super::nearest::{self, Held, Undecided};
use crate::constraint::{Point, Vector};
use crate::solve::island::Island;
use crate::solve::method::coefficient::Coefficient;
use crate::solve::method::relaxation;
use crate::solve::method::spectrum::{Spectrum, noise};
use crate::solve::method::{Limits, Outcome, Pose, Workspace};
use crate::solve::method::{conjugate_gradient, newton};
use crate::solve::report::{Counters, Status};

/// What went farther than this many times the size, or the distance to satisfaction that it started
/// with, and did not arrive, does not.
const OUT_OF_SIGHT: f64 = 1e3;
/// A start this far off, relative to the size, is far: first-order steps first.
const FAR: f64 = 1e-3;
/// How many of them.
const FIRST_ORDER_STEPS: u32 = 300;
/// How far points are pushed to leave a saddle, relative to the size.
const PUSH: f64 = 1e-4;
/// The same where a solution is looked for before it is said that none is found: off a stop, and
/// over to another branch.
const FAR_PUSHES: [f64; 6] = [1e-2, -1e-2, 0.1, -0.1, 0.3, -0.3];
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
/// A way of more than this many times what the start was off is looked at again, in steps that are
/// this part as long, and so many times as many; unless it is as long as what the rows ask for where it
/// begins: a way that they do not turn on leads past nothing.
const DETOUR: f64 = 1.25;
const SMALL_STEPS: f64 = 0.1;
const MORE_STEPS: u32 = 4;
/// A solution that is nearer by less than this part is not worth another one.
const CLEARLY: f64 = 0.05;
/// Ways whose lengths differ by no more than this part are as long.
const SAME_WAY: f64 = 1e-9;
/// The part of the energy a push has to gain to count.
const WORTHWHILE: f64 = 1e-6;

/// Solves an island while time stands still, however long that takes as long as it gets on, and looks
/// about before it says that there is no solution.
pub(crate) fn settle_at_last(island: &mut Island, limits: &Limits, work: &mut Counters) -> Outcome {
    let start: Box<[Point]> = island.x[..island.n_free].into();
    let mut outcome = settle_on(island, limits, work);
    if !outcome.is_converged() && !limits.budget.is_spent() {
        let n_sweeps = MOST_SWEPT / island.constraints.len() as u32;
        let mut workspace = island.take_workspace();
        outcome = relax_first(island, &mut workspace, &start, outcome, n_sweeps, limits, work);
        outcome = in_sight(island, &mut workspace, &start, outcome, limits, work);
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

/// Solves an island while time stands still, as long as it gets on.
pub(crate) fn settle_on(island: &mut Island, limits: &Limits, work: &mut Counters) -> Outcome {
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
    let mut best = either_way(island, &mut workspace, &start, limits, work);
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
        let from = from.as_deref().unwrap_or(&start);
        let has_moved = island.x[..n_free] != *from;
        if has_moved {
            nearest::approach(island, &mut workspace, from, limits, work);
            if !best_is_from_feasible {
                by_small_steps(island, &mut workspace, &start, best, limits, work);
            }
        }
        let width = extent(&island.x[..n_free]);
        let is_small = width > 0.0 && width <= SMALL_PART * limits.size;
        if is_small {
            let mut pose = Pose { constraints: &island.constraints, x: &mut island.x };
            newton::refine(&mut workspace, &mut pose, limits, work);
        }
        if has_moved || is_small {
            best.worst = workspace.rows.worst;
            best.energy = workspace.rows.energy;
        }
    }
    island.put_workspace(workspace);
    if best.is_converged() {
        mark_converged(island);
    }
    best
}

/// Looks for a nearer solution by small steps from the start, and from around it, where the present
/// one is much farther away than what was off there: long steps may lead past the nearest of several.
fn by_small_steps(
    island: &mut Island,
    workspace: &mut Workspace,
    start: &[Point],
    found: Outcome,
    limits: &Limits,
    work: &mut Counters,
) {
    let here: Box<[Point]> = island.x[..start.len()].into();
    let way = nearest::distance(workspace, start, &island.x);
    island.x[..start.len()].copy_from_slice(start);
    let pose = Pose { constraints: &island.constraints, x: &mut island.x };
    workspace.evaluate(&pose, work);
    let off = (2.0 * workspace.rows.energy).sqrt();
    // Only what is clearly nearer counts: what is symmetric is to stay so.
    let mut nearest = Nearest(Some(((1.0 - CLEARLY) * way, found, here)));
    let is_straight = |way: f64, direct: f64| (way - direct).abs() <= CLEARLY * direct;
    if way > DETOUR * off && !is_straight(way, newton::shortest_step(workspace, work)) {
        let small = Limits { size: SMALL_STEPS * limits.size, ..*limits };
        nearest.look_around(island, workspace, start, &[0.0], &small, work);
        if island.constraints.len() <= MOST_PUSHED {
            nearest.look_around(island, workspace, start, &FAR_PUSHES, limits, work);
        }
    }
    if let Some((_, _, x)) = nearest.0 {
        island.x[..start.len()].copy_from_slice(&x);
    }
    let pose = Pose { constraints: &island.constraints, x: &mut island.x };
    workspace.evaluate(&pose, work);
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

/// The way down from the start. Where angles begin exactly between two ways to turn, of all the
/// ways that lead to a solution the shortest.
fn either_way(
    island: &mut Island,
    workspace: &mut Workspace,
    start: &[Point],
    limits: &Limits,
    work: &mut Counters,
) -> Outcome {
    let undecided = Undecided::all(island);
    let mut nearest = Nearest::default();
    let n_ways = if undecided.is_empty() { 0 } else { 1 << undecided.len() };
    for turned in 0..n_ways {
        Undecided::decide(&undecided, island, turned);
        island.x[..start.len()].copy_from_slice(start);
        let outcome = first_descent(island, workspace, start, limits, work);
        if outcome.is_converged() {
            nearest.add(island, workspace, start, outcome, limits, work);
        }
    }
    Undecided::release(&undecided, island);
    let Some((_, outcome, x)) = nearest.0 else {
        island.x[..start.len()].copy_from_slice(start);
        return first_descent(island, workspace, start, limits, work);
    };
    island.x[..start.len()].copy_from_slice(&x);
    outcome
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

/// Whether one ending is better than another, by more than rounding: of two that are as good the one
/// that is known to be a best fit.
fn is_better(one: &Outcome, other: &Outcome) -> bool {
    match (one.is_converged(), other.is_converged()) {
        (true, other) => !other,
        (false, true) => false,
        (false, false) => {
            let is_known = one.status == Status::BestFit && other.status != Status::BestFit;
            let margin = if is_known { WORTHWHILE } else { -WORTHWHILE };
            one.energy < other.energy * (1.0 + margin)
        }
    }
}

/// The way down from the present pose, unless it leads out of sight.
fn descend(
    island: &mut Island,
    workspace: &mut Workspace,
    limits: &Limits,
    work: &mut Counters,
) -> Outcome {
    let start: Box<[Point]> = island.x[..island.n_free].into();
    let outcome = descend_anywhere(island, workspace, limits, work);
    in_sight(island, workspace, &start, outcome, limits, work)
}

/// Goes back to the start if what was reached is out of sight: the residual of an angle can fall for
/// ever as its points go away, and what is reached on that way is no best fit.
fn in_sight(
    island: &mut Island,
    workspace: &mut Workspace,
    start: &[Point],
    outcome: Outcome,
    limits: &Limits,
    work: &mut Counters,
) -> Outcome {
    let motion = motion_since(island, start);
    if outcome.is_converged() || motion <= OUT_OF_SIGHT * limits.size {
        return outcome;
    }
    let there: Box<[Point]> = island.x[..start.len()].into();
    island.x[..start.len()].copy_from_slice(start);
    let pose = Pose { constraints: &island.constraints, x: &mut island.x };
    workspace.evaluate(&pose, work);
    if motion > OUT_OF_SIGHT * workspace.rows.worst {
        return workspace.outcome(Status::Stalled, outcome.n_iterations);
    }
    island.x[..start.len()].copy_from_slice(&there);
    outcome
}

/// Newton steps; where they do not arrive from afar, first-order steps and then again.
fn descend_anywhere(
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

/// Looks for solutions from poses that the points are pushed to from the start, and takes the
/// nearest; the pose stays as it is where there is none.
fn from_elsewhere(
    island: &mut Island,
    workspace: &mut Workspace,
    start: &[Point],
    before: Outcome,
    limits: &Limits,
    work: &mut Counters,
) -> Outcome {
    let here: Box<[Point]> = island.x[..start.len()].into();
    let mut nearest = Nearest::default();
    nearest.look_around(island, workspace, start, &FAR_PUSHES, limits, work);
    let Some((_, outcome, x)) = nearest.0 else {
        island.x[..start.len()].copy_from_slice(&here);
        return before;
    };
    island.x[..start.len()].copy_from_slice(&x);
    let n_iterations = before.n_iterations.saturating_add(outcome.n_iterations);
    Outcome { n_iterations, ..outcome }
}

/// Of some solutions the one with the shortest way from the start: its length, how it was found, and
/// where.
#[derive(Default)]
struct Nearest(Option<(f64, Outcome, Box<[Point]>)>);

impl Nearest {
    /// Takes in the solutions near the start and near where pushes of these parts of the size lead.
    fn look_around(
        &mut self,
        island: &mut Island,
        workspace: &mut Workspace,
        start: &[Point],
        pushes: &[f64],
        limits: &Limits,
        work: &mut Counters,
    ) {
        // What does not end in a solution is not asked where it ends.
        let n_iterations = limits.n_iterations.saturating_mul(MORE_STEPS);
        let many = Limits { n_iterations, ..*limits };
        for far in pushes {
            if limits.budget.is_spent() {
                return;
            }
            island.x[..start.len()].copy_from_slice(start);
            push(&mut island.x[..start.len()], far * limits.size);
            let mut pose = Pose { constraints: &island.constraints, x: &mut island.x };
            let after = newton::solve(workspace, &mut pose, &many, work);
            if after.is_converged() && !self.is_at(workspace, &island.x) {
                self.add(island, workspace, start, after, &many, work);
            }
        }
    }

    /// Whether a solution is so near to the one that is known that it comes to the same.
    fn is_at(&self, workspace: &Workspace, x: &[Point]) -> bool {
        let is_near = |(way, _, known): &(f64, Outcome, Box<[Point]>)| {
            nearest::distance(workspace, known, x) <= CLEARLY * way
        };
        self.0.as_ref().is_some_and(is_near)
    }

    /// Takes in the solution that is the present pose.
    fn add(
        &mut self,
        island: &mut Island,
        workspace: &mut Workspace,
        start: &[Point],
        outcome: Outcome,
        limits: &Limits,
        work: &mut Counters,
    ) {
        nearest::approach(island, workspace, start, limits, work);
        let way = nearest::distance(workspace, start, &island.x);
        if self.0.as_ref().is_none_or(|(least, ..)| way < (1.0 - SAME_WAY) * least) {
            let outcome = workspace.outcome(outcome.status, outcome.n_iterations);
            self.0 = Some((way, outcome, island.x[..start.len()].into()));
        }
    }
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
    let after = in_sight(island, workspace, start, after, limits, work);
    if is_better(&after, &before) {
        return Outcome { n_iterations: before.n_iterations + after.n_iterations, ..after };
    }
    island.x[..n_free].copy_from_slice(&here);
    before
}
