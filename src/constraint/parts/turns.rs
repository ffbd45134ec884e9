//! An angle accumulated frame by frame that loses nothing in a million turns.

use super::geometry::wrap;
use std::f64::consts::TAU;

/// How far something has turned: whole turns and a fraction of one, to about twice the precision
/// of `f64`. A turn is `f64`'s 2 pi, the `1rev` of the command language.
///
/// The fraction is counted in parts of a turn, so that sums are exact: a hundred steps one by one lead where a
/// hundred at once do.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Turns {
    /// Whole turns.
    whole: i64,
    /// The rest, within half a turn of 0.
    fraction: Fraction,
}

/// A part of a turn, in two digits to the base [`BASE`]; each is at least `-BASE / 2` and below `BASE / 2`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
struct Fraction {
    /// Parts of a turn.
    high: i64,
    /// Parts of such a part.
    low: i64,
}

/// The binary digits of a digit.
const BITS: u32 = 52;
/// The parts of a turn, and of one of these.
const BASE: i64 = 1 << BITS;
/// A part of a turn, and a part of that, in turns.
const PARTS: [f64; 2] = [1.0 / BASE as f64, 1.0 / BASE as f64 / BASE as f64];

/// What a digit has too much, and what is left of it.
#[allow(clippy::inline_always, reason = "it becomes part of loops that vectors are made of")]
#[inline(always)]
const fn carry(digit: i64) -> (i64, i64) {
    let over = (digit + BASE / 2) >> BITS;
    (over, digit - (over << BITS))
}

/// A digit as a number; exact.
#[allow(clippy::inline_always, reason = "it becomes part of loops that vectors are made of")]
#[inline(always)]
const fn number(digit: i64) -> f64 {
    // Next to this number the digits of a float count ones: so it goes in vectors too.
    const ONES: f64 = 1.5 * BASE as f64;
    f64::from_bits((ONES.to_bits().cast_signed() + digit).cast_unsigned()) - ONES
}

impl Fraction {
    /// So many parts, and the turns that are in them.
    #[allow(clippy::inline_always, reason = "it becomes part of loops that vectors are made of")]
    #[inline(always)]
    const fn of(high: i64, low: i64) -> (i64, Self) {
        let (over, low) = carry(low);
        let (whole, high) = carry(high + over);
        (whole, Self { high, low })
    }

    /// The sum of two numbers of turns, one at most each, and the turns that are in it. What is below a part of a
    /// part is rounded.
    fn nearest([one, other]: [f64; 2]) -> (i64, Self) {
        let split = |turns: f64| {
            let high = (turns / PARTS[0]).round();
            (high as i64, ((turns - high * PARTS[0]) / PARTS[1]).round() as i64)
        };
        let ((a, b), (c, d)) = (split(one), split(other));
        Self::of(a + c, b + d)
    }

    /// In turns.
    #[allow(clippy::inline_always, reason = "it becomes part of loops that vectors are made of")]
    #[inline(always)]
    const fn to_numbers(self) -> [f64; 2] {
        [number(self.high) * PARTS[0], number(self.low) * PARTS[1]]
    }

    /// In radians.
    #[allow(clippy::inline_always, reason = "it becomes part of loops that vectors are made of")]
    #[inline(always)]
    fn angle(self) -> f64 {
        let [high, low] = self.to_numbers();
        high.mul_add(TAU, low * TAU)
    }
}

