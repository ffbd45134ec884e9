//! Positions and differences whose coordinates are any kind of number.

use crate::constraint::{Real, Vector};
use std::ops::{Add, Sub};

/// A position, or a difference of two, whose coordinates are any kind of number.
#[must_use]
#[derive(Debug, Clone, Copy)]
pub struct Vec2<T> {
    /// The horizontal coordinate.
    pub x: T,
    /// The vertical coordinate.
    pub y: T,
}

impl<T: Real> Vec2<T> {
    /// One that does not change in time.
    pub fn constant(v: Vector) -> Self {
        Self { x: T::constant(v.x), y: T::constant(v.y) }
    }

    /// The value now.
    pub fn value(self) -> Vector {
        Vector::new(self.x.value(), self.y.value())
    }

    /// The product with a number.
    pub fn scale(self, k: T) -> Self {
        Self { x: self.x * k, y: self.y * k }
    }

    /// The product as complex numbers.
    pub fn times(self, z: Self) -> Self {
        Self { x: self.x * z.x - self.y * z.y, y: self.x * z.y + self.y * z.x }
    }

    /// The scalar product.
    pub fn dot(self, o: Self) -> T {
        self.x * o.x + self.y * o.y
    }

    /// The signed area of the parallelogram, positive when `o` lies to the left.
    pub fn cross(self, o: Self) -> T {
        self.x * o.y - self.y * o.x
    }

    /// The length; that of the zero vector changes as if it pointed along the x axis, as
    /// the rows of the Jacobian have it.
    pub fn norm(self) -> T {
        if self.x.value() == 0.0 && self.y.value() == 0.0 {
            return self.x;
        }
        self.dot(self).sqrt()
    }

    /// The length; that of the zero vector changes as if it pointed along `other`, or else
    /// the x axis.
    pub fn norm_or_along(self, other: Vector) -> T {
        match other.unit() {
            Some(e) if self.value() == Vector::ZERO => self.dot(Self::constant(e)),
            _ => self.norm(),
        }
    }

    /// The direction against the x axis, in (-pi, pi].
    pub fn angle(self) -> T {
        self.y.atan2(self.x)
    }

    /// The signed angle from this vector to `o`, in (-pi, pi].
    pub fn angle_to(self, o: Self) -> T {
        self.cross(o).atan2(self.dot(o))
    }
}

impl<T: Real> Add for Vec2<T> {
    type Output = Self;
    fn add(self, o: Self) -> Self {
        Self { x: self.x + o.x, y: self.y + o.y }
    }
}

impl<T: Real> Sub for Vec2<T> {
    type Output = Self;
    fn sub(self, o: Self) -> Self {
        Self { x: self.x - o.x, y: self.y - o.y }
    }
}
