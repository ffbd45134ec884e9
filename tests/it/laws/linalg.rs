//! The sparse linear algebra against dense algebra that knows nothing of patterns.

use linkwork::linalg::{NormalMatrix, RowBasis, Storage};
use nalgebra::{DMatrix, DVector};

/// A small reproducible source of numbers (Steele, Lea and Flood, `SplitMix64`).
struct Random(u64);

impl Random {
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Below `n`.
    fn index(&mut self, n: usize) -> usize {
        (self.bits() % n as u64) as usize
    }

    /// In [-1, 1).
    fn number(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}

/// Rows of a Jacobian: the points of each and the values by (x, y) of each point.
#[derive(Clone, Default)]
struct Rows {
    n_points: usize,
    points: Vec<Vec<u32>>,
    values: Vec<Vec<f64>>,
}

impl Rows {
    fn push(&mut self, points: &[u32], values: &[f64]) {
        self.points.push(points.to_vec());
        self.values.push(values.to_vec());
    }

    /// Random rows of one to four points near each other, so that the pattern is sparse.
    fn random(n_points: usize, n_rows: usize, reach: usize, random: &mut Random) -> Self {
        let mut rows = Self { n_points, ..Self::default() };
        for _ in 0..n_rows {
            let around = random.index(n_points);
            let mut points: Vec<u32> = Vec::new();
            for _ in 0..=random.index(4) {
                let p = ((around + random.index(reach)) % n_points) as u32;
                if !points.contains(&p) {
                    points.push(p);
                }
            }
            let values: Vec<f64> = (0..2 * points.len()).map(|_| random.number()).collect();
            let norm = values.iter().map(|v| v * v).sum::<f64>().sqrt();
            rows.push(&points, &values.iter().map(|v| v / norm).collect::<Vec<_>>());
        }
        rows
    }

    /// A net of `n` x `n` squares with both diagonals.
    fn net(n: usize, random: &mut Random) -> Self {
        let side = n + 1;
        let mut rows = Self { n_points: side * side, ..Self::default() };
        let at = |i: usize, j: usize| (i * side + j) as u32;
        let mut bar = |a: u32, b: u32| {
            let phi = random.number() * 3.0;
            let (s, c) = phi.sin_cos();
            let h = std::f64::consts::FRAC_1_SQRT_2;
            rows.push(&[a, b], &[-c * h, -s * h, c * h, s * h]);
        };
        for i in 0..side {
            for j in 0..side {
                if i < n {
                    bar(at(i, j), at(i + 1, j));
                }
                if j < n {
                    bar(at(i, j), at(i, j + 1));
                }
                if i < n && j < n {
                    bar(at(i, j), at(i + 1, j + 1));
                    bar(at(i + 1, j), at(i, j + 1));
                }
            }
        }
        rows
    }

    /// The normal matrix in each storage.
    fn normal_matrices(&self) -> [NormalMatrix; 2] {
        [Storage::Sparse, Storage::Supernodal].map(|storage| {
            let points = self.points.iter().map(Vec::as_slice);
            self.filled(NormalMatrix::with_storage(storage, self.n_points, points))
        })
    }

    /// The normal matrix in the storage that suits it.
    fn normal_matrix(&self) -> NormalMatrix {
        self.filled(NormalMatrix::new(self.n_points, self.points.iter().map(Vec::as_slice)))
    }

    fn filled(&self, mut normal: NormalMatrix) -> NormalMatrix {
        for (row_idx, values) in self.values.iter().enumerate() {
            normal.add_row(row_idx, values);
        }
        normal
    }

