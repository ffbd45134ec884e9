//! The orientation constraint, section 3.6: the angle between two segments.

use crate::constraint::parts::content::add_all;
use crate::constraint::parts::geometry::has_direction;
use crate::constraint::{
    Activity, Bounds, Carried, ConstraintKind, Declared, Field, Flaw, Given, Point, PointIdx,
    Quantity, Real, Refusal, Row, Stateful, Traits, Vec2, Vector,
};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Which angles count as the same.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Period {
    /// Those that differ by whole turns.
    Whole,
    /// Those that differ by half turns: parallel or antiparallel, whichever is nearer.
    Half,
}

impl Period {
    /// The period in radians.
    pub const fn radians(self) -> f64 {
        match self {
            Self::Whole => TAU,
            Self::Half => PI,
        }
    }
}

/// The signed angle from the first segment to the second lies in `bounds`.
///
/// While a segment has no length the constraint asks for nothing.
#[derive(Debug, Clone, PartialEq)]
pub struct Orientation {
    /// Start and end of the one segment, start and end of the other.
    pub points: [PointIdx; 4],
    /// The allowed angles, radians. An infinite end stands for the next odd multiple of half
    /// a period: angles are compared as if they lay within half a period of 0.
    pub bounds: Bounds,
    /// Which angles count as the same.
    pub period: Period,
    /// The side of the interval the angle was last accepted on, -1 or 1; 0 before that. It
    /// decides which way to turn where both ways are as far.
    pub side: f64,
}

/// How near to the far side of the interval, radians, `side` decides the way. Wide enough
/// that iterations do not change their mind, too narrow to be seen.
const UNDECIDED: f64 = 1e-3;

/// How far outside the interval, radians, an angle says on which side it is: above rounding.
const ASIDE: f64 = 1e-9;

impl Orientation {
    /// The angle by which the second segment has to turn back for the allowed interval.
    fn excess(&self, theta: f64) -> f64 {
        let (offset, half_width) = self.offset(theta);
        offset - offset.clamp(-half_width, half_width)
    }

    /// The angle from the middle of the interval and the interval's half width.
    fn offset(&self, theta: f64) -> (f64, f64) {
        let period = self.period.radians();
        let half = 0.5 * period;
        let Bounds { lo, hi } = self.bounds;
        let (lo, hi) = match (lo.is_finite(), hi.is_finite()) {
            (true, true) => (lo, hi),
            (true, false) => (lo, ((lo - half) / period).ceil() * period + half),
            (false, true) => (((hi + half) / period).floor() * period - half, hi),
            (false, false) => (-half, half),
        };
        let middle = 0.5 * (lo + hi);
        let mut offset = theta - middle;
        offset -= period * (offset / period).round();
        if half - offset.abs() < UNDECIDED && offset * self.side < 0.0 {
            offset += period * self.side;
        }
        (offset, 0.5 * (hi - lo).max(0.0))
    }

    /// The vectors of both segments; none while one has no direction.
    fn segments(&self, x: &[Point]) -> Option<(Vector, Vector)> {
        let [x1, x2, x3, x4] = self.points.map(|p| x[p as usize]);
        (has_direction(x1, x2) && has_direction(x3, x4)).then_some((x2 - x1, x4 - x3))
    }

    fn row(&self, f: f64, v12: Vector, v34: Vector) -> Row<'static> {
        let [a, b, c, d] = self.points;
        let (p12, p34) = (turning(v12), turning(v34));
        Row::new(f).with(a, p12).with(b, -p12).with(c, -p34).with(d, p34)
    }
}

/// The gradient of the angle of `v` by its end: one radian per length, across.
pub(crate) fn turning(v: Vector) -> Vector {
    let l = v.norm();
    (v / l).perp() / l
}

impl Declared for Orientation {
    const WORDS: &'static [&'static str] = &["orientation", "parallel", "perpendicular"];

    fn declare(given: &Given) -> Result<Self, Refusal> {
        let points = given.different_pairs()?;
        let turned = |angle: f64| (Bounds::exactly(angle), Period::Half);
        let (bounds, period) = match given.word {
            "parallel" => turned(0.0),
            "perpendicular" => turned(FRAC_PI_2),
            _ => {
                let [x1, x2, x3, x4] = points.map(|p| given.at(p));
                let now = Bounds::exactly((x2 - x1).angle_to(x4 - x3));
                (given.bounds.map_or(now, within_a_turn), Period::Whole)
            }
        };
        Ok(Self { points, bounds, period, side: 0.0 })
    }
}

