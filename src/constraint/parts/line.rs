//! A point against a line, shared by the glider and the distance.

use super::geometry::has_direction;
use crate::constraint::{Point, PointIdx, Row, Vector};

/// Where a point stands against the line from A to B.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Foot {
    /// The unit vector to the left of the line.
    pub normal: Vector,
    /// The distance from A to B.
    pub length: f64,
    /// The signed distance of the point, positive on the left.
    pub height: f64,
    /// The paper's mu: where its foot divides AB, 0 at A and 1 at B.
    pub mu: f64,
}

impl Foot {
    /// Of the first point on the line through the others; none if they span no line.
    pub fn new([x1, x2, x3]: [Point; 3]) -> Option<Self> {
        if !has_direction(x2, x3) {
            return None;
        }
        let v = x3 - x2;
        let length = v.norm();
        let e = v / length;
        let arm = x1 - x2;
        let (height, mu) = (e.cross(arm), e.dot(arm) / length);
        Some(Self { normal: e.perp(), length, height, mu })
    }

    /// The linearised equation between the signed distance and a value it exceeds by `f`.
    pub fn row(&self, f: f64, [p, a, b]: [PointIdx; 3]) -> Row<'static> {
        // On the line whatever happens; mu - 1 would be rounding and not 0.
        if p == a || p == b {
            return Row::new(f).with(a, Vector::ZERO).with(b, Vector::ZERO);
        }
        let n = self.normal;
        Row::new(f).with(p, n).with(a, n * (self.mu - 1.0)).with(b, n * -self.mu)
    }
}
