//! The equal distance constraint, section 3.4: two segments of equal length, or of lengths in a
//! ratio.

use crate::constraint::parts::content::add_all;
use crate::constraint::{
    Activity, Bounds, Carried, ConstraintKind, Declared, Field, Flaw, Given, Point, PointIdx,
    Quantity, Real, Refusal, Row, Stateless, Traits, Vec2, Vector,
};

/// The distance of the first two points less `ratio` times that of the last two lies in `bounds`.
#[derive(Debug, Clone, PartialEq)]
pub struct Equal {
    /// The ends of the one segment, the ends of the other.
    pub points: [PointIdx; 4],
    /// The allowed differences, length units; exactly 0 for equal lengths.
    pub bounds: Bounds,
    /// How many times as long as the second segment the first is; 1 in the paper.
    pub ratio: f64,
}

/// Both segments: e12, l12, e34, l34.
struct Segments {
    e12: Vector,
    l12: f64,
    e34: Vector,
    l34: f64,
}

impl Equal {
    fn segments(&self, x: &[Point]) -> Segments {
        let [x1, x2, x3, x4] = self.points.map(|p| x[p as usize]);
        let (v12, v34) = (x2 - x1, x4 - x3);
        // A segment of length 0 grows along the other one.
        let x_axis = Vector::new(1.0, 0.0);
        let e12 = v12.unit().or(v34.unit()).unwrap_or(x_axis);
        let e34 = v34.unit().unwrap_or(e12);
        Segments { e12, l12: v12.norm(), e34, l34: v34.norm() }
    }

    /// The paper's `f`, clamped.
    fn excess(&self, s: &Segments) -> f64 {
        self.bounds.excess(s.l12 - self.ratio * s.l34)
    }

    /// The value and its derivative by an end alone, both divided by the length of the
    /// derivative; none where that takes the general way.
    #[inline]
    pub fn felt_by(&self, p: PointIdx, x: &[Point]) -> Option<(f64, Vector)> {
        let [a, b, c, d] = self.points;
        let is_once = self.points.iter().filter(|q| **q == p).count() == 1;
        if !is_once || a == b || c == d || !self.bounds.is_equality() {
            return None;
        }
        let s = self.segments(x);
        let f = self.excess(&s);
        let sign = if p == a || p == d { -1.0 } else { 1.0 };
        // As if the gradient were of length 1.
        Some(if p == a || p == b { (f, s.e12 * sign) } else { (f / self.ratio, s.e34 * sign) })
    }

    fn row(&self, s: &Segments) -> Row<'static> {
        let [a, b, c, d] = self.points;
        let f = self.excess(s);
        if f == 0.0 && !self.bounds.is_equality() {
            return Row::inactive(&self.points);
        }
        let g34 = s.e34 * self.ratio;
        Row::new(f).with(a, -s.e12).with(b, s.e12).with(c, g34).with(d, -g34)
    }
}

impl Declared for Equal {
    const WORDS: &'static [&'static str] = &["equal"];

    fn declare(given: &Given) -> Result<Self, Refusal> {
        let bounds = given.bounds.unwrap_or(Bounds::exactly(0.0));
        let ratio = given.value(Field::Ratio).unwrap_or(1.0);
        Ok(Self { points: given.different_pairs()?, bounds, ratio })
    }
}

impl Stateless for Equal {}

impl ConstraintKind for Equal {
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
        let [x1, x2, x3, x4] = self.points.map(|p| x[p as usize]);
        self.bounds.excess(x1.distance(x2) - self.ratio * x3.distance(x4))
    }

    fn correct(&self, x: &[Point], w: &[f64], move_by: &mut impl FnMut(PointIdx, Vector)) {
        let [a, b, c, d] = self.points;
        let s = self.segments(x);
        if a == b || c == d || a == c || a == d || b == c || b == d {
            return self.row(&s).correct(w, move_by);
        }
        let (f, k) = (self.excess(&s), self.ratio);
        let [w1, w2, w3, w4] = self.points.map(|p| w[p as usize]);
        let sum = w1 + w2 + k * k * (w3 + w4);
        if f == 0.0 || sum == 0.0 {
            return;
        }
        // The paper's shares, but a segment cannot become shorter than 0: the other one
        // takes what is left.
        let shrink12 = (f * (w1 + w2) / sum).min(s.l12);
        let grow34 = ((f - shrink12) / k).max(-s.l34);
        let shrink12 = if w1 + w2 > 0.0 { (f - k * grow34).min(s.l12) } else { 0.0 };
        if w1 + w2 > 0.0 {
            move_by(a, s.e12 * (shrink12 * w1 / (w1 + w2)));
            move_by(b, s.e12 * (-shrink12 * w2 / (w1 + w2)));
        }
        if w3 + w4 > 0.0 {
            move_by(c, s.e34 * (-grow34 * w3 / (w3 + w4)));
            move_by(d, s.e34 * (grow34 * w4 / (w3 + w4)));
        }
    }

    fn jacobian(&self, x: &[Point], row: &mut impl FnMut(Row)) {
        row(self.row(&self.segments(x)));
    }

    fn equations<T: Real>(
        &self,
        x: &impl Fn(PointIdx) -> Vec2<T>,
        field: &impl Fn(Field, f64) -> T,
        equation: &mut impl FnMut(T),
    ) {
        let [x1, x2, x3, x4] = self.points.map(x);
        let (v12, v34) = (x2 - x1, x4 - x3);
        let ratio = field(Field::Ratio, self.ratio);
        let difference = v12.norm_or_along(v34.value()) - ratio * v34.norm_or_along(v12.value());
        equation(self.bounds.excess_of(difference, field));
    }

    fn get(&self, field: Field) -> Option<f64> {
        if field == Field::Ratio { Some(self.ratio) } else { self.bounds.get(field) }
    }

    fn set(&mut self, field: Field, value: f64) -> bool {
        if field == Field::Ratio {
            self.ratio = value;
            return true;
        }
        self.bounds.set(field, value)
    }

    fn nominal_length(&self) -> f64 {
        0.0
    }

    fn traits(&self) -> Traits {
        Traits {
            word: "equal",
            quantity: Quantity::Length,
            bounds: Some(self.bounds),
            activity: Activity::within(self.bounds),
            n_firm_rows: usize::from(self.bounds.is_equality()),
            is_linear: false,
            is_wheel: false,
            carried: Carried::Nothing,
            flags: &[],
            flaw: Flaw::of_range(self.bounds)
                .or((self.ratio <= 0.0).then_some(Flaw::RatioNotAboveZero)),
        }
    }

    fn content(&self, word: &mut impl FnMut(u64)) {
        let Self { points: _, bounds, ratio } = self;
        bounds.content(word);
        add_all([*ratio], word);
    }
}
