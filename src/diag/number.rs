//! How numbers are written: exactly, to so many digits, or to so many decimals.

/// Writes `value` in the fewest digits that read back to the same bits.
///
/// Plain notation for magnitudes from 1e-5 up to 1e16, an exponent outside of it; no
/// trailing `.0`, and minus zero keeps its sign.
///
/// ```
/// use linkwork::diag::format_number;
///
/// assert_eq!(format_number(3.0), "3");
/// assert_eq!(format_number(0.1 + 0.2), "0.30000000000000004");
/// assert_eq!(format_number(1e-7), "1e-7");
/// assert_eq!(format_number(-0.0), "-0");
/// ```
pub fn format_number(value: f64) -> String {
    let size = value.abs();
    if size == 0.0 || !size.is_finite() || (1e-5..1e16).contains(&size) {
        format!("{value}")
    } else {
        format!("{value:e}")
    }
}

/// Writes `value` as [`format_number`] does, or as one over a whole number where that reads back to
/// the same bits and is shorter: a sixtieth is `1/60`.
///
/// ```
/// use linkwork::diag::format_fraction;
///
/// assert_eq!(format_fraction(1.0 / 60.0), "1/60");
/// assert_eq!(format_fraction(0.5), "0.5");
/// ```
pub fn format_fraction(value: f64) -> String {
    let decimal = format_number(value);
    let whole = (1.0 / value).round();
    if !(1.0..1e9).contains(&whole) || 1.0 / whole != value {
        return decimal;
    }
    let fraction = format!("1/{}", format_number(whole));
    if fraction.len() < decimal.len() { fraction } else { decimal }
}

/// A number rounded to so many digits, of which there is at least one.
///
/// ```
/// use linkwork::diag::format_digits;
///
/// assert_eq!(format_digits(0.123456, 5), "0.12346");
/// ```
pub fn format_digits(value: f64, n_digits: usize) -> String {
    let text = format!("{value:.*e}", n_digits - 1);
    format_number(text.parse().unwrap_or(value))
}

/// A number for talk: three digits say enough.
pub fn format_rounded(value: f64) -> String {
    if !value.is_finite() {
        return "unknown".to_owned();
    }
    format_digits(value, 3)
}

/// Writes `value` with an exponent and so many significant digits, trailing zeros included, so
/// that a column of them lines up; zero is `0`.
///
/// ```
/// use linkwork::diag::format_exponent;
///
/// assert_eq!(format_exponent(0.0012, 3), "1.20e-3");
/// ```
pub fn format_exponent(value: f64, n_digits: usize) -> String {
    if value == 0.0 { "0".to_owned() } else { format!("{value:.*e}", n_digits - 1) }
}

/// Appends `value` with at most `n_decimals` digits after the point, without trailing zeros
/// and never as `-0`: how pictures write px and degrees.
pub fn push_decimals(text: &mut String, value: f64, n_decimals: usize) {
    use std::fmt::Write;
    let start = text.len();
    // Writing to a string cannot fail.
    let _ = write!(text, "{value:.n_decimals$}");
    if n_decimals > 0 {
        let kept = text.trim_end_matches('0').trim_end_matches('.').len();
        text.truncate(kept);
    }
    if &text[start..] == "-0" {
        text.replace_range(start.., "0");
    }
}

/// `value` with at most `n_decimals` digits after the point; see [`push_decimals`].
pub fn format_decimals(value: f64, n_decimals: usize) -> String {
    let mut text = String::new();
    push_decimals(&mut text, value, n_decimals);
    text
}

/// A count for a message: nobody counts the zeros of a large round one.
pub fn format_count(value: f64) -> String {
    if value.abs() >= 1e6 { format!("{value:e}") } else { format_number(value) }
}

/// So many things: `1 frame`, `2 frames`.
///
/// ```
/// use linkwork::diag::format_counted;
///
/// assert_eq!(format_counted(1, "frame"), "1 frame");
/// assert_eq!(format_counted(0, "frame"), "0 frames");
/// ```
pub fn format_counted(n: u64, noun: &str) -> String {
    let plural = if n == 1 { "" } else { "s" };
    format!("{n} {noun}{plural}")
}

