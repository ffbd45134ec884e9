//! The equivalence constraint, section 3.3: two vectors of equal length and direction.

use crate::constraint::parts::linear::Linear;
use crate::constraint::{
    Activity, Carried, ConstraintKind, Declared, Field, Given, Point, PointIdx, Quantity, Real,
    Refusal, Row, Stateless, Traits, Vec2, Vector,
};

/// The vector from the first point to the second equals that from the third to the fourth.
#[derive(Debug, Clone, PartialEq)]
pub struct Equivalence {
    /// Start and end of the one vector, start and end of the other.
    pub points: [PointIdx; 4],
}

impl Equivalence {
    /// `x1 - x2 - x3 + x4 = 0`. With a shared point, as when `x2 = x3` makes it the midpoint,
    /// the coefficients merge; the printed quarter steps would overshoot.
    fn linear(&self) -> Linear {
        let [a, b, c, d] = self.points;
        Linear::new().with_real(a, 1.0).with_real(b, -1.0).with_real(c, -1.0).with_real(d, 1.0)
    }

    fn value(&self, x: &[Point]) -> Vector {
        let [x1, x2, x3, x4] = self.points.map(|p| x[p as usize]);
        (x4 - x3) - (x2 - x1)
    }
}

impl Declared for Equivalence {
    const WORDS: &'static [&'static str] = &["equivalence"];

    fn declare(given: &Given) -> Result<Self, Refusal> {
        Ok(Self { points: given.different_pairs()? })
    }
}

impl Stateless for Equivalence {}

impl ConstraintKind for Equivalence {
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
        self.value(x).norm()
    }

    fn correct(&self, x: &[Point], w: &[f64], move_by: &mut impl FnMut(PointIdx, Vector)) {
        self.linear().correct(self.value(x), w, move_by);
    }

    fn jacobian(&self, x: &[Point], row: &mut impl FnMut(Row)) {
        self.linear().rows(self.value(x), row);
    }

    fn equations<T: Real>(
        &self,
        x: &impl Fn(PointIdx) -> Vec2<T>,
        _field: &impl Fn(Field, f64) -> T,
        equation: &mut impl FnMut(T),
    ) {
        let [x1, x2, x3, x4] = self.points.map(x);
        let g = (x4 - x3) - (x2 - x1);
        equation(g.x);
        equation(g.y);
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
            word: "equivalence",
            quantity: Quantity::Length,
            bounds: None,
            activity: Activity::Always,
            n_firm_rows: 2,
            is_linear: true,
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
