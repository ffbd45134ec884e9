//! What an equation ties: a small `=` beside each, or the sign of an inequality.

use super::bar::Segment;
use super::draw::Draw;
use crate::constraint::{Point, PointIdx, Vector};
use crate::render::canvas::Canvas;
use crate::render::figure::{Layer, Placement};
use crate::render::path::Path;
use crate::render::style::Class;

/// Where along a segment its sign is.
const OFF_MIDDLE: f64 = 0.4;

/// The points and the segments between points that an expression measures.
#[derive(Debug, Clone, PartialEq)]
pub struct Equation {
    /// Pairs of points whose distance or direction is measured.
    pub segments: Vec<[PointIdx; 2]>,
    /// Points that are measured by themselves.
    pub points: Vec<PointIdx>,
    /// Whether it is an equation, and no inequality.
    pub is_equality: bool,
}

impl Equation {
    fn sign(&self, size: f64) -> Path {
        let mut sign = Path::default();
        let corner = |x: f64, y: f64| Point::new(x * size, y * size);
        if self.is_equality {
            sign.move_to(corner(-1.0, -0.45)).line_to(corner(1.0, -0.45));
            sign.move_to(corner(-1.0, 0.45)).line_to(corner(1.0, 0.45));
        } else {
            sign.move_to(corner(1.0, -1.1)).line_to(corner(-1.0, -0.3)).line_to(corner(1.0, 0.5));
            sign.move_to(corner(-1.0, 1.1)).line_to(corner(1.0, 1.1));
        }
        sign
    }
}

impl Draw for Equation {
    fn points(&self) -> Vec<PointIdx> {
        self.segments.iter().flatten().chain(&self.points).copied().collect()
    }

    fn draw(&self, canvas: &mut Canvas) {
        let (size, away) = (canvas.size(4.5), canvas.size(13.0));
        let beside_segment = |&[a, b]: &[PointIdx; 2]| {
            let segment = Segment::between(canvas, a, b);
            let across = Vector::polar(away, segment.placement.turn.to_radians()).perp();
            // Beside the segment, on the side that is down or else to the left: dimensions and
            // letters are on the other.
            let is_up = across.y < -1e-9 || across.y <= 1e-9 && across.x > 0.0;
            // Not at the middle, where there may be a point with a sign of its own.
            segment.placement.place(Point::new(OFF_MIDDLE * segment.length, 0.0))
                + if is_up { -across } else { across }
        };
        // Below and to the right of a point: names begin on the other side.
        let below = Vector::polar(away, 0.25 * std::f64::consts::PI);
        let mut places: Vec<Point> = self.segments.iter().map(beside_segment).collect();
        places.extend(self.points.iter().map(|&p| canvas.px(p) + below));
        for at in places {
            let sign = self.sign(size);
            canvas.figure(Layer::Mark, Placement::at(at)).path(Class::Mark, sign);
        }
    }
}
