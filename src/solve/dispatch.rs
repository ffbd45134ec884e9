//! What a call of the solver does with one island.

use super::closed_form::Found;
use super::frame::predict::{self, Doubt};
use super::frame::settle;
use super::island::{Island, rounding};
use super::method::{self, Limits, Outcome};
use super::report::{Budget, Counters, NoStep, Status};
use super::settings::{Method, Settings};
use crate::constraint::{Constraint, ConstraintKind, Point};
use crate::world::{PointId, World};

/// Rounds of a method before it counts as getting nowhere.
const MOST_ROUNDS: u32 = 2_000;

/// What a call does with each island.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Task {
    /// The clock went one frame on.
    Frame,
    /// Bare iterations at the present time.
    Relax,
    /// As far as it gets on, at the present time: another place follows, and with it a better start.
    Lead,
    /// Until solved or at rest, at the present time.
    Settle,
}

/// What changed the world.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Cause {
    /// Time went on, and what it drives.
    Clock,
    /// The user.
    Hand,
}

/// A factorisation takes about as long as so many evaluations of each constraint.
const FACTORISATION: u64 = 4;

/// What a visit came to.
#[derive(Clone, Copy)]
pub(super) struct Visit {
    /// How solving ended; none if there was nothing to solve.
    pub outcome: Option<Outcome>,
    /// The size of the island, length units.
    pub size: f64,
    /// The coefficient of relaxation, if it had to be lowered.
    pub lowered: Option<f64>,
    /// Whether its list of steps found the pose, or why not; none where it was not asked.
    pub by_steps: Option<Result<(), NoStep>>,
}

/// Solves an island. Touches nothing else: visits may be made in any order, or side by side.
pub(super) fn visit(
    island: &mut Island,
    settings: &Settings,
    budget: &Budget,
    task: Task,
    work: &mut Counters,
) -> Visit {
    let mut visit = Visit { outcome: None, size: 1.0, lowered: None, by_steps: None };
    work.islands_visited += 1;
    island.remembered.take();
    island.before = None;
    island.position_error = 0.0;
    let is_driven = !island.inputs.is_empty();
    let is_at_rest = matches!(island.status, Status::Converged | Status::BestFit);
    if task == Task::Frame && !is_driven && is_at_rest {
        // Nothing moved it for a whole frame: what comes next does not go on from before.
        island.history.forget();
        island.is_awake = false;
        return visit;
    }
    island.begin_change();
    island.prepare();
    if task == Task::Frame && settings.method == Method::Auto {
        let tolerance = budget.tolerance_of(settings);
        let found = island.closed_frame(tolerance);
        visit.by_steps = is_driven.then_some(found.map(|_| ()));
        if let Ok(found) = found {
            let size = island.size_before();
            let doubt = Doubt { known: budget.known_error, tolerance: tolerance * size };
            island.note_closed_form(&found, size, &doubt);
            return end_closed(island, &found, size, work, visit);
        }
    }
    island.leave_closed_form();
    let limits = island.limits(settings, budget);
    let is_first = island.is_new;
    let start: Option<Box<[Point]>> =
        (is_first && island.is_passive()).then(|| island.x[..island.n_free].into());
    let before = *work;
    if (island.is_new || island.is_edited) && task == Task::Frame && settings.method == Method::Auto
    {
        begin(island, &limits, work);
    }
    let could_follow = task == Task::Frame
        && is_driven
        && (island.status == Status::Converged || is_first && settings.method != Method::Auto);
    if could_follow && settings.method != Method::Auto {
        island.history.begin_anew(&island.x[..island.n_free]);
    }
    let (mut outcome, lowered) = solve(island, settings, &limits, task, work);
    confirm(island, &mut outcome, settings, &limits, work);
    if could_follow && !outcome.is_converged() {
        island.note_halt(is_first);
    }
    let n_evaluations = work.evaluations - before.evaluations;
    let n_factored =
        (work.factorisations - before.factorisations) * island.constraints.len() as u64;
    island.n_evaluations =
        u32::try_from(n_evaluations + FACTORISATION * n_factored).unwrap_or(u32::MAX);
    if !outcome.is_converged() && island.feasible.is_none() && settings.method == Method::Auto {
        // Everything may have held there before it was edited.
        island.feasible = start;
    }
    island.is_new = false;
    island.is_edited = false;
    island.status = outcome.status;
    // What is not solved may have become much smaller.
    let size = if outcome.is_converged() { limits.size } else { island.size() };
    island.residual = outcome.worst / size;
    island.settle_inputs();
    visit.size = size;
    visit.lowered = lowered;
    island.is_awake = is_driven || outcome.status == Status::Stalled;
    visit.outcome = Some(outcome);
    visit
}

/// Ends a visit in which the pose was found by the list of steps.
fn end_closed(
    island: &mut Island,
    found: &Found,
    size: f64,
    work: &mut Counters,
    visit: Visit,
) -> Visit {
    let n = island.n_closed();
    work.evaluations += u64::from(n);
    island.n_evaluations = n;
    island.residual = found.worst / size;
    island.settle_inputs();
    island.is_awake = true;
    let (worst, energy) = (found.worst, 0.5 * found.worst * found.worst);
    let outcome = Outcome { status: Status::Converged, worst, energy, n_iterations: 1 };
    Visit { outcome: Some(outcome), size, ..visit }
}

/// Works out what drove an island at the beginning of a frame that it was made in.
pub(super) fn turn_back(island: &mut Island, dt: f64) {
    island.settle_inputs();
    for (c, constraint) in island.constraints.iter().enumerate() {
        let mut before = constraint.clone();
        if before.advance(-dt) {
            island.inputs.note_values(c as u32, before);
        }
    }
}

