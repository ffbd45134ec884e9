//! A segment parallel to an axis: a small H or V beside its middle.

use super::bar::Segment;
use super::draw::Draw;
use crate::constraint::{AxisDirection, Point, PointIdx, Vector};
use crate::render::canvas::Canvas;
use crate::render::figure::{Layer, Placement};
use crate::render::path::Path;
use crate::render::style::Class;

/// Two points on a line parallel to an axis.
#[derive(Debug, Clone, PartialEq)]
pub struct AxisMark {
    /// The points.
    pub points: [PointIdx; 2],
    /// Which axis.
    pub direction: AxisDirection,
}

impl Draw for AxisMark {
    fn points(&self) -> Vec<PointIdx> {
        self.points.to_vec()
    }

    fn draw(&self, canvas: &mut Canvas) {
        let [a, b] = self.points;
        let middle = Segment::between(canvas, a, b).middle().at;
        // Above a horizontal segment and to the right of a vertical one; page y grows downward.
        let (half, away) = (canvas.size(4.0), canvas.size(12.0));
        let corner = |x: f64, y: f64| Point::new(x * half, y * half);
        let mut letter = Path::default();
        let beside = match self.direction {
            AxisDirection::Horizontal => {
                letter.move_to(corner(-0.8, -1.0)).line_to(corner(-0.8, 1.0));
                letter.move_to(corner(0.8, -1.0)).line_to(corner(0.8, 1.0));
                letter.move_to(corner(-0.8, 0.0)).line_to(corner(0.8, 0.0));
                Vector::new(0.0, -away)
            }
            AxisDirection::Vertical => {
                letter.move_to(corner(-0.9, -1.0)).line_to(corner(0.0, 1.0));
                letter.line_to(corner(0.9, -1.0));
                Vector::new(away, 0.0)
            }
        };
        canvas.figure(Layer::Mark, Placement::at(middle + beside)).path(Class::Mark, letter);
    }
}
