//! How numbers of a picture are written: rounded, short, and the same everywhere.

/// Appends `value` with at most `n_decimals` digits after the point, without trailing zeros
/// and never as `-0`.
///
/// # Panics
///
/// In debug builds, if `value` is not finite: a drawing has no such place.
pub fn push_rounded(text: &mut String, value: f64, n_decimals: usize) {
    use std::fmt::Write;
    debug_assert!(value.is_finite(), "a picture is made of finite numbers");
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

/// `value` with at most `n_decimals` digits after the point; see [`push_rounded`].
pub fn rounded(value: f64, n_decimals: usize) -> String {
    let mut text = String::new();
    push_rounded(&mut text, value, n_decimals);
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn short_and_without_minus_zero() {
        let check = |value: f64, n_decimals: usize, wanted: &str| {
            assert_eq!(rounded(value, n_decimals), wanted);
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
        push_rounded(&mut text, 0.0, 2);
        assert_eq!(text, "10 0");
    }
}
