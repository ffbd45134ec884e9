//! The numbers of J^T J, gathered row by row into the lower triangle in elimination order.

use super::block::Block;
use super::graph::{Lists, inverse};

/// The lower triangle of J^T J by blocks, and where each row of J adds to it.
pub struct Normal {
    /// For each place the earlier places it is coupled with, ascending, then itself.
    pattern: Lists,
    blocks: Vec<Block>,
    /// For each row its points in elimination order, as positions within the row.
    terms: Lists,
    /// For each row the blocks of its pairs of points, in the order `add_row` meets them.
    targets: Lists,
}

impl Normal {
    /// `lower` is the strictly lower triangle for `order`; `rows` are the points of each row.
    pub fn new<'a>(lower: &Lists, order: &[u32], rows: impl Iterator<Item = &'a [u32]>) -> Self {
        let mut pattern = Lists::new();
        for k in 0..lower.len() {
            pattern.push(lower.get(k).iter().copied().chain([k as u32]));
        }
        let pattern = pattern.shrunk();
        let place = inverse(order);
        let mut terms = Lists::new();
        let mut targets = Lists::new();
        let mut sorted = Vec::new();
        for row in rows {
            sorted.clear();
            sorted.extend(row.iter().enumerate().map(|(t, &p)| (place[p as usize], t as u32)));
            sorted.sort_unstable();
            terms.push(sorted.iter().map(|&(_, t)| t));
            targets.push(sorted.iter().enumerate().flat_map(|(n, &(later, _))| {
                let range = pattern.range(later as usize);
                let pattern = &pattern;
                sorted[..=n].iter().map(move |(earlier, _)| {
                    let places = &pattern.items()[range.clone()];
                    let at = places.binary_search(earlier).expect("each pair of a row is coupled");
                    (range.start + at) as u32
                })
            }));
        }
        let blocks = vec![Block::default(); pattern.n_items()];
        Self { pattern, blocks, terms: terms.shrunk(), targets: targets.shrunk() }
    }

    /// Sets all numbers to 0.
    pub fn clear(&mut self) {
        self.blocks.fill(Block::default());
    }

    /// Adds the outer product of a row with itself; `values` holds (x, y) for each of its points.
    pub fn add_row(&mut self, row_idx: usize, values: &[f64]) {
        let terms = self.terms.get(row_idx);
        let (values, _) = values.as_chunks::<2>();
        assert_eq!(values.len(), terms.len(), "a row has two values for each of its points");
        let mut targets = self.targets.get(row_idx).iter();
        for (n, &b) in terms.iter().enumerate() {
            let b = values[b as usize];
            for (&a, &target) in terms[..=n].iter().zip(&mut targets) {
                let a = values[a as usize];
                let block = &mut self.blocks[target as usize];
                block[0] += b[0] * a[0];
                block[1] += b[0] * a[1];
                block[2] += b[1] * a[0];
                block[3] += b[1] * a[1];
            }
        }
    }

    /// Adds a symmetric matrix over the points of a row; `matrix` holds it row by row, (x, y) for
    /// each of its points.
    pub fn add_symmetric(&mut self, row_idx: usize, matrix: &[f64]) {
        let terms = self.terms.get(row_idx);
        let n = 2 * terms.len();
        assert_eq!(matrix.len(), n * n, "a matrix has a row and a column for each coordinate");
        let mut targets = self.targets.get(row_idx).iter();
        for (k, &b) in terms.iter().enumerate() {
            let b = 2 * b as usize;
            for (&a, &target) in terms[..=k].iter().zip(&mut targets) {
                let a = 2 * a as usize;
                let block = &mut self.blocks[target as usize];
                block[0] += matrix[n * b + a];
                block[1] += matrix[n * b + a + 1];
                block[2] += matrix[n * (b + 1) + a];
                block[3] += matrix[n * (b + 1) + a + 1];
            }
        }
    }

    /// How many places there are.
    pub fn len(&self) -> usize {
        self.pattern.len()
    }

    /// Block `n` of all, row by row in the order of [`Normal::row`].
    pub fn block(&self, n: usize) -> &Block {
        &self.blocks[n]
    }

    /// The blocks of place `k` with the places they couple it with, its own block last.
    pub fn row(&self, k: usize) -> impl Iterator<Item = (usize, &Block)> {
        let range = self.pattern.range(k);
        self.pattern.items()[range.clone()]
            .iter()
            .zip(&self.blocks[range])
            .map(|(&i, block)| (i as usize, block))
    }
}
