//! The method `relaxation`: the paper's. Every constraint is corrected exactly, from the same
//! pose and all at once; the corrections, times rho, are added up.

use super::spectrum::Spectrum;
use super::sweep::Sweep;
use super::{Limits, Outcome};
use crate::constraint::{ConstraintKind, Vector};
use crate::solve::island::Island;
use crate::solve::report::{Counters, Status};

/// Simultaneous corrections contract if rho < 2 / lambda; this keeps a tenth away from that.
const MOST_RHO: f64 = 1.8;
/// Sweeps whose moves grow by this factor, as a sum of squares, diverge: that of sweeps which
/// contract can grow only where the constraints are far from linear.
const GROWTH: f64 = 4.0;
/// How often in a run that leads to a closer look at the coefficient.
const MOST_LOOKS: u32 = 4;
/// A pose that a sweep moves by less, relative to the size, is where the sweeps end.
const STILL: f64 = 1e-15;

/// The coefficients of a run: the user's, lowered where they would diverge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Coefficient {
    /// What every constraint without one of its own gets.
    pub rho: f64,
    /// What those of constraints that have one are multiplied with.
    pub factor: f64,
}

impl Coefficient {
    /// The user's coefficient, or what contracts where that would diverge.
    pub fn new(island: &mut Island, rho: f64, work: &mut Counters) -> Self {
        let mut workspace = island.take_workspace();
        workspace.rows.evaluate(&workspace.equations, &island.constraints, &island.x, work);
        let mut spectrum = island
            .spectrum
            .take()
            .unwrap_or_else(|| Box::new(Spectrum::new(&island.points[..island.n_free])));
        let by_row: Vec<f64> = if island.own_rho.is_empty() {
            Vec::new()
        } else {
            let rows = island.constraints.iter().zip(&island.own_rho);
            rows.flat_map(|(c, own)| std::iter::repeat_n(own.unwrap_or(rho), c.n_rows())).collect()
        };
        let largest = spectrum.largest(&workspace.equations, &workspace.rows, |r| {
            by_row.get(r).copied().unwrap_or(rho)
        });
        island.spectrum = Some(spectrum);
        island.put_workspace(workspace);
        let factor = if largest > MOST_RHO { MOST_RHO / largest } else { 1.0 };
        Self { rho: rho * factor, factor }
    }

    /// The coefficient where sweeps with the present one diverge: the eigenvalue it was worked
    /// out from is no longer the largest.
    fn look_again(&mut self, island: &mut Island, work: &mut Counters) {
        if let Some(spectrum) = &mut island.spectrum {
            spectrum.forget();
        }
        let found = Self::new(island, self.rho / self.factor, work);
        if found.rho < self.rho {
            *self = found;
        }
    }

    /// The coefficient, if it is lower than the user's.
    pub fn lowered(self) -> Option<f64> {
        (self.factor < 1.0).then_some(self.rho)
    }

    /// The coefficient `rho`, or what contracts where the largest eigenvalue is `largest`.
    pub fn at_most(rho: f64, largest: f64) -> Self {
        let factor = if rho * largest > MOST_RHO { MOST_RHO / (rho * largest) } else { 1.0 };
        Self { rho: rho * factor, factor }
    }

    /// The coefficient of constraint `c`.
    pub fn of(self, own: &[Option<f64>], c: usize) -> f64 {
        own.get(c).copied().flatten().map_or(self.rho, |own| own * self.factor)
    }
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
