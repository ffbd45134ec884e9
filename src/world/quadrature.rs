//! The mean of a function over an interval, as exact as rounding lets it be where it is smooth.
//!
//! Gauss and Kronrod: fifteen values give the mean, and the seven of them that are Gauss's say how
//! far off it may be. Where that is too far the interval is halved, the worst part first.

/// Places of the rule on [-1, 1], outermost first; those with an odd index, and the middle, are
/// Gauss's seven. From A. S. Kronrod, Nodes and Weights of Quadrature Formulas, 1965.
const PLACES: [f64; 7] = [
    0.991_455_371_120_812_6,
    0.949_107_912_342_758_5,
    0.864_864_423_359_769_1,
    0.741_531_185_599_394_4,
    0.586_087_235_467_691_1,
    0.405_845_151_377_397_2,
    0.207_784_955_007_898_47,
];
/// Kronrod's weights of these places; the middle has what is left of 2.
const WEIGHTS: [f64; 7] = [
    0.022_935_322_010_529_224,
    0.063_092_092_629_978_55,
    0.104_790_010_322_250_18,
    0.140_653_259_715_525_92,
    0.169_004_726_639_267_9,
    0.190_350_578_064_785_4,
    0.204_432_940_075_298_9,
];
/// Gauss's weights of the places with an odd index; the middle has what is left of 2.
const GAUSS: [f64; 3] =
    [0.129_484_966_168_869_7, 0.279_705_391_489_276_64, 0.381_830_050_505_118_9];

/// The error of a mean that is good enough, in parts of the mean size: some rounding errors.
const ENOUGH: f64 = 1e-14;
/// Parts that an interval is divided into at most. A jump takes some fifty; more are only of use
/// to what swings hundreds of times in one frame.
const MOST_PARTS: usize = 256;
/// A part that is narrower than this is not halved: 2^-50 of the whole.
const NARROWEST: f64 = 1.0 / (1_u64 << 50) as f64;
/// What is below this part of the mean size, and in both halves as in the whole, is rounding in
/// the function itself; halving does not better it.
const ROUNDING: f64 = 1e-8;
/// Halvings that met nothing but rounding before it is taken for what it is.
const MOST_FUTILE: u32 = 4;

/// A part of the interval from 0 to 1.
#[derive(Clone, Copy)]
struct Part {
    from: f64,
    width: f64,
    /// The mean over the part.
    mean: f64,
    /// How far off the mean may be.
    error: f64,
    /// The mean of the size.
    size: f64,
    /// The ways up and down between the values.
    variation: f64,
}

impl Part {
    fn new<E>(from: f64, width: f64, f: &mut impl FnMut(f64) -> Result<f64, E>) -> Result<Self, E> {
        let half = 0.5 * width;
        let middle = f(from + half)?;
        // Differences from the middle: what is constant comes out as it is, to the bit.
        let (mut kronrod, mut gauss, mut size) = (0.0, 0.0, 0.0);
        let mut variation = 0.0;
        let (mut left_before, mut right_before) = (middle, middle);
        for k in (0..PLACES.len()).rev() {
            let (left, right) =
                (f(from + half * (1.0 - PLACES[k]))?, f(from + half * (1.0 + PLACES[k]))?);
            let pair = (left - middle) + (right - middle);
            kronrod += WEIGHTS[k] * pair;
            if k % 2 == 1 {
                gauss += GAUSS[k / 2] * pair;
            }
            size += WEIGHTS[k] * (left.abs() + right.abs());
            variation += (left - left_before).abs() + (right - right_before).abs();
            (left_before, right_before) = (left, right);
        }
        Ok(Self {
            from,
            width,
            mean: 0.5f64.mul_add(kronrod, middle),
            error: 0.5 * (kronrod - gauss).abs(),
            size: 0.5 * size,
            variation,
        })
    }

    /// What it adds to the error of the whole.
    fn share(&self) -> f64 {
        self.error * self.width
    }
}

