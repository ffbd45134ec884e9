//! The area within three rods, which hold one another rigid.

use super::Draw;
use super::bar::Span;
use super::plate::polygon_from;
use crate::constraint::PointIdx;
use crate::render::canvas::Ink;
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

    fn draw(&self, ink: &mut Ink) {
        let [a, b, _] = self.points;
        let placement = Span::between(ink, a, b).placement;
        let outline = polygon_from(ink, &placement, &self.points);
        ink.figure(Layer::Plate, placement).path(Class::Web, outline);
    }
}
