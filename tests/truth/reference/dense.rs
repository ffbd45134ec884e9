//! Dense matrices: singular values, eigenvalues, least squares. Small, plain and slow.

/// A matrix by rows.
#[derive(Clone, Debug, Default)]
pub struct Matrix {
    pub n_columns: usize,
    pub rows: Vec<Vec<f64>>,
}

/// `A = sum of sigma_k u_k v_k^T`, the largest sigma first; as many as the matrix has columns or
/// rows, whichever is less.
pub struct Svd {
    pub sigma: Vec<f64>,
    pub u: Vec<Vec<f64>>,
    pub v: Vec<Vec<f64>>,
}

/// Rotations are repeated until all columns are orthogonal to this part of their lengths.
const ORTHOGONAL: f64 = 1e-14;
/// Sweeps converge quadratically: some eight do.
const MOST_SWEEPS: usize = 60;

impl Matrix {
    /// Of zeros.
    pub fn zero(n_rows: usize, n_columns: usize) -> Self {
        Self { n_columns, rows: vec![vec![0.0; n_columns]; n_rows] }
    }

    /// The matrix of these rows, all of `n_columns` numbers.
    pub fn of(n_columns: usize, rows: Vec<Vec<f64>>) -> Self {
        Self { n_columns, rows }
    }

    /// The product of the transpose with a vector.
    pub fn transposed_times(&self, y: &[f64]) -> Vec<f64> {
        let mut x = vec![0.0; self.n_columns];
        for (row, &y) in self.rows.iter().zip(y) {
            add_scaled(&mut x, y, row);
        }
        x
    }

    fn transposed(&self) -> Self {
        let column = |k: usize| self.rows.iter().map(|row| row[k]).collect();
        Self::of(self.rows.len(), (0..self.n_columns).map(column).collect())
    }

    /// `A^T A`.
    pub fn gram(&self) -> Self {
        let mut gram = Self::zero(self.n_columns, self.n_columns);
        for row in &self.rows {
            for (i, &a) in row.iter().enumerate().filter(|(_, a)| **a != 0.0) {
                add_scaled(&mut gram.rows[i], a, row);
            }
        }
        gram
    }

    /// The singular value decomposition, by the one-sided rotations of Hestenes.
    pub fn svd(&self) -> Svd {
        if self.rows.len() < self.n_columns {
            let Svd { sigma, u, v } = self.transposed().svd();
            return Svd { sigma, u: v, v: u };
        }
        let n = self.n_columns;
        let mut columns = self.transposed().rows;
        let mut v = identity(n);
        for _ in 0..MOST_SWEEPS {
            let mut is_done = true;
            for i in 0..n {
                for j in i + 1..n {
                    let (a, b) = (square(&columns[i]), square(&columns[j]));
                    let c = dot(&columns[i], &columns[j]);
                    if c.abs() <= ORTHOGONAL * (a * b).sqrt() || c == 0.0 {
                        continue;
                    }
                    is_done = false;
                    let rotation = rotation((b - a) / (2.0 * c));
                    rotate(&mut columns, i, j, rotation);
                    rotate(&mut v, i, j, rotation);
                }
            }
            if is_done {
                break;
            }
        }
        let mut all: Vec<(f64, Vec<f64>, Vec<f64>)> = columns
            .into_iter()
            .zip(v)
            .map(|(mut u, v)| {
                let sigma = norm(&u);
                if sigma > 0.0 {
                    u.iter_mut().for_each(|u| *u /= sigma);
                }
                (sigma, u, v)
            })
            .collect();
        all.sort_by(|a, b| b.0.total_cmp(&a.0));
        let mut svd = Svd { sigma: Vec::new(), u: Vec::new(), v: Vec::new() };
        for (sigma, u, v) in all {
            svd.sigma.push(sigma);
            svd.u.push(u);
            svd.v.push(v);
        }
        svd
    }

    /// Eigenvalues of a symmetric matrix, the least first, each with its vector (Jacobi).
    pub fn eigen(&self) -> Vec<(f64, Vec<f64>)> {
        let n = self.n_columns;
        let mut a = self.rows.clone();
        let mut v = identity(n);
        let size = a.iter().map(|row| square(row)).sum::<f64>().sqrt();
        for _ in 0..MOST_SWEEPS {
            let mut is_done = true;
            for i in 0..n {
                for j in i + 1..n {
                    if a[i][j].abs() <= f64::EPSILON * size * 1e-2 {
                        continue;
                    }
                    is_done = false;
                    let rotation = rotation((a[j][j] - a[i][i]) / (2.0 * a[i][j]));
                    rotate(&mut a, i, j, rotation);
                    let (c, s) = rotation;
                    for row in &mut a {
                        (row[i], row[j]) = (c * row[i] - s * row[j], s * row[i] + c * row[j]);
                    }
                    rotate(&mut v, i, j, rotation);
                }
            }
            if is_done {
                break;
            }
        }
        let mut all: Vec<_> = v.into_iter().enumerate().map(|(k, v)| (a[k][k], v)).collect();
        all.sort_by(|a, b| a.0.total_cmp(&b.0));
        all
    }

