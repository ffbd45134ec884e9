//! Small square systems that need not be symmetric.

/// Systems of more unknowns do not fit into a [`Square`].
pub const MOST_UNKNOWNS: usize = 24;

/// A square matrix of few rows, with a right side.
pub struct Square<const MOST: usize = MOST_UNKNOWNS> {
    n: usize,
    rows: [[f64; MOST]; MOST],
    rhs: [f64; MOST],
}

impl<const MOST: usize> Square<MOST> {
    /// A matrix of `n` rows, no more than there is room for, of zeros.
    pub const fn new(n: usize) -> Self {
        Self { n, rows: [[0.0; MOST]; MOST], rhs: [0.0; MOST] }
    }

    /// A row, to be filled in.
    pub fn row(&mut self, r: usize) -> &mut [f64] {
        &mut self.rows[r][..self.n]
    }

    /// Sets what a row times the unknowns is to be.
    pub fn set_right_side(&mut self, r: usize, value: f64) {
        self.rhs[r] = value;
    }

    /// Makes it triangular by elimination; gives the least pivot with the sign of the determinant.
    /// For rows of length 1 it is about as large as the least singular value.
    pub fn eliminate(&mut self) -> f64 {
        let Self { n, rows, rhs } = self;
        let n = *n;
        let (mut sign, mut least) = (1.0, f64::INFINITY);
        for k in 0..n {
            let mut largest = k;
            for row in k + 1..n {
                if rows[row][k].abs() > rows[largest][k].abs() {
                    largest = row;
                }
            }
            let pivot = rows[largest][k];
            if pivot == 0.0 {
                return 0.0;
            }
            if largest != k {
                rows.swap(largest, k);
                rhs.swap(largest, k);
                sign = -sign;
            }
            sign *= pivot.signum();
            least = least.min(pivot.abs());
            let (done, left) = rows.split_at_mut(k + 1);
            let (done_rhs, left_rhs) = rhs.split_at_mut(k + 1);
            for (row, rhs) in left[..n - k - 1].iter_mut().zip(left_rhs) {
                let factor = row[k] / pivot;
                if factor != 0.0 {
                    for (a, b) in row[k + 1..n].iter_mut().zip(&done[k][k + 1..n]) {
                        *a -= factor * b;
                    }
                    *rhs -= factor * done_rhs[k];
                }
            }
        }
        sign * least
    }

    /// The unknowns, after an elimination whose least pivot is not 0.
    pub fn solution(&self) -> [f64; MOST] {
        let mut x = [0.0; MOST];
        for k in (0..self.n).rev() {
            let known: f64 = (k + 1..self.n).map(|j| self.rows[k][j] * x[j]).sum();
            x[k] = (self.rhs[k] - known) / self.rows[k][k];
        }
        x
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pivot_has_the_sign_of_the_determinant_and_a_solution_meets_its_rows() {
        let rows = [[0.0, 2.0, 1.0], [3.0, 0.0, 1.0], [1.0, 1.0, 0.0]];
        let x = [1.0, -2.0, 0.5];
        let mut square: Square = Square::new(3);
        for (r, row) in rows.iter().enumerate() {
            square.row(r).copy_from_slice(row);
            square.set_right_side(r, row.iter().zip(x).map(|(a, x)| a * x).sum());
        }
        // Its pivots are 3, 2 and -5/6; two rows change places.
        assert!((square.eliminate() - 5.0 / 6.0).abs() < 1e-15);
        let found = square.solution();
        assert!(found.iter().zip(x).all(|(found, x)| (found - x).abs() < 1e-15));
    }
}
