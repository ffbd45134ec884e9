//! The method `relaxation`: the paper's. Every constraint is corrected exactly, from the same
//! pose and all at once; the corrections, times rho, are added up.

use super::coefficient::Coefficient;
use super::sweep::Sweep;
use super::{Limits, Outcome};
use crate::constraint::{ConstraintKind, Vector};
use crate::solve::island::Island;
use crate::solve::report::{Counters, Status};
use crate::solve::settings::Settings;

/// Sweeps whose moves grow by this factor, as a sum of squares, diverge: that of sweeps which
/// contract can grow only where the constraints are far from linear.
const GROWTH: f64 = 4.0;
/// How often in a run that leads to a closer look at the coefficient.
const MOST_LOOKS: u32 = 4;
/// A pose that a sweep moves by less, relative to the size, is where the sweeps end.
const STILL: f64 = 1e-15;

/// Relaxes an island in one round.
pub(crate) fn round(
    island: &mut Island,
    settings: &Settings,
    limits: &Limits,
    work: &mut Counters,
) -> (Outcome, Option<f64>) {
    let mut coefficient = Coefficient::new(island, settings.rho, work);
    let outcome = solve(island, &mut coefficient, limits, work);
    (outcome, coefficient.lowered())
}

/// Improves the pose of an island; gives how it ended.
pub(crate) fn solve(
    island: &mut Island,
    coefficient: &mut Coefficient,
    limits: &Limits,
    work: &mut Counters,
) -> Outcome {
    let mut sweep = Sweep::new(island, *coefficient);
    let mut d = vec![Vector::ZERO; island.x.len()];
    let (mut least, mut n_looks) = (f64::INFINITY, 0);
    for n in 0..limits.n_iterations {
        let Island { constraints, x, w, n_free, .. } = &mut *island;
        let worst = sweep.correct_all(constraints, x, w, &mut d, work);
        let (free, d) = (&mut x[..*n_free], &d[..*n_free]);
        let (square, longest) = measure(d);
        // A correction that overflowed would poison its neighbours.
        let is_finite = square.is_finite() || d.iter().all(|d| d.is_finite());
        if worst <= limits.tolerance || !is_finite || limits.budget.is_spent() {
            return ending(island, limits, n, f64::INFINITY, work);
        }
        free.iter_mut().zip(d).for_each(|(x, d)| *x += *d);
        if square > GROWTH * least && n_looks < MOST_LOOKS {
            n_looks += 1;
            coefficient.look_again(island, work);
            sweep = Sweep::new(island, *coefficient);
        }
        least = least.min(square);
        if longest <= STILL * limits.size {
            return ending(island, limits, n + 1, longest, work);
        }
    }
    ending(island, limits, limits.n_iterations, f64::INFINITY, work)
}

/// The sum of the squares of displacements, and the largest coordinate of one; several at a time,
/// for the vector units.
fn measure(d: &[Vector]) -> (f64, f64) {
    const LANES: usize = 4;
    let (mut squares, mut longest) = ([0.0; LANES], [0.0_f64; LANES]);
    let (chunks, rest) = d.as_chunks::<LANES>();
    for chunk in chunks {
        for ((square, longest), d) in squares.iter_mut().zip(&mut longest).zip(chunk) {
            *square += d.norm_squared();
            let long = if d.x.abs() > d.y.abs() { d.x.abs() } else { d.y.abs() };
            *longest = if long > *longest { long } else { *longest };
        }
    }
    for d in rest {
        squares[0] += d.norm_squared();
        longest[0] = longest[0].max(d.x.abs()).max(d.y.abs());
    }
    (squares.iter().sum(), longest.into_iter().fold(0.0, f64::max))
}

/// How a run of sweeps ended, whose last one moved the points by `longest` at most.
pub(crate) fn ending(
    island: &Island,
    limits: &Limits,
    n_iterations: u32,
    longest: f64,
    work: &mut Counters,
) -> Outcome {
    let (mut worst, mut energy) = (0.0_f64, 0.0);
    for constraint in &island.constraints {
        let violation = constraint.violation(&island.x, &island.w);
        worst = worst.max(violation);
        energy += 0.5 * violation * violation;
    }
    work.evaluations += island.constraints.len() as u64;
    let status = if worst <= limits.tolerance {
        Status::Converged
    } else if longest <= STILL * limits.size {
        Status::BestFit
    } else {
        Status::Stalled
    };
    Outcome { status, worst, energy, n_iterations }
}