/// Solves an island that is new as it was when its first frame began, so that the motion of
/// that frame has a beginning.
pub(super) fn begin(island: &mut Island, limits: &Limits, work: &mut Counters) {
    if !island.inputs.is_empty() {
        island.swap_inputs();
        island.status = settle::settle(island, limits, work).status;
        island.swap_inputs();
    }
}

/// How often a pose is solved anew because its island became smaller.
const MOST_CONFIRMATIONS: u32 = 4;

/// Sees to it that what counts as solved does so by the size of the island as it is now: it may
/// have been much larger before.
pub(super) fn confirm(
    island: &mut Island,
    outcome: &mut Outcome,
    settings: &Settings,
    limits: &Limits,
    work: &mut Counters,
) {
    for n in 0..=MOST_CONFIRMATIONS {
        let tolerance = limits.budget.tolerance_of(settings);
        // The size is never below what the constraints ask for; and what is far below the
        // tolerance is so whatever the size.
        let enough = (tolerance * island.wanted()).max(1e-4 * limits.tolerance);
        if !outcome.is_converged() || outcome.worst <= enough {
            return;
        }
        let now = island.limits(settings, limits.budget);
        if outcome.worst <= now.tolerance {
            return;
        }
        if n == MOST_CONFIRMATIONS || limits.budget.is_spent() {
            outcome.status = Status::Stalled;
            return;
        }
        let n_iterations = outcome.n_iterations;
        // It moves by no more than it was off: what comes next still goes on from before.
        let history = island.history.clone();
        *outcome = solve(island, settings, &now, Task::Settle, work).0;
        island.history = history;
        outcome.n_iterations = outcome.n_iterations.saturating_add(n_iterations);
    }
}

/// Solves an island by the chosen method; gives the coefficient of relaxation too, if it had
/// to be lowered.
pub(super) fn solve(
    island: &mut Island,
    settings: &Settings,
    limits: &Limits,
    task: Task,
    work: &mut Counters,
) -> (Outcome, Option<f64>) {
    let Some(round) = method::round_of(settings.method) else {
        let outcome = match task {
            Task::Frame => predict::frame(island, limits, work),
            Task::Relax => settle::settle(island, limits, work),
            Task::Lead => settle::settle_on(island, limits, work),
            Task::Settle => settle::settle_at_last(island, limits, work),
        };
        if task == Task::Frame && !outcome.is_converged() {
            island.begin_velocities();
        }
        return (outcome, None);
    };
    island.history.forget();
    island.feasible = None;
    let (mut outcome, mut lowered) = round(island, settings, limits, work);
    if matches!(task, Task::Lead | Task::Settle) {
        let mut n = outcome.n_iterations;
        for _ in 0..MOST_ROUNDS {
            if outcome.status != Status::Stalled || limits.budget.is_spent() {
                break;
            }
            (outcome, lowered) = round(island, settings, limits, work);
            n = n.saturating_add(outcome.n_iterations);
        }
        outcome.n_iterations = n;
    }
    if outcome.is_converged() {
        island.accept_pose();
        island.update_sides();
    } else if task == Task::Frame {
        island.begin_velocities();
    }
    (outcome, lowered)
}

/// Puts an island back where the world has it: nothing was found.
pub(super) fn take_back(island: &mut Island, world: &World) {
    for (at, id) in island.x[..island.n_free].iter_mut().zip(&island.points) {
        *at = world.points().at(*id);
    }
    island.status = Status::Stalled;
    island.is_awake = true;
    island.history.forget();
    island.begin_change();
    let violations = island.constraints.iter().map(|c| c.violation(&island.x, &island.w));
    island.residual = violations.fold(0.0, f64::max) / island.size();
}

/// Puts what was found back into the world.
pub(super) fn write_back(island: &Island, world: &mut World) {
    for (id, at) in island.points[..island.n_free].iter().zip(&island.x) {
        world.set_position(*id, *at);
    }
    for &c in &island.stateful {
        let c = c as usize;
        if let Some(state) = island.constraints[c].state() {
            world.constraint_state_mut(island.ids[c]).set_state(&state);
        }
    }
}

/// A constraint by itself.
pub(super) struct Alone {
    /// How far it is from satisfaction, length units.
    pub violation: f64,
    /// How large what it holds is, length units; never 0.
    pub size: f64,
    /// What rounding leaves of numbers as large as these.
    pub rounding: f64,
}

/// Looks at a constraint by itself.
pub(super) fn check(world: &World, constraint: &Constraint) -> Alone {
    let points = constraint.points().to_vec();
    let x: Vec<_> = points.iter().map(|&p| world.points().at(PointId(p))).collect();
    let w: Vec<f64> = points.iter().map(|&p| world.points().inverse_mass(PointId(p))).collect();
    let mut local = constraint.clone();
    local.map_points(|p| points.iter().position(|&q| q == p).expect("it holds it") as u32);
    let extent = |of: fn(&Point) -> f64| {
        let values = x.iter().map(of);
        let (lo, hi) =
            values.fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), v| (lo.min(v), hi.max(v)));
        hi - lo
    };
    let size = extent(|p| p.x).max(extent(|p| p.y));
    let size = size.max(constraint.nominal_length());
    let farthest = x.iter().fold(0.0_f64, |most, p| most.max(p.x.abs()).max(p.y.abs()));
    Alone {
        violation: local.violation(&x, &w),
        size: if size > 0.0 { size } else { 1.0 },
        rounding: rounding(farthest),
    }
}
