//! Which rows depend on earlier ones: a sparse triangular factor that rows are rotated into.

use super::elimination::{self, ROOT};
use super::graph::{Graph, Lists, inverse, lower_triangle};
use super::order::minimum_degree;
use crate::interrupt::tick;

/// An entry smaller than this is the rounding of a 0: not worth a rotation.
const NOISE: f64 = 1e-15;

/// The rows seen so far, as the triangular factor R of J = Q R.
///
/// Rows may come in any order, here that of creation, while the columns keep one with little
/// fill (George and Heath, "Solution of sparse linear least squares problems using Givens
/// rotations", Linear Algebra Appl. 34, 1980). Rotations are stable whatever the rank.
pub struct RowBasis {
    /// The place of each point in elimination order.
    place: Vec<u32>,
    parent: Vec<u32>,
    /// For each place the later places that its rows of R hold.
    reach: Lists,
    /// The two rows of R of each place: numbers for the place itself and those it reaches.
    rows: Vec<[Option<Vec<[f64; 2]>>; 2]>,
    /// The row at work, by places; 0 between rows.
    work: Vec<[f64; 2]>,
    /// What may be left of a dependent row.
    tolerance: f64,
}

impl RowBasis {
    /// No rows yet; each of `rows` lists the points of a row that may come.
    ///
    /// A row is dependent if, of its length 1, no more than `tolerance` is left once all that
    /// earlier rows account for is rotated away. Dependent rows of sound scenes leave less
    /// than 1e-12, independent ones more than 1e-2.
    pub fn new<'a>(n_points: usize, rows: impl Iterator<Item = &'a [u32]>, tolerance: f64) -> Self {
        let graph = Graph::new(n_points, rows);
        let order = minimum_degree(&graph);
        let lower = lower_triangle(&graph, &order);
        let parent = elimination::tree(&lower);
        let reach = elimination::fill(&lower, &parent).transposed();
        let rows = vec![[None, None]; n_points];
        let work = vec![[0.0; 2]; n_points];
        Self { place: inverse(&order), parent, reach, rows, work, tolerance }
    }

    /// Adds a row of length 1, with (x, y) in `values` for each of its `points`; false if it
    /// depends on those added before, which changes nothing but rounding.
    pub fn insert(&mut self, points: &[u32], values: &[f64]) -> bool {
        let mut first = ROOT;
        for (&point, &value) in points.iter().zip(values.as_chunks::<2>().0) {
            let place = self.place[point as usize];
            self.work[place as usize] = value;
            first = first.min(place);
        }
        // All the row holds, or will hold, lies on the way from its first place to the root.
        while first != ROOT {
            let place = first as usize;
            tick(2 * self.reach.get(place).len());
            for half in 0..2 {
                if self.work[place][half].abs() < NOISE {
                    self.work[place][half] = 0.0;
                } else if let Some(row) = &mut self.rows[place][half] {
                    rotate(row, &mut self.work, place, self.reach.get(place), half);
                } else if self.is_nothing_left(place) {
                    self.discard(place);
                    return false;
                } else if self.work[place][half].abs() <= self.tolerance {
                    self.work[place][half] = 0.0;
                } else {
                    let places = [place].into_iter().chain(self.reach_of(place));
                    let row: Vec<_> = places.map(|p| self.work[p]).collect();
                    self.rows[place][half] = Some(row);
                    self.discard(place);
                    return true;
                }
            }
            first = self.parent[place];
        }
        false
    }

    fn reach_of(&self, place: usize) -> impl Iterator<Item = usize> {
        self.reach.get(place).iter().map(|&p| p as usize)
    }

    fn is_nothing_left(&self, place: usize) -> bool {
        let places = [place].into_iter().chain(self.reach_of(place));
        let squared: f64 = places.flat_map(|p| self.work[p]).map(|v| v * v).sum();
        squared <= self.tolerance * self.tolerance
    }

    fn discard(&mut self, place: usize) {
        self.work[place] = [0.0; 2];
        for &p in self.reach.get(place) {
            self.work[p as usize] = [0.0; 2];
        }
    }
}

/// Turns a row of R and the row at work in their plane until the latter is 0 at `half`.
fn rotate(row: &mut [[f64; 2]], work: &mut [[f64; 2]], place: usize, reach: &[u32], half: usize) {
    let (a, b) = (row[0][half], work[place][half]);
    let r = libm::hypot(a, b);
    let (c, s) = (a / r, b / r);
    let turn = |row: &mut f64, work: &mut f64| {
        (*row, *work) = (c * *row + s * *work, c * *work - s * *row);
    };
    for k in half..2 {
        turn(&mut row[0][k], &mut work[place][k]);
    }
    work[place][half] = 0.0;
    for (row, &p) in row[1..].iter_mut().zip(reach) {
        let work = &mut work[p as usize];
        turn(&mut row[0], &mut work[0]);
        turn(&mut row[1], &mut work[1]);
    }
}
