//! A coincidence: a ring around two points that are one.

use super::Draw;
use super::bar::Span;
use crate::constraint::{Point, PointIdx};
use crate::render::canvas::Ink;
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

    fn draw(&self, ink: &mut Ink) {
        let [a, b] = self.points;
        let span = Span::between(ink, a, b);
        let middle = Placement::at(span.middle().at);
        let radius = ink.size(2.0 * JOINT);
        ink.figure(Layer::Construction, span.placement)
            .path(Class::Construction, Path::along_x(0.0, span.length));
        ink.figure(Layer::Mark, middle).circle(Class::Mark, Point::ORIGIN, radius);
    }
}
