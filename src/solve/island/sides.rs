//! On which side of its singular pose everything in an island is, and what turned over.

use super::Island;
use crate::constraint::PointIdx;
use crate::solve::frame::branch::FLAT;
use crate::solve::frame::decomposition::Block;

/// On which side everything is.
pub(crate) struct Sides(Vec<f64>);

impl Island {
    /// On which side each block and each watched point is.
    pub fn sides(&self) -> Sides {
        let blocks = self.plan.blocks.iter().map(|block| block.side);
        Sides(blocks.chain(self.watch.sides.iter().copied()).collect())
    }

    /// Puts sides back.
    pub fn set_sides(&mut self, sides: Sides) {
        let mut sides = sides.0.into_iter();
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
        let mut both = before.0.iter().zip(&now.0).zip(blocks.chain(watched));
        let over = |((a, b), point): ((&f64, &f64), Option<PointIdx>)| {
            point.filter(|_| a * b < 0.0 && a.abs().min(b.abs()) > FLAT)
        };
        both.find_map(over)
    }

    /// Notes what is on the other side at a pose that was tried, as against the last that
    /// counted.
    pub fn note_turning_over(&mut self) {
        let is_over = |block: &&Block| block.is_determined && block.side * block.next_side < 0.0;
        let block = self.plan.blocks.iter().find(is_over);
        let point = block.map(|block| block.point).or_else(|| self.watched_point_over());
        self.turned_over = self.turned_over.or(point);
    }
}
