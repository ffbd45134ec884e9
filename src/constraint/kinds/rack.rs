//! A wheel that rolls along a line: the cog wheels of section 3.10 with one radius infinite.

use super::orientation::turning;
use crate::constraint::parts::content::add_all;
use crate::constraint::parts::geometry::has_direction;
use crate::constraint::parts::mesh::Counts;
use crate::constraint::parts::winding::Winding;
use crate::constraint::{
    Activity, Carried, ConstraintKind, Culprit, Declared, Field, Flaw, Given, Point, PointIdx,
    Quantity, Real, Refusal, Row, Stateful, Traits, Vec2, Vector,
};
use std::f64::consts::TAU;

/// A wheel rolls along a line without slip: `s + R theta = K`, in length units.
///
/// s is how far along the line from P to Q the centre stands, theta the angle of the rim
/// point seen from the centre, against the line, R the pitch radius, positive where the wheel
/// stands on the left of the line. K is what it was at creation. The height of the centre
/// over the line is not held; a `distance` does that.
///
/// While the rim point lies on the centre, or P on Q, the constraint asks for nothing.
#[derive(Debug, Clone, PartialEq)]
pub struct Rack {
    /// Centre O and rim point A of the wheel, P and Q of the line.
    pub points: [PointIdx; 4],
    /// The R of the equation.
    radius: f64,
    pitch: Pitch,
    k: f64,
    /// theta as last accepted.
    lifted: Winding,
}

/// Where the radius is from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Pitch {
    /// It was the height of the centre over the line.
    Height,
    /// It is said, of a wheel that stood on the left of the line, or on it.
    Left,
    /// It is said, of a wheel that stood on the right.
    Right,
}

