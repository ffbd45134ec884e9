//! L D L^T row by row, for chains, trees and meshes of moderate size.

use super::block::{Block, Pivots};
use super::graph::Lists;
use super::normal::Normal;
use crate::interrupt::tick;

/// So many products of blocks are worth a tick.
const MANY: usize = 1 << 14;

/// What the elimination of a point takes beside its products, in ticks.
const POINT: usize = 20;

/// A factor by columns of blocks, with room for its fill; nothing is allocated per factor.
pub struct Sparse {
    /// The columns of each row of L, ascending.
    columns: Lists,
    /// The rows of each column of L, ascending.
    rows: Lists,
    /// L by columns, without its diagonal blocks.
    blocks: Vec<Block>,
    /// The diagonal block of L and D of each place.
    diagonal: Vec<Diagonal>,
    /// Where the next row enters each column.
    next: Vec<u32>,
    /// The row at work, by columns; 0 between rows.
    work: Vec<Block>,
}

/// [1 0; l 1] and the reciprocals of the two pivots.
#[derive(Clone, Copy, Default)]
struct Diagonal {
    l: f64,
    reciprocals: [f64; 2],
}

impl Sparse {
    /// `columns` is the pattern of L by rows.
    pub fn new(columns: Lists) -> Self {
        let columns = columns.shrunk();
        let n = columns.len();
        let rows = columns.transposed();
        Self {
            blocks: vec![Block::default(); rows.n_items()],
            columns,
            rows,
            diagonal: vec![Diagonal::default(); n],
            next: vec![0; n],
            work: vec![Block::default(); n],
        }
    }

    /// How many numbers the factor stores.
    pub fn n_stored(&self) -> usize {
        4 * self.blocks.len() + 3 * self.diagonal.len()
    }

    /// Factors `normal + mu I`.
    ///
    /// Row k of L from those above: `Z_ki = A_ki - sum_j<i Z_kj L_ij^T`, `L_ki = Z_ki / D_i`,
    /// `D_k = A_kk - sum_i L_ki Z_ki^T` (T. Davis, "Algorithm 849: LDL", ACM TOMS 31, 2005).
    pub fn factor(&mut self, normal: &Normal, mu: f64) -> Pivots {
        let mut pivots = Pivots::NONE;
        let mut n_products = 0;
        for k in 0..self.diagonal.len() {
            if n_products > MANY {
                tick(std::mem::take(&mut n_products));
            }
            for (i, block) in normal.row(k) {
                self.work[i] = *block;
            }
            let [mut d00, _, mut d10, mut d11] = std::mem::take(&mut self.work[k]);
            self.next[k] = self.rows.range(k).start as u32;
            for &i in self.columns.get(k) {
                let i = i as usize;
                let y = std::mem::take(&mut self.work[i]);
                let Diagonal { l, reciprocals: [r0, r1] } = self.diagonal[i];
                let z = [y[0], y[1] - l * y[0], y[2], y[3] - l * y[2]];
                let (start, end) = (self.rows.range(i).start, self.next[i] as usize);
                n_products += end - start + 1;
                for (&j, b) in self.rows.items()[start..end].iter().zip(&self.blocks[start..end]) {
                    let target = &mut self.work[j as usize];
                    target[0] -= z[0] * b[0] + z[1] * b[1];
                    target[1] -= z[0] * b[2] + z[1] * b[3];
                    target[2] -= z[2] * b[0] + z[3] * b[1];
                    target[3] -= z[2] * b[2] + z[3] * b[3];
                }
                let entry = [z[0] * r0, z[1] * r1, z[2] * r0, z[3] * r1];
                d00 -= entry[0] * z[0] + entry[1] * z[1];
                d10 -= entry[2] * z[0] + entry[3] * z[1];
                d11 -= entry[2] * z[2] + entry[3] * z[3];
                self.blocks[end] = entry;
                self.next[i] += 1;
            }
            let r0 = pivots.note(d00 + mu);
            let l = d10 * r0;
            let r1 = pivots.note(d11 + mu - l * d10);
            self.diagonal[k] = Diagonal { l, reciprocals: [r0, r1] };
        }
        tick(n_products + POINT * self.diagonal.len());
        pivots
    }

    /// Replaces the right-hand side, in elimination order, by the solution.
    pub fn solve(&self, rhs: &mut [f64]) {
        let (rhs, _) = rhs.as_chunks_mut::<2>();
        for k in 0..self.diagonal.len() {
            let y = &mut rhs[k];
            y[1] -= self.diagonal[k].l * y[0];
            let y = *y;
            let range = self.rows.range(k);
            for (&j, b) in self.rows.get(k).iter().zip(&self.blocks[range]) {
                let target = &mut rhs[j as usize];
                target[0] -= b[0] * y[0] + b[1] * y[1];
                target[1] -= b[2] * y[0] + b[3] * y[1];
            }
        }
        for k in (0..self.diagonal.len()).rev() {
            let Diagonal { l, reciprocals } = self.diagonal[k];
            let mut y = [rhs[k][0] * reciprocals[0], rhs[k][1] * reciprocals[1]];
            let range = self.rows.range(k);
            for (&j, b) in self.rows.get(k).iter().zip(&self.blocks[range]) {
                let x = rhs[j as usize];
                y[0] -= b[0] * x[0] + b[2] * x[1];
                y[1] -= b[1] * x[0] + b[3] * x[1];
            }
            y[0] -= l * y[1];
            rhs[k] = y;
        }
    }
}