impl ConstraintKind for Orientation {
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
        self.segments(x).map_or(0.0, |(v12, v34)| self.excess(v12.angle_to(v34)))
    }

    fn correct(&self, x: &[Point], w: &[f64], move_by: &mut impl FnMut(PointIdx, Vector)) {
        let Some((v12, v34)) = self.segments(x) else { return };
        let f = self.excess(v12.angle_to(v34));
        if f == 0.0 {
            return;
        }
        let [a, b, c, d] = self.points;
        if a == c || a == d || b == c || b == d {
            return self.row(f, v12, v34).correct(w, move_by);
        }
        // How readily each segment turns: the shorter and lighter does most. Halves for
        // both, as printed, would turn the pair as a whole unless both are equally long.
        let [w1, w2, w3, w4] = self.points.map(|p| w[p as usize]);
        let s12 = (w1 + w2) / v12.norm_squared();
        let s34 = (w3 + w4) / v34.norm_squared();
        if s12 + s34 == 0.0 {
            return;
        }
        turn([a, b], v12, [w1, w2], f * s12 / (s12 + s34), move_by);
        turn([c, d], v34, [w3, w4], -f * s34 / (s12 + s34), move_by);
    }

    fn jacobian(&self, x: &[Point], row: &mut impl FnMut(Row)) {
        let Some((v12, v34)) = self.segments(x) else { return row(Row::inactive(&self.points)) };
        let f = self.excess(v12.angle_to(v34));
        if f == 0.0 && !self.bounds.is_equality() {
            return row(Row::inactive(&self.points));
        }
        row(self.row(f, v12, v34));
    }

    fn equations<T: Real>(
        &self,
        x: &impl Fn(PointIdx) -> Vec2<T>,
        field: &impl Fn(Field, f64) -> T,
        equation: &mut impl FnMut(T),
    ) {
        let [x1, x2, x3, x4] = self.points.map(x);
        let value = |p: Vec2<T>| p.value().to_point();
        if !(has_direction(value(x1), value(x2)) && has_direction(value(x3), value(x4))) {
            return equation(T::constant(0.0));
        }
        let theta = (x2 - x1).angle_to(x4 - x3);
        let f = self.excess(theta.value());
        if f == 0.0 && !self.bounds.is_equality() {
            return equation(T::constant(0.0));
        }
        let (end, bound) =
            if f > 0.0 { (Field::Hi, self.bounds.hi) } else { (Field::Lo, self.bounds.lo) };
        let (end, bound) =
            if self.bounds.is_equality() { (Field::Lo, self.bounds.lo) } else { (end, bound) };
        // An infinite end is a constant of the period.
        let difference = if bound.is_finite() { theta - field(end, bound) } else { theta };
        equation(difference + T::constant(f - difference.value()));
    }

    fn get(&self, field: Field) -> Option<f64> {
        self.bounds.get(field)
    }

    fn set(&mut self, field: Field, value: f64) -> bool {
        let is_open = self.period == Period::Whole && value.is_infinite();
        self.bounds.set(field, if is_open { PI.copysign(value) } else { value })
    }

    fn nominal_length(&self) -> f64 {
        0.0
    }

    fn traits(&self) -> Traits {
        Traits {
            word: match self.period {
                Period::Whole => "orientation",
                Period::Half if self.bounds == Bounds::exactly(FRAC_PI_2) => "perpendicular",
                Period::Half => "parallel",
            },
            quantity: Quantity::Angle,
            bounds: Some(self.bounds),
            activity: Activity::within(self.bounds),
            n_firm_rows: usize::from(self.bounds.is_equality()),
            is_linear: false,
            is_wheel: false,
            carried: Carried::ByPose,
            flags: &[],
            flaw: Flaw::of_range(self.bounds).or_else(|| wider_than_a_turn(self.bounds)),
        }
    }

    fn content(&self, word: &mut impl FnMut(u64)) {
        let Self { points: _, bounds, period, side } = self;
        bounds.content(word);
        add_all([*side, period.radians()], word);
    }
}

impl Stateful for Orientation {
    fn state(&self) -> Option<Vec<f64>> {
        Some(vec![self.side])
    }

    fn set_state(&mut self, state: &[f64]) {
        if let &[side] = state {
            self.side = side;
        }
    }

    fn captured(&self) -> Vec<f64> {
        Vec::new()
    }

