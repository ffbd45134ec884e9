//! On which side of its singular pose everything in an island is, and what turned over.

use super::Island;
use crate::constraint::PointIdx;
use crate::solve::frame::branch::{FLAT, Volume};

use crate::solve::method::Pose;
use crate::solve::report::Counters;

/// A pose this near to a singular one counts as singular: velocities come from squares, of which a
/// ten thousandth is too near to what is added to them.
const SINGULAR: f64 = 3e-4;

/// On which side everything is.
pub(crate) struct Sides {
    /// Of each block, then of each watched triangle.
    sides: Vec<f64>,
    volumes: Vec<Option<Volume>>,
}

impl Island {
    /// Works out the volumes of the parts at the present pose, where they are not known.
    pub fn measure_volumes(&mut self, work: &mut Counters) {
        if self.watch.knows_volumes || self.plan.is_complete() {
            return;
        }
        let mut workspaces = self.take_part_workspaces();
        for (k, workspace) in workspaces.iter_mut().enumerate() {
            let pose = Pose { constraints: &self.constraints, x: &mut self.x };
            workspace.evaluate(&pose, work);
            self.watch.volumes[k] = Volume::of(&workspace.equations, &workspace.rows);
        }
        self.part_workspaces = workspaces;
        self.watch.knows_volumes = true;
    }

    /// Whether the present pose is singular, or too near to tell: no velocity is exact there.
    pub fn is_singular(&self) -> bool {
        let blocks = self.plan.blocks.iter().filter(|block| block.has_branches());
        let sides = blocks.map(|block| block.side);
        let volumes = self.watch.volumes.iter().flatten().map(|volume| volume.value);
        sides.chain(volumes).any(|side| side.abs() < SINGULAR)
    }

    /// A point that has more than one place where its constraints hold.
    pub fn point_with_branches(&self) -> Option<PointIdx> {
        let block = self.plan.blocks.iter().find(|block| block.has_branches());
        let of_part = || {
            let parts = self.plan.rest.iter().zip(&self.watch.volumes);
            parts.filter(|(_, volume)| volume.is_some()).find_map(|(part, _)| part.points.first())
        };
        block.map(|block| block.point).or_else(|| of_part().copied())
    }

    /// On which side each block and each watched point is.
    pub fn sides(&self) -> Sides {
        let blocks = self.plan.blocks.iter().map(|block| block.side);
        let sides = blocks.chain(self.watch.sides.iter().copied()).collect();
        Sides { sides, volumes: self.watch.volumes.clone() }
    }

    /// Puts sides back.
    pub fn set_sides(&mut self, sides: Sides) {
        self.watch.volumes = sides.volumes;
        let mut sides = sides.sides.into_iter();
        self.plan.blocks.iter_mut().zip(&mut sides).for_each(|(block, side)| block.side = side);
        self.watch.sides.iter_mut().zip(&mut sides).for_each(|(to, side)| *to = side);
    }

    /// A watched point that is on the other side than at the last pose that counted. Points
    /// with freedom left may be on any side.
    pub fn watched_point_over(&self) -> Option<PointIdx> {
        self.is_smooth().then(|| self.watch.turned_over(&self.x))?
    }

    /// A point that is on the other side than it was.
    pub fn changed_since(&self, before: &Sides) -> Option<PointIdx> {
        let now = self.sides();
        let blocks = self.plan.blocks.iter();
        let blocks = blocks.map(|block| block.is_determined.then_some(block.point));
        let watched = self.watch.triangles.iter().map(|t| self.is_smooth().then_some(t[0]));
        let mut both = before.sides.iter().zip(&now.sides).zip(blocks.chain(watched));
        let over = |((a, b), point): ((&f64, &f64), Option<PointIdx>)| {
            point.filter(|_| a * b < 0.0 && a.abs().min(b.abs()) > FLAT)
        };
        both.find_map(over)
    }

    /// The present sides are those of the pose that was tried last.
    pub fn sides_are_next(&mut self) {
        for block in &mut self.plan.blocks {
            block.next_side = block.side;
        }
        self.watch.next_volumes.fill(None);
    }
}
