//! Which rows say nothing that earlier ones do not say already, and which those are.

use super::projector::Projector;
use super::scene::{Rows, UnitRow};
use crate::solve::linear::RowBasis;

/// A row that is a sum of multiples of earlier, independent ones.
#[derive(Debug, Clone)]
pub struct Dependence {
    /// The row, as an index into the island's rows.
    pub row: usize,
    /// The rows it depends on, with their multiples; none can be left out.
    pub on: Vec<(usize, f64)>,
}

impl Dependence {
    /// The rows with the forces they bear against each other: 1 for the dependent one.
    pub fn stress(&self) -> impl Iterator<Item = (usize, f64)> {
        [(self.row, 1.0)].into_iter().chain(self.on.iter().map(|&(row, c)| (row, -c)))
    }

    /// How far the rows contradict each other: what the stress makes of their values, for a
    /// stress of length 1. No motion changes it, to first order.
    pub fn misfit(&self, rows: &[UnitRow]) -> f64 {
        let work: f64 = self.stress().map(|(row, y)| y * rows[row].f).sum();
        let squared: f64 = self.stress().map(|(_, y)| y * y).sum();
        work / squared.sqrt()
    }
}

/// All dependent rows of an island, taken in order of creation. `tolerance` is what may be
/// left of a row of length 1 that depends on others.
pub fn dependences(island: &Rows, tolerance: f64) -> Vec<Dependence> {
    let n_points = island.points.len();
    let mut basis = RowBasis::new(n_points, island.rows.iter().map(UnitRow::points), tolerance);
    let (mut independent, mut dependent) = (Vec::new(), Vec::new());
    for (row_idx, row) in island.rows.iter().enumerate() {
        let is_new = basis.insert(row.points(), row.values());
        if is_new { &mut independent } else { &mut dependent }.push(row_idx);
    }
    if dependent.is_empty() {
        return Vec::new();
    }
    let rows: Vec<UnitRow> = independent.iter().map(|&k| island.rows[k].clone()).collect();
    let mut projector = Projector::new(n_points, &rows);
    let mut gradient = vec![0.0; island.n_unknowns()];
    dependent
        .into_iter()
        .map(|row| {
            gradient.fill(0.0);
            island.rows[row].add_to(1.0, &mut gradient);
            let multipliers = projector.multipliers(&gradient);
            let most = multipliers.iter().fold(0.0, |most: f64, m| most.max(m.abs()));
            // Others are rounding, or the trace of a tolerance.
            let least = most * (10.0 * tolerance).max(1e-7);
            let on = independent.iter().copied().zip(multipliers);
            Dependence { row, on: on.filter(|(_, m)| m.abs() > least).collect() }
        })
        .collect()
}
