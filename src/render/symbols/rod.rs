//! A rod: a length that is held.

use super::bar::{Segment, outlined};
use super::draw::Draw;
use crate::constraint::PointIdx;
use crate::render::canvas::Canvas;
use crate::render::style::Class;

/// A solid bar between two joints.
#[derive(Debug, Clone, PartialEq)]
pub struct Rod {
    /// Its ends.
    pub points: [PointIdx; 2],
}

impl Draw for Rod {
    fn points(&self) -> Vec<PointIdx> {
        self.points.to_vec()
    }

    fn draw(&self, canvas: &mut Canvas) {
        let [a, b] = self.points;
        let segment = Segment::between(canvas, a, b);
        outlined(canvas, &segment, [Class::RodEdge, Class::Rod]);
    }
}
