//! The area within three rods, which hold one another rigid.

use super::bar::Segment;
use super::draw::Draw;
use super::plate::polygon_from;
use crate::constraint::PointIdx;
use crate::render::canvas::Canvas;
use crate::render::figure::Layer;
use crate::render::style::Class;

/// A lightly filled triangle.
#[derive(Debug, Clone, PartialEq)]
pub struct Web {
    /// Its corners.
    pub points: [PointIdx; 3],
}

impl Draw for Web {
    fn points(&self) -> Vec<PointIdx> {
        self.points.to_vec()
    }

    fn draw(&self, canvas: &mut Canvas) {
        let [a, b, _] = self.points;
        let placement = Segment::between(canvas, a, b).placement;
        let outline = polygon_from(canvas, &placement, &self.points);
        canvas.figure(Layer::Plate, placement).path(Class::Web, outline);
    }
}