    fn set_captured(&mut self, _captured: &[f64]) {}

    fn pick_up(&mut self, _x: &[Point]) {}

    fn advance(&mut self, _dt: f64) -> bool {
        false
    }

    fn accept(&mut self, x: &[Point]) {
        if let Some((v12, v34)) = self.segments(x) {
            let (offset, _) = self.offset(v12.angle_to(v34));
            if offset.abs() > ASIDE {
                self.side = offset.signum();
            }
        }
    }
}

/// Bounds of an angle: an open end is at half a turn.
fn within_a_turn(Bounds { lo, hi }: Bounds) -> Bounds {
    let end = |bound: f64, half: f64| if bound.is_finite() { bound } else { half };
    Bounds { lo: end(lo, -PI), hi: end(hi, PI) }
}

/// What is wrong with a range that no angle within one turn can leave.
fn wider_than_a_turn(Bounds { lo, hi }: Bounds) -> Option<Flaw> {
    // Both ends of a whole turn may be rounded.
    (hi - lo > 2.0 * PI * (1.0 + 4.0 * f64::EPSILON)).then_some(Flaw::WiderThanATurn)
}

/// Turns a segment by `phi` about the pivot that leaves its centre of gravity at rest.
fn turn(
    [a, b]: [PointIdx; 2],
    v: Vector,
    [wa, wb]: [f64; 2],
    phi: f64,
    move_by: &mut impl FnMut(PointIdx, Vector),
) {
    if wa + wb == 0.0 {
        return;
    }
    let chord = v.rotate(phi) - v;
    move_by(a, chord * (-wa / (wa + wb)));
    move_by(b, chord * (wb / (wa + wb)));
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The residual for segments at `theta` degrees, with bounds in degrees.
    fn excess(period: Period, lo: f64, hi: f64, side: f64, theta: f64) -> f64 {
        let bounds = Bounds { lo: lo.to_radians(), hi: hi.to_radians() };
        let tip = Vector::polar(2.0, theta.to_radians()).to_point();
        let x = [Point::ORIGIN, Point::new(1.0, 0.0), tip];
        let c = Orientation { points: [0, 1, 0, 2], bounds, period, side };
        c.residual(&x).to_degrees()
    }

    #[test]
    fn angles_are_compared_the_short_way_round() {
        const INF: f64 = f64::INFINITY;
        use Period::{Half, Whole};
        for (period, lo, hi, theta, expected) in [
            (Whole, 90.0, 90.0, 80.0, -10.0),
            (Whole, 181.0, 181.0, 179.0, -2.0),
            (Whole, 170.0, 170.0, -170.0, 20.0),
            (Whole, 730.0, 730.0, 0.0, -10.0),
            (Half, 0.0, 0.0, 170.0, -10.0),
            (Half, 0.0, 0.0, 100.0, -80.0),
            (Half, 90.0, 90.0, -80.0, 10.0),
            (Whole, 10.0, 50.0, 30.0, 0.0),
            (Whole, 10.0, 50.0, 60.0, 10.0),
            (Whole, 170.0, 190.0, -165.0, 5.0),
            (Whole, 10.0, INF, 175.0, 0.0),
            (Whole, 10.0, INF, -20.0, -30.0),
            (Whole, -INF, 10.0, 40.0, 30.0),
            (Whole, -INF, INF, 40.0, 0.0),
        ] {
            let f = excess(period, lo, hi, 0.0, theta);
            assert!((f - expected).abs() < 1e-9, "{theta} in {lo}..{hi}: {f}");
        }
    }

    #[test]
    fn half_way_round_the_last_side_decides() {
        for side in [-1.0, 1.0] {
            for theta in [179.99, 180.0, 180.01] {
                let f = excess(Period::Whole, 0.0, 0.0, side, theta);
                assert!((f - side * theta).abs() < 0.03, "{f}");
            }
        }
    }

    #[test]
    fn a_segment_without_length_asks_for_nothing() {
        let bounds = Bounds::exactly(1.0);
        let c = Orientation { points: [0, 1, 2, 3], bounds, period: Period::Whole, side: 0.0 };
        let p = Point::new(1e6, 1.0);
        let x = [p, p + Vector::new(1e-10, 0.0), Point::ORIGIN, Point::new(1.0, 0.0)];
        c.jacobian(&x, &mut |row| assert!(!row.is_active));
        c.correct(&x, &[1.0; 4], &mut |_, _| panic!("moved"));
    }
}
