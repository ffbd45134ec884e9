//! Which rows say nothing that earlier ones do not say already, and which those are.

use super::projector::Projector;
use super::system::{UnitRow, UnitRows};
use crate::linalg::RowBasis;

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

    /// Leaves out rows whose multiples are below this part of the largest.
    pub fn keep_above(&mut self, part: f64) {
        let most = self.on.iter().fold(0.0, |most: f64, (_, c)| most.max(c.abs()));
        self.on.retain(|(_, c)| c.abs() > part * most);
    }

    /// How far the rows contradict each other: what the stress makes of their values, for a
    /// stress of length 1. No motion changes it, to first order.
    pub fn misfit(&self, rows: &[UnitRow]) -> f64 {
        let work: f64 = self.stress().map(|(row, y)| y * rows[row].f).sum();
        let squared: f64 = self.stress().map(|(_, y)| y * y).sum();
        work / squared.sqrt()
    }
}

/// Multiples below this part of the largest are rounding: independent rows are told apart by 1e-5,
/// and rounding of 1e-14 is divided by that.
const ROUNDING: f64 = 1e-9;

/// All dependent rows of an island, taken in order of creation. `tolerance` is what may be
/// left of a row of length 1 that depends on others.
///
/// Each is explained by rows close by if it can be, else by independent rows anywhere. Either
/// way the stresses of all span all stresses, as each has a row that only later ones share.
pub fn dependences(island: &UnitRows, tolerance: f64) -> Vec<Dependence> {
    let (independent, dependent) = independent(island.points.len(), &island.rows, tolerance);
    let neighbourhood = Neighbourhood::new(island);
    let mut everywhere = None;
    dependent
        .into_iter()
        .map(|row| {
            let on = neighbourhood.explain(row, tolerance).unwrap_or_else(|| {
                everywhere
                    .get_or_insert_with(|| Explainer::new(island, &independent))
                    .explain(row)
                    .0
            });
            let mut dependence = Dependence { row, on };
            dependence.keep_above(ROUNDING);
            dependence
        })
        .collect()
}

/// The rows that raise the rank, taken in order, and those that do not.
fn independent(n_points: usize, rows: &[UnitRow], tolerance: f64) -> (Vec<usize>, Vec<usize>) {
    let mut basis = RowBasis::new(n_points, rows.iter().map(UnitRow::points), tolerance);
    (0..rows.len()).partition(|&k| basis.insert(rows[k].points(), rows[k].values()))
}

/// Rows as sums of multiples of independent ones.
struct Explainer<'a> {
    island: &'a UnitRows,
    basis: &'a [usize],
    projector: Projector,
}

impl<'a> Explainer<'a> {
    fn new(island: &'a UnitRows, basis: &'a [usize]) -> Self {
        let rows = basis.iter().map(|&k| island.rows[k].clone()).collect();
        Self { island, basis, projector: Projector::new(island.points.len(), rows) }
    }

    /// The multiples of the basis that come nearest to a row, and how far away that is.
    fn explain(&mut self, row: usize) -> (Vec<(usize, f64)>, f64) {
        let mut gradient = vec![0.0; self.island.n_unknowns()];
        self.island.rows[row].add_to(1.0, &mut gradient);
        let (multipliers, left) = self.projector.multipliers(&gradient);
        (self.basis.iter().copied().zip(multipliers).collect(), left)
    }
}

/// Which rows are near which: in a net that is where a dependence is short.
struct Neighbourhood<'a> {
    island: &'a UnitRows,
    /// The rows that hold each point.
    at: Vec<Vec<usize>>,
}

/// More points than this are not near.
const NEAR: usize = 32;

impl<'a> Neighbourhood<'a> {
    fn new(island: &'a UnitRows) -> Self {
        let mut at = vec![Vec::new(); island.points.len()];
        for (k, row) in island.rows.iter().enumerate() {
            for &p in row.points() {
                at[p as usize].push(k);
            }
        }
        Self { island, at }
    }

    /// Explains a row by earlier ones that hold no points but its own, then those next to two
    /// of these, then all next to them, and once more; none if that does not do.
    fn explain(&self, row: usize, tolerance: f64) -> Option<Vec<(usize, f64)>> {
        let mut points = self.island.rows[row].points().to_vec();
        points.sort_unstable();
        for n_shared in [0, 2, 1, 1] {
            if n_shared > 0 {
                points = self.grown(&points, n_shared)?;
            }
            let place = |p: u32| points.binary_search(&p).map(|at| at as u32);
            let is_inside = |k: &usize| {
                *k < row && self.island.rows[*k].points().iter().all(|&p| place(p).is_ok())
            };
            let at = points.iter().flat_map(|&p| &self.at[p as usize]);
            let mut inside: Vec<usize> = at.copied().filter(is_inside).collect();
            inside.sort_unstable();
            inside.dedup();
            let near = UnitRows {
                points: points.clone(),
                rows: inside
                    .iter()
                    .chain([&row])
                    .map(|&k| self.island.rows[k].renumbered(|p| place(p).expect("it is inside")))
                    .collect(),
            };
            let (basis, dependent) = independent(points.len(), &near.rows, tolerance);
            if dependent.last() == Some(&inside.len()) {
                let (on, left) = Explainer::new(&near, &basis).explain(inside.len());
                if left <= tolerance {
                    return Some(on.into_iter().map(|(k, c)| (inside[k], c)).collect());
                }
            }
        }
        None
    }

    /// The points and those that share a row with at least `n_shared` of them, ascending; none
    /// if they are too many.
    fn grown(&self, points: &[u32], n_shared: usize) -> Option<Vec<u32>> {
        let n_rows: usize = points.iter().map(|&p| self.at[p as usize].len()).sum();
        if n_rows > 8 * NEAR {
            return None;
        }
        let mut all = Vec::new();
        for &p in points {
            let rows = self.at[p as usize].iter().map(|&k| &self.island.rows[k]);
            let mut next: Vec<_> = rows.flat_map(UnitRow::points).copied().collect();
            next.sort_unstable();
            next.dedup();
            all.append(&mut next);
        }
        all.sort_unstable();
        let grown = all.chunk_by(|a, b| a == b);
        let grown: Vec<_> = grown
            .filter(|same| same.len() >= n_shared || points.binary_search(&same[0]).is_ok())
            .map(|same| same[0])
            .collect();
        (grown.len() <= NEAR).then_some(grown)
    }
}