/// The quotient of two numbers, as an unevaluated sum of two; 0 where it is no number.
fn quotient(a: f64, b: f64) -> [f64; 2] {
    let high = a / b;
    if high.is_finite() { [high, (-high).mul_add(b, a) / b] } else { [0.0; 2] }
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
        let [turns, less] = quotient(radians, TAU);
        let whole = turns.round();
        let rest = turns - whole;
        let fraction = simplest_fraction(rest, 4.0 * f64::EPSILON * turns.abs())
            .map_or([rest, less], |(p, q)| quotient(p, q));
        Self::sum(whole as i64, Fraction::nearest(fraction))
    }

    const fn sum(whole: i64, (more, fraction): (i64, Fraction)) -> Self {
        Self { whole: whole.saturating_add(more), fraction }
    }

    /// Turns on by another amount.
    #[must_use]
    pub const fn plus(self, by: Self) -> Self {
        self.plus_times(by, 1)
    }

    /// Turns on by another amount so many times, eight at most.
    #[allow(clippy::inline_always, reason = "it becomes part of loops that vectors are made of")]
    #[must_use]
    #[inline(always)]
    pub const fn plus_times(self, by: Self, times: usize) -> Self {
        let times = times.cast_signed() as i64;
        let (high, low) = (by.fraction.high * times, by.fraction.low * times);
        let (more, fraction) = Fraction::of(self.fraction.high + high, self.fraction.low + low);
        // Eight times as much may be too many, though not for what was less than nothing.
        let whole = self.whole as i128 + by.whole as i128 * times as i128 + more as i128;
        let (most, least) = (i64::MAX as i128, i64::MIN as i128);
        let whole = if whole > most {
            most
        } else if whole < least {
            least
        } else {
            whole
        };
        Self { whole: whole as i64, fraction }
    }

    /// The angle without whole turns, radians, in [-pi, pi].
    #[allow(clippy::inline_always, reason = "it becomes part of loops that vectors are made of")]
    #[inline(always)]
    pub fn angle(self) -> f64 {
        self.fraction.angle()
    }

    /// The whole angle, radians; as exact as one number can be.
    pub fn total(self) -> f64 {
        (self.whole as f64).mul_add(TAU, self.angle())
    }

    /// The angle between two amounts, radians; exact to rounding of what is between them.
    pub fn apart(self, other: Self) -> f64 {
        let (one, two) = (self.fraction, other.fraction);
        let between = Fraction::of(one.high - two.high, one.low - two.low);
        Self::sum(self.whole.saturating_sub(other.whole), between).total().abs()
    }

    /// The amount as whole turns and the two parts of the fraction.
    pub const fn to_numbers(self) -> [f64; 3] {
        let [high, low] = self.fraction.to_numbers();
        [self.whole as f64, high, low]
    }

    /// The amount that [`to_numbers`](Self::to_numbers) gave; of others whole turns alone are taken.
    pub fn from_numbers([whole, high, low]: [f64; 3]) -> Self {
        let is_part = high.abs() <= 1.0 && low.abs() <= 1.0;
        Self::sum(whole as i64, Fraction::nearest(if is_part { [high, low] } else { [0.0; 2] }))
    }

    /// The amount nearest to this one that differs from `angle` by whole turns.
    #[must_use]
    pub fn pick_up(self, angle: f64) -> Self {
        let on = quotient(wrap(angle - self.angle()), TAU);
        self.plus(Self::sum(0, Fraction::nearest(on)))
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
    use std::f64::consts::PI;

    fn after(n: usize, radians: f64) -> Turns {
        let step = Turns::from_radians(radians);
        (0..n).fold(Turns::default(), |turns, _| turns.plus(step))
    }

    #[test]
    fn whole_turns_come_back() {
        for frames in [1, 2, 3, 7, 24, 36, 60, 90, 360, 1440] {
            for speed in [TAU, -TAU, 2.0 * TAU, 7.0 * TAU] {
                let turns = after(frames, speed * (1.0 / frames as f64));
                assert!(turns.angle().abs() < 1e-27, "{frames} frames at {speed}");
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
    fn steps_at_once_lead_where_they_lead_one_by_one() {
        let steps = [
            1e-300,
            1e-17,
            0.1,
            -0.1,
            TAU / 360.0,
            3.0,
            -3.0,
            PI,
            -PI,
            1e6 * TAU + 1.0,
            1e25,
            -1e300,
        ];
        for radians in steps {
            let (from, step) = (after(5, 2.9 + radians), Turns::from_radians(radians));
            let mut one_by_one = from;
            for n in 1..=8 {
                one_by_one = one_by_one.plus(step);
                assert_eq!(from.plus_times(step, n), one_by_one, "{n} of {radians}");
                assert!(one_by_one.angle().abs() <= PI);
                assert_eq!(Turns::from_numbers(one_by_one.to_numbers()), one_by_one);
            }
        }
    }

    #[test]
    fn other_numbers_are_read_as_something_near_or_as_whole_turns() {
        let near = Turns::from_numbers([2.0, 0.3, -1e-18]);
        assert!((near.total() - 2.3 * TAU).abs() < 1e-14);
        for bad in [f64::NAN, f64::INFINITY, 1e300, -7.0] {
            assert_eq!(Turns::from_numbers([1.0, bad, 0.0]).total(), TAU);
            assert_eq!(Turns::from_numbers([1.0, 0.0, bad]).total(), TAU);
        }
    }

    #[test]
    fn picking_up_goes_the_short_way() {
        let turns = after(7, 0.9 * TAU);
        let picked = turns.pick_up(turns.total() + 0.25 + 40.0 * TAU);
        assert!((picked.total() - turns.total() - 0.25).abs() < 1e-13);
    }
}