    /// Solves `A x = b` for a positive definite A (Cholesky); none if it is not.
    pub fn solve_definite(mut self, b: &[f64]) -> Option<Vec<f64>> {
        let n = self.n_columns;
        let l = &mut self.rows;
        for j in 0..n {
            for i in j..n {
                let (upper, lower) = l.split_at_mut(i);
                let row_j = if i == j { &lower[0] } else { &upper[j] };
                let sum = lower[0][j] - dot(&lower[0][..j], &row_j[..j]);
                if i == j {
                    if sum.is_nan() || sum <= 0.0 {
                        return None;
                    }
                    lower[0][j] = sum.sqrt();
                } else {
                    lower[0][j] = sum / upper[j][j];
                }
            }
        }
        let mut x = b.to_vec();
        for i in 0..n {
            x[i] = (x[i] - dot(&l[i][..i], &x[..i])) / l[i][i];
        }
        for i in (0..n).rev() {
            let below: f64 = (i + 1..n).map(|k| l[k][i] * x[k]).sum();
            x[i] = (x[i] - below) / l[i][i];
        }
        Some(x)
    }
}

/// `P A = L U` of a square matrix.
pub struct Factors {
    rows: Vec<Vec<f64>>,
    order: Vec<usize>,
}

impl Factors {
    /// By Gauss with pivots; none where one vanishes.
    pub fn new(matrix: &Matrix) -> Option<Self> {
        let n = matrix.n_columns;
        let mut rows = matrix.rows.clone();
        let mut order: Vec<usize> = (0..n).collect();
        for k in 0..n {
            let pivot = (k..n).max_by(|&i, &j| rows[i][k].abs().total_cmp(&rows[j][k].abs()))?;
            if pivot != k {
                rows.swap(k, pivot);
                order.swap(k, pivot);
            }
            if rows[k][k] == 0.0 {
                return None;
            }
            let (above, below) = rows.split_at_mut(k + 1);
            for row in below {
                row[k] /= above[k][k];
                let share = row[k];
                add_scaled(&mut row[k + 1..], -share, &above[k][k + 1..]);
            }
        }
        Some(Self { rows, order })
    }

    /// The x with `A x = b`.
    pub fn solve(&self, b: &[f64]) -> Vec<f64> {
        let n = self.rows.len();
        let mut x: Vec<f64> = self.order.iter().map(|&k| b[k]).collect();
        for i in 0..n {
            x[i] -= dot(&self.rows[i][..i], &x[..i]);
        }
        for i in (0..n).rev() {
            x[i] = (x[i] - dot(&self.rows[i][i + 1..], &x[i + 1..])) / self.rows[i][i];
        }
        x
    }
}

impl Svd {
    /// How many singular values exceed this part of the largest, of 1 at least: the rows this is
    /// used on have length 1.
    pub fn rank(&self, cut: f64) -> usize {
        let least = cut * self.sigma.first().copied().unwrap_or(0.0).max(1.0);
        self.sigma.iter().filter(|sigma| **sigma > least).count()
    }

    /// The shortest x with `A x` nearest to b; singular values below the cut count as 0.
    pub fn solve(&self, b: &[f64], cut: f64) -> Vec<f64> {
        let n = self.v.first().map_or(0, Vec::len);
        let mut x = vec![0.0; n];
        for k in 0..self.rank(cut) {
            add_scaled(&mut x, dot(&self.u[k], b) / self.sigma[k], &self.v[k]);
        }
        x
    }
}

/// Cosine and sine of the rotation that makes two columns orthogonal.
fn rotation(zeta: f64) -> (f64, f64) {
    let t = zeta.signum() / (zeta.abs() + libm::hypot(zeta, 1.0));
    let c = 1.0 / libm::hypot(t, 1.0);
    (c, c * t)
}

fn rotate(vectors: &mut [Vec<f64>], i: usize, j: usize, (c, s): (f64, f64)) {
    let (before, after) = vectors.split_at_mut(j);
    for (a, b) in before[i].iter_mut().zip(after[0].iter_mut()) {
        (*a, *b) = (c * *a - s * *b, s * *a + c * *b);
    }
}

fn identity(n: usize) -> Vec<Vec<f64>> {
    let row = |i: usize| (0..n).map(|j| if i == j { 1.0 } else { 0.0 }).collect();
    (0..n).map(row).collect()
}

/// The scalar product.
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// The length squared.
pub fn square(a: &[f64]) -> f64 {
    dot(a, a)
}

/// The length.
pub fn norm(a: &[f64]) -> f64 {
    square(a).sqrt()
}

/// Adds a multiple of one vector to another.
pub fn add_scaled(to: &mut [f64], k: f64, what: &[f64]) {
    to.iter_mut().zip(what).for_each(|(to, what)| *to += k * what);
}
