//! A coordinate: a small cross where a point belongs.

use super::Draw;
use crate::constraint::{Point, PointIdx};
use crate::render::canvas::Ink;
use crate::render::figure::{Layer, Placement};
use crate::render::page::Extent;
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

    fn extend(&self, _at: &[Point], extent: &mut Extent) {
        extent.include(self.target);
    }

    fn draw(&self, ink: &mut Ink) {
        let arm = ink.size(12.0);
        let target = ink.page.px(self.target);
        let mut cross = Path::along_x(-arm, arm);
        cross.move_to(Point::new(0.0, -arm)).line_to(Point::new(0.0, arm));
        let path = Path::segment(ink.px(self.point), target);
        ink.figure(Layer::Construction, Placement::default()).path(Class::Construction, path);
        ink.figure(Layer::Mark, Placement::at(target)).path(Class::Mark, cross);
    }
}
