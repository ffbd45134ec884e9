//! An attempt at a pose from an expected one: block by block, then the parts that are solved as a
//! whole.

use super::branch::{Volume, may_cross};
use super::dyad;
use crate::constraint::Point;
use crate::solve::island::Island;
use crate::solve::method::newton;
use crate::solve::method::{Limits, Pose, Stiffness, Workspace};
use crate::solve::report::Counters;

/// A correction of the expected pose larger than this part of the motion means that the
/// motion was not understood; measured on mechanisms at 1 to 60 degrees a frame.
pub(crate) const SURPRISE: f64 = 0.3;
/// The same for points with freedom left, against the size.
const FREE_SURPRISE: f64 = 0.02;
/// A motion that is smaller than this part of the size is not worth a second look.
pub(crate) const NO_MOTION: f64 = 1e-6;

/// Squares of singular values below this count as freedom: in the middle of the range in
/// which the count was right on all scenes measured, 1e-14 to 1e-6.
const RANK_CUT: f64 = 1e-10;

/// How an attempt at a pose from an expected one went.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Attempt {
    /// The largest distance to satisfaction, length units.
    pub worst: f64,
    /// The steps it took.
    pub n_iterations: u32,
    /// How far the farthest point ended from where it was expected.
    pub correction: f64,
    /// Whether a singular pose lies on the way, or may.
    pub may_cross: bool,
    /// How near the pose is to a singular one, as the sine of an angle or as a volume: an error of a
    /// length is one of a place divided by this.
    pub least_side: f64,
}

impl Attempt {
    /// Whether the pose, reached by `motion` from the last one, follows from it.
    pub fn is_safe(&self, motion: f64, limits: &Limits) -> bool {
        !self.may_cross
            && (self.correction <= SURPRISE * motion || motion <= NO_MOTION * limits.size)
    }
}

/// The longest way a free point went since a pose.
pub(crate) fn motion_since(island: &Island, before: &[Point]) -> f64 {
    motion_between(&island.x, before)
}

/// The longest way between two poses.
pub(crate) fn motion_between(now: &[Point], before: &[Point]) -> f64 {
    let moves = now.iter().zip(before).map(|(a, b)| *a - *b);
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
    let mut sum = Attempt { least_side: 1.0, ..Attempt::default() };
    let Island { plan, constraints, x, .. } = island;
    for block in &mut plan.blocks {
        let which = &plan.constraints[block.first as usize..block.end as usize];
        let found = dyad::find(block, which, constraints, x, is_predicted, limits, work)?;
        sum.worst = sum.worst.max(found.worst);
        sum.n_iterations = sum.n_iterations.max(found.n_steps);
        if block.is_determined || found.correction > FREE_SURPRISE * limits.size {
            sum.correction = sum.correction.max(found.correction);
        }
        if block.has_branches() {
            sum.may_cross |= may_cross(block.side, found.side);
            sum.least_side = sum.least_side.min(found.side.abs());
        }
        block.next_side = found.side;
    }
    if !island.plan.is_complete() {
        attempt_rest(island, is_predicted, limits, work, &mut sum)?;
    }
    Some(sum)
}

/// The same for the parts that are solved as a whole.
fn attempt_rest(
    island: &mut Island,
    is_predicted: bool,
    limits: &Limits,
    work: &mut Counters,
    sum: &mut Attempt,
) -> Option<()> {
    let mut workspaces = island.take_part_workspaces();
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
            let is_rigid = |workspace: &mut Workspace| {
                workspace.assemble(Stiffness::None).nullity(RANK_CUT) == 0
            };
            island.set_smooth(workspaces.iter_mut().all(is_rigid));
        }
        let correction =
            workspaces.iter().map(|workspace| workspace.correction(&island.x)).fold(0.0, f64::max);
        if island.is_smooth() {
            for (k, workspace) in workspaces.iter().enumerate() {
                let now = Volume::of(&workspace.equations, &workspace.rows);
                island.watch.next_volumes[k] = now;
                if let (Some(before), Some(now)) = (island.watch.volumes[k], now) {
                    sum.may_cross |= before.may_cross(now);
                    sum.least_side = sum.least_side.min(now.value.abs());
                }
            }
        }
        // What is free to choose where it goes has no branch to lose.
        if island.is_smooth() || correction > FREE_SURPRISE * limits.size {
            sum.correction = sum.correction.max(correction);
        }
    }
    island.part_workspaces = workspaces;
    is_found.then_some(())
}
