//! An attempt at a pose from an expected one: block by block, then the parts that are solved as a
//! whole.

use super::dyad;
use super::expected::{NO_MOTION, SURPRISE};
use crate::constraint::{ConstraintKind, Point};
use crate::solve::island::Island;
use crate::solve::island::sides::SINGULAR;
use crate::solve::method::newton;
use crate::solve::method::{Limits, Pose, Stiffness, Workspace};
use crate::solve::report::Counters;

/// A correction larger than this part of the size means the same for points with freedom left.
const FREE_SURPRISE: f64 = 0.02;
/// Squares of singular values below this count as freedom: in the middle of the range in
/// which the count was right on all scenes measured, 1e-14 to 1e-6.
const RANK_CUT: f64 = 1e-10;

/// Where the least singular value of all rows is larger than this, the other place where they hold
/// is at least such a part of the size away.
const REGULAR: f64 = 1e-2;

/// How an attempt at a pose from an expected one went.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Attempt {
    /// The largest distance to satisfaction, length units.
    pub worst: f64,
    /// The steps it took.
    pub n_iterations: u32,
    /// How far the farthest point ended from where it was expected.
    pub correction: f64,
    /// The largest correction of a point as a part of the way to the other place where its
    /// constraints hold, over those that are on the side they were on, squared.
    pub doubt_squared: f64,
    /// How far away the nearest of these places is, squared.
    pub nearest_squared: f64,
    /// Whether something is on the other side of a singular pose than before, or was too near to
    /// one to tell.
    pub has_crossed: bool,
    /// Of what has crossed, the largest correction against what lay between the two places before and after.
    pub leap: f64,
    /// How near the pose is to a singular one, as the sine of an angle or a pivot: an error of a
    /// length is one of a place divided by this.
    pub least_side: f64,
}

impl Attempt {
    /// Takes in on which side of its singular pose something is that was corrected by so much: before
    /// and now, and the square of how far away its other place is for a side of 1.
    #[inline]
    fn compare(&mut self, [before, now]: [f64; 2], correction: f64, apart_squared: f64) {
        // Comparisons, since `min` and `max` ask about values that are not numbers each time.
        if now.abs() < self.least_side {
            self.least_side = now.abs();
        }
        if before * now > 0.0 && before.abs() > SINGULAR {
            let apart_squared = apart_squared * (now * now);
            if apart_squared < self.nearest_squared {
                self.nearest_squared = apart_squared;
            }
            let squared = correction * correction;
            if squared > self.doubt_squared * apart_squared {
                self.doubt_squared = squared / apart_squared;
            }
        } else {
            self.has_crossed = true;
            if correction > 0.0 {
                let apart = apart_squared.sqrt() * (before.abs() + now.abs());
                self.leap = self.leap.max(correction / apart);
            }
        }
    }

    /// Whether the pose ends near where it was expected, for a motion of this length.
    pub fn is_expected(&self, motion: f64, limits: &Limits) -> bool {
        self.correction <= SURPRISE * motion || motion <= NO_MOTION * limits.size
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
    let may_be_found_at_once =
        is_predicted && island.plan.is_redundant && island.plan.is_complete();
    let expected = may_be_found_at_once.then(|| Box::from(&island.x[..island.n_free]));
    let Some(mut sum) = attempt_blocks(island, is_predicted, limits, work) else {
        return attempt_whole(island, &expected?, limits, work);
    };
    if !island.plan.is_complete() {
        attempt_rest(island, is_predicted, limits, work, &mut sum)?;
    }
    Some(sum)
}

/// Looks for the points that are found one by one.
#[inline]
fn attempt_blocks(
    island: &mut Island,
    is_predicted: bool,
    limits: &Limits,
    work: &mut Counters,
) -> Option<Attempt> {
    let mut sum = Attempt { least_side: 1.0, nearest_squared: f64::INFINITY, ..Attempt::default() };
    let Island { plan, constraints, x, .. } = island;
    for block in &mut plan.blocks {
        let which = &plan.constraints[block.first as usize..block.end as usize];
        let found = dyad::find(block, which, constraints, x, is_predicted, limits, work)?;
        if found.worst > sum.worst {
            sum.worst = found.worst;
        }
        sum.n_iterations = sum.n_iterations.max(found.n_steps);
        if found.correction > sum.correction
            && (block.is_determined || found.correction > FREE_SURPRISE * limits.size)
        {
            sum.correction = found.correction;
        }
        if block.has_branches() {
            sum.compare([block.side.sine, found.sine], found.correction, found.apart_squared);
        }
        block.next_side = found.side;
    }
    Some(sum)
}

/// Looks for all points at once. Where two bars are in line, a third may tell where their point is,
/// but only through points that are found after it.
fn attempt_whole(
    island: &mut Island,
    expected: &[Point],
    limits: &Limits,
    work: &mut Counters,
) -> Option<Attempt> {
    island.x[..expected.len()].copy_from_slice(expected);
    let (outcome, is_regular) = island.with_workspace(|workspace, pose, _| {
        let outcome = newton::solve_near(workspace, pose, limits, work);
        (outcome, workspace.assemble(Stiffness::None).nullity(REGULAR * REGULAR) == 0)
    });
    if !outcome.is_converged() || !is_regular {
        return None;
    }
    for k in 0..island.plan.blocks.len() {
        let side = island.side_of_block(k);
        island.plan.blocks[k].next_side = side;
    }
    let correction = motion_between(&island.x, expected);
    let doubt = correction / (REGULAR * limits.size);
    Some(Attempt {
        worst: outcome.worst,
        n_iterations: outcome.n_iterations,
        correction,
        doubt_squared: doubt * doubt,
        least_side: REGULAR,
        ..Attempt::default()
    })
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
        for (k, workspace) in workspaces.iter().enumerate() {
            let now = island.part_side(workspace);
            island.watch.next_part_sides[k] = now;
            if let (Some(before), Some(now)) = (island.watch.part_sides[k], now)
                && before.is_like(now)
            {
                let part = &island.plan.rest[k];
                let lengths = part.constraints.iter();
                let lengths = lengths.map(|&c| island.constraints[c as usize].nominal_length());
                let shortest = lengths.filter(|l| *l > 0.0).fold(limits.size, f64::min);
                let sides = [before.value, now.value];
                let apart_squared = 4.0 * shortest * shortest;
                sum.compare(sides, workspace.correction(&island.x), apart_squared);
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