impl Pitch {
    /// The R of the equation over the radius that is said.
    const fn side(self) -> f64 {
        match self {
            Self::Height | Self::Left => 1.0,
            Self::Right => -1.0,
        }
    }
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
        Self::rolling(points, None, x)
    }

    /// A wheel of a pitch radius as it stands, at whatever height.
    pub fn with_radius(points: [PointIdx; 4], radius: f64, x: &[Point]) -> Self {
        Self::rolling(points, Some(radius), x)
    }

    fn rolling(points: [PointIdx; 4], radius: Option<f64>, x: &[Point]) -> Self {
        let lifted = Winding::default();
        let pitch = if radius.is_some() { Pitch::Left } else { Pitch::Height };
        let mut rack = Self { points, radius: radius.unwrap_or(0.0), pitch, k: 0.0, lifted };
        if let Some(arms) = rack.arms(x) {
            let e = arms.line / arms.line.norm();
            let height = e.cross(arms.centre);
            match radius {
                None => rack.radius = height,
                Some(radius) if height < 0.0 => {
                    (rack.radius, rack.pitch) = (-radius, Pitch::Right);
                }
                Some(_) => {}
            }
            rack.lifted = Winding::new(arms.line.angle_to(arms.spoke));
            rack.k = e.dot(arms.centre) + rack.radius * rack.lifted.angle;
        }
        rack
    }

    /// The pitch radius, positive on the left of the line.
    pub const fn radius(&self) -> f64 {
        self.radius
    }

    /// Whether its statement says the radius.
    pub fn has_said_radius(&self) -> bool {
        self.pitch != Pitch::Height
    }

    /// How far the wheel has turned against the line.
    pub(crate) fn counts(&self) -> Counts {
        Counts::of_one(self.lifted)
    }

    /// It has turned so far.
    pub(crate) const fn set_counts(&mut self, counts: Counts) {
        self.lifted = counts.lifted[0];
    }

    /// What so many whole turns contribute to the equation.
    pub(crate) fn wound_by(&self, n_turns: i64) -> f64 {
        self.radius * (n_turns as f64 * TAU)
    }

    /// The theta of the equation where whole turns contribute so much and the centre stands there.
    #[allow(clippy::inline_always, reason = "it becomes part of loops that vectors are made of")]
    #[inline(always)]
    pub(crate) fn theta(&self, wound: f64, s: f64) -> f64 {
        (self.k - wound - s) / self.radius
    }

    /// What is left of the equation there, length units, at an angle that was counted on.
    #[allow(clippy::inline_always, reason = "it becomes part of loops that vectors are made of")]
    #[inline(always)]
    pub(crate) fn value_where(&self, wound: f64, s: f64, theta: f64) -> f64 {
        s + self.radius * theta + (wound - self.k)
    }

    /// The direction of the rim point from its centre while everything else is at these places, radians; none
    /// while the line has none.
    pub fn rim_angle(&self, [o, _, p, q]: [Point; 4]) -> Option<f64> {
        let line = q - p;
        let s = line.dot(o - p) / line.norm();
        has_direction(p, q).then(|| line.angle() + self.theta(self.wound(), s))
    }

    /// What is left of the equation at these places, length units; none while something has no direction.
    pub fn value_at(&self, places: [Point; 4]) -> Option<f64> {
        Self::arms_at(places).map(|arms| self.value(&arms))
    }

    fn arms(&self, x: &[Point]) -> Option<Arms> {
        Self::arms_at(self.points.map(|p| x[p as usize]))
    }

    fn arms_at([o, a, p, q]: [Point; 4]) -> Option<Arms> {
        (has_direction(o, a) && has_direction(p, q)).then_some(Arms {
            line: q - p,
            spoke: a - o,
            centre: o - p,
        })
    }

    /// What whole turns contribute to the equation.
    fn wound(&self) -> f64 {
        self.wound_by(self.lifted.turns)
    }

    fn value(&self, arms: &Arms) -> f64 {
        let theta = self.lifted.near(arms.line.angle_to(arms.spoke));
        let s = arms.line.dot(arms.centre) / arms.line.norm();
        self.value_where(self.wound(), s, theta)
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
        let radius = given.value(Field::Radius);
        let label = if radius.is_some() {
            "it does not show how the wheel turns"
        } else {
            "a wheel of radius 0 does not roll"
        };
        let without_direction = [
            (o == a, "the rim point lies on the centre", label),
            (p == q, "the points of the line lie on each other", "no line to roll along"),
        ];
        for (is_so, message, label) in without_direction {
            if is_so && !given.is_restored {
                return Err(Refusal { message, at: Culprit::Statement, label, help: None });
            }
        }
        Ok(Self::rolling(points, radius, given.x))
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
        let is_said = field == Field::Radius && self.has_said_radius();
        is_said.then_some(self.pitch.side() * self.radius)
    }

    fn set(&mut self, field: Field, value: f64) -> bool {
        if field != Field::Radius || !self.has_said_radius() {
            return false;
        }
        let radius = self.pitch.side() * value;
        if radius != self.radius {
            // Rolls on from where it stands.
            let angle = self.lifted.angle;
            self.k += (radius - self.radius) * angle - self.wound();
            self.lifted = Winding::new(angle);
            self.radius = radius;
        }
        true
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
            flaw: match self.get(Field::Radius) {
                Some(0.0) => Some(Flaw::ZeroRadius),
                Some(radius) if radius < 0.0 => Some(Flaw::NegativeRadius),
                _ => None,
            },
        }
    }

    fn content(&self, word: &mut impl FnMut(u64)) {
        // On which side it stands is the sign of the radius.
        let Self { points: _, radius, pitch: _, k, lifted } = self;
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
            if self.has_said_radius() {
                self.pitch = if radius < 0.0 { Pitch::Right } else { Pitch::Left };
            }
        }
    }

    /// A wheel or a line without a direction rolls as before.
    fn pick_up(&mut self, x: &[Point]) {
        if self.arms(x).is_some() {
            *self = Self::rolling(self.points, self.get(Field::Radius), x);
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
    fn the_height_of_a_wheel_with_a_radius_is_free() {
        // On either side of the line, which one being that of the start.
        for points in [[0, 1, 2, 3], [0, 1, 3, 2]] {
            let lifted = |i: i32| {
                let mut x = rolled(0.7 * f64::from(i));
                let up = Vector::new(0.0, 3.0 * libm::sin(0.3 * f64::from(i)));
                (x[0], x[1]) = (x[0] + up, x[1] + up);
                x
            };
            let mut rack = Rack::with_radius(points, 2.0, &lifted(0));
            for i in 0..200 {
                assert!(rack.residual(&lifted(i)).abs() < 1e-12, "{i}");
                rack.accept(&lifted(i));
            }
        }
    }

    #[test]
    fn a_change_of_radius_is_no_jump() {
        let mut rack = Rack::with_radius([0, 1, 2, 3], 2.0, &rolled(0.0));
        (0..50).for_each(|i| rack.accept(&rolled(f64::from(i))));
        let before = rack.clone();
        assert!(rack.set(Field::Radius, 2.0));
        assert_eq!(rack, before, "the radius it has is no change");
        assert!(rack.set(Field::Radius, 7.0));
        assert!(rack.residual(&rolled(49.0)).abs() < 1e-12);
    }
}
