//! A wheel that rolls along a line: the cog wheels of section 3.10 with one radius infinite.

use super::orientation::turning;
use crate::constraint::parts::content::add_all;
use crate::constraint::parts::geometry::has_direction;
use crate::constraint::parts::winding::Winding;
use crate::constraint::{
    Activity, Carried, ConstraintKind, Culprit, Declared, Field, Given, Point, PointIdx, Quantity,
    Real, Refusal, Row, Stateful, Traits, Vec2, Vector,
};
use std::f64::consts::TAU;

/// A wheel rolls along a line without slip: `s + R theta = K`, in length units.
///
/// s is how far along the line from P to Q the centre stands, theta the angle of the rim
/// point seen from the centre, against the line, R the radius, positive where the wheel
/// stands on the left of the line. K is what it was at creation. The height of the centre
/// over the line is not held; a `distance` does that.
///
/// While the rim point lies on the centre, or P on Q, the constraint asks for nothing.
#[derive(Debug, Clone, PartialEq)]
pub struct Rack {
    /// Centre O and rim point A of the wheel, P and Q of the line.
    pub points: [PointIdx; 4],
    radius: f64,
    k: f64,
    /// theta as last accepted.
    lifted: Winding,
}

/// The vectors that matter: P to Q, O to A, P to O.
struct Arms {
    line: Vector,
    spoke: Vector,
    centre: Vector,
}

impl Rack {
    /// A wheel as it stands, touching the line.
    pub fn new(points: [PointIdx; 4], x: &[Point]) -> Self {
        let mut rack = Self { points, radius: 0.0, k: 0.0, lifted: Winding::default() };
        if let Some(arms) = rack.arms(x) {
            let e = arms.line / arms.line.norm();
            rack.radius = e.cross(arms.centre);
            rack.lifted = Winding::new(arms.line.angle_to(arms.spoke));
            rack.k = e.dot(arms.centre) + rack.radius * rack.lifted.angle;
        }
        rack
    }

    fn arms(&self, x: &[Point]) -> Option<Arms> {
        let [o, a, p, q] = self.points.map(|p| x[p as usize]);
        (has_direction(o, a) && has_direction(p, q)).then_some(Arms {
            line: q - p,
            spoke: a - o,
            centre: o - p,
        })
    }

    /// What whole turns contribute to the equation.
    fn wound(&self) -> f64 {
        self.radius * (self.lifted.turns as f64 * TAU)
    }

    fn value(&self, arms: &Arms) -> f64 {
        let theta = self.lifted.near(arms.line.angle_to(arms.spoke));
        let s = arms.line.dot(arms.centre) / arms.line.norm();
        s + self.radius * theta + (self.wound() - self.k)
    }

    fn row(&self, arms: &Arms) -> Row<'static> {
        let [o, a, p, q] = self.points;
        let length = arms.line.norm();
        let e = arms.line / length;
        let rim = turning(arms.spoke) * self.radius;
        // Turning the line about P lifts it against the wheel by the height of the centre.
        let tilt = e.perp() * ((e.cross(arms.centre) - self.radius) / length);
        Row::new(self.value(arms)).with(o, e - rim).with(a, rim).with(p, -e - tilt).with(q, tilt)
    }
}

impl Declared for Rack {
    const WORDS: &'static [&'static str] = &["rack"];

    fn declare(given: &Given) -> Result<Self, Refusal> {
        let points = given.pairs()?;
        let [o, a, p, q] = points.map(|p| given.at(p));
        let without_direction = [
            (o == a, "the rim point lies on the centre", "a wheel of radius 0 does not roll"),
            (p == q, "the points of the line lie on each other", "no line to roll along"),
        ];
        for (is_so, message, label) in without_direction {
            if is_so && !given.is_restored {
                return Err(Refusal { message, at: Culprit::Statement, label, help: None });
            }
        }
        Ok(Self::new(points, given.x))
    }
}

impl ConstraintKind for Rack {
    fn points(&self) -> &[PointIdx] {
        &self.points
    }

    fn points_mut(&mut self) -> &mut [PointIdx] {
        &mut self.points
    }

    fn n_rows(&self) -> usize {
        1
    }

    fn residual(&self, x: &[Point]) -> f64 {
        self.arms(x).map_or(0.0, |arms| self.value(&arms))
    }

    /// Exact to first order, as wheel and line turn: a few repeats reach rounding.
    fn correct(&self, x: &[Point], w: &[f64], move_by: &mut impl FnMut(PointIdx, Vector)) {
        if let Some(arms) = self.arms(x) {
            self.row(&arms).correct(w, move_by);
        }
    }