/// An angle, given in radians, in degrees with its unit, to 1e-9.
pub fn format_degrees(radians: f64) -> String {
    let rounded = (radians.to_degrees() * 1e9).round() / 1e9;
    // Adding 0 makes a 0 of -0.
    format!("{} deg", format_number(rounded + 0.0))
}

/// A time with its unit, three digits: `1.25 us`.
pub fn format_seconds(seconds: f64) -> String {
    let units = [(1.0, "s"), (1e-3, "ms"), (1e-6, "us"), (1e-9, "ns")];
    let (scale, unit) =
        units.into_iter().find(|(scale, _)| seconds >= *scale).unwrap_or((1e-9, "ns"));
    let value = seconds / scale;
    let n_places = if value >= 100.0 { 0 } else { usize::from(value < 10.0) + 1 };
    format!("{value:.n_places$} {unit}")
}

/// Adds a whole number to a text, in a fraction of the time that the general formatting takes:
/// a loop spells millions of names.
pub fn push_integer(text: &mut String, value: i64) {
    if value < 0 {
        text.push('-');
    }
    push_digits(text, value.unsigned_abs());
}

fn push_digits(text: &mut String, value: u64) {
    /// The numbers below 100, two digits each.
    const PAIRS: &str = "00010203040506070809101112131415161718192021222324252627282930313233\
                         34353637383940414243444546474849505152535455565758596061626364656667\
                         6869707172737475767778798081828384858687888990919293949596979899";
    let pair = 2 * (value % 100) as usize;
    if value >= 100 {
        push_digits(text, value / 100);
        text.push_str(&PAIRS[pair..pair + 2]);
    } else {
        text.push_str(&PAIRS[pair + usize::from(value < 10)..pair + 2]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_numbers_are_written_as_ever() {
        for value in [0, 7, -7, 10, 1_234_567_890, i64::MAX, i64::MIN] {
            let mut text = String::from("p");
            push_integer(&mut text, value);
            assert_eq!(text, format!("p{value}"));
        }
    }

    #[test]
    fn decimals_are_short_and_without_minus_zero() {
        let check = |value: f64, n_decimals: usize, wanted: &str| {
            assert_eq!(format_decimals(value, n_decimals), wanted);
        };
        check(0.1 + 0.2, 2, "0.3");
        check(-0.001, 2, "0");
        check(-0.0, 2, "0");
        check(100.0, 2, "100");
        check(100.0, 0, "100");
        check(-12.345, 1, "-12.3");
        check(0.005, 2, "0.01");
        check(1e6, 2, "1000000");
    }

    #[test]
    fn zeros_of_the_text_before_stay() {
        let mut text = String::from("10 ");
        push_decimals(&mut text, 0.0, 2);
        assert_eq!(text, "10 0");
    }

    #[test]
    fn times_have_three_digits_and_a_unit() {
        let check = |seconds: f64, wanted: &str| assert_eq!(format_seconds(seconds), wanted);
        check(1.25, "1.25 s");
        check(0.0123, "12.3 ms");
        check(4.2e-6, "4.20 us");
        check(3.21e-7, "321 ns");
        check(0.0, "0.00 ns");
    }

    #[test]
    fn angles_are_degrees_without_a_sign_of_zero() {
        let check = |radians: f64, wanted: &str| assert_eq!(format_degrees(radians), wanted);
        check(std::f64::consts::FRAC_PI_2, "90 deg");
        check(-0.0, "0 deg");
        check(-1e-12, "0 deg");
    }

    #[test]
    fn large_counts_have_an_exponent() {
        assert_eq!([format_count(1e9), format_count(720.0)], ["1e9", "720"]);
    }

    #[test]
    fn reads_back_to_the_same_bits() {
        let check = |value: f64, wanted: &str| {
            let text = format_number(value);
            assert_eq!(text, wanted);
            assert_eq!(text.parse::<f64>().expect("a number").to_bits(), value.to_bits());
        };
        check(0.0, "0");
        check(-0.0, "-0");
        check(1.0, "1");
        check(-2.5, "-2.5");
        check(1e-5, "0.00001");
        check(9.999e-6, "9.999e-6");
        check(9_999_999_999_999_998.0, "9999999999999998");
        check(1e16, "1e16");
        check(f64::MAX, "1.7976931348623157e308");
        check(5e-324, "5e-324");
        check(1.0 / 3.0, "0.3333333333333333");
    }
}
