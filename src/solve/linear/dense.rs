//! L D L^T of a small matrix in which nearly everything is coupled.

use super::block::Pivots;
use super::normal::Normal;

/// A factor stored in full: column `j` of L below the diagonal, 1 / D on it.
pub struct Dense {
    n: usize,
    columns: Vec<f64>,
}

impl Dense {
    /// Room for `n_points` points.
    pub fn new(n_points: usize) -> Self {
        let n = 2 * n_points;
        Self { n, columns: vec![0.0; n * n] }
    }

    /// Factors `normal + mu I`.
    pub fn factor(&mut self, normal: &Normal, mu: f64) -> Pivots {
        let n = self.n;
        self.columns.fill(0.0);
        for k in 0..normal.len() {
            for (i, block) in normal.row(k) {
                let at = 2 * i * n + 2 * k;
                self.columns[at] = block[0];
                self.columns[at + n] = block[1];
                self.columns[at + 1] = block[2];
                self.columns[at + n + 1] = block[3];
            }
        }
        // A length known to the compiler unrolls the loops: the usual mechanism has one to
        // eight points that move.
        match n {
            2 => factor_fixed::<2>(&mut self.columns, mu),
            4 => factor_fixed::<4>(&mut self.columns, mu),
            6 => factor_fixed::<6>(&mut self.columns, mu),
            8 => factor_fixed::<8>(&mut self.columns, mu),
            10 => factor_fixed::<10>(&mut self.columns, mu),
            12 => factor_fixed::<12>(&mut self.columns, mu),
            14 => factor_fixed::<14>(&mut self.columns, mu),
            16 => factor_fixed::<16>(&mut self.columns, mu),
            _ => factor_any(&mut self.columns, n, mu),
        }
    }

    /// Replaces the right-hand side by the solution.
    pub fn solve(&self, rhs: &mut [f64]) {
        let n = self.n;
        for (j, column) in self.columns.chunks_exact(n).enumerate() {
            let y = rhs[j];
            for (r, l) in rhs[j + 1..].iter_mut().zip(&column[j + 1..]) {
                *r -= l * y;
            }
        }
        for (j, column) in self.columns.chunks_exact(n).enumerate().rev() {
            let mut y = rhs[j] * column[j];
            for (r, l) in rhs[j + 1..].iter().zip(&column[j + 1..]) {
                y -= l * r;
            }
            rhs[j] = y;
        }
    }
}

fn factor_fixed<const N: usize>(columns: &mut [f64], mu: f64) -> Pivots {
    let (columns, _) = columns.as_chunks_mut::<N>();
    let columns: &mut [[f64; N]; N] = columns.try_into().expect("the matrix is square");
    let mut pivots = Pivots::NONE;
    for j in 0..N {
        let column = columns[j];
        let reciprocal = pivots.note(column[j] + mu);
        for k in j + 1..N {
            let l = column[k] * reciprocal;
            for i in k..N {
                columns[k][i] -= l * column[i];
            }
            columns[j][k] = l;
        }
        columns[j][j] = reciprocal;
    }
    pivots
}

fn factor_any(columns: &mut [f64], n: usize, mu: f64) -> Pivots {
    let mut pivots = Pivots::NONE;
    let mut rest = columns;
    for j in 0..n {
        let (column, later) = rest.split_at_mut(n);
        let reciprocal = pivots.note(column[j] + mu);
        for (k, target) in (j + 1..n).zip(later.chunks_exact_mut(n)) {
            let l = column[k] * reciprocal;
            for (t, c) in target[k..].iter_mut().zip(&column[k..]) {
                *t -= l * c;
            }
        }
        for c in &mut column[j + 1..] {
            *c *= reciprocal;
        }
        column[j] = reciprocal;
        rest = later;
    }
    pivots
}
