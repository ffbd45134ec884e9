//! A telescope: a length between two bounds, or one that is driven.

use super::bar::{Segment, outlined};
use super::draw::Draw;
use crate::constraint::PointIdx;
use crate::render::canvas::Canvas;
use crate::render::figure::Layer;
use crate::render::path::Path;
use crate::render::style::Class;

/// A bar of two stages that slide in one another.
#[derive(Debug, Clone, PartialEq)]
pub struct Telescope {
    /// Its ends: the outer stage hangs on the first, the inner one on the second.
    pub points: [PointIdx; 2],
    /// The length of the outer stage, world units: the least length it allows.
    pub outer: f64,
}

impl Draw for Telescope {
    fn points(&self) -> Vec<PointIdx> {
        self.points.to_vec()
    }

    fn draw(&self, canvas: &mut Canvas) {
        let [a, b] = self.points;
        let segment = Segment::between(canvas, a, b);
        // Some of the inner stage always shows, and the outer one is never a stump, so that
        // the two can be told apart whatever the bounds.
        let outer =
            canvas.page.length(self.outer).clamp(0.35 * segment.length, 0.72 * segment.length);
        let sleeve = Segment { length: outer, ..segment };
        canvas
            .figure(Layer::Bar, segment.placement)
            .path(Class::PistonEdge, Path::along_x(outer, segment.length))
            .path(Class::Piston, Path::along_x(outer, segment.length));
        outlined(canvas, &sleeve, [Class::RodEdge, Class::Rod]);
    }
}
