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
        if fraction.hi.abs() < 0.5 && fraction.hi != 0.0 {
            // Nothing is carried, as in most frames, and it is a sum already.
            return Self { whole: self.whole.saturating_add(by.whole), fraction };
        }
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

    /// The angle between two amounts, radians; exact to rounding of what is between them.
    pub fn apart(self, other: Self) -> f64 {
        let whole = self.whole.saturating_sub(other.whole) as f64;
        let fraction =
            (self.fraction.hi - other.fraction.hi) + (self.fraction.lo - other.fraction.lo);
        ((whole + fraction) * TAU).abs()
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
/// Three thousand million such fractions lie between 0 and 1. With a tolerance of a few units
/// in the last place one number in 200 000 meets one by accident, and that harms nothing: the
/// number was not known any better.
pub(crate) fn simplest_fraction(t: f64, tolerance: f64) -> Option<(f64, f64)> {
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

#[cfg(test)]
mod tests {
    use super::*;

    fn after(n: usize, radians: f64) -> Turns {
        let step = Turns::from_radians(radians);
        (0..n).fold(Turns::default(), |turns, _| turns.plus(step))
    }

    #[test]
    fn whole_turns_come_back() {
        for frames in [1, 2, 3, 7, 24, 36, 60, 90, 360, 1440] {
            for speed in [TAU, -TAU, 2.0 * TAU, 7.0 * TAU] {
                let turns = after(frames, speed * (1.0 / frames as f64));
                assert!(turns.angle().abs() < 1e-28, "{frames} frames at {speed}");
                assert_eq!(turns.total(), speed);
            }
        }
    }

    #[test]
    fn a_million_turns_lose_nothing() {
        let n = 1_000_000 * 36;
        let turns = after(n / 36, TAU * (1.0 + 1.0 / 36.0));
        assert_eq!(turns.total(), (n as f64 / 36.0 + n as f64 / 36.0 / 36.0) * TAU);
        let part = 1e6_f64 / 36.0;
        assert!((turns.angle() - wrap((part - part.floor()) * TAU)).abs() < 1e-10);
    }

    #[test]
    fn no_rounding_gathers_in_an_odd_step() {
        // 0.1 rad is no simple fraction of a turn; the sum keeps twice the digits.
        let turns = after(1_000_000, 0.1);
        assert!((turns.total() - 1e5).abs() <= 1e-10, "{}", turns.total());
        let back = (0..1_000_000).fold(turns, |t, _| t.plus(Turns::from_radians(-0.1)));
        assert!(back.total().abs() < 1e-22, "{}", back.total());
    }

    #[test]
    fn a_million_turns_a_frame_stay_finite() {
        assert_eq!(after(1000, 1e6 * TAU).angle(), 0.0);
        for huge in [1e30, 1e300, f64::MAX] {
            let turns = after(3, huge);
            assert!(turns.angle().is_finite() && turns.total().is_finite());
        }
        assert_eq!(Turns::from_radians(f64::INFINITY), Turns::default());
        assert_eq!(Turns::from_radians(f64::NAN), Turns::default());
    }

    #[test]
    fn amounts_are_apart_by_what_is_between_them() {
        let turns = after(1000, 0.9 * TAU);
        let further = turns.plus(Turns::from_radians(-0.3));
        assert!((turns.apart(further) - 0.3).abs() < 1e-15);
        assert_eq!(turns.apart(turns), 0.0);
        assert_eq!(after(7, TAU).apart(Turns::default()), 7.0 * TAU);
    }

    #[test]
    fn picking_up_goes_the_short_way() {
        let turns = after(7, 0.9 * TAU);
        let picked = turns.pick_up(turns.total() + 0.25 + 40.0 * TAU);
        assert!((picked.total() - turns.total() - 0.25).abs() < 1e-13);
    }
}
