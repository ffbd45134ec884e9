//! A glider: a rail with end stops and a block on it.

use super::Draw;
use super::bar::Span;
use crate::constraint::{Point, PointIdx};
use crate::render::canvas::Ink;
use crate::render::figure::{Layer, Placement};
use crate::render::path::Path;
use crate::render::style::Class;

/// A rail and the block that slides on it.
#[derive(Debug, Clone, PartialEq)]
pub struct Rail {
    /// The point on the block.
    pub block: PointIdx,
    /// The points that span the rail.
    pub ends: [PointIdx; 2],
    /// Whether the rail ends there.
    pub is_bounded: bool,
}

impl Draw for Rail {
    fn points(&self) -> Vec<PointIdx> {
        vec![self.block, self.ends[0], self.ends[1]]
    }

    fn draw(&self, ink: &mut Ink) {
        let [a, b] = self.ends;
        let span = Span::between(ink, a, b);
        let (half_stop, beyond) = (ink.size(11.0), ink.size(34.0));
        let (half_length, half_width) = (ink.size(12.0), ink.size(7.5));
        let block = ink.px(self.block);
        let along = span.placement;

        let rail = ink.figure(Layer::Rail, along);
        rail.path(Class::Rail, Path::along_x(0.0, span.length));
        if self.is_bounded {
            let stops = ink.figure(Layer::Slider, along);
            for x in [0.0, span.length] {
                let stop = Path::segment(Point::new(x, -half_stop), Point::new(x, half_stop));
                stops.path(Class::Stop, stop);
            }
        } else {
            // On to where the block is, and somewhat further: there is no end.
            let x = (block - along.at).rotate(-along.turn.to_radians()).x;
            let from = x.min(0.0) - beyond;
            let to = x.max(span.length) + beyond;
            rail.path(Class::RailOn, Path::along_x(0.0, from));
            rail.path(Class::RailOn, Path::along_x(span.length, to));
        }
        let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
        let corners = corners.map(|(x, y)| Point::new(x * half_length, y * half_width));
        ink.figure(Layer::Slider, Placement { at: block, ..along })
            .path(Class::Block, Path::polygon(corners));
    }
}
