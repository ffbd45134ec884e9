//! The method `auto`: expect where the points will be, find them from there block by block,
//! follow the motion in smaller steps where that is not safe, and where there is no solution
//! settle for the best fit.

use super::{dyad, settle, substep};
use crate::constraint::Point;
use crate::solve::island::Island;
use crate::solve::method::newton;
use crate::solve::method::rows::Equations;
use crate::solve::method::{Limits, Outcome, Pose, Workspace};
use crate::solve::report::{Counters, Status};

/// A correction of the expected pose larger than this part of the motion means that the
/// motion was not understood; measured on mechanisms at 1 to 60 degrees a frame.
pub(crate) const SURPRISE: f64 = 0.3;
/// The same for points with freedom left, against the size.
const FREE_SURPRISE: f64 = 0.02;
/// What is left of the energy where points with freedom left are well expected; it was below 1e-5
/// in most frames of chains of 10 to 100 000 bars. Folds that are not yet to be seen show in more,
/// and expecting them to go on makes them grow.
const WELL_EXPECTED: f64 = 1e-4;
/// A motion that is smaller than this part of the size is not worth a second look.
pub(crate) const NO_MOTION: f64 = 1e-6;

/// Squares of singular values below this count as freedom: in the middle of the range in
/// which the count was right on all scenes measured, 1e-14 to 1e-6.
const RANK_CUT: f64 = 1e-10;

/// How an attempt at a pose from an expected one went.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Attempt {
    /// The largest distance to satisfaction, length units.
    pub worst: f64,
    /// The steps it took.
    pub n_iterations: u32,
    /// How far the farthest point ended from where it was expected.
    pub correction: f64,
    /// Whether a block changed sides of its singular pose.
    pub has_flipped: bool,
}

impl Attempt {
    /// Whether the pose, reached by `motion` from the last one, follows from it.
    pub fn is_safe(&self, motion: f64, limits: &Limits) -> bool {
        !self.has_flipped
            && (self.correction <= SURPRISE * motion || motion <= NO_MOTION * limits.size)
    }
}

/// Solves a frame: the values of the constraints and the frozen points are those at its end.
pub(crate) fn frame(island: &mut Island, limits: &Limits, work: &mut Counters) -> Outcome {
    if island.status != Status::Converged || island.inputs.is_disturbed {
        return settle(island, limits, work);
    }
    let n_free = island.n_free;
    island.history.begin(&island.x[..n_free], island.highest_degree());
    let is_predicted = island.history.predict(&island.degree, &mut island.x[..n_free]);
    if is_predicted && !island.plan.is_complete() && !island.is_smooth() {
        project_prediction(island, limits, work);
    }
    if let Some(attempt) = attempt(island, is_predicted, limits, work)
        && (island.has_velocities()
            || island.plan.is_linear()
            || attempt.is_safe(motion_since(island, island.history.origin()), limits)
                && island.watched_point_over().is_none())
    {
        return accept(island, attempt);
    }
    island.x[..n_free].copy_from_slice(island.history.origin());
    let sides = island.sides();
    if !island.has_velocities()
        && let Some(attempt) = substep::frame(island, limits, work)
    {
        return accept(island, attempt);
    }
    island.turned_over = None;
    island.set_sides(sides);
    island.x[..n_free].copy_from_slice(island.history.origin());
    settle(island, limits, work)
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
    let mut workspaces = take_part_workspaces(island);
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

/// The frame ends at the present pose.
fn accept(island: &mut Island, attempt: Attempt) -> Outcome {
    island.history.advance();
    island.keep_sides();
    island.accept_pose();
    let Attempt { worst, n_iterations, .. } = attempt;
    Outcome { status: Status::Converged, worst, energy: 0.5 * worst * worst, n_iterations }
}

/// The longest way a free point went since a pose.
pub(crate) fn motion_since(island: &Island, before: &[Point]) -> f64 {
    let moves = island.x.iter().zip(before).map(|(a, b)| *a - *b);
    moves.fold(0.0_f64, |most, d| most.max(d.x.abs()).max(d.y.abs()))
}

/// Looks for the solution near the present pose; none if there is none near. The pose is to
/// be thrown away then.
pub(crate) fn attempt(
    island: &mut Island,
    is_predicted: bool,
    limits: &Limits,
    work: &mut Counters,
) -> Option<Attempt> {
    let mut sum = Attempt { worst: 0.0, n_iterations: 0, correction: 0.0, has_flipped: false };
    let Island { plan, constraints, x, .. } = island;
    for block in &mut plan.blocks {
        let which = &plan.constraints[block.first as usize..block.end as usize];
        let found = dyad::find(block, which, constraints, x, is_predicted, limits, work)?;
        sum.worst = sum.worst.max(found.worst);
        sum.n_iterations = sum.n_iterations.max(found.n_steps);
        if block.is_determined || found.correction > FREE_SURPRISE * limits.size {
            sum.correction = sum.correction.max(found.correction);
        }
        sum.has_flipped |= found.side * block.side < 0.0;
        block.next_side = found.side;
    }
    if !island.plan.is_complete() {
        attempt_rest(island, is_predicted, limits, work, &mut sum)?;
    }
    Some(sum)
}

/// The room of each part that is solved as a whole, made when it is needed first.
fn take_part_workspaces(island: &mut Island) -> Vec<Workspace> {
    let mut workspaces = std::mem::take(&mut island.part_workspaces);
    if workspaces.is_empty() {
        workspaces.extend(island.plan.rest.iter().map(|part| {
            let (constraints, points) = (part.constraints.clone(), part.points.clone());
            let equations =
                Equations::new(&island.constraints, constraints, points, &island.x, &island.w);
            Workspace::new(equations)
        }));
    }
    workspaces
}

/// The same for the parts that are solved as a whole.
fn attempt_rest(
    island: &mut Island,
    is_predicted: bool,
    limits: &Limits,
    work: &mut Counters,
    sum: &mut Attempt,
) -> Option<()> {
    let mut workspaces = take_part_workspaces(island);
    let mut is_found = true;
    for workspace in &mut workspaces {
        let mut pose = Pose { constraints: &island.constraints, x: &mut island.x };
        let mut n = 0;
        if !is_predicted {
            // Where the first step leads is what the motion looks like from here.
            let one = Limits { n_iterations: 1, ..*limits };
            n = newton::solve_near(workspace, &mut pose, &one, work).n_iterations;
        }
        workspace.equations.gather(pose.x, &mut workspace.expected);
        let outcome = newton::solve_near(workspace, &mut pose, limits, work);
        sum.worst = sum.worst.max(outcome.worst);
        sum.n_iterations = sum.n_iterations.max(outcome.n_iterations + n);
        if !outcome.is_converged() {
            is_found = false;
            break;
        }
    }
    if is_found {
        if !island.has_degree {
            let is_rigid = |workspace: &mut Workspace| workspace.assemble().nullity(RANK_CUT) == 0;
            island.set_smooth(workspaces.iter_mut().all(is_rigid));
        }
        let correction =
            workspaces.iter().map(|workspace| workspace.correction(&island.x)).fold(0.0, f64::max);
        // What is free to choose where it goes has no branch to lose.
        if island.is_smooth() || correction > FREE_SURPRISE * limits.size {
            sum.correction = sum.correction.max(correction);
        }
    }
    island.part_workspaces = workspaces;
    is_found.then_some(())
}
