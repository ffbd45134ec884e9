//! The distance of a point to a line, as a dimension line.

use super::bar::{Segment, arrow_head};
use super::draw::Draw;
use crate::constraint::{Point, PointIdx, Vector};
use crate::render::canvas::Canvas;
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

    fn draw(&self, canvas: &mut Canvas) {
        let [a, b] = self.line.map(|p| canvas.px(p));
        let p = canvas.px(self.point);
        let Some(e) = (b - a).unit() else {
            return;
        };
        let along = (p - a).dot(e);
        let support = a + e * along;
        // A support beyond the segment stands on its extension.
        let near = a + e * along.clamp(0.0, a.distance(b));
        let extension = Segment::new(near, support);
        canvas
            .figure(Layer::Construction, extension.placement)
            .path(Class::Construction, Path::along_x(0.0, extension.length));
        let segment = Segment::new(p, support);
        let head = canvas.size(9.0).min(0.4 * segment.length);
        let x_axis = Vector::new(1.0, 0.0);
        canvas
            .figure(Layer::Mark, segment.placement)
            .path(
                Class::Mark,
                Path::along_x(0.5 * head, (segment.length - 0.5 * head).max(0.5 * head)),
            )
            .path(Class::Arrow, arrow_head(Point::ORIGIN, -x_axis, head))
            .path(Class::Arrow, arrow_head(Point::new(segment.length, 0.0), x_axis, head));
    }
}
