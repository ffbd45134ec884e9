//! The coincidence constraint, section 3.2: two points in one place.

use crate::constraint::parts::linear::Linear;
use crate::constraint::{
    Activity, Carried, ConstraintKind, Declared, Field, Given, Point, PointIdx, Quantity, Real,
    Refusal, Row, Stateless, Traits, Vec2, Vector,
};

/// Two points lie in one place.
#[derive(Debug, Clone, PartialEq)]
pub struct Coincidence {
    /// The points.
    pub points: [PointIdx; 2],
}

impl Coincidence {
    fn linear(&self) -> Linear {
        let [a, b] = self.points;
        Linear::new().with_real(a, 1.0).with_real(b, -1.0)
    }

    fn value(&self, x: &[Point]) -> Vector {
        let [x1, x2] = self.points.map(|p| x[p as usize]);
        x1 - x2
    }
}

impl Declared for Coincidence {
    const WORDS: &'static [&'static str] = &["coincidence"];

    fn declare(given: &Given) -> Result<Self, Refusal> {
        let points = given.two(0, "a point coincides with itself anyway")?;
        Ok(Self { points })
    }
}

impl Stateless for Coincidence {}

impl ConstraintKind for Coincidence {
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
        let [x1, x2] = self.points.map(x);
        let g = x1 - x2;
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
            word: "coincidence",
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