    fn jacobian(&self, x: &[Point], row: &mut impl FnMut(Row)) {
        row(self.arms(x).map_or_else(|| Row::inactive(&self.points), |arms| self.row(&arms)));
    }

    fn equations<T: Real>(
        &self,
        x: &impl Fn(PointIdx) -> Vec2<T>,
        _field: &impl Fn(Field, f64) -> T,
        equation: &mut impl FnMut(T),
    ) {
        let [o, a, p, q] = self.points.map(x);
        let value = |p: Vec2<T>| p.value().to_point();
        if !(has_direction(value(o), value(a)) && has_direction(value(p), value(q))) {
            return equation(T::constant(0.0));
        }
        let line = q - p;
        let direction = line.angle_to(a - o);
        let theta = self.lifted.near(direction.value());
        let theta = direction + T::constant(theta - direction.value());
        let s = line.dot(o - p) / line.norm();
        equation(s + T::constant(self.radius) * theta + T::constant(self.wound() - self.k));
    }

    fn get(&self, field: Field) -> Option<f64> {
        (field == Field::Radius).then_some(self.radius)
    }

    fn set(&mut self, field: Field, value: f64) -> bool {
        if field == Field::Radius && value != self.radius {
            // Rolls on from where it stands.
            let angle = self.lifted.angle;
            self.k += (value - self.radius) * angle - self.wound();
            self.lifted = Winding::new(angle);
            self.radius = value;
        }
        field == Field::Radius
    }

    fn nominal_length(&self) -> f64 {
        0.0
    }

    fn traits(&self) -> Traits {
        Traits {
            word: "rack",
            quantity: Quantity::Length,
            bounds: None,
            activity: Activity::Always,
            n_firm_rows: 1,
            is_linear: false,
            is_wheel: true,
            carried: Carried::ByPose,
            flags: &[],
            flaw: None,
        }
    }

    fn content(&self, word: &mut impl FnMut(u64)) {
        let Self { points: _, radius, k, lifted } = self;
        add_all([*radius], word);
        lifted.content(word);
        add_all([*k], word);
    }
}

impl Stateful for Rack {
    fn state(&self) -> Option<Vec<f64>> {
        Some(self.lifted.to_numbers().to_vec())
    }

    fn set_state(&mut self, state: &[f64]) {
        if let &[turns, angle] = state {
            self.lifted = Winding::from_numbers([turns, angle]);
        }
    }

    fn captured(&self) -> Vec<f64> {
        vec![self.radius, self.k]
    }

    fn set_captured(&mut self, captured: &[f64]) {
        if let &[radius, k] = captured {
            self.radius = radius;
            self.k = k;
        }
    }

    /// A wheel or a line without a direction rolls as before.
    fn pick_up(&mut self, x: &[Point]) {
        if self.arms(x).is_some() {
            *self = Self::new(self.points, x);
        }
    }

    fn advance(&mut self, _dt: f64) -> bool {
        false
    }

    fn accept(&mut self, x: &[Point]) {
        if let Some(arms) = self.arms(x) {
            self.lifted.follow(arms.line.angle_to(arms.spoke));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A wheel of radius 2 that has rolled `s` along the x axis, on its upper side.
    fn rolled(s: f64) -> [Point; 4] {
        let o = Point::new(s, 2.0);
        [o, o + Vector::polar(2.0, 0.3 - s / 2.0), Point::ORIGIN, Point::new(10.0, 0.0)]
    }

    #[test]
    fn a_wheel_rolls_without_slip() {
        // The same with the line stated either way round: the wheel is on its right then.
        for points in [[0, 1, 2, 3], [0, 1, 3, 2]] {
            let mut rack = Rack::new(points, &rolled(0.0));
            for i in (0..5000).chain((0..5000).rev()) {
                let x = rolled(0.7 * f64::from(i));
                assert!(rack.residual(&x).abs() < 1e-11, "{i}: {}", rack.residual(&x));
                rack.accept(&x);
            }
        }
    }

    #[test]
    fn a_change_of_radius_is_no_jump() {
        let mut rack = Rack::new([0, 1, 2, 3], &rolled(0.0));
        (0..50).for_each(|i| rack.accept(&rolled(f64::from(i))));
        let before = rack.clone();
        assert!(rack.set(Field::Radius, 2.0));
        assert_eq!(rack, before, "the radius it has is no change");
        assert!(rack.set(Field::Radius, -7.0));
        assert!(rack.residual(&rolled(49.0)).abs() < 1e-12);
    }
}
