//! What `hold` states: an expression has a value, or lies between two.

use crate::constraint::parts::content::add_all;
use crate::constraint::{
    Activity, Bounds, Carried, ConstraintKind, Culprit, Declared, Field, Flaw, Given, Point,
    PointIdx, Quantity, Real, Refusal, Row, Stateless, Traits, Vec2, Vector,
};

/// A number lies in an interval, or a vector is another one.
///
/// By itself it holds no points: its values are measured on them, see
/// [`Measured`](super::Measured).
#[derive(Debug, Clone, PartialEq)]
pub enum Hold {
    /// A number and where it has to lie.
    Number {
        /// What is measured.
        value: f64,
        /// The values it may have.
        bounds: Bounds,
    },
    /// A vector and what it has to be.
    Vector {
        /// What is measured.
        value: Vector,
        /// What it has to be.
        target: Vector,
    },
}

impl Declared for Hold {
    const WORDS: &'static [&'static str] = &["hold"];

    fn declare(given: &Given) -> Result<Self, Refusal> {
        let value = |field| given.value(field);
        let vector = |x, y| Some(Vector::new(value(x)?, value(y)?));
        let of_vector = vector(Field::Value, Field::ValueY).zip(vector(Field::X, Field::Y));
        if let Some((value, target)) = of_vector {
            return Ok(Self::Vector { value, target });
        }
        match value(Field::Value).zip(given.bounds) {
            Some((value, bounds)) => Ok(Self::Number { value, bounds }),
            None => Err(Refusal {
                message: "this says nothing that could be held",
                at: Culprit::Statement,
                label: "two sides, and `=`, `<=`, `>=` or `in` between them",
                help: None,
            }),
        }
    }
}

impl Stateless for Hold {}

impl ConstraintKind for Hold {
    fn points(&self) -> &[PointIdx] {
        &[]
    }

    fn points_mut(&mut self) -> &mut [PointIdx] {
        &mut []
    }

    fn n_rows(&self) -> usize {
        match self {
            Self::Number { .. } => 1,
            Self::Vector { .. } => 2,
        }
    }

    fn residual(&self, _x: &[Point]) -> f64 {
        match self {
            Self::Number { value, bounds } => bounds.excess(*value),
            Self::Vector { value, target } => (*value - *target).norm(),
        }
    }

    fn correct(&self, _x: &[Point], _w: &[f64], _move_by: &mut impl FnMut(PointIdx, Vector)) {}

    fn jacobian(&self, _x: &[Point], row: &mut impl FnMut(Row)) {
        match self {
            Self::Number { value, bounds } => {
                let f = bounds.excess(*value);
                let is_active = f != 0.0 || bounds.is_equality();
                row(Row { is_active, ..Row::new(f) });
            }
            Self::Vector { value, target } => {
                let f = *value - *target;
                row(Row::new(f.x));
                row(Row::new(f.y));
            }
        }
    }

    fn equations<T: Real>(
        &self,
        _x: &impl Fn(PointIdx) -> Vec2<T>,
        field: &impl Fn(Field, f64) -> T,
        equation: &mut impl FnMut(T),
    ) {
        match self {
            Self::Number { value, bounds } => {
                equation(bounds.excess_of(field(Field::Value, *value), field));
            }
            Self::Vector { value, target } => {
                equation(field(Field::Value, value.x) - field(Field::X, target.x));
                equation(field(Field::ValueY, value.y) - field(Field::Y, target.y));
            }
        }
    }

    fn get(&self, field: Field) -> Option<f64> {
        match (self, field) {
            (Self::Number { value, .. }, Field::Value) => Some(*value),
            (Self::Number { bounds, .. }, _) => bounds.get(field),
            (Self::Vector { value, .. }, Field::Value) => Some(value.x),
            (Self::Vector { value, .. }, Field::ValueY) => Some(value.y),
            (Self::Vector { target, .. }, Field::X) => Some(target.x),
            (Self::Vector { target, .. }, Field::Y) => Some(target.y),
            (Self::Vector { .. }, _) => None,
        }
    }

    fn set(&mut self, field: Field, to: f64) -> bool {
        let place = match (self, field) {
            (Self::Number { value, .. }, Field::Value) => value,
            (Self::Number { bounds, .. }, _) => return bounds.set(field, to),
            (Self::Vector { value, .. }, Field::Value) => &mut value.x,
            (Self::Vector { value, .. }, Field::ValueY) => &mut value.y,
            (Self::Vector { target, .. }, Field::X) => &mut target.x,
            (Self::Vector { target, .. }, Field::Y) => &mut target.y,
            (Self::Vector { .. }, _) => return false,
        };
        *place = to;
        true
    }

    fn nominal_length(&self) -> f64 {
        // It may be a number of any unit.
        0.0
    }

    fn traits(&self) -> Traits {
        let bounds = match self {
            Self::Number { bounds, .. } => Some(*bounds),
            Self::Vector { .. } => None,
        };
        Traits {
            word: "hold",
            quantity: Quantity::Number,
            bounds,
            activity: bounds.map_or(Activity::Always, Activity::within),
            n_firm_rows: 0,
            is_linear: true,
            is_wheel: false,
            carried: Carried::Nothing,
            flags: &[],
            flaw: bounds.and_then(Flaw::of_range),
        }
    }

    fn content(&self, word: &mut impl FnMut(u64)) {
        match self {
            Self::Number { value, bounds } => {
                add_all([*value], word);
                bounds.content(word);
            }
            Self::Vector { value, target } => {
                add_all([value.x, value.y, target.x, target.y], word);
            }
        }
    }
}
