//! The least value of a function that may have corners, as a greatest or least of many values does.
//!
//! The simplex of J. A. Nelder and R. Mead (A simplex method for function minimization, 1965) asks for
//! values alone. It follows the bend of a valley with a sharp floor, where models of the function by
//! planes or by its gradient stop short; its steps are those of F. Gao and L. Han (2012), which do as
//! well for more numbers. Corners of the simplex beyond a wall of the box stand on the wall.

use super::starts::starts;
use super::{Best, is_better};

/// Values that one search asks for at most, for each number.
const MOST_VALUES: usize = 200;
/// The edges of the simplex with which searches begin, and of those that begin anew where one ended:
/// a simplex may have become flat.
const EDGE: f64 = 0.1;
const EDGES_ANEW: [f64; 3] = [0.05, 0.02, 0.1];
/// A simplex no larger than that ends a search.
const SMALLEST: f64 = 1e-11;

/// The least value of a function in a box, from `first` and from other places; none where it has no
/// value at any of them.
pub fn minimum(first: &[f64], value: &mut dyn FnMut(&[f64]) -> Option<f64>) -> Option<Best> {
    let mut best: Option<Best> = None;
    for start in starts(first, &mut *value) {
        keep(search(&start, EDGE, value), &mut best);
    }
    for edge in EDGES_ANEW {
        let from = best.as_ref()?.at.clone();
        keep(search(&from, edge, value), &mut best);
    }
    best
}

fn keep(found: Best, best: &mut Option<Best>) {
    if found.value < f64::INFINITY && is_better(found.value, best.as_ref()) {
        *best = Some(found);
    }
}

fn search(start: &[f64], edge: f64, value: &mut dyn FnMut(&[f64]) -> Option<f64>) -> Best {
    let n = start.len();
    let mut n_values = 0;
    // What has no value is no better than anything.
    let mut ask = |at: Vec<f64>| {
        n_values += 1;
        (Best { value: value(&at).unwrap_or(f64::INFINITY), at }, n_values)
    };
    let beside = (0..n).map(|j| {
        let mut at = start.to_vec();
        at[j] += if at[j] + edge <= 1.0 { edge } else { -edge };
        at
    });
    let corners = std::iter::once(start.to_vec()).chain(beside);
    let mut simplex: Vec<Best> = corners.map(|at| ask(at).0).collect();
    let dims = n.max(2) as f64;
    let (longer, shorter, smaller) = (1.0 + 2.0 / dims, 0.75 - 0.5 / dims, 1.0 - 1.0 / dims);
    loop {
        simplex.sort_by(|a, b| a.value.total_cmp(&b.value));
        let (worst, second) = (simplex[n].clone(), simplex[n - 1].value);
        let middle: Vec<f64> = (0..n)
            .map(|j| simplex[..n].iter().map(|it| it.at[j]).sum::<f64>() / n as f64)
            .collect();
        // So many times as far beyond the middle as the worst is before it.
        let beyond = |times: f64| -> Vec<f64> {
            let corner = middle.iter().zip(&worst.at);
            corner.map(|(m, w)| times.mul_add(m - w, *m).clamp(0.0, 1.0)).collect()
        };
        let (reflected, asked) = ask(beyond(1.0));
        if asked > MOST_VALUES * n || size(&simplex) < SMALLEST {
            break;
        }
        simplex[n] = if reflected.value < simplex[0].value {
            let (farther, _) = ask(beyond(longer));
            if farther.value < reflected.value { farther } else { reflected }
        } else if reflected.value < second {
            reflected
        } else {
            let is_outside = reflected.value < worst.value;
            let (nearer, _) = ask(beyond(if is_outside { shorter } else { -shorter }));
            if nearer.value < reflected.value.min(worst.value) {
                nearer
            } else {
                let centre = simplex[0].at.clone();
                for corner in &mut simplex[1..] {
                    let ends = centre.iter().zip(&corner.at);
                    *corner = ask(ends.map(|(c, x)| smaller.mul_add(x - c, *c)).collect()).0;
                }
                continue;
            }
        };
    }
    simplex.swap_remove(0)
}

/// How far the farthest corner is from the first.
fn size(simplex: &[Best]) -> f64 {
    let first = &simplex[0].at;
    let apart = |at: &[f64]| at.iter().zip(first).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    simplex[1..].iter().map(|corner| apart(&corner.at)).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_corner_is_found_inside_and_at_the_edge_of_the_box() {
        let check = |corner: [f64; 2], wanted: f64| {
            let mut f =
                |x: &[f64]| Some((x[0] - corner[0]).abs().max(2.0 * (x[1] - corner[1]).abs()));
            let best = minimum(&[0.1, 0.1], &mut f).expect("it has values");
            assert!((best.value - wanted).abs() < 1e-6, "{best:?}");
        };
        check([0.3, 0.8], 0.0);
        check([1.5, 0.4], 0.5);
    }

    #[test]
    fn a_bent_valley_with_a_sharp_floor_is_followed_to_its_end() {
        for n in 1..=3 {
            let mut f = |x: &[f64]| {
                let bends = x.windows(2).map(|pair| (pair[1] - pair[0] * pair[0]).abs());
                Some(10.0 * bends.sum::<f64>() + (x[0] - 0.7).abs())
            };
            let first = vec![0.2; n];
            let best = minimum(&first, &mut f).expect("it has values");
            assert!(best.value < 1e-2, "{best:?}");
        }
    }

    #[test]
    fn what_has_no_value_is_left_out() {
        let mut f = |x: &[f64]| (x[0] > 0.4).then(|| (x[0] - 0.1) * (x[0] - 0.1) + x[1]);
        let best = minimum(&[0.9, 0.9], &mut f).expect("it has values");
        assert!(best.at[0] < 0.42 && best.at[1] < 1e-6, "{best:?}");
        assert_eq!(minimum(&[0.5], &mut |_| None), None);
    }
}
