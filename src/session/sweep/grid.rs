//! The grid of a sweep: parameters with the values each of them takes.

use crate::diag::{Diagnostic, format_count};
use crate::errors;
use crate::session::ask::evaluate_binding;

/// A parameter with the values that it takes.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// Its name.
    pub name: String,
    /// Its values, at least one.
    pub values: Vec<f64>,
}

/// The most values of one parameter: more than a machine sweeps in a year.
const MOST_VALUES: f64 = 1e8;
/// How far behind the end of a range its last value may lie, in steps: what rounding makes of it.
const SLACK: f64 = 1e-9;

/// `name=1..5:0.5`, `name=1,2,4`, `name=3`, or several of these with commas; the numbers as the
/// language writes them. A range without a step goes by ones, and holds its end where a step meets it.
///
/// # Errors
/// What is wrong with it.
///
/// ```
/// use linkwork::session::parse_axis;
///
/// assert_eq!(parse_axis("a=1..2:0.5").unwrap().values, [1.0, 1.5, 2.0]);
/// assert_eq!(parse_axis("b=1, 2, 4").unwrap().values, [1.0, 2.0, 4.0]);
/// assert!(parse_axis("a=2..1").is_err());
/// ```
pub fn parse_axis(text: &str) -> Result<Axis, Diagnostic> {
    let (name, values) = text.split_once('=').unwrap_or((text, ""));
    let number = |text: &str| evaluate_binding(&format!("{}={}", name.trim(), text.trim()));
    let mut axis = Axis { name: number("0")?.0, values: Vec::new() };
    for item in items(values) {
        let Some((from, rest)) = item.split_once("..") else {
            axis.values.push(number(item)?.1);
            continue;
        };
        let (to, step) = rest.split_once(':').unwrap_or((rest, "1"));
        let [from, to, step] = [number(from)?.1, number(to)?.1, number(step)?.1];
        let n_steps = (to - from) / step;
        if step == 0.0 || n_steps < 0.0 || !n_steps.is_finite() {
            return Err(Diagnostic::error(
                errors::OUT_OF_RANGE,
                format!("`{}` has no values: write LEAST..MOST:STEP", item.trim()),
            ));
        }
        if n_steps >= MOST_VALUES {
            let message = format!(
                "{} values are too many for one parameter: use a larger STEP in LEAST..MOST:STEP",
                format_count(n_steps)
            );
            return Err(Diagnostic::error(errors::OUT_OF_RANGE, message));
        }
        let n = (n_steps + SLACK).floor() as u64;
        axis.values.extend((0..=n).map(|k| from + step * k as f64));
    }
    Ok(axis)
}

/// What stands between commas that are not within parentheses.
fn items(text: &str) -> impl Iterator<Item = &str> {
    let mut depth = 0;
    text.split(move |c: char| {
        depth += i32::from(c == '(') - i32::from(c == ')');
        c == ',' && depth == 0
    })
}

/// All combinations of the values of some parameters; those of the last follow each other.
#[derive(Debug, Clone, PartialEq)]
pub struct Grid {
    /// The parameters.
    pub axes: Vec<Axis>,
}

impl Grid {
    /// How many variants it has, as far as a number tells.
    pub fn n_variants(&self) -> f64 {
        self.axes.iter().map(|axis| axis.values.len() as f64).product()
    }

    /// The values of a variant, in the order of the parameters.
    pub fn values(&self, variant: u64) -> Vec<f64> {
        let mut left = variant;
        let mut values: Vec<f64> = self
            .axes
            .iter()
            .rev()
            .map(|axis| {
                let n = axis.values.len() as u64;
                let value = axis.values[(left % n) as usize];
                left /= n;
                value
            })
            .collect();
        values.reverse();
        values
    }
}

/// One of several machines that share a sweep: each takes every so many variants.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shard {
    /// Its number, from 1.
    pub number: u64,
    /// How many there are.
    pub of: u64,
}

impl Shard {
    /// The only one.
    pub const WHOLE: Self = Self { number: 1, of: 1 };

    /// How many of `n` variants it takes.
    pub const fn n_rows(self, n: u64) -> u64 {
        (n + self.of - self.number) / self.of
    }

    /// The variant of a row.
    pub const fn variant(self, row: u64) -> u64 {
        row * self.of + self.number - 1
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_hold_their_ends_and_not_more() {
        let check = |text: &str, wanted: &[f64]| {
            assert_eq!(parse_axis(text).map(|axis| axis.values).as_deref(), Ok(wanted), "{text}");
        };
        check("a=0..1:0.1", &[0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10].map(|k| 0.1 * f64::from(k)));
        check("a=1..3", &[1.0, 2.0, 3.0]);
        check("a=1..2.9:0.5", &[1.0, 1.5, 2.0, 2.5]);
        check("a=3..1:-1", &[3.0, 2.0, 1.0]);
        check("a=-1..1:2, 1/4, max(1, 7)", &[-1.0, 1.0, 0.25, 7.0]);
        check("a=90deg", &[std::f64::consts::FRAC_PI_2]);
        for text in ["a", "a=", "=1", "a=1..2:0", "a=2..1", "a=1..2:-1", "a=1,,2", "a=0..1:1e-9"] {
            assert!(parse_axis(text).is_err(), "{text}");
        }
    }

    #[test]
    fn shards_share_all_variants() {
        let axes = [("a", 3), ("b", 4)].map(|(name, n)| Axis {
            name: name.to_owned(),
            values: (0..n).map(f64::from).collect(),
        });
        let grid = Grid { axes: axes.to_vec() };
        assert_eq!(
            (grid.values(0), grid.values(1), grid.values(4)),
            (vec![0.0, 0.0], vec![0.0, 1.0], vec![1.0, 0.0])
        );
        for of in 1..=14 {
            let mut all: Vec<u64> = (1..=of)
                .flat_map(|number| {
                    let shard = Shard { number, of };
                    (0..shard.n_rows(12)).map(move |row| shard.variant(row))
                })
                .collect();
            all.sort_unstable();
            assert_eq!(all, (0..12).collect::<Vec<_>>(), "in {of}");
        }
    }
}
