//! A coincidence: a ring around two points that are one.

use super::bar::Segment;
use super::draw::Draw;
use crate::constraint::{Point, PointIdx};
use crate::render::canvas::Canvas;
use crate::render::figure::{Layer, Placement};
use crate::render::path::Path;
use crate::render::style::{Class, JOINT};

/// Two points in one place.
#[derive(Debug, Clone, PartialEq)]
pub struct Ring {
    /// The points.
    pub points: [PointIdx; 2],
}

impl Draw for Ring {
    fn points(&self) -> Vec<PointIdx> {
        self.points.to_vec()
    }

    fn draw(&self, canvas: &mut Canvas) {
        let [a, b] = self.points;
        let segment = Segment::between(canvas, a, b);
        let middle = Placement::at(segment.middle().at);
        let radius = canvas.size(2.0 * JOINT);
        canvas
            .figure(Layer::Construction, segment.placement)
            .path(Class::Construction, Path::along_x(0.0, segment.length));
        canvas.figure(Layer::Mark, middle).circle(Class::Mark, Point::ORIGIN, radius);
    }
}
