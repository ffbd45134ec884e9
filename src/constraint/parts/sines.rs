//! Sines and cosines of several angles at a time, with the bits that `libm` gives for each by itself.
//!
//! Its way (that of FreeBSD's msun) is taken for angles of up to five eighths of a turn, in one loop without branches: what is left of the angle after so many quarter turns, and two
//! polynomials. Tiny angles, and those within rounding of a quarter turn or half a turn, for which it takes
//! other ways, are left to it.

#![allow(
    clippy::needless_bitwise_bool,
    clippy::manual_range_contains,
    reason = "conditions without branches become part of vectors"
)]

/// A quarter turn in two parts, the first with so few digits that small multiples of it are exact.
const QUARTER: [f64; 2] = [1.570_796_326_734_125_6, 6.077_100_506_506_192e-11];

const SINE: [f64; 6] = [
    -0.166_666_666_666_666_32,
    0.008_333_333_333_322_49,
    -0.000_198_412_698_298_579_5,
    2.755_731_370_707_006_8e-6,
    -2.505_076_025_340_686_3e-8,
    1.589_690_995_211_55e-10,
];
const COSINE: [f64; 6] = [
    0.041_666_666_666_666_6,
    -0.001_388_888_888_887_411,
    2.480_158_728_947_673e-5,
    -2.755_731_435_139_066_3e-7,
    2.087_572_321_298_175e-9,
    -1.135_964_755_778_819_5e-11,
];

/// The least number whose upper half has these bits.
const fn above(upper: u64) -> f64 {
    f64::from_bits(upper << 32)
}

/// Angles from which on one, from which on two quarter turns are taken off, and beyond which more are.
const BOUNDS: [f64; 3] = [above(0x3fe9_21fc), above(0x4002_d97d), above(0x400f_6a7b)];
/// Below that the sine of an angle is the angle, nearly enough.
const TINY: f64 = above(0x3e47_0000);
/// Where a quarter turn and a half are, to the upper half of their bits.
const NEAR: [[f64; 2]; 2] =
    [[above(0x3ff9_21fb), above(0x3ff9_21fc)], [above(0x4009_21fb), above(0x4009_21fc)]];

/// The sines and the cosines.
#[allow(clippy::inline_always, reason = "it becomes part of who calls it, with its vectors")]
#[inline(always)]
pub(crate) fn sines_and_cosines<const N: usize>(angles: &[f64; N]) -> [[f64; N]; 2] {
    let mut all = [[0.0; N]; 2];
    let mut is_left = [0.0; N];
    for l in 0..N {
        let [s, c, left] = one(angles[l]);
        (all[0][l], all[1][l], is_left[l]) = (s, c, left);
    }
    if is_left != [0.0; N] {
        for l in (0..N).filter(|&l| is_left[l] != 0.0) {
            (all[0][l], all[1][l]) = libm::sincos(angles[l]);
        }
    }
    all
}

/// The sine and the cosine of an angle, and 1 if it is left to `libm`, else 0.
#[allow(clippy::inline_always, reason = "it becomes part of who calls it, with its vectors")]
#[inline(always)]
fn one(angle: f64) -> [f64; 3] {
    let size = angle.abs();
    let is_near = |[lo, hi]: [f64; 2]| (size >= lo) & (size < hi);
    let is_plain = (size >= TINY) & (size < BOUNDS[2]) & !is_near(NEAR[0]) & !is_near(NEAR[1]);
    let sign = 1_f64.copysign(angle);
    let (is_whole, is_two) = (size < BOUNDS[0], size >= BOUNDS[1]);
    let n = if is_whole { 0.0 } else { sign } * if is_two { 2.0 } else { 1.0 };
    let first = angle - n * QUARTER[0];
    let x = first - n * QUARTER[1];
    let rest = (first - x) - n * QUARTER[1];

    let z = x * x;
    let w = z * z;
    let [s1, s2, s3, s4, s5, s6] = SINE;
    let r = s2 + z * (s3 + z * s4) + z * w * (s5 + z * s6);
    let v = z * x;
    let whole = x + v * (s1 + z * r);
    let part = x - ((z * (0.5 * rest - v * r) - rest) - v * s1);
    let sine = if is_whole { whole } else { part };

    let [c1, c2, c3, c4, c5, c6] = COSINE;
    let r = z * (c1 + z * (c2 + z * c3)) + w * w * (c4 + z * (c5 + z * c6));
    let half = 0.5 * z;
    let w = 1.0 - half;
    let cosine = w + (((1.0 - w) - half) + (z * r - x * rest));

    let is_odd = !is_whole & !is_two;
    let (s, c) = if is_odd { (cosine, sine) } else { (sine, cosine) };
    let turned = if is_two { -1.0 } else { 1.0 };
    let (of_s, of_c) = if is_odd { (sign, -sign) } else { (turned, turned) };
    [of_s * s, of_c * c, if is_plain { 0.0 } else { 1.0 }]
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::array;
    use std::f64::consts::{PI, TAU};

    fn check(angles: [f64; 8]) {
        let [sines, cosines] = sines_and_cosines(&angles);
        let bits = array::from_fn::<_, 8, _>(|l| [sines[l].to_bits(), cosines[l].to_bits()]);
        let theirs = angles.map(|angle| {
            let (s, c) = libm::sincos(angle);
            [s.to_bits(), c.to_bits()]
        });
        assert_eq!(bits, theirs, "{angles:?}");
    }

    #[test]
    fn each_has_the_bits_that_it_has_alone() {
        // A sequence that fills the turn evenly.
        for k in 0..100_000 {
            check(array::from_fn(|l| {
                let part = (f64::from(8 * k + l as u32) * 0.618_033_988_749_895).fract();
                (part - 0.5) * 1.3 * TAU
            }));
        }
    }

    #[test]
    fn so_have_those_next_to_where_its_ways_part() {
        let edges = BOUNDS.into_iter().chain(NEAR.into_iter().flatten()).chain([
            TINY,
            0.0,
            PI,
            PI / 2.0,
            PI / 4.0,
            1.0,
            1e-300,
            1e300,
            f64::INFINITY,
            f64::NAN,
        ]);
        for edge in edges {
            check(
                [1.0, -1.0, 1.0 + 1e-15, 1.0 - 1e-15, 1.001, 0.999, -1.001, 2.0].map(|k| k * edge),
            );
            let bits = edge.to_bits();
            check(array::from_fn(|l| f64::from_bits(bits.wrapping_add(l as u64).wrapping_sub(4))));
        }
    }
}
