//! The values of the functions of numbers.

use crate::constraint::Real;
use crate::terms::Function;

impl Function {
    /// The argument that says whether there is a value.
    pub(super) const fn limited_argument(self) -> usize {
        match self {
            Self::Mod => 1,
            _ => 0,
        }
    }

    /// The value for numbers; none outside the domain. Only for functions of numbers to a
    /// number.
    pub(super) fn of_numbers<T: Real>(self, a: &[T]) -> Option<T> {
        let x = a[0];
        let v = x.value();
        Some(match self {
            Self::Sin => x.sin(),
            Self::Cos => x.cos(),
            Self::Tan => {
                let t = libm::tan(v);
                let d = 1.0 + t * t;
                x.chain(t, d, 2.0 * t * d)
            }
            Self::Asin => {
                let q = 1.0 - v * v;
                (q >= 0.0).then(|| x.chain(libm::asin(v), 1.0 / q.sqrt(), v / (q * q.sqrt())))?
            }
            Self::Acos => {
                let q = 1.0 - v * v;
                (q >= 0.0).then(|| x.chain(libm::acos(v), -1.0 / q.sqrt(), -v / (q * q.sqrt())))?
            }
            Self::Atan => {
                let q = 1.0 + v * v;
                x.chain(libm::atan(v), 1.0 / q, -2.0 * v / (q * q))
            }
            Self::Atan2 => x.atan2(a[1]),
            Self::Sqrt => (v >= 0.0).then(|| x.sqrt())?,
            Self::Abs => x.chain(v.abs(), sign(v), 0.0),
            Self::Sign => x.chain(sign(v), 0.0, 0.0),
            Self::Min => {
                a.iter().copied().reduce(|p, q| if q.value() < p.value() { q } else { p })?
            }
            Self::Max => {
                a.iter().copied().reduce(|p, q| if q.value() > p.value() { q } else { p })?
            }
            Self::Hypot => {
                // The value by the function that cannot overflow, the slopes by the formula.
                let r = libm::hypot(v, a[1].value());
                let root = (x * x + a[1] * a[1]).sqrt();
                if root.value() == r { root } else { root + T::constant(r - root.value()) }
            }
            Self::Floor => x.chain(v.floor(), 0.0, 0.0),
            Self::Ceil => x.chain(v.ceil(), 0.0, 0.0),
            Self::Round => x.chain(v.round(), 0.0, 0.0),
            Self::Exp => {
                let e = libm::exp(v);
                x.chain(e, e, e)
            }
            Self::Ln => (v > 0.0).then(|| x.chain(libm::log(v), 1.0 / v, -1.0 / (v * v)))?,
            Self::Triangle => {
                // The nearest even number is exact, and so is the distance from it.
                let r = v - 2.0 * (0.5 * v).round();
                let slope = if (0.0..1.0).contains(&r) { 1.0 } else { -1.0 };
                x.chain(r.abs(), slope, 0.0)
            }
            Self::Mod => {
                let b = a[1].value();
                if b == 0.0 {
                    return None;
                }
                let q = (v / b).floor();
                let m = x - T::constant(q) * a[1];
                // The rounded quotient may leave the remainder a step outside [0, b).
                let wrapped = v.rem_euclid(b.abs());
                let wrapped = if b < 0.0 && wrapped != 0.0 { wrapped + b } else { wrapped };
                m + T::constant(wrapped - m.value())
            }
            _ => unreachable!("{} takes a vector or a point", self.name()),
        })
    }
}

fn sign(v: f64) -> f64 {
    if v == 0.0 { 0.0 } else { v.signum() }
}
