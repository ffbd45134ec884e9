//! A glider: a rail with end stops and a block on it.

use super::bar::Segment;
use super::draw::Draw;
use crate::constraint::{Point, PointIdx};
use crate::render::canvas::Canvas;
use crate::render::figure::{Layer, Placement};
use crate::render::path::Path;
use crate::render::style::Class;

/// A rail and the block that slides on it.
#[derive(Debug, Clone, PartialEq)]
pub struct Rail {
    /// The point on the block.
    pub block: PointIdx,
    /// The points that segment the rail.
    pub ends: [PointIdx; 2],
    /// Whether the rail ends there.
    pub is_bounded: bool,
}

impl Draw for Rail {
    fn points(&self) -> Vec<PointIdx> {
        vec![self.block, self.ends[0], self.ends[1]]
    }

    fn draw(&self, canvas: &mut Canvas) {
        let [a, b] = self.ends;
        let segment = Segment::between(canvas, a, b);
        let (half_stop, beyond) = (canvas.size(11.0), canvas.size(34.0));
        let (half_length, half_width) = (canvas.size(12.0), canvas.size(7.5));
        let block = canvas.px(self.block);
        let along = segment.placement;

        let rail = canvas.figure(Layer::Rail, along);
        rail.path(Class::Rail, Path::along_x(0.0, segment.length));
        if self.is_bounded {
            let stops = canvas.figure(Layer::Slider, along);
            for x in [0.0, segment.length] {
                let stop = Path::segment(Point::new(x, -half_stop), Point::new(x, half_stop));
                stops.path(Class::Stop, stop);
            }
        } else {
            // On to where the block is, and somewhat further: there is no end.
            let x = (block - along.at).rotate(-along.turn.to_radians()).x;
            let from = x.min(0.0) - beyond;
            let to = x.max(segment.length) + beyond;
            rail.path(Class::RailOn, Path::along_x(0.0, from));
            rail.path(Class::RailOn, Path::along_x(segment.length, to));
        }
        let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
        let corners = corners.map(|(x, y)| Point::new(x * half_length, y * half_width));
        canvas
            .figure(Layer::Slider, Placement { at: block, ..along })
            .path(Class::Block, Path::polygon(corners));
    }
}
