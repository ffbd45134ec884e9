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

    /// The same for other rows. Where these stand between the same points, what is kept is who has to do
    /// with whom, most of the work of a projector of a few points.
    #[must_use]
    pub fn anew(mut self, island: &UnitRows) -> Self {
        let is_alike = self.normal.n_unknowns() == island.n_unknowns()
            && self.rows.iter().map(UnitRow::points).eq(island.rows.iter().map(UnitRow::points));
        if !is_alike {
            return Self::of(island);
        }
        self.rows.clone_from(&island.rows);
        self.normal.clear();
        for (row_idx, row) in self.rows.iter().enumerate() {
            self.normal.add_row(row_idx, row.values());
        }
        self.mu = f64::NAN;
        self
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::constraint::{Bounds, Constraint, Length, Point};
    use crate::mobility::ConstraintSystem;
    use crate::mobility::motions::Random;

    /// The rows of some bars between points that lie anywhere.
    fn rows(bars: &[[u32; 2]], random: &mut Random) -> UnitRows {
        let bounds = Bounds::exactly(1.0);
        let of = |&points: &[u32; 2]| Constraint::from(Length { points, bounds });
        let bars: Vec<Constraint> = bars.iter().map(of).collect();
        let x: Vec<Point> = (0..5).map(|_| Point::new(random.next(), random.next())).collect();
        let constraints: Vec<&Constraint> = bars.iter().collect();
        let all: Vec<usize> = (0..bars.len()).collect();
        let scene = ConstraintSystem { constraints: &constraints, x: &x, w: &[1.0; 5] };
        scene.rows_over((0..5).collect(), &all)
    }

    #[test]
    fn a_projector_that_was_for_other_rows_gives_the_same_bits() {
        let nets: [&[[u32; 2]]; 4] = [
            &[[0, 1], [1, 2], [2, 3], [3, 4]],
            &[[0, 1], [1, 2], [2, 3], [3, 4], [0, 4]],
            &[[0, 1], [2, 1], [2, 3], [3, 4]],
            &[[3, 4], [1, 3]],
        ];
        let mut random = Random::new();
        let mut last = Projector::of(&rows(nets[0], &mut random));
        for k in 0..200 {
            let rows = rows(nets[k / 3 * 7 % 4], &mut random);
            let mut fresh = Projector::of(&rows);
            last = last.anew(&rows);
            let y: Vec<f64> = (0..10).map(|_| random.next()).collect();
            let bits = |projector: &mut Projector| {
                let mut all = vec![projector.nullity() as u64];
                for of in [Projector::onto_motions, |it: &mut Projector, y: &mut [f64]| {
                    it.solve_damped(1e-12, y);
                }] {
                    let mut y = y.clone();
                    of(projector, &mut y);
                    all.extend(y.into_iter().map(f64::to_bits));
                }
                let (multipliers, left) = projector.multipliers(&y);
                all.extend(multipliers.into_iter().chain([left]).map(f64::to_bits));
                all
            };
            assert_eq!(bits(&mut last), bits(&mut fresh), "{k}");
        }
    }
}
