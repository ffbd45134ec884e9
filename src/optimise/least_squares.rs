//! The least sum of squares: damped Gauss-Newton steps (K. Levenberg, 1944; D. Marquardt, 1963) that
//! end at the walls of the box.

use super::starts::starts;
use super::{Best, is_better};
use crate::linalg::{MOST_UNKNOWNS, Square};

/// Steps of one search.
const MOST_STEPS: u32 = 60;
/// Half the way between the places of a difference: a third of the digits of a double are lost to
/// rounding, and as many to the bend of the function.
const DIFFERENCE: f64 = 1e-5;
/// A step that is shorter ends a search.
const SHORTEST: f64 = 1e-14;
/// How much less a step must promise of the sum of squares to be worth taking.
const DAMPINGS: u32 = 12;

/// Where the squares of some numbers have the least sum, from `first` and from other places; none
/// where there are none at any of them.
pub fn least_squares(
    first: &[f64],
    residuals: &mut dyn FnMut(&[f64]) -> Option<Vec<f64>>,
) -> Option<Best> {
    let mut best: Option<Best> = None;
    let from = starts(first, |at| residuals(at).map(|r| sum_of_squares(&r)));
    for start in from {
        if let Some(found) = search(start, residuals)
            && is_better(found.value, best.as_ref())
        {
            best = Some(found);
        }
    }
    best
}

fn sum_of_squares(r: &[f64]) -> f64 {
    r.iter().map(|r| r * r).sum()
}

fn search(mut at: Vec<f64>, residuals: &mut dyn FnMut(&[f64]) -> Option<Vec<f64>>) -> Option<Best> {
    let mut r = residuals(&at)?;
    let mut value = sum_of_squares(&r);
    let mut damping = 1e-3;
    for _ in 0..MOST_STEPS {
        let Some(columns) = jacobian(&at, residuals) else { break };
        let mut step = None;
        for _ in 0..DAMPINGS {
            let next = moved(&at, &columns, &r, damping);
            let found = residuals(&next).map(|r| (sum_of_squares(&r), r));
            if let Some((less, r)) = found.filter(|(found, _)| *found < value) {
                damping = f64::max(0.1 * damping, 1e-12);
                step = Some((next, less, r));
                break;
            }
            damping *= 10.0;
        }
        let Some((next, less, now)) = step else { break };
        let way = at.iter().zip(&next).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        (at, value, r) = (next, less, now);
        if way < SHORTEST || value == 0.0 {
            break;
        }
    }
    Some(Best { at, value })
}

/// The derivatives of all residuals by each number, as differences within the box.
fn jacobian(
    at: &[f64],
    residuals: &mut dyn FnMut(&[f64]) -> Option<Vec<f64>>,
) -> Option<Vec<Vec<f64>>> {
    let mut columns = Vec::with_capacity(at.len());
    for j in 0..at.len() {
        let mut side = |by: f64| {
            let mut there = at.to_vec();
            there[j] = (at[j] + by).clamp(0.0, 1.0);
            Some((there[j], residuals(&there)?))
        };
        let ((lo, below), (hi, above)) = (side(-DIFFERENCE)?, side(DIFFERENCE)?);
        columns.push(above.iter().zip(&below).map(|(a, b)| (a - b) / (hi - lo)).collect());
    }
    Some(columns)
}

/// Where a damped step leads; what it would lead out of the box stays at the wall.
fn moved(at: &[f64], columns: &[Vec<f64>], r: &[f64], damping: f64) -> Vec<f64> {
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let slope: Vec<f64> = columns.iter().map(|column| dot(column, r)).collect();
    let may_move = |j: &usize| {
        let (x, slope) = (at[*j], slope[*j]);
        !(x <= 0.0 && slope > 0.0 || x >= 1.0 && slope < 0.0)
    };
    let free: Vec<usize> = (0..at.len()).filter(may_move).take(MOST_UNKNOWNS).collect();
    let mut square: Square = Square::new(free.len());
    for (row, &j) in free.iter().enumerate() {
        for (column, &k) in free.iter().enumerate() {
            square.row(row)[column] = dot(&columns[j], &columns[k]);
        }
        let own = square.row(row)[row];
        square.row(row)[row] = own * (1.0 + damping) + f64::MIN_POSITIVE;
        square.set_right_side(row, -slope[j]);
    }
    let mut next = at.to_vec();
    if square.eliminate() != 0.0 {
        let step = square.solution();
        for (step, &j) in step.iter().zip(&free) {
            next[j] = (at[j] + step).clamp(0.0, 1.0);
        }
    }
    next
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn planted_numbers_are_found_again() {
        let planted = [0.37, 0.81, 0.12];
        let wave = |x: &[f64], t: f64| x[0] * libm::sin(3.0 * x[1] * t) + x[2] * t * t;
        let times = || (0..40).map(|k| f64::from(k) / 10.0);
        let mut r =
            |x: &[f64]| Some(times().map(|t| wave(x, t) - wave(&planted, t)).collect::<Vec<f64>>());
        let best = least_squares(&[0.5, 0.5, 0.5], &mut r).expect("it has values");
        let off = best.at.iter().zip(planted).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(off < 1e-11, "{best:?}");
    }

    #[test]
    fn a_wall_ends_the_way() {
        let mut r = |x: &[f64]| Some(vec![x[0] - 1.4, x[1] - 0.3, 0.1 * (x[0] + x[1])]);
        let best = least_squares(&[0.2, 0.9], &mut r).expect("it has values");
        // With the first at 1 the second is where its own derivative is 0.
        assert!((best.at[0] - 1.0).abs() < 1e-15, "{best:?}");
        assert!((best.at[1] - (0.3 - 0.01) / 1.01).abs() < 1e-10, "{best:?}");
        assert_eq!(least_squares(&[0.5], &mut |_| None), None);
    }
}
