//! Projections onto motions that change no row, and onto what rows can bear among themselves.

use super::system::{UnitRow, UnitRows};
use crate::linalg::NormalMatrix;

/// Eigenvalues of J^T J below this count as 0: singular values below 1e-5.
pub const TAU: f64 = 1e-10;

/// The same where a motion below [`TAU`] was tried and does not go on: rounding of rows of length
/// 1 leaves less.
pub const FINE: f64 = 1e-14;

/// Holds motions that no row resists, while projecting. What is left of resisted ones is
/// `MU / sigma^2` a round; rounding along free ones is `1e-16 / MU`.
const MU: f64 = 1e-8;
const N_ROUNDS: usize = 4;

/// Rows with the factor of their normal matrix.
pub struct Projector {
    rows: Vec<UnitRow>,
    normal: NormalMatrix,
    mu: f64,
}

impl Projector {
    /// For `rows` over `n_points` points.
    pub fn new(n_points: usize, rows: Vec<UnitRow>) -> Self {
        let mut normal = NormalMatrix::new(n_points, rows.iter().map(UnitRow::points));
        for (row_idx, row) in rows.iter().enumerate() {
            normal.add_row(row_idx, row.values());
        }
        Self { rows, normal, mu: f64::NAN }
    }

    /// For the rows of an island.
    pub fn of(island: &UnitRows) -> Self {
        Self::new(island.points.len(), island.rows.clone())
    }

    fn factor(&mut self, mu: f64) {
        if self.mu != mu {
            self.normal.factor(mu);
            self.mu = mu;
        }
    }

    /// How many independent motions change no row.
    pub fn nullity(&mut self) -> usize {
        self.count_below(TAU)
    }

    /// How many eigenvalues of J^T J lie below `bound`.
    pub fn count_below(&mut self, bound: f64) -> usize {
        self.mu = f64::NAN;
        self.normal.nullity(bound)
    }

    /// Replaces a right-hand side by the solution of J^T J + `mu` I.
    pub fn solve_damped(&mut self, mu: f64, rhs: &mut [f64]) {
        self.factor(mu);
        self.normal.solve(rhs);
    }

    /// Projects unknowns onto the motions that change no row.
    pub fn onto_motions(&mut self, y: &mut [f64]) {
        self.factor(MU);
        for _ in 0..N_ROUNDS {
            self.normal.solve(y);
            for y in y.iter_mut() {
                *y *= MU;
            }
        }
    }

    /// The multiples of the rows whose sum is nearest to `gradient`, and how far away it is;
    /// the rows must be independent for these to be unique.
    pub fn multipliers(&mut self, gradient: &[f64]) -> (Vec<f64>, f64) {
        // Rounding along free motions does no harm here, so the first round is nearly exact.
        self.factor(1e-3 * MU);
        let mut multipliers = vec![0.0; self.rows.len()];
        let mut rest = gradient.to_vec();
        let mut left = f64::INFINITY;
        for _ in 0..2 * N_ROUNDS {
            self.normal.solve(&mut rest);
            for (m, row) in multipliers.iter_mut().zip(&self.rows) {
                *m += row.dot(&rest);
            }
            rest.copy_from_slice(gradient);
            for (&m, row) in multipliers.iter().zip(&self.rows) {
                row.add_to(-m, &mut rest);
            }
            let before = left;
            left = rest.iter().map(|r| r * r).sum::<f64>().sqrt();
            if left < 1e-14 || left > 0.5 * before {
                break;
            }
        }
        (multipliers, left)
    }

    /// The smallest singular value of J that is not 0, and the largest; none without rows.
    /// Eigenvalues of `J^T J` below `cut` count as 0.
    ///
    /// Found by counting eigenvalues, to 1 part in 1000.
    pub fn extreme_singular_values(&mut self, cut: f64) -> Option<(f64, f64)> {
        let n_null = self.count_below(cut);
        let n = self.normal.n_unknowns();
        if n_null == n {
            return None;
        }
        // No eigenvalue is larger than the sum of all, the number of rows.
        let most = 2.0 * self.rows.len() as f64;
        let smallest = self.bisect(cut, most, |count| count > n_null);
        let largest = self.bisect(cut, most, |count| count == n);
        Some((smallest.sqrt(), largest.sqrt()))
    }

    /// Where, between two bounds, the count of eigenvalues below begins to be `enough`.
    fn bisect(&mut self, least: f64, most: f64, enough: impl Fn(usize) -> bool) -> f64 {
        let (mut low, mut high) = (least, most);
        while high > 1.002 * low {
            let middle = (low * high).sqrt();
            if enough(self.count_below(middle)) { high = middle } else { low = middle }
        }
        high
    }
}
