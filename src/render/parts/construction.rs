//! A thin line between points that no bar connects, for a mark to hang on.

use super::Draw;
use super::bar::Span;
use crate::constraint::PointIdx;
use crate::render::canvas::Ink;
use crate::render::figure::Layer;
use crate::render::path::Path;
use crate::render::style::Class;

/// A line that is measured and not made of anything.
#[derive(Debug, Clone, PartialEq)]
pub struct Construction {
    /// Its ends.
    pub points: [PointIdx; 2],
}

impl Draw for Construction {
    fn points(&self) -> Vec<PointIdx> {
        self.points.to_vec()
    }

    fn draw(&self, ink: &mut Ink) {
        let [a, b] = self.points;
        let span = Span::between(ink, a, b);
        ink.figure(Layer::Construction, span.placement)
            .path(Class::Construction, Path::along_x(0.0, span.length));
    }
}
