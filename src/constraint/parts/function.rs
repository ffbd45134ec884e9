//! The values of functions of numbers, over any kind of number.

use crate::constraint::{Real, Vec2, Vector};
use crate::terms::Function;

/// The value of a function of numbers; none outside its domain.
///
/// # Panics
/// For a function that takes a vector or the name of a point.
pub fn value_of<T: Real>(function: Function, a: &[T]) -> Option<T> {
    let x = a[0];
    let v = x.value();
    Some(match function {
        Function::Sin => x.sin(),
        Function::Cos => x.cos(),
        Function::Tan => {
            let t = libm::tan(v);
            let d = 1.0 + t * t;
            x.chain(t, d, 2.0 * t * d)
        }
        Function::Asin => {
            let q = 1.0 - v * v;
            (q >= 0.0).then(|| x.chain(libm::asin(v), 1.0 / q.sqrt(), v / (q * q.sqrt())))?
        }
        Function::Acos => {
            let q = 1.0 - v * v;
            (q >= 0.0).then(|| x.chain(libm::acos(v), -1.0 / q.sqrt(), -v / (q * q.sqrt())))?
        }
        Function::Atan => {
            let q = 1.0 + v * v;
            x.chain(libm::atan(v), 1.0 / q, -2.0 * v / (q * q))
        }
        Function::Atan2 => x.atan2(a[1]),
        Function::Sqrt => (v >= 0.0).then(|| x.sqrt())?,
        Function::Abs => x.chain(v.abs(), sign(v), 0.0),
        Function::Sign => x.chain(sign(v), 0.0, 0.0),
        Function::Min => {
            a.iter().copied().reduce(|p, q| if q.value() < p.value() { q } else { p })?
        }
        Function::Max => {
            a.iter().copied().reduce(|p, q| if q.value() > p.value() { q } else { p })?
        }
        Function::Hypot => {
            // The value by the function that cannot overflow, the slopes by the formula.
            let r = libm::hypot(v, a[1].value());
            let root = (x * x + a[1] * a[1]).sqrt();
            if root.value() == r { root } else { root + T::constant(r - root.value()) }
        }
        Function::Floor => x.chain(v.floor(), 0.0, 0.0),
        Function::Ceil => x.chain(v.ceil(), 0.0, 0.0),
        Function::Round => x.chain(v.round(), 0.0, 0.0),
        Function::Exp => {
            let e = libm::exp(v);
            x.chain(e, e, e)
        }
        Function::Ln => (v > 0.0).then(|| x.chain(libm::log(v), 1.0 / v, -1.0 / (v * v)))?,
        Function::Triangle => {
            // The nearest even number is exact, and so is the distance from it.
            let r = v - 2.0 * (0.5 * v).round();
            let slope = if (0.0..1.0).contains(&r) { 1.0 } else { -1.0 };
            x.chain(r.abs(), slope, 0.0)
        }
        Function::Mod => {
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
        _ => unreachable!("{} takes a vector or a point", function.name()),
    })
}

/// Which of the sine and the cosine of an angle a function is, if one.
pub const fn of_unit_circle(function: Function) -> Option<usize> {
    match function {
        Function::Sin => Some(0),
        Function::Cos => Some(1),
        _ => None,
    }
}

/// The argument that says whether a function has a value.
pub const fn limited_argument(function: Function) -> usize {
    match function {
        Function::Mod => 1,
        _ => 0,
    }
}

/// The length of a vector; the value never overflows before its result does.
pub fn length<T: Real>(v: Vec2<T>) -> T {
    let squares = v.norm();
    let exact = Vector::new(v.x.value(), v.y.value()).norm();
    if squares.value() == exact { squares } else { squares.chain(exact, 1.0, 0.0) }
}

/// a^b; none where it has no real value.
pub fn power<T: Real>(a: T, b: T) -> Option<T> {
    let (x, p) = (a.value(), b.value());
    if (x == 0.0 && p < 0.0) || (x < 0.0 && p != p.trunc()) {
        return None;
    }
    let v = libm::pow(x, p);
    // As a function of the base with a constant power, then of the power with a constant base.
    let by_base = a.chain(v, slope(p, x, p - 1.0), slope(p * (p - 1.0), x, p - 2.0));
    if b.is_constant() || x <= 0.0 {
        return Some(by_base);
    }
    let e = b * a.chain(libm::log(x), 1.0 / x, -1.0 / (x * x));
    Some(e.chain(v, v, v))
}

/// k x^p, 0 where k is.
fn slope(k: f64, x: f64, p: f64) -> f64 {
    if k == 0.0 { 0.0 } else { k * libm::pow(x, p) }
}

fn sign(v: f64) -> f64 {
    if v == 0.0 { 0.0 } else { v.signum() }
}
