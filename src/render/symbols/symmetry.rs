//! A symmetry: a dash-dotted axis with two strokes across it at either end, and a thin line from
//! a point to its image.

use super::bar::Segment;
use super::draw::Draw;
use crate::constraint::{Point, PointIdx};
use crate::render::canvas::Canvas;
use crate::render::figure::Layer;
use crate::render::path::Path;
use crate::render::style::Class;

/// Two points that mirror one another, and the axis.
#[derive(Debug, Clone, PartialEq)]
pub struct Symmetry {
    /// A point and its image.
    pub points: [PointIdx; 2],
    /// Two points of the axis.
    pub axis: [PointIdx; 2],
}

impl Draw for Symmetry {
    fn points(&self) -> Vec<PointIdx> {
        [self.points, self.axis].concat()
    }

    fn draw(&self, canvas: &mut Canvas) {
        let [a, b] = self.points.map(|p| canvas.px(p));
        let [p, q] = self.axis.map(|p| canvas.px(p));
        let (beyond, half, gap) = (canvas.size(16.0), canvas.size(7.0), canvas.size(4.0));
        let across = Segment::new(a, b);
        canvas
            .figure(Layer::Construction, across.placement)
            .path(Class::Construction, Path::along_x(0.0, across.length));
        let Some(e) = (q - p).unit() else { return };
        // From before the first of all four to behind the last.
        let along = [a, b, q].map(|at| (at - p).dot(e));
        let from = along.into_iter().fold(0.0, f64::min) - beyond;
        let to = along.into_iter().fold(0.0, f64::max) + beyond;
        let axis = Segment::new(p + e * from, p + e * to);
        let mut strokes = Path::default();
        for x in [gap, 2.0 * gap, axis.length - 2.0 * gap, axis.length - gap] {
            strokes.move_to(Point::new(x, -half)).line_to(Point::new(x, half));
        }
        canvas
            .figure(Layer::Mark, axis.placement)
            .path(Class::Axis, Path::along_x(0.0, axis.length))
            .path(Class::Mark, strokes);
    }
}
