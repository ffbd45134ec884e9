//! The coordinate constraint, section 3.1: a point tied to a place.

use crate::constraint::parts::content::add_all;
use crate::constraint::parts::linear::Linear;
use crate::constraint::{
    Activity, Carried, ConstraintKind, Declared, Field, Given, Point, PointIdx, Quantity, Real,
    Refusal, Row, Stateless, Traits, Vec2, Vector,
};

/// A point stays at a place of the plane.
#[derive(Debug, Clone, PartialEq)]
pub struct Coordinate {
    /// The point.
    pub points: [PointIdx; 1],
    /// Where it belongs.
    pub target: Point,
}

impl Coordinate {
    /// The vector equation `x1 - c = 0`; the printed norm has no gradient where it is met.
    fn linear(&self) -> Linear {
        Linear::new().with_real(self.points[0], 1.0)
    }

    fn value(&self, x: &[Point]) -> Vector {
        x[self.points[0] as usize] - self.target
    }
}

impl Declared for Coordinate {
    const WORDS: &'static [&'static str] = &["coordinate"];

    fn declare(given: &Given) -> Result<Self, Refusal> {
        let value = |field| given.value(field).unwrap_or_default();
        let target = Point::new(value(Field::X), value(Field::Y));
        Ok(Self { points: [given.point(0)], target })
    }
}

impl Stateless for Coordinate {}

impl ConstraintKind for Coordinate {
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
        field: &impl Fn(Field, f64) -> T,
        equation: &mut impl FnMut(T),
    ) {
        let x1 = x(self.points[0]);
        equation(x1.x - field(Field::X, self.target.x));
        equation(x1.y - field(Field::Y, self.target.y));
    }

    fn get(&self, field: Field) -> Option<f64> {
        match field {
            Field::X => Some(self.target.x),
            Field::Y => Some(self.target.y),
            _ => None,
        }
    }

    fn set(&mut self, field: Field, value: f64) -> bool {
        match field {
            Field::X => self.target.x = value,
            Field::Y => self.target.y = value,
            _ => return false,
        }
        true
    }

    fn nominal_length(&self) -> f64 {
        0.0
    }

    fn traits(&self) -> Traits {
        Traits {
            word: "coordinate",
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

    fn content(&self, word: &mut impl FnMut(u64)) {
        let Self { points: _, target: Point { x, y } } = self;
        add_all([*x, *y], word);
    }
}
