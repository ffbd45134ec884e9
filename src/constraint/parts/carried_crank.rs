//! A crank whose angle is measured from a link that carries it.

use super::geometry::has_direction;
use crate::constraint::{Point, PointIdx, Row, Vector};

/// Where the points of such a crank are.
#[derive(Debug, Clone, Copy)]
pub(crate) struct CarriedCrank {
    points: [PointIdx; 4],
    /// The direction in which the driven point belongs.
    u: Vector,
    /// How the driven point lies from the centre, along that and across it.
    along: f64,
    across: f64,
    /// Across the link, over its length: how its direction turns as its end moves.
    turning: Vector,
}

impl CarriedCrank {
    /// With centre and driven point, then the ends of the link that the angle is measured from;
    /// none while these have no direction.
    pub fn new(points: [PointIdx; 4], angle: f64, x: &[Point]) -> Option<Self> {
        let [o, p, s, e] = points.map(|p| x[p as usize]);
        if !has_direction(s, e) {
            return None;
        }
        let length = s.distance(e);
        let link = (e - s) / length;
        let u = link.times(Vector::polar(1.0, angle));
        let (along, across) = (u.dot(p - o), u.cross(p - o));
        Some(Self { points, u, along, across, turning: link.perp() / length })
    }

    /// The rows of the values `along - radius` and `across`, which do not depend on the axes.
    pub fn rows(&self, radius: f64) -> [Row<'static>; 2] {
        let [o, p, s, e] = self.points;
        let row = |f: f64, axis: Vector, slope: f64| {
            let swing = self.turning * slope;
            Row::new(f).with(o, -axis).with(p, axis).with(s, -swing).with(e, swing)
        };
        let [first, second] = self.slopes();
        [row(self.along - radius, self.u, first), row(self.across, self.u.perp(), second)]
    }

    /// How both values change as the direction turns.
    const fn slopes(&self) -> [f64; 2] {
        [self.across, -self.along]
    }
}
