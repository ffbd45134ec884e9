//! Products of dense panels, in tiles that stay in registers.
//!
//! Columns follow each other at a distance of `ld` numbers. Every entry is summed in the same
//! order whatever the tile, so the bits do not depend on how the loops are vectorised.

// They become part of a function that may use wider vectors than the rest of the program.
#![allow(clippy::inline_always)]

use super::block::Pivots;

/// Rows of a tile.
const TALL: usize = 8;
/// Columns of a tile.
const WIDE: usize = 4;

/// A dense panel: columns of numbers at a distance of `ld`.
#[derive(Clone, Copy)]
pub struct Panel<'a> {
    /// The numbers.
    pub numbers: &'a [f64],
    /// From one column to the next.
    pub ld: usize,
}

/// Subtracts `a b^T` from the lower trapezoid of `c`: rows `j..n_rows` of each column `j`.
///
/// `a` has `n_rows` rows, `b` has `n_columns`, both have `depth` columns. Some entries above the
/// diagonal are changed too.
#[inline(always)]
pub fn subtract_product(
    c: &mut [f64],
    ldc: usize,
    a: Panel,
    b: Panel,
    [n_rows, n_columns, depth]: [usize; 3],
) {
    let mut j = 0;
    while j < n_columns {
        let wide = if n_columns - j >= WIDE { WIDE } else { 2 };
        let mut i = j;
        while i < n_rows {
            let c = &mut c[j * ldc + i..];
            let (a, b) = (a.from(i), b.from(j));
            let left = n_rows - i;
            let tall = if left >= TALL {
                TALL
            } else if left >= 4 {
                4
            } else {
                2
            };
            match (tall, wide) {
                (TALL, WIDE) => tile::<TALL, WIDE>(c, ldc, a, b, depth),
                (4, WIDE) => tile::<4, WIDE>(c, ldc, a, b, depth),
                (2, WIDE) => tile::<2, WIDE>(c, ldc, a, b, depth),
                (TALL, _) => tile::<TALL, 2>(c, ldc, a, b, depth),
                (4, _) => tile::<4, 2>(c, ldc, a, b, depth),
                _ => tile::<2, 2>(c, ldc, a, b, depth),
            }
            i += tall;
        }
        j += wide;
    }
}

impl<'a> Panel<'a> {
    /// The panel without its first `row` rows.
    pub fn from(self, row: usize) -> Self {
        Self { numbers: self.numbers.get(row..).unwrap_or(&[]), ld: self.ld }
    }

    #[inline(always)]
    fn column<const N: usize>(self, p: usize) -> &'a [f64; N] {
        self.numbers[p * self.ld..].first_chunk().expect("a tile lies inside its panel")
    }
}

#[inline(always)]
fn tile<const R: usize, const C: usize>(
    c: &mut [f64],
    ldc: usize,
    a: Panel,
    b: Panel,
    depth: usize,
) {
    let mut sum = [[0.0; R]; C];
    for p in 0..depth {
        let a = a.column::<R>(p);
        let b = b.column::<C>(p);
        for j in 0..C {
            for i in 0..R {
                sum[j][i] += a[i] * b[j];
            }
        }
    }
    for (j, sum) in sum.iter().enumerate() {
        for (c, s) in c[j * ldc..][..R].iter_mut().zip(sum) {
            *c -= s;
        }
    }
}

/// Columns factored one by one before their product is subtracted from the others.
const STRIP: usize = 8;

/// Factors the first `n_pivots` columns of a symmetric matrix with `n_rows` rows, given below
/// the diagonal: on return `l` holds L below the diagonal and 1 / D on it, `z` holds L D.
#[inline(always)]
pub fn factor_panel(
    l: &mut [f64],
    z: &mut [f64],
    n_rows: usize,
    n_pivots: usize,
    pivots: &mut Pivots,
) {
    let ld = n_rows;
    for start in (0..n_pivots).step_by(STRIP) {
        let end = (start + STRIP).min(n_pivots);
        let (done, rest) = l.split_at_mut(start * ld);
        subtract_product(
            &mut rest[start..],
            ld,
            Panel { numbers: done, ld }.from(start),
            Panel { numbers: &z[..start * ld], ld }.from(start),
            [n_rows - start, end - start, start],
        );
        for j in start..end {
            let (column, later) = l[j * ld..end * ld].split_at_mut(ld);
            let reciprocal = pivots.note(column[j]);
            for (k, target) in (j + 1..end).zip(later.chunks_exact_mut(ld)) {
                let l = column[k] * reciprocal;
                for (t, c) in target[k..].iter_mut().zip(&column[k..]) {
                    *t -= l * c;
                }
            }
            z[j * ld + j + 1..(j + 1) * ld].copy_from_slice(&column[j + 1..]);
            for c in &mut column[j + 1..] {
                *c *= reciprocal;
            }
            column[j] = reciprocal;
        }
    }
}
