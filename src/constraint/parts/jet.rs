//! Numbers that carry their first two derivatives in time, and what a formula needs of a number.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// What the equations of a constraint ask of a number; `f64` gives values, [`Jet`] motions.
pub trait Real:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// A number that does not change in time.
    fn constant(value: f64) -> Self;
    /// The value now.
    fn value(self) -> f64;
    /// Whether it does not change in time.
    fn is_constant(self) -> bool;
    /// A function of one variable from its value and two derivatives at `self.value()`.
    #[must_use]
    fn chain(self, f: f64, df: f64, ddf: f64) -> Self;

    /// The number that has `value` now and changes at `rate`.
    fn integral(value: f64, rate: Self) -> Self;

    /// The square root; at 0, where it has no derivative, one that does not change.
    #[must_use]
    fn sqrt(self) -> Self {
        let r = self.value().sqrt();
        if r == 0.0 {
            return Self::constant(r);
        }
        self.chain(r, 0.5 / r, -0.25 / (r * r * r))
    }
    /// The sine of an angle in radians.
    #[must_use]
    fn sin(self) -> Self {
        let (s, c) = libm::sincos(self.value());
        self.chain(s, c, -s)
    }
    /// The cosine of an angle in radians.
    #[must_use]
    fn cos(self) -> Self {
        let (s, c) = libm::sincos(self.value());
        self.chain(c, -s, -c)
    }
    /// The angle of the vector (x, y) for y = `self`, in (-pi, pi].
    #[must_use]
    fn atan2(self, x: Self) -> Self;
}

impl Real for f64 {
    fn constant(value: f64) -> Self {
        value
    }
    fn value(self) -> f64 {
        self
    }
    fn is_constant(self) -> bool {
        true
    }
    fn chain(self, f: f64, _df: f64, _ddf: f64) -> Self {
        f
    }
    fn integral(value: f64, _rate: Self) -> Self {
        value
    }
    fn atan2(self, x: Self) -> Self {
        libm::atan2(self, x)
    }
}

/// A value with its first and second derivative in time.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Jet {
    /// The value.
    pub v: f64,
    /// Its rate of change, per time unit.
    pub d: f64,
    /// Its second derivative, per time unit squared.
    pub dd: f64,
}

impl Jet {
    /// The jet with value `v`, rate `d` and second derivative `dd`.
    pub const fn new(v: f64, d: f64, dd: f64) -> Self {
        Self { v, d, dd }
    }
}

impl Real for Jet {
    fn constant(value: f64) -> Self {
        Self::new(value, 0.0, 0.0)
    }
    fn value(self) -> f64 {
        self.v
    }
    fn is_constant(self) -> bool {
        self.d == 0.0 && self.dd == 0.0
    }
    fn chain(self, f: f64, df: f64, ddf: f64) -> Self {
        Self::new(f, df * self.d, ddf * self.d * self.d + df * self.dd)
    }
    fn integral(value: f64, rate: Self) -> Self {
        Self::new(value, rate.v, rate.d)
    }
    fn atan2(self, x: Self) -> Self {
        // d(theta) = (x dy - y dx) / (x^2 + y^2), as a quotient of jets of first order.
        let y = self;
        let n = x.v * y.d - y.v * x.d;
        let dn = x.v * y.dd - y.v * x.dd;
        let q = x.v * x.v + y.v * y.v;
        // The zero vector has no direction that could turn.
        if q == 0.0 {
            return Self::constant(0.0);
        }
        let dq = 2.0 * (x.v * x.d + y.v * y.d);
        Self::new(libm::atan2(y.v, x.v), n / q, (dn - n / q * dq) / q)
    }
}

impl Add for Jet {
    type Output = Self;
    fn add(self, o: Self) -> Self {
        Self::new(self.v + o.v, self.d + o.d, self.dd + o.dd)
    }
}
impl Sub for Jet {
    type Output = Self;
    fn sub(self, o: Self) -> Self {
        Self::new(self.v - o.v, self.d - o.d, self.dd - o.dd)
    }
}
impl Neg for Jet {
    type Output = Self;
    fn neg(self) -> Self {
        Self::new(-self.v, -self.d, -self.dd)
    }
}
impl Mul for Jet {
    type Output = Self;
    fn mul(self, o: Self) -> Self {
        Self::new(
            self.v * o.v,
            self.d * o.v + self.v * o.d,
            self.dd * o.v + 2.0 * self.d * o.d + self.v * o.dd,
        )
    }
}
impl Div for Jet {
    type Output = Self;
    fn div(self, o: Self) -> Self {
        let r = 1.0 / o.v;
        self * o.chain(r, -r * r, 2.0 * r * r * r)
    }
}
