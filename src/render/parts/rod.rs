//! A rod: a length that is held.

use super::Draw;
use super::bar::{Span, outlined};
use crate::constraint::PointIdx;
use crate::render::canvas::Ink;
use crate::render::style::Class;

/// A solid bar between two joints.
#[derive(Debug, Clone, PartialEq)]
pub struct Rod {
    /// Its ends.
    pub points: [PointIdx; 2],
}

impl Draw for Rod {
    fn points(&self) -> Vec<PointIdx> {
        self.points.to_vec()
    }

    fn draw(&self, ink: &mut Ink) {
        let [a, b] = self.points;
        let span = Span::between(ink, a, b);
        outlined(ink, &span, [Class::RodEdge, Class::Rod]);
    }
}
