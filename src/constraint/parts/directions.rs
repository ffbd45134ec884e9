//! Directions of several vectors at a time, with the bits that `libm::atan2` gives for each by itself.
//!
//! Its way (that of FreeBSD's msun) is taken in one loop without branches: the quotient of the components is brought
//! near 0 by one of four known angles, and a polynomial says what is left. Vectors along an axis, or nearly so, for
//! which it takes other ways, are left to it.

#![allow(
    clippy::needless_bitwise_bool,
    clippy::manual_range_contains,
    clippy::needless_range_loop,
    reason = "conditions without branches become part of vectors"
)]

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

const ODD: [f64; 6] = [
    0.333_333_333_333_329_3,
    0.142_857_142_725_034_66,
    0.090_908_871_334_365_07,
    0.066_610_731_373_875_31,
    0.049_768_779_946_159_324,
    0.016_285_820_115_365_782,
];
const EVEN: [f64; 5] = [
    -0.199_999_999_998_764_83,
    -0.111_111_104_054_623_56,
    -0.076_918_762_050_448_3,
    -0.058_335_701_337_905_735,
    -0.036_531_572_744_216_916,
];

/// The angles whose tangents are 1/2, 1, 3/2, and a quarter turn, each in two parts.
const KNOWN: [[f64; 2]; 4] = [
    [0.463_647_609_000_806_1, 2.269_877_745_296_168_7e-17],
    [FRAC_PI_4, 3.061_616_997_868_383e-17],
    [0.982_793_723_247_329, 1.390_331_103_123_099_8e-17],
    [FRAC_PI_2, 6.123_233_995_736_766e-17],
];
/// What is left of half a turn.
const PI_REST: f64 = 1.224_646_799_147_353_2e-16;

/// The least number whose upper half has these bits.
const fn above(upper: u64) -> f64 {
    f64::from_bits(upper << 32)
}

/// Tangents from which on these angles are taken off.
const BOUNDS: [f64; 4] =
    [above(0x3fdc_0000), above(0x3fe6_0000), above(0x3ff3_0000), above(0x4003_8000)];
/// Tangents that are so small, or as large, are left to `libm`.
const LEAST: f64 = above(0x3e40_0000);
const MOST: f64 = 1e15;

/// The directions of the vectors (x, y), radians, in (-pi, pi].
#[allow(clippy::inline_always, reason = "it becomes part of who calls it, with its vectors")]
#[inline(always)]
pub(crate) fn directions<const N: usize>(x: &[f64; N], y: &[f64; N]) -> [f64; N] {
    let (mut all, mut is_left) = ([0.0; N], [0.0; N]);
    for l in 0..N {
        [all[l], is_left[l]] = one(x[l], y[l]);
    }
    if is_left != [0.0; N] {
        for l in (0..N).filter(|&l| is_left[l] != 0.0) {
            all[l] = libm::atan2(y[l], x[l]);
        }
    }
    all
}

/// The direction of a vector, and 1 if it is left to `libm`, else 0.
#[allow(clippy::inline_always, reason = "it becomes part of who calls it, with its vectors")]
#[inline(always)]
fn one(x: f64, y: f64) -> [f64; 2] {
    let t = (y / x).abs();
    // False for what is not a number.
    let is_plain = (t >= LEAST) & (t < MOST);
    let [half, one, more, most] = [t >= BOUNDS[0], t >= BOUNDS[1], t >= BOUNDS[2], t >= BOUNDS[3]];
    let (mut above_line, mut below_line, mut hi, mut lo) = (t, 1.0, 0.0, 0.0);
    (above_line, below_line) =
        if half { (2.0 * t - 1.0, 2.0 + t) } else { (above_line, below_line) };
    (hi, lo) = if half { (KNOWN[0][0], KNOWN[0][1]) } else { (hi, lo) };
    (above_line, below_line) = if one { (t - 1.0, t + 1.0) } else { (above_line, below_line) };
    (hi, lo) = if one { (KNOWN[1][0], KNOWN[1][1]) } else { (hi, lo) };
    (above_line, below_line) =
        if more { (t - 1.5, 1.0 + 1.5 * t) } else { (above_line, below_line) };
    (hi, lo) = if more { (KNOWN[2][0], KNOWN[2][1]) } else { (hi, lo) };
    (above_line, below_line) = if most { (-1.0, t) } else { (above_line, below_line) };
    (hi, lo) = if most { (KNOWN[3][0], KNOWN[3][1]) } else { (hi, lo) };
    let left = above_line / below_line;
    let z = left * left;
    let w = z * z;
    let [a1, a3, a5, a7, a9, a11] = ODD;
    let [a2, a4, a6, a8, a10] = EVEN;
    let odd = z * (a1 + w * (a3 + w * (a5 + w * (a7 + w * (a9 + w * a11)))));
    let even = w * (a2 + w * (a4 + w * (a6 + w * (a8 + w * a10))));
    let angle = hi - (left * (odd + even) - lo - left);
    let turned = if x < 0.0 { PI - (angle - PI_REST) } else { angle };
    [turned.copysign(y), if is_plain { 0.0 } else { 1.0 }]
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::array;
    use std::f64::consts::TAU;

    #[track_caller]
    fn check(x: [f64; 8], y: [f64; 8]) {
        let bits = directions(&x, &y).map(f64::to_bits);
        let theirs: [u64; 8] = array::from_fn(|l| libm::atan2(y[l], x[l]).to_bits());
        assert_eq!(bits, theirs, "{x:?} {y:?}");
    }

    #[test]
    fn each_has_the_bits_that_it_has_alone() {
        // Sequences that fill the turn, and lengths, evenly.
        for k in 0..100_000 {
            let part = |l: usize, step: f64| (f64::from(8 * k + l as u32) * step).fract();
            let polar = |l: usize| {
                let (s, c) = libm::sincos(TAU * part(l, 0.618_033_988_749_895));
                let length = libm::exp2(40.0 * (part(l, 0.414_213_562_373_095) - 0.5));
                [length * c, length * s]
            };
            check(array::from_fn(|l| polar(l)[0]), array::from_fn(|l| polar(l)[1]));
        }
    }

    #[test]
    fn so_have_those_next_to_where_its_ways_part() {
        let edges = BOUNDS.into_iter().chain([LEAST, MOST, 1.0, 0.0, 1e-300, 1e300]);
        for edge in edges.chain([f64::INFINITY, f64::NAN]) {
            for (sign_x, sign_y) in [(1.0, 1.0), (-1.0, 1.0), (1.0, -1.0), (-1.0, -1.0)] {
                for length in [1.0, 3.0, 1e-5, 1e20, 0.0, f64::INFINITY] {
                    let near = |l: u64| edge.to_bits().wrapping_add(l).wrapping_sub(4);
                    let y = array::from_fn(|l| sign_y * length * f64::from_bits(near(l as u64)));
                    check([sign_x * length; 8], y);
                }
            }
        }
    }
}
