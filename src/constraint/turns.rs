//! An angle accumulated frame by frame that loses nothing in a million turns.

use super::geometry::wrap;
use std::f64::consts::TAU;

/// How far something has turned: whole turns and a fraction of one, to twice the precision
/// of `f64`. A turn is `f64`'s 2 pi, the `1rev` of the command language.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Turns {
    /// Whole turns.
    whole: i64,
    /// The rest, in turns, as an unevaluated sum of two; within half a turn of 0.
    fraction: Double,
}

/// The sum of two numbers, the second below the rounding of the first.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
struct Double {
    hi: f64,
    lo: f64,
}

impl Double {
    /// The exact sum of two numbers.
    fn sum(a: f64, b: f64) -> Self {
        let hi = a + b;
        let b_part = hi - a;
        Self { hi, lo: (a - (hi - b_part)) + (b - b_part) }
    }

    /// The quotient of two numbers.
    fn quotient(a: f64, b: f64) -> Self {
        let hi = a / b;
        if hi.is_finite() { Self { hi, lo: (-hi).mul_add(b, a) / b } } else { Self::default() }
    }

    fn plus(self, o: Self) -> Self {
        let high = Self::sum(self.hi, o.hi);
        let low = Self::sum(self.lo, o.lo);
        let once = Self::sum(high.hi, high.lo + low.hi);
        Self::sum(once.hi, once.lo + low.lo)
    }
}

impl Turns {
    /// The amount an angle in radians makes.
    ///
    /// A step of 1/60 of 2 pi is not a number of `f64`. Where a fraction with a small
    /// denominator lies within the rounding of `radians`, that fraction is meant, and taken:
    /// 60 such steps are one turn and not nearly one. Not finite counts as 0.
    pub fn from_radians(radians: f64) -> Self {
        if !radians.is_finite() {
            return Self::default();
        }
        let turns = Double::quotient(radians, TAU);
        let whole = turns.hi.round();
        let rest = Double::sum(turns.hi - whole, turns.lo);
        let fraction = simplest_fraction(rest.hi, 4.0 * f64::EPSILON * turns.hi.abs())
            .map_or(rest, |(p, q)| Double::quotient(p, q));
        Self { whole: whole as i64, fraction }
    }

    /// Turns on by another amount.
    #[must_use]
    pub fn plus(self, by: Self) -> Self {
        let fraction = self.fraction.plus(by.fraction);
        let carry = fraction.hi.round();
        Self {
            whole: self.whole.saturating_add(by.whole).saturating_add(carry as i64),
            fraction: Double::sum(fraction.hi - carry, fraction.lo),
        }
    }

    /// The angle without whole turns, radians, in [-pi, pi].
    pub fn angle(self) -> f64 {
        self.fraction.hi.mul_add(TAU, self.fraction.lo * TAU)
    }

    /// The whole angle, radians; as exact as one number can be.
    pub fn total(self) -> f64 {
        (self.whole as f64).mul_add(TAU, self.angle())
    }

    /// The amount as whole turns and the two parts of the fraction.
    pub const fn to_numbers(self) -> [f64; 3] {
        [self.whole as f64, self.fraction.hi, self.fraction.lo]
    }

    /// The amount that [`to_numbers`](Self::to_numbers) gave.
    pub const fn from_numbers([whole, hi, lo]: [f64; 3]) -> Self {
        Self { whole: whole as i64, fraction: Double { hi, lo } }
    }

    /// The amount nearest to this one that differs from `angle` by whole turns.
    #[must_use]
    pub fn pick_up(self, angle: f64) -> Self {
        self.plus(Self { whole: 0, fraction: Double::quotient(wrap(angle - self.angle()), TAU) })
    }
}

/// The fraction p/q with the smallest q up to 100 000 that lies within `tolerance` of `t`,
/// if any, by continued fractions.
///
/// A million times fewer such fractions than numbers `f64` can tell apart lie in a unit
/// interval, so that a step that meets one by accident is rare, and off by its rounding then.
pub(super) fn simplest_fraction(t: f64, tolerance: f64) -> Option<(f64, f64)> {
    const LARGEST: f64 = 1e5;
    let (mut p0, mut q0, mut p1, mut q1) = (0.0, 1.0, 1.0, 0.0);
    let mut rest = t;
    // Denominators at least double every two rounds.
    for _ in 0..40 {
        let digit = rest.round();
        (p0, p1) = (p1, digit * p1 + p0);
        (q0, q1) = (q1, digit * q1 + q0);
        if q1.abs() > LARGEST {
            return None;
        }
        if (p1 - t * q1).abs() <= tolerance * q1.abs() {
            return Some((p1 * q1.signum(), q1.abs()));
        }
        rest = 1.0 / (rest - digit);
    }
    None
}