/// The mean of `f` over [0, 1]. `grain` is the rounding of its argument: what `f` varies within
/// that is no error.
///
/// # Errors
/// The first that `f` gives.
pub(super) fn mean<E>(grain: f64, mut f: impl FnMut(f64) -> Result<f64, E>) -> Result<f64, E> {
    let whole = Part::new(0.0, 1.0, &mut f)?;
    let enough = |size: f64, variation: f64| (ENOUGH * size).max(2.0 * grain * variation);
    if whole.error <= enough(whole.size, whole.variation) {
        return Ok(whole.mean);
    }
    let mut parts = vec![whole];
    let mut n_futile = 0;
    while parts.len() < MOST_PARTS && n_futile < MOST_FUTILE {
        let sum = |of: fn(&Part) -> f64| parts.iter().map(of).sum::<f64>();
        let size = sum(|part| part.size * part.width);
        if sum(Part::share) <= enough(size, sum(|part| part.variation)) {
            break;
        }
        let wide = parts.iter().enumerate().filter(|(_, part)| part.width > NARROWEST);
        let Some((worst, part)) = wide.max_by(|(_, a), (_, b)| a.share().total_cmp(&b.share()))
        else {
            break;
        };
        let (part, half) = (*part, 0.5 * part.width);
        let halves =
            [Part::new(part.from, half, &mut f)?, Part::new(part.from + half, half, &mut f)?];
        let [a, b] = halves.map(|half| half.share());
        let is_rounding = part.error <= ROUNDING * size
            && a + b > 0.5 * part.share()
            && a.min(b) > 0.1 * a.max(b);
        n_futile += u32::from(is_rounding);
        parts[worst] = halves[0];
        parts.push(halves[1]);
    }
    Ok(parts.iter().map(|part| part.mean * part.width).sum())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::convert::Infallible;

    /// The mean and how many values it took.
    fn counted(f: impl Fn(f64) -> f64) -> (f64, u32) {
        let mut n = 0;
        let mean = mean(1e-14, |t| {
            n += 1;
            Ok::<_, Infallible>(f(t))
        });
        let Ok(mean) = mean;
        (mean, n)
    }

    #[test]
    fn the_rule_is_exact_for_powers_up_to_22() {
        for power in 0..=22 {
            let Ok(part) = Part::new(0.0, 1.0, &mut |t: f64| {
                Ok::<_, Infallible>(libm::pow(t, f64::from(power)))
            });
            let exact = 1.0 / f64::from(power + 1);
            assert!((part.mean - exact).abs() < 2e-16, "t^{power}: {}", part.mean);
            if power <= 13 {
                assert!(part.error < 2e-16, "t^{power}: {}", part.error);
            }
        }
    }

    #[test]
    fn a_constant_comes_out_to_the_bit() {
        for value in [0.1, -7.3e9, 1.0 / 3.0, 0.0] {
            assert_eq!(counted(|_| value), (value, 15));
        }
    }

    #[test]
    fn what_is_smooth_takes_one_rule() {
        let (value, n) = counted(libm::exp);
        assert!((value - libm::expm1(1.0)).abs() < 4e-16, "{value}");
        assert_eq!(n, 15);
    }

    #[test]
    fn kinks_jumps_and_swings_are_found() {
        type Case<'a> = (&'a str, &'a dyn Fn(f64) -> f64, f64, f64);
        let kink = |t: f64| (t - 0.3).abs();
        let jump = |t: f64| if t < 0.3 { -2.0 } else { 5.0 };
        let swing = |t: f64| libm::cos(900.0 * t);
        let peak = |t: f64| 1.0 / (1.0 + 1e6 * (t - 0.3) * (t - 0.3));
        let exact_peak = (libm::atan(700.0) + libm::atan(300.0)) / 1e3;
        let cases: [Case; 4] = [
            ("kink", &kink, 0.29, 1e-14),
            ("jump", &jump, 2.9, 3e-13),
            ("swing", &swing, libm::sin(900.0) / 900.0, 1e-13),
            ("peak", &peak, exact_peak, 1e-14),
        ];
        for (name, f, exact, tolerance) in cases {
            let (value, n) = counted(f);
            assert!((value - exact).abs() < tolerance, "{name}: {value} is not {exact}");
            assert!(n <= 30 * MOST_PARTS as u32, "{name}: {n} values");
        }
    }

    #[test]
    fn rounding_in_the_function_is_not_chased() {
        // Ten digits are lost.
        let (value, n) = counted(|t| (1e6 + libm::sin(t)) - 1e6);
        assert!((value - (1.0 - libm::cos(1.0))).abs() < 1e-10, "{value}");
        assert!(n < 40 * 15, "{n} values");
        // Nothing is left of what swings faster than anyone could follow, but an end.
        let (_, n) = counted(|t| libm::sin(1e12 * t));
        assert!(n <= 30 * MOST_PARTS as u32, "{n} values");
    }
}
