//! Products of dense panels, in tiles that stay in registers.
//!
//! Columns follow each other at a distance of `ld` numbers. Every entry is summed in the same
//! order whatever the tile, so the bits do not depend on how the loops are vectorised.

// They become part of a function that may use wider vectors than the rest of the program.
#![allow(clippy::inline_always)]

use super::block::Pivots;
use crate::interrupt::tick;

/// Rows of a tile.
const TALL: usize = 8;
/// Columns of a tile.
pub const WIDE: usize = 4;

/// A dense panel: columns of numbers at a distance of `ld`.
#[derive(Clone, Copy)]
pub struct Panel<'a> {
    /// The numbers.
    pub numbers: &'a [f64],
    /// From one column to the next.
    pub ld: usize,
}

/// Subtracts `l D l^T` from the lower trapezoid of `c`: rows `j..n_rows` of each of `n_columns`
/// columns `j`.
///
/// `l` has `n_rows` rows and a column for each number of the diagonal `d`; `packed` is room for
/// [`WIDE`] times as many numbers. Some entries above the diagonal are changed too.
#[inline(always)]
pub fn subtract_product(
    c: &mut [f64],
    ldc: usize,
    l: Panel,
    d: &[f64],
    packed: &mut [f64],
    [n_rows, n_columns]: [usize; 2],
) {
    let mut j = 0;
    while j < n_columns {
        // A product of this many numbers takes about a nanosecond for each eight.
        tick(d.len() * (n_rows - j) / 2);
        if n_columns - j >= WIDE {
            strip::<WIDE>(&mut c[j * ldc..], ldc, l, d, packed, [j, n_rows]);
            j += WIDE;
        } else {
            strip::<2>(&mut c[j * ldc..], ldc, l, d, packed, [j, n_rows]);
            j += 2;
        }
    }
}

/// The same for the columns from `j` on that one tile spans.
#[inline(always)]
fn strip<const C: usize>(
    c: &mut [f64],
    ldc: usize,
    l: Panel,
    d: &[f64],
    packed: &mut [f64],
    [j, n_rows]: [usize; 2],
) {
    // What each tile multiplies with lies together: D l^T for these columns.
    let (packed, _) = packed.as_chunks_mut::<C>();
    let packed = &mut packed[..d.len()];
    let beginning = l.from(j);
    for (p, (packed, d)) in packed.iter_mut().zip(d).enumerate() {
        *packed = beginning.column::<C>(p).map(|l| l * d);
    }
    let mut i = j;
    while i < n_rows {
        let c = &mut c[i..];
        let a = l.from(i);
        let left = n_rows - i;
        i += if left >= TALL {
            tile::<TALL, C>(c, ldc, a, packed);
            TALL
        } else if left >= 4 {
            tile::<4, C>(c, ldc, a, packed);
            4
        } else {
            tile::<2, C>(c, ldc, a, packed);
            2
        };
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
fn tile<const R: usize, const C: usize>(c: &mut [f64], ldc: usize, a: Panel, b: &[[f64; C]]) {
    let mut sum = [[0.0; R]; C];
    for (p, b) in b.iter().enumerate() {
        let a = a.column::<R>(p);
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

/// Factors the first columns of a symmetric matrix with `n_rows` rows, given below the diagonal,
/// as many as `d` has room for: on return `l` holds L below the diagonal and 1 / D on it, `d`
/// holds D. `packed` is room for [`WIDE`] times as many numbers as `d`.
#[inline(always)]
pub fn factor_panel(
    l: &mut [f64],
    d: &mut [f64],
    packed: &mut [f64],
    n_rows: usize,
    pivots: &mut Pivots,
) {
    let ld = n_rows;
    for start in (0..d.len()).step_by(STRIP) {
        let end = (start + STRIP).min(d.len());
        let (done, rest) = l.split_at_mut(start * ld);
        subtract_product(
            &mut rest[start..],
            ld,
            Panel { numbers: done, ld }.from(start),
            &d[..start],
            packed,
            [n_rows - start, end - start],
        );
        for j in start..end {
            let (column, later) = l[j * ld..end * ld].split_at_mut(ld);
            d[j] = column[j];
            let reciprocal = pivots.note(d[j]);
            for (k, target) in (j + 1..end).zip(later.chunks_exact_mut(ld)) {
                let l = column[k] * reciprocal;
                for (t, c) in target[k..].iter_mut().zip(&column[k..]) {
                    *t -= l * c;
                }
            }
            for c in &mut column[j + 1..] {
                *c *= reciprocal;
            }
            column[j] = reciprocal;
        }
    }
}
