//! Values of expressions, numbers or vectors, and the operators between them.

use crate::constraint::{Real, Vec2};
use crate::terms::Shape;

/// A value of an expression over any kind of number.
#[derive(Debug, Clone, Copy)]
pub enum Value<T = f64> {
    /// A number.
    Number(T),
    /// A vector.
    Vector(Vec2<T>),
}

impl<T: Real> Value<T> {
    /// Nothing of this shape.
    pub fn zero(shape: Shape) -> Self {
        let zero = T::constant(0.0);
        match shape {
            Shape::Number => Self::Number(zero),
            Shape::Vector => Self::Vector(Vec2 { x: zero, y: zero }),
        }
    }

    /// A value that does not change.
    pub fn constant(value: Value) -> Self {
        match value {
            Value::Number(n) => Self::Number(T::constant(n)),
            Value::Vector(v) => Self::Vector(Vec2 { x: T::constant(v.x), y: T::constant(v.y) }),
        }
    }

    /// What it is.
    pub const fn shape(&self) -> Shape {
        match self {
            Self::Number(_) => Shape::Number,
            Self::Vector(_) => Shape::Vector,
        }
    }

    /// Whether it holds neither an infinity nor not-a-number.
    pub fn is_finite(self) -> bool {
        match self {
            Self::Number(n) => n.value().is_finite(),
            Self::Vector(v) => v.x.value().is_finite() && v.y.value().is_finite(),
        }
    }

    /// Whether nothing in it is larger than `most`.
    pub fn is_within(self, most: f64) -> bool {
        match self {
            Self::Number(n) => n.value().abs() <= most,
            Self::Vector(v) => v.x.value().abs() <= most && v.y.value().abs() <= most,
        }
    }

    /// The number; formulas are checked for shape when they are bound.
    pub fn number(self) -> T {
        match self {
            Self::Number(n) => n,
            Self::Vector(_) => unreachable!("shapes are checked when a formula is bound"),
        }
    }

    /// The vector; formulas are checked for shape when they are bound.
    pub fn vector(self) -> Vec2<T> {
        match self {
            Self::Vector(v) => v,
            Self::Number(_) => unreachable!("shapes are checked when a formula is bound"),
        }
    }
}
