//! The coefficient of relaxation: the paper's rho, lowered where it would diverge.

use super::spectrum::Spectrum;
use crate::constraint::ConstraintKind;
use crate::solve::island::Island;
use crate::solve::report::Counters;

/// Simultaneous corrections contract if rho < 2 / lambda; this keeps a tenth away from that.
const MOST_RHO: f64 = 1.8;

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
    pub fn look_again(&mut self, island: &mut Island, work: &mut Counters) {
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
