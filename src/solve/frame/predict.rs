//! The method `auto`: expect where the points will be, find them from there block by block,
//! follow the motion in smaller steps where that is not safe, and where there is no solution
//! settle for the best fit.

use super::attempt::{Attempt, attempt, motion_between, motion_since};
use super::branch::{NEARLY_SINGULAR, SENSITIVE};
use super::expected::{NEAR_DOUBT, NO_MOTION, WELL_KNOWN, is_clear};
use super::{nearest, settle, substep};
use crate::constraint::Point;
use crate::solve::island::Island;
use crate::solve::island::sides::SINGULAR;
use crate::solve::method::newton;
use crate::solve::method::{Limits, Outcome, Pose};
use crate::solve::report::{Counters, Status};
use crate::solve::velocity;

/// What is left of the energy where points with freedom left are well expected; it was below 1e-5
/// in most frames of chains of 10 to 100 000 bars. Folds that are not yet to be seen show in more,
/// and expecting them to go on makes them grow.
const WELL_EXPECTED: f64 = 1e-4;

/// Position errors are larger than the residual over that sine by no more than this, through the
/// points that depend on each other: what cannot be the largest of a run is not worked out.
const ROUGHLY: f64 = 10.0;

/// The same as [`NEAR_DOUBT`] for one that passed a singular pose. Two branches may come near there and not meet. If
/// they are passed in a part e of the frame, four poses on one let a pose on the other expect with an
/// error of more than 3 e^2 of the way by which the branches part in a frame.
const LEAP: f64 = 1.5e-5;

/// A motion of more than this part of the size may lead points with freedom left off the shortest way.
const LONG: f64 = 1e-2;

/// A tolerance of less than this part of the size is fine enough to follow any motion.
const FINE: f64 = 1e-8;
/// The same relative to the motion of a frame: expectations from four poses make 15 times as much of
/// what they are off, and next to another branch a correction of a percent is too much.
const FINE_MOTION: f64 = 3e-4;

/// The limits for following a motion. Poses that are off by as much as they move are no ground
/// to expect the next one from: a frame would seem to need ever smaller steps.
fn following<'a>(island: &Island, limits: &Limits<'a>) -> Limits<'a> {
    let fine = FINE * limits.size;
    if limits.tolerance <= fine {
        return *limits;
    }
    let history = &island.history;
    let way =
        if history.n_past() > 0 { motion_between(history.origin(), history.past(1)) } else { 0.0 };
    Limits { tolerance: (FINE_MOTION * way).clamp(fine, limits.tolerance), ..*limits }
}

/// Solves a frame: the values of the constraints and the frozen points are those at its end.
pub(crate) fn frame(island: &mut Island, limits: &Limits, work: &mut Counters) -> Outcome {
    if island.status != Status::Converged || island.inputs.is_disturbed {
        return settle(island, limits, work);
    }
    let n_free = island.n_free;
    island.measure_part_sides(work);
    island.history.begin(&island.x[..n_free], island.highest_degree());
    // A motion that begins at a change point or at a dead point may go on along any branch.
    let is_first = island.history.n_past() == 0;
    let Some(open) = island.singular_point(SINGULAR).filter(|_| is_first) else {
        return go_on(island, is_first, false, limits, work);
    };
    let start: Box<[Point]> = island.x[..n_free].into();
    let outcome = go_on(island, is_first, true, limits, work);
    let is_moved = motion_since(island, &start) > NO_MOTION * limits.size;
    if outcome.is_converged() && is_moved && !island.is_singular(SINGULAR) {
        island.chosen = Some(open);
    }
    outcome
}

/// The same from a solved pose; it may be the first of a motion, and may be one where branches meet.
fn go_on(
    island: &mut Island,
    is_first: bool,
    is_open: bool,
    limits: &Limits,
    work: &mut Counters,
) -> Outcome {
    let n_free = island.n_free;
    let may_be_open = is_first && island.is_singular(NEARLY_SINGULAR);
    let is_predicted = island.history.predict(&island.degree, &mut island.x[..n_free]);
    if is_predicted && !island.plan.is_complete() && !island.is_smooth() {
        project_prediction(island, limits, work);
    }
    let near = following(island, limits);
    let tried = attempt(island, is_predicted, &near, work);
    if let Some(attempt) = tried
        && (island.has_velocities()
            || is_open
            || island.plan.is_linear()
            || follows(island, &attempt, is_predicted, limits))
    {
        let attempt = stay_near(island, attempt, limits, work);
        return accept(island, attempt, limits);
    }
    let ends_in_singular = tried.is_some_and(|attempt| attempt.least_side < NEARLY_SINGULAR);
    island.x[..n_free].copy_from_slice(island.history.origin());
    let sides = island.sides();
    if !island.has_velocities()
        && let Some(attempt) = substep::frame(island, ends_in_singular, &near, work)
    {
        let attempt = stay_near(island, attempt, limits, work);
        return accept(island, attempt, limits);
    }
    island.turned_over = None;
    island.set_sides(sides);
    island.x[..n_free].copy_from_slice(island.history.origin());
    let outcome = settle(island, limits, work);
    if outcome.is_converged()
        && !may_be_open
        && !island.has_velocities()
        && !island.is_singular(NEARLY_SINGULAR)
    {
        // It could not be followed here: whatever side it is on, it may be another branch. At a
        // singular pose all of them meet.
        island.turned_over = island.turned_over.or_else(|| island.point_with_branches());
    }
    outcome
}

