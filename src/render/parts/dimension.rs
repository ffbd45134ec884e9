//! The distance of a point to a line, as a dimension line.

use super::Draw;
use super::bar::{Span, arrow_head};
use crate::constraint::{Point, PointIdx, Vector};
use crate::render::canvas::Ink;
use crate::render::figure::Layer;
use crate::render::path::Path;
use crate::render::style::Class;

/// A point and the line it keeps a distance to.
#[derive(Debug, Clone, PartialEq)]
pub struct Dimension {
    /// The point.
    pub point: PointIdx,
    /// Two points of the line.
    pub line: [PointIdx; 2],
}

impl Draw for Dimension {
    fn points(&self) -> Vec<PointIdx> {
        vec![self.point, self.line[0], self.line[1]]
    }

    fn draw(&self, ink: &mut Ink) {
        let [a, b] = self.line.map(|p| ink.px(p));
        let p = ink.px(self.point);
        let Some(e) = (b - a).unit() else {
            return;
        };
        let along = (p - a).dot(e);
        let foot = a + e * along;
        // A foot beyond the segment stands on its extension.
        let near = a + e * along.clamp(0.0, a.distance(b));
        let extension = Span::new(near, foot);
        ink.figure(Layer::Construction, extension.placement)
            .path(Class::Construction, Path::along_x(0.0, extension.length));
        let span = Span::new(p, foot);
        let head = ink.size(9.0).min(0.4 * span.length);
        let x_axis = Vector::new(1.0, 0.0);
        ink.figure(Layer::Mark, span.placement)
            .path(
                Class::Mark,
                Path::along_x(0.5 * head, (span.length - 0.5 * head).max(0.5 * head)),
            )
            .path(Class::Arrow, arrow_head(Point::ORIGIN, -x_axis, head))
            .path(Class::Arrow, arrow_head(Point::new(span.length, 0.0), x_axis, head));
    }
}
