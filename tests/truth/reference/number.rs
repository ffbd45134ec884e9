//! Numbers that carry their derivatives, so that each formula is written once.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// The most variables that one equation has: two for each of four points.
pub const MOST: usize = 8;

/// A number, with or without derivatives.
pub trait Number:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// A number that does not depend on anything.
    fn constant(value: f64) -> Self;
    /// The value alone.
    fn value(self) -> f64;
    /// The square root of a number above 0.
    fn sqrt(self) -> Self;
    /// The direction of the vector (x, y); `self` is y, and not both are 0.
    fn atan2(self, x: Self) -> Self;
}

impl Number for f64 {
    fn constant(value: f64) -> Self {
        value
    }

    fn value(self) -> f64 {
        self
    }

    fn sqrt(self) -> Self {
        self.sqrt()
    }

    fn atan2(self, x: Self) -> Self {
        libm::atan2(self, x)
    }
}

/// How a function of two numbers changes: its value, first and second derivatives.
struct Chain {
    f: f64,
    by: [f64; 2],
    by_both: [f64; 3],
}

impl Chain {
    fn product(a: f64, b: f64) -> Self {
        Self { f: a * b, by: [b, a], by_both: [0.0, 1.0, 0.0] }
    }

    fn quotient(a: f64, b: f64) -> Self {
        let f = a / b;
        Self { f, by: [1.0 / b, -f / b], by_both: [0.0, -1.0 / (b * b), 2.0 * f / (b * b)] }
    }

    /// At 0, where it has no slope, it is flat: points in one place are not pushed apart.
    fn root(a: f64) -> Self {
        let f = a.sqrt();
        if f == 0.0 {
            return Self { f, by: [0.0; 2], by_both: [0.0; 3] };
        }
        Self { f, by: [0.5 / f, 0.0], by_both: [-0.25 / (f * a), 0.0, 0.0] }
    }

    fn direction(y: f64, x: f64) -> Self {
        let r2 = x * x + y * y;
        let r4 = r2 * r2;
        Self {
            f: libm::atan2(y, x),
            by: [x / r2, -y / r2],
            by_both: [-2.0 * x * y / r4, (y * y - x * x) / r4, 2.0 * x * y / r4],
        }
    }
}

/// A number with its gradient.
#[derive(Clone, Copy)]
pub struct Slope {
    pub value: f64,
    pub gradient: [f64; MOST],
}

impl Slope {
    /// The variable with this index.
    pub fn variable(value: f64, index: usize) -> Self {
        let mut slope = Self::constant(value);
        slope.gradient[index] = 1.0;
        slope
    }

    fn chain(self, other: &Self, chain: &Chain) -> Self {
        let mut gradient = self.gradient;
        for (g, h) in gradient.iter_mut().zip(&other.gradient) {
            *g = chain.by[0] * *g + chain.by[1] * h;
        }
        Self { value: chain.f, gradient }
    }
}

/// A number with its gradient and the matrix of its second derivatives.
#[derive(Clone, Copy)]
pub struct Curve {
    pub value: f64,
    pub gradient: [f64; MOST],
    pub hessian: [[f64; MOST]; MOST],
}

impl Curve {
    /// The variable with this index.
    pub fn variable(value: f64, index: usize) -> Self {
        let mut curve = Self::constant(value);
        curve.gradient[index] = 1.0;
        curve
    }

    fn chain(self, other: &Self, chain: &Chain) -> Self {
        let ([da, db], [daa, dab, dbb]) = (chain.by, chain.by_both);
        let (a, b) = (&self.gradient, &other.gradient);
        let mut result = Self::constant(chain.f);
        for i in 0..MOST {
            result.gradient[i] = da * a[i] + db * b[i];
            for j in 0..MOST {
                result.hessian[i][j] = da * self.hessian[i][j]
                    + db * other.hessian[i][j]
                    + daa * a[i] * a[j]
                    + dab * (a[i] * b[j] + b[i] * a[j])
                    + dbb * b[i] * b[j];
            }
        }
        result
    }
}

macro_rules! number {
    ($type:ident, $constant:expr) => {
        impl Number for $type {
            fn constant(value: f64) -> Self {
                $constant(value)
            }

            fn value(self) -> f64 {
                self.value
            }

            fn sqrt(self) -> Self {
                self.chain(&self, &Chain::root(self.value))
            }

            fn atan2(self, x: Self) -> Self {
                self.chain(&x, &Chain::direction(self.value, x.value))
            }
        }

        impl Add for $type {
            type Output = Self;
            fn add(self, o: Self) -> Self {
                let f = self.value + o.value;
                self.chain(&o, &Chain { f, by: [1.0, 1.0], by_both: [0.0; 3] })
            }
        }

        impl Sub for $type {
            type Output = Self;
            fn sub(self, o: Self) -> Self {
                let f = self.value - o.value;
                self.chain(&o, &Chain { f, by: [1.0, -1.0], by_both: [0.0; 3] })
            }
        }

        impl Mul for $type {
            type Output = Self;
            fn mul(self, o: Self) -> Self {
                self.chain(&o, &Chain::product(self.value, o.value))
            }
        }

        impl Div for $type {
            type Output = Self;
            fn div(self, o: Self) -> Self {
                self.chain(&o, &Chain::quotient(self.value, o.value))
            }
        }

        impl Neg for $type {
            type Output = Self;
            fn neg(self) -> Self {
                Self::constant(0.0) - self
            }
        }
    };
}

number!(Slope, |value| Slope { value, gradient: [0.0; MOST] });
number!(Curve, |value| Curve { value, gradient: [0.0; MOST], hessian: [[0.0; MOST]; MOST] });