/// Whether the pose that was reached at once is the one that the motion leads to.
fn follows(island: &Island, attempt: &Attempt, is_predicted: bool, limits: &Limits) -> bool {
    let motion = motion_since(island, island.history.origin());
    if !attempt.is_expected(motion, limits) || island.watched_point_over().is_some() {
        return false;
    }
    if !is_predicted && attempt.nearest_squared.is_finite() {
        return false;
    }
    let n_past = island.history.n_past();
    if attempt.has_crossed {
        return n_past == WELL_KNOWN
            && attempt.least_side >= NEARLY_SINGULAR
            && attempt.leap <= LEAP
            && attempt.doubt_squared <= NEAR_DOUBT * NEAR_DOUBT;
    }
    is_clear(attempt.correction, motion, attempt.doubt_squared, attempt.nearest_squared, n_past)
}

/// Solves a frame that does not follow from the one before, and notes what changed sides.
fn settle(island: &mut Island, limits: &Limits, work: &mut Counters) -> Outcome {
    // What a user put elsewhere, or edited, may lie on any side.
    let is_watched = !(island.is_new || island.is_edited || island.inputs.is_disturbed);
    let sides = is_watched.then(|| island.sides());
    let outcome = settle::settle(island, limits, work);
    if let Some(sides) = sides
        && outcome.is_converged()
    {
        island.turned_over = island.changed_since(&sides);
    }
    outcome
}

/// Keeps of the expected places of parts with freedom left only what the constraints ask for:
/// where they leave a choice, points stay where they are, whatever their past. Takes back what
/// is not much better than the places they come from.
fn project_prediction(island: &mut Island, limits: &Limits, work: &mut Counters) {
    let mut workspaces = island.take_part_workspaces();
    for workspace in &mut workspaces {
        workspace.equations.gather(&island.x, &mut workspace.expected);
        let points = workspace.equations.points().iter();
        let origin: Vec<Point> = points.map(|&p| island.history.origin()[p as usize]).collect();
        let mut pose = Pose { constraints: &island.constraints, x: &mut island.x };
        workspace.equations.scatter(&origin, pose.x);
        workspace.evaluate(&pose, work);
        let energy = workspace.rows.energy;
        workspace.equations.scatter(&workspace.expected, pose.x);
        workspace.evaluate(&pose, work);
        if workspace.rows.energy >= energy
            || !newton::project_prediction(
                workspace,
                &mut pose,
                &origin,
                WELL_EXPECTED * energy,
                limits,
                work,
            )
        {
            workspace.equations.scatter(&origin, pose.x);
        }
    }
    island.part_workspaces = workspaces;
}

/// Takes back what points with freedom left went farther than they had to, where they went far: a
/// short way hardly differs from the shortest.
fn stay_near(
    island: &mut Island,
    mut attempt: Attempt,
    limits: &Limits,
    work: &mut Counters,
) -> Attempt {
    let origin = island.history.origin();
    let has_freedom = !island.plan.is_complete() && !island.is_smooth();
    if has_freedom && motion_since(island, origin) > LONG * limits.size {
        let origin: Box<[Point]> = origin.into();
        let mut workspace = island.take_workspace();
        nearest::approach(island, &mut workspace, &origin, limits, work);
        attempt.worst = workspace.rows.worst;
        island.put_workspace(workspace);
    }
    attempt
}

/// The frame ends at the present pose.
fn accept(island: &mut Island, attempt: Attempt, limits: &Limits) -> Outcome {
    island.history.advance();
    island.keep_sides();
    island.accept_pose();
    let Attempt { worst, n_iterations, least_side, .. } = attempt;
    let doubt = Doubt { known: limits.budget.known_error, tolerance: limits.tolerance };
    island.position_error = position_error(island, worst, least_side, limits.size, &doubt);
    Outcome { status: Status::Converged, worst, energy: 0.5 * worst * worst, n_iterations }
}

/// How far points may be from where they belong: what is known of it already, and what matters.
#[derive(Clone, Copy)]
pub(crate) struct Doubt {
    /// The largest position error that is known.
    pub known: f64,
    /// The distance to satisfaction that is met.
    pub tolerance: f64,
}

impl Doubt {
    /// What is said, without working it out, of the position error at a pose this near to a singular one: 0
    /// where it is no matter, or no more than is known already, and roughly how large it is where that is
    /// within the tolerance. None where it is to be worked out.
    pub fn roughly(&self, worst: f64, least_side: f64, size: f64) -> Option<f64> {
        if least_side >= SENSITIVE {
            return Some(0.0);
        }
        let rough = worst.max(f64::EPSILON * size) / least_side;
        let most = ROUGHLY * rough;
        let is_small = most <= self.tolerance;
        (is_small || most <= self.known).then_some(if is_small { rough } else { 0.0 })
    }
}

/// How far points may be from where they belong at a pose this near to a singular one, as far as
/// [`Doubt`] asks for it.
pub(crate) fn position_error(
    island: &mut Island,
    worst: f64,
    least_side: f64,
    size: f64,
    doubt: &Doubt,
) -> f64 {
    doubt.roughly(worst, least_side, size).unwrap_or_else(|| {
        island.know_sides();
        velocity::position_error(island)
    })
}
