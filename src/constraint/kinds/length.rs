//! The length constraint, section 3.5: a rod, a cord, a telescope.

use crate::constraint::parts::geometry::direction;
use crate::constraint::{
    Activity, Bounds, Carried, ConstraintKind, Declared, Field, Flaw, Given, Point, PointIdx,
    Quantity, Real, Refusal, Row, Stateless, Traits, Vec2, Vector,
};

/// The distance between two points lies in `bounds`.
#[derive(Debug, Clone, PartialEq)]
pub struct Length {
    /// The end points.
    pub points: [PointIdx; 2],
    /// The allowed distances, length units.
    pub bounds: Bounds,
}

impl Length {
    /// The value and its derivative by an end alone; none where that takes the general way.
    #[inline]
    pub fn felt_by(&self, p: PointIdx, x: &[Point]) -> Option<(f64, Vector)> {
        let [a, b] = self.points;
        let v = x[p as usize] - x[(if p == a { b } else { a }) as usize];
        let l = v.norm();
        let is_plain = self.bounds.is_equality() && a != b && l > 0.0 && l.is_finite();
        is_plain.then(|| (l - self.bounds.lo, v / l))
    }
}

impl Declared for Length {
    const WORDS: &'static [&'static str] = &["length"];

    fn declare(given: &Given) -> Result<Self, Refusal> {
        let points = given.pair(0)?;
        let [a, b] = points.map(|p| given.at(p));
        let bounds = given.bounds.unwrap_or(Bounds::exactly(a.distance(b)));
        Ok(Self { points, bounds })
    }
}

impl Stateless for Length {}

impl ConstraintKind for Length {
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
        let [a, b] = self.points;
        self.bounds.excess(x[a as usize].distance(x[b as usize]))
    }

    fn correct(&self, x: &[Point], w: &[f64], move_by: &mut impl FnMut(PointIdx, Vector)) {
        let [a, b] = self.points;
        let (w1, w2) = (w[a as usize], w[b as usize]);
        // Both ends frozen, or one point given twice: nothing can move.
        if w1 + w2 == 0.0 || a == b {
            return;
        }
        let (e12, l12) = direction(x[a as usize], x[b as usize]);
        let tau = self.bounds.excess(l12) / (w1 + w2);
        if tau != 0.0 {
            move_by(a, e12 * (w1 * tau));
            move_by(b, e12 * (-w2 * tau));
        }
    }

    fn jacobian(&self, x: &[Point], row: &mut impl FnMut(Row)) {
        let [a, b] = self.points;
        let (e12, l12) = direction(x[a as usize], x[b as usize]);
        let f = self.bounds.excess(l12);
        if f == 0.0 && !self.bounds.is_equality() {
            return row(Row::inactive(&self.points));
        }
        let mut r = Row::new(f).with(a, -e12).with(b, e12);
        r.span = l12;
        row(r);
    }

    fn equations<T: Real>(
        &self,
        x: &impl Fn(PointIdx) -> Vec2<T>,
        field: &impl Fn(Field, f64) -> T,
        equation: &mut impl FnMut(T),
    ) {
        let [a, b] = self.points;
        let l12 = (x(b) - x(a)).norm();
        equation(self.bounds.excess_of(l12, field));
    }

    fn get(&self, field: Field) -> Option<f64> {
        self.bounds.get(field)
    }

    fn set(&mut self, field: Field, value: f64) -> bool {
        self.bounds.set(field, value)
    }

    fn nominal_length(&self) -> f64 {
        let Bounds { lo, hi } = self.bounds;
        (if hi.is_finite() { hi } else { lo }).abs()
    }

    fn traits(&self) -> Traits {
        let hi = self.bounds.hi;
        Traits {
            word: "length",
            quantity: Quantity::Length,
            bounds: Some(self.bounds),
            activity: Activity::within(self.bounds),
            n_firm_rows: usize::from(self.bounds.is_equality()),
            is_linear: false,
            is_wheel: false,
            carried: Carried::Nothing,
            flags: &[],
            flaw: Flaw::of_range(self.bounds).or((hi < 0.0).then_some(Flaw::NegativeLength)),
        }
    }

    fn content(&self, word: &mut impl FnMut(u64)) {
        let Self { points: _, bounds } = self;
        bounds.content(word);
    }
}
