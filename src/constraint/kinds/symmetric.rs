//! Two points, each the mirror image of the other: beyond the paper, made of a `glider` for their
//! midpoint (section 3.8) and a right angle (section 3.6).

use crate::constraint::parts::geometry::has_direction;
use crate::constraint::parts::two_rows;
use crate::constraint::{
    Activity, Carried, ConstraintKind, Culprit, Declared, Field, Given, Point, PointIdx, Quantity,
    Real, Refusal, Row, Stateless, Traits, Vec2, Vector,
};

/// The second point is the mirror image of the first in the line from the third to the fourth.
///
/// Both values are parts of the way from the image to the second point: along the line
/// `e (B - A)`, and across it `n (A - P + B - P)`, with e and n the unit vectors along and to the
/// left. While P and Q coincide the constraint asks for nothing.
#[derive(Debug, Clone, PartialEq)]
pub struct Symmetric {
    /// A and its image B, then P and Q of the axis.
    pub points: [PointIdx; 4],
}

impl Symmetric {
    fn rows(&self, x: &[Point]) -> Option<[Row<'static>; 2]> {
        let [a, b, p, q] = self.points.map(|p| x[p as usize]);
        if !has_direction(p, q) {
            return None;
        }
        let v = q - p;
        let length = v.norm();
        let e = v / length;
        let n = e.perp();
        let (between, arms) = (b - a, (a - p) + (b - p));
        // Turning the axis moves e along n, and n against e.
        let turn = n * (n.dot(between) / length);
        let swing = n * (-e.dot(arms) / length);
        let [i, j, k, l] = self.points;
        Some([
            Row::new(e.dot(between)).with(i, -e).with(j, e).with(k, -turn).with(l, turn),
            Row::new(n.dot(arms)).with(i, n).with(j, n).with(k, n * -2.0 - swing).with(l, swing),
        ])
    }
}

impl Declared for Symmetric {
    const WORDS: &'static [&'static str] = &["symmetric"];

    fn declare(given: &Given) -> Result<Self, Refusal> {
        let [a, b] = given.two(0, "a point that is its own mirror image lies on the axis")?;
        let [p, q] = given.two(1, "an axis needs two different points")?;
        for (k, point) in [a, b].into_iter().enumerate() {
            if point == p || point == q {
                return Err(Refusal {
                    message: "a point of the axis is its own mirror image",
                    at: Culprit::Point(0, k),
                    label: "this is a point of that axis",
                    help: Some("name two points beside the axis"),
                });
            }
        }
        Ok(Self { points: [a, b, p, q] })
    }
}

impl Stateless for Symmetric {}

impl ConstraintKind for Symmetric {
    fn points(&self) -> &[PointIdx] {
        &self.points
    }

    fn points_mut(&mut self) -> &mut [PointIdx] {
        &mut self.points
    }

    fn n_rows(&self) -> usize {
        2
    }

    fn residual(&self, x: &[Point]) -> f64 {
        self.rows(x).map_or(0.0, |[along, across]| Vector::new(along.f, across.f).norm())
    }

    /// Exact while the axis stands; to first order where it turns.
    fn correct(&self, x: &[Point], w: &[f64], move_by: &mut impl FnMut(PointIdx, Vector)) {
        if let Some(rows) = self.rows(x) {
            two_rows::correct(&rows, w, move_by);
        }
    }

    fn jacobian(&self, x: &[Point], row: &mut impl FnMut(Row)) {
        let idle = || [Row::inactive(&self.points); 2];
        self.rows(x).unwrap_or_else(idle).into_iter().for_each(row);
    }

    fn equations<T: Real>(
        &self,
        x: &impl Fn(PointIdx) -> Vec2<T>,
        _field: &impl Fn(Field, f64) -> T,
        equation: &mut impl FnMut(T),
    ) {
        let [a, b, p, q] = self.points.map(x);
        if !has_direction(p.value().to_point(), q.value().to_point()) {
            equation(T::constant(0.0));
            return equation(T::constant(0.0));
        }
        let v = q - p;
        let length = v.norm();
        equation(v.dot(b - a) / length);
        equation(v.cross((a - p) + (b - p)) / length);
    }

    fn get(&self, _field: Field) -> Option<f64> {
        None
    }

    fn set(&mut self, _field: Field, _value: f64) -> bool {
        false
    }

    fn nominal_length(&self) -> f64 {
        0.0
    }

    fn traits(&self) -> Traits {
        Traits {
            word: "symmetric",
            quantity: Quantity::Length,
            bounds: None,
            activity: Activity::Always,
            // A point of the axis feels but how the axis turns.
            n_firm_rows: 1,
            is_linear: false,
            is_wheel: false,
            carried: Carried::Nothing,
            flags: &[],
            flaw: None,
        }
    }

    fn content(&self, _word: &mut impl FnMut(u64)) {
        let Self { points: _ } = self;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_image_is_found_in_one_step_while_the_axis_stands() {
        // The image of (5, 0) in the line y = x / 2 is (3, 4).
        let c = Symmetric { points: [0, 1, 2, 3] };
        let mut x =
            [Point::new(5.0, 0.0), Point::new(-7.0, 2.0), Point::ORIGIN, Point::new(2.0, 1.0)];
        c.correct(&x.clone(), &[0.0, 1.0, 0.0, 0.0], &mut |p, d| x[p as usize] += d);
        assert!(x[1].distance(Point::new(3.0, 4.0)) < 1e-14, "{:?}", x[1]);
    }

    #[test]
    fn the_axis_turns_to_where_the_points_mirror() {
        let c = Symmetric { points: [0, 1, 2, 3] };
        let mut x =
            [Point::new(5.0, 0.0), Point::new(3.0, 4.0), Point::ORIGIN, Point::new(2.0, 0.0)];
        for _ in 0..20 {
            c.correct(&x.clone(), &[0.0, 0.0, 0.0, 1.0], &mut |p, d| x[p as usize] += d);
        }
        assert!((x[3].y / x[3].x - 0.5).abs() < 1e-14, "{:?}", x[3]);
    }
}
