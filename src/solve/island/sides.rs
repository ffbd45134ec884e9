//! On which side of its singular pose everything in an island is, and what turned over.

use super::Island;
use super::known_sides::{KnownSides, WatchedSides};
use crate::constraint::PointIdx;
use crate::solve::frame::branch::{FLAT, PartSide};
use crate::solve::frame::decomposition::Side;
use crate::solve::method::{Pose, Workspace};
use crate::solve::report::Counters;

/// And this near it counts as singular: rounding leaves open on which side of it the pose is.
pub(crate) const SINGULAR: f64 = 1e-6;

/// On which side everything is.
#[derive(Clone)]
pub(crate) struct Sides {
    blocks: Vec<Side>,
    /// Of each watched triangle.
    triangles: Vec<f64>,
    parts: Vec<Option<PartSide>>,
}

impl Island {
    /// Whether anything is watched in parts that are solved as a whole.
    pub fn is_watched(&self) -> bool {
        !self.watch.triangles.is_empty() || !self.watch.part_sides.is_empty()
    }

    /// On which side everything was when last looked at.
    pub fn known_sides(&self) -> KnownSides {
        let watch = &self.watch;
        let watched = self.is_watched().then(|| {
            Box::new(WatchedSides {
                triangles: watch.sides.clone(),
                parts: watch.part_sides.clone(),
                knows_parts: watch.knows_part_sides,
            })
        });
        let (are_old, blocks) = self.block_sides();
        KnownSides { blocks: blocks.collect(), are_old, watched }
    }

    /// The same of its blocks, and whether it has to be worked out again: what they were before does
    /// not matter then, and is left out.
    pub fn block_sides(&self) -> (bool, impl ExactSizeIterator<Item = Side>) {
        let blocks = if self.are_sides_old { &[][..] } else { &self.plan.blocks };
        (self.are_sides_old, blocks.iter().map(|block| block.side))
    }

    /// Brings back what [`known_sides`](Self::known_sides) gave.
    pub fn recall_sides(&mut self, sides: &KnownSides) {
        self.are_sides_old = sides.are_old;
        for (block, side) in self.plan.blocks.iter_mut().zip(&sides.blocks) {
            block.side = *side;
        }
        if let Some(watched) = &sides.watched {
            self.watch.sides.clone_from(&watched.triangles);
            self.watch.part_sides.clone_from(&watched.parts);
            self.watch.knows_part_sides = watched.knows_parts;
        }
    }

    /// On which side a part is where its rows were evaluated; none of what is known to have freedom left, which may be
    /// on any.
    pub fn part_side(&self, workspace: &Workspace) -> Option<PartSide> {
        let may_be_on_any = self.has_degree && !self.is_smooth();
        if may_be_on_any { None } else { PartSide::of(&workspace.equations, &workspace.rows) }
    }

    /// Works out on which side the parts are at the present pose, where they are not known.
    pub fn measure_part_sides(&mut self, work: &mut Counters) {
        if self.watch.knows_part_sides || self.plan.is_complete() {
            return;
        }
        let mut workspaces = self.take_part_workspaces();
        for (k, workspace) in workspaces.iter_mut().enumerate() {
            let pose = Pose { constraints: &self.constraints, x: &mut self.x };
            workspace.evaluate(&pose, work);
            self.watch.part_sides[k] = self.part_side(workspace);
        }
        self.part_workspaces = workspaces;
        self.watch.knows_part_sides = true;
    }

    /// Whether the last pose that counted is as near to a singular one as that.
    pub fn is_singular(&self, nearness: f64) -> bool {
        self.singular_point(nearness).is_some()
    }

    /// A point of what is as near to a singular pose.
    pub fn singular_point(&self, nearness: f64) -> Option<PointIdx> {
        let mut blocks = self.plan.blocks.iter().filter(|block| block.has_branches());
        let block = blocks.find(|block| block.side.sine.abs() < nearness).map(|block| block.point);
        let of_part = || {
            let mut parts = self.plan.rest.iter().zip(&self.watch.part_sides);
            let is_near = |side: &PartSide| side.value.abs() < nearness;
            let (part, _) = parts.find(|(_, side)| side.as_ref().is_some_and(is_near))?;
            part.points.first().copied()
        };
        block.or_else(of_part)
    }

    /// A point that has more than one place where its constraints hold.
    pub fn point_with_branches(&self) -> Option<PointIdx> {
        let block = self.plan.blocks.iter().find(|block| block.has_branches());
        let of_part = || {
            let parts = self.plan.rest.iter().zip(&self.watch.part_sides);
            parts
                .filter(|(_, part_side)| part_side.is_some())
                .find_map(|(part, _)| part.points.first())
        };
        block.map(|block| block.point).or_else(|| of_part().copied())
    }

    /// On which side each block and each watched point is.
    pub fn sides(&self) -> Sides {
        Sides {
            blocks: self.plan.blocks.iter().map(|block| block.side).collect(),
            triangles: self.watch.sides.clone(),
            parts: self.watch.part_sides.clone(),
        }
    }

    /// Puts sides back.
    pub fn set_sides(&mut self, sides: Sides) {
        let blocks = self.plan.blocks.iter_mut();
        blocks.zip(sides.blocks).for_each(|(block, side)| block.side = side);
        self.watch.part_sides = sides.parts;
        self.watch.sides = sides.triangles;
    }

    /// A watched point that is on the other side than at the last pose that counted. Points
    /// with freedom left may be on any side.
    pub fn watched_point_over(&self) -> Option<PointIdx> {
        self.is_smooth().then(|| self.watch.turned_over(&self.x))?
    }

    /// A point that is on the other side than it was.
    pub fn changed_since(&self, before: &Sides) -> Option<PointIdx> {
        let is_over = |a: f64, b: f64| a * b < 0.0 && a.abs().min(b.abs()) > FLAT;
        let mut blocks = self.plan.blocks.iter().zip(&before.blocks);
        let block = blocks.find(|(block, before)| {
            let now = block.side;
            block.is_determined && now.other == before.other && is_over(before.sine, now.sine)
        });
        let triangle = || {
            let both = before.triangles.iter().zip(&self.watch.sides);
            let mut triangles = both.zip(&self.watch.triangles);
            triangles.find(|((a, b), _)| is_over(**a, **b)).map(|(_, triangle)| triangle[0])
        };
        block
            .map(|(block, _)| block.point)
            .or_else(|| if self.is_smooth() { triangle() } else { None })
    }

    /// The present sides are those of the pose that was tried last.
    pub fn sides_are_next(&mut self) {
        for block in &mut self.plan.blocks {
            block.next_side = block.side;
        }
        self.watch.next_part_sides.copy_from_slice(&self.watch.part_sides);
    }
}
