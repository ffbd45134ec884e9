//! A coordinate: a small cross where a point belongs.

use super::draw::Draw;
use crate::constraint::{Point, PointIdx};
use crate::render::canvas::Canvas;
use crate::render::figure::{Layer, Placement};
use crate::render::page::BoundingBox;
use crate::render::path::Path;
use crate::render::style::Class;

/// A target and the point that belongs there.
#[derive(Debug, Clone, PartialEq)]
pub struct Cross {
    /// The point.
    pub point: PointIdx,
    /// Where it belongs.
    pub target: Point,
}

impl Draw for Cross {
    fn points(&self) -> Vec<PointIdx> {
        vec![self.point]
    }

    fn extend(&self, _at: &[Point], bounds: &mut BoundingBox) {
        bounds.include(self.target);
    }

    fn draw(&self, canvas: &mut Canvas) {
        let arm = canvas.size(12.0);
        let target = canvas.page.px(self.target);
        let mut cross = Path::along_x(-arm, arm);
        cross.move_to(Point::new(0.0, -arm)).line_to(Point::new(0.0, arm));
        let path = Path::segment(canvas.px(self.point), target);
        canvas.figure(Layer::Construction, Placement::default()).path(Class::Construction, path);
        canvas.figure(Layer::Mark, Placement::at(target)).path(Class::Mark, cross);
    }
}
