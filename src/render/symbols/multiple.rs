//! A length that is a multiple of another: both named by letters, `2a` and `a`.

use std::sync::Arc;

use super::bar::Segment;
use super::draw::Draw;
use crate::constraint::{Point, PointIdx, Vector};
use crate::render::canvas::Canvas;
use crate::render::figure::{Layer, Placement};
use crate::render::style::{BASE_LINE, Class};

/// Two segments whose lengths have a ratio.
#[derive(Debug, Clone, PartialEq)]
pub struct Multiple {
    /// The ends of the one, the ends of the other.
    pub points: [PointIdx; 4],
    /// What is written beside each.
    pub texts: [Arc<str>; 2],
}

impl Draw for Multiple {
    fn points(&self) -> Vec<PointIdx> {
        self.points.to_vec()
    }

    fn draw(&self, canvas: &mut Canvas) {
        let [a, b, c, d] = self.points;
        let size = canvas.size(14.0);
        for ([p, q], text) in [[a, b], [c, d]].into_iter().zip(&self.texts) {
            let segment = Segment::between(canvas, p, q);
            let across = Vector::polar(1.0, segment.placement.turn.to_radians()).perp();
            // Beside the segment, on the side that is up or else to the right.
            let is_up = across.y < -1e-9 || across.y <= 1e-9 && across.x > 0.0;
            let beside = across * (if is_up { size } else { -size });
            let base_line = Point::new(0.0, BASE_LINE * size);
            canvas.figure(Layer::Mark, Placement::at(segment.middle().at + beside)).text(
                Class::Name,
                base_line,
                text.clone(),
            );
        }
    }
}
