//! A thin line between points that no bar connects, for a mark to hang on.

use super::bar::Segment;
use super::draw::Draw;
use crate::constraint::PointIdx;
use crate::render::canvas::Canvas;
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

    fn draw(&self, canvas: &mut Canvas) {
        let [a, b] = self.points;
        let segment = Segment::between(canvas, a, b);
        canvas
            .figure(Layer::Construction, segment.placement)
            .path(Class::Construction, Path::along_x(0.0, segment.length));
    }
}