    fn jacobian(&self) -> DMatrix<f64> {
        let mut jacobian = DMatrix::zeros(self.points.len(), 2 * self.n_points);
        for (row_idx, (points, values)) in self.points.iter().zip(&self.values).enumerate() {
            for (p, v) in points.iter().zip(values.chunks(2)) {
                jacobian[(row_idx, 2 * *p as usize)] = v[0];
                jacobian[(row_idx, 2 * *p as usize + 1)] = v[1];
            }
        }
        jacobian
    }
}

/// The factor solves the system, and counts the negative eigenvalues, that dense algebra has.
fn check(rows: &Rows, mu: f64) {
    let jacobian = rows.jacobian();
    let n = 2 * rows.n_points;
    let full = jacobian.transpose() * &jacobian + DMatrix::identity(n, n) * mu;
    let mut random = Random(n as u64);
    let expected = DVector::from_fn(n, |_, _| random.number());
    let rhs = &full * &expected;
    let n_negative = full.symmetric_eigenvalues().iter().filter(|&&e| e < 0.0).count();
    for mut normal in rows.normal_matrices() {
        let case = format!("{:?}, {n} unknowns, mu {mu}", normal.storage());
        let pivots = normal.factor(mu);
        assert_eq!(pivots.n_negative, n_negative, "{case}");
        let mut solution = rhs.as_slice().to_vec();
        normal.solve(&mut solution);
        let error = (DVector::from_vec(solution) - &expected).amax();
        assert!(error < 1e-14 * n as f64 / mu.abs().min(1.0), "{case}: error {error:e}");
    }
}

#[test]
fn random_patterns_solve_like_dense_algebra() {
    let mut random = Random(1);
    for n_points in (1..12).chain([15, 20, 24, 25, 30, 40, 60]) {
        for density in 1..4 {
            let rows = Rows::random(n_points, density * n_points, 4 + density, &mut random);
            for mu in [1.0, 1e-3, 1e-6, -0.05] {
                check(&rows, mu);
            }
        }
    }
}

#[test]
fn nets_solve_like_dense_algebra() {
    let mut random = Random(2);
    for n in [1, 2, 3, 4, 6, 9] {
        check(&Rows::net(n, &mut random), 1e-4);
    }
}

#[test]
fn a_hub_that_everything_holds_comes_last_and_costs_no_fill() {
    let mut random = Random(3);
    let mut rows = Rows { n_points: 301, ..Rows::default() };
    for p in 1..=300 {
        rows.push(&[0, p], &[random.number(), random.number(), random.number(), random.number()]);
    }
    check(&rows, 1e-3);
}

#[test]
fn renumbering_the_points_changes_nothing_but_rounding() {
    let mut random = Random(4);
    let rows = Rows::random(50, 120, 6, &mut random);
    let mut renumbered: Vec<u32> = (0..50).collect();
    for k in (1..50).rev() {
        renumbered.swap(k, random.index(k + 1));
    }
    let mut moved = rows.clone();
    for p in moved.points.iter_mut().flatten() {
        *p = renumbered[*p as usize];
    }
    let rhs: Vec<f64> = (0..100).map(|_| random.number()).collect();
    let mut moved_rhs = vec![0.0; 100];
    for (p, &q) in renumbered.iter().enumerate() {
        moved_rhs[2 * q as usize..][..2].copy_from_slice(&rhs[2 * p..][..2]);
    }
    let solve = |rows: &Rows, mut rhs: Vec<f64>| {
        let mut normal = rows.normal_matrix();
        normal.factor(1e-2);
        normal.solve(&mut rhs);
        rhs
    };
    let (here, there) = (solve(&rows, rhs), solve(&moved, moved_rhs));
    for (p, &q) in renumbered.iter().enumerate() {
        for c in 0..2 {
            assert!((here[2 * p + c] - there[2 * q as usize + c]).abs() < 1e-11);
        }
    }
}

#[test]
fn nullity_counts_singular_values_of_zero() {
    let mut random = Random(5);
    for n_points in [3, 8, 20, 30, 45] {
        let mut rows = Rows::random(n_points, n_points, 5, &mut random);
        // Repeated rows: dependent, whatever the rest.
        for k in 0..n_points / 2 {
            let (points, values) = (rows.points[k].clone(), rows.values[k].clone());
            rows.push(&points, &values);
        }
        let rank = rows.jacobian().rank(1e-9);
        for tau in [1e-12, 1e-10, 1e-8] {
            assert_eq!(rows.normal_matrix().nullity(tau), 2 * n_points - rank, "{n_points}");
        }
    }
}

#[test]
fn what_nothing_acts_on_does_not_move() {
    for n_points in [1, 5, 40] {
        let points: Vec<[u32; 2]> = (1..n_points).map(|p| [p - 1, p]).collect();
        let mut normal =
            NormalMatrix::new(n_points as usize, points.iter().map(<[u32; 2]>::as_slice));
        let mut rhs = vec![1.0; 2 * n_points as usize];
        normal.factor(0.5);
        normal.solve(&mut rhs);
        assert!(rhs.iter().all(|&v| v == 2.0));
        let pivots = normal.factor(0.0);
        normal.solve(&mut rhs);
        assert!(rhs.iter().all(|&v| v == 0.0));
        assert_eq!((pivots.smallest, pivots.largest), (0.0, 0.0));
    }
}

#[test]
fn clearing_forgets_to_the_bit() {
    let mut random = Random(6);
    for n_points in [6, 40, 500] {
        let rows = Rows::random(n_points, 2 * n_points, 5, &mut random);
        let mut normal = rows.normal_matrix();
        let mut first = vec![1.0; 2 * n_points];
        normal.factor(1e-3);
        normal.solve(&mut first);
        normal.factor(7.0);
        normal.clear();
        for (row_idx, values) in rows.values.iter().enumerate() {
            normal.add_row(row_idx, values);
        }
        let mut second = vec![1.0; 2 * n_points];
        normal.factor(1e-3);
        normal.solve(&mut second);
        assert_eq!(first, second);
    }
}

#[test]
fn rows_join_the_basis_while_they_raise_the_rank() {
    let mut random = Random(7);
    for n_points in [2, 5, 12, 25] {
        let mut rows = Rows::random(n_points, 2 * n_points, 5, &mut random);
        // Some repeated, some the sum of two others on the same points.
        for k in 0..n_points {
            let (points, values) = (rows.points[k].clone(), rows.values[k].clone());
            let other: Vec<f64> = values.iter().map(|_| random.number()).collect();
            let sum: Vec<f64> = values.iter().zip(&other).map(|(a, b)| 0.5 * (a + b)).collect();
            rows.push(&points, &other);
            rows.push(&points, &sum);
        }
        let jacobian = rows.jacobian();
        let mut basis = RowBasis::new(n_points, rows.points.iter().map(Vec::as_slice), 1e-9);
        for row_idx in 0..rows.points.len() {
            let (points, values) = (&rows.points[row_idx], &rows.values[row_idx]);
            let before = jacobian.rows(0, row_idx).into_owned();
            let rank = if row_idx == 0 { 0 } else { before.rank(1e-9) };
            let raises = jacobian.rows(0, row_idx + 1).into_owned().rank(1e-9) > rank;
            assert_eq!(basis.insert(points, values), raises, "row {row_idx} of {n_points} points");
        }
    }
}

#[test]
fn no_points_and_rows_without_points_are_nothing() {
    let empty: [&[u32]; 2] = [&[], &[]];
    for storage in [Storage::Sparse, Storage::Supernodal] {
        for n_points in [0, 3] {
            let mut normal = NormalMatrix::with_storage(storage, n_points, empty.into_iter());
            normal.add_row(1, &[]);
            assert_eq!(normal.nullity(1e-10), 2 * n_points);
            normal.factor(1.0);
            let mut rhs = vec![3.0; 2 * n_points];
            normal.solve(&mut rhs);
            assert_eq!(rhs, vec![3.0; 2 * n_points]);
        }
    }
    assert!(!RowBasis::new(2, empty.into_iter(), 1e-9).insert(&[], &[]));
}
