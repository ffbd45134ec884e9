//! The method `anderson`: relaxation, extrapolated from its last few sweeps. The extrapolator
//! the paper has in mind where it says that standard accelerators apply; not always stable.

use super::coefficient::Coefficient;
use super::relaxation::ending;
use super::sweep::Sweep;
use super::{Limits, Outcome};
use crate::constraint::{Point, Vector};
use crate::solve::island::Island;
use crate::solve::report::Counters;
use crate::solve::settings::Settings;

/// How many past sweeps are used. More is not better: measured non-monotone from 3 to 8.
const DEPTH: usize = 5;
/// Sweeps that nearly repeat each other say nothing new; relative to the largest of them.
const REGULAR: f64 = 1e-12;

/// Relaxes and extrapolates in one round.
pub(crate) fn round(
    island: &mut Island,
    settings: &Settings,
    limits: &Limits,
    work: &mut Counters,
) -> (Outcome, Option<f64>) {
    let coefficient = Coefficient::new(island, settings.rho, work);
    (solve(island, coefficient, limits, work), coefficient.lowered())
}

/// Improves the pose of an island; gives how it ended.
fn solve(
    island: &mut Island,
    coefficient: Coefficient,
    limits: &Limits,
    work: &mut Counters,
) -> Outcome {
    let n_free = island.n_free;
    let mut sweep = Sweep::new(island, coefficient);
    let mut d = vec![Vector::ZERO; island.x.len()];
    let mut last: Option<(Vec<Point>, Vec<Vector>)> = None;
    // Changes of the pose and of its correction from one sweep to the next.
    let mut changes: Vec<(Vec<Vector>, Vec<Vector>)> = Vec::new();
    let mut best = f64::INFINITY;
    for n in 0..limits.n_iterations {
        let Island { constraints, x, w, .. } = &mut *island;
        let worst = sweep.correct_all(constraints, x, w, &mut d, work);
        let d = &d[..n_free];
        if worst <= limits.tolerance || limits.budget.is_spent() {
            return ending(island, limits, n, f64::INFINITY, work);
        }
        let free = &mut x[..n_free];
        if worst > 2.0 * best {
            // It overshot: what it learned is of no use here.
            changes.clear();
            last = None;
        }
        best = best.min(worst);
        if let Some((x_last, d_last)) = &last {
            let dx = free.iter().zip(x_last).map(|(a, b)| *a - *b).collect();
            let dd = d.iter().zip(d_last).map(|(a, b)| *a - *b).collect();
            if changes.len() == DEPTH {
                changes.remove(0);
            }
            changes.push((dx, dd));
        }
        last = Some((free.to_vec(), d.to_vec()));
        let gamma = combine(&changes, d);
        let mut to: Vec<Vector> = d.to_vec();
        for ((dx, dd), gamma) in changes.iter().zip(&gamma) {
            for (to, (dx, dd)) in to.iter_mut().zip(dx.iter().zip(dd)) {
                *to -= (*dx + *dd) * *gamma;
            }
        }
        let longest = to.iter().fold(0.0_f64, |most, d| most.max(d.norm()));
        let step = if longest <= 0.5 * limits.size { &to[..] } else { d };
        if !step.iter().all(|d| d.is_finite()) {
            return ending(island, limits, n, f64::INFINITY, work);
        }
        free.iter_mut().zip(step).for_each(|(x, d)| *x += *d);
    }
    ending(island, limits, limits.n_iterations, f64::INFINITY, work)
}

/// The combination of past changes that makes the correction smallest, by least squares.
fn combine(changes: &[(Vec<Vector>, Vec<Vector>)], d: &[Vector]) -> [f64; DEPTH] {
    let dot = |a: &[Vector], b: &[Vector]| -> f64 { a.iter().zip(b).map(|(a, b)| a.dot(*b)).sum() };
    let mut matrix = [[0.0; DEPTH]; DEPTH];
    let mut gamma = [0.0; DEPTH];
    for (i, (_, one)) in changes.iter().enumerate() {
        for (j, (_, other)) in changes.iter().enumerate() {
            matrix[i][j] = dot(one, other);
        }
        gamma[i] = dot(one, d);
    }
    let largest = (0..DEPTH).fold(0.0_f64, |most, i| most.max(matrix[i][i]));
    // Gauss on a matrix that is positive definite by what is added: no pivoting needed.
    for i in 0..changes.len() {
        matrix[i][i] += REGULAR * largest;
        let (done, below) = matrix.split_at_mut(i + 1);
        let pivot = &done[i];
        if pivot[i] <= 0.0 || pivot[i].is_nan() {
            return [0.0; DEPTH];
        }
        for (j, row) in below.iter_mut().enumerate() {
            let l = row[i] / pivot[i];
            row.iter_mut().zip(pivot).for_each(|(a, b)| *a -= l * b);
            gamma[i + 1 + j] -= l * gamma[i];
        }
    }
    for i in (0..changes.len()).rev() {
        let known: f64 = (i + 1..changes.len()).map(|k| matrix[i][k] * gamma[k]).sum();
        gamma[i] = (gamma[i] - known) / matrix[i][i];
    }
    gamma
}
