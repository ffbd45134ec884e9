//! The linear algebra of an island: J^T J + mu I, gathered from rows, factored, solved.
//!
//! The unknowns are pairs, the two coordinates of a point. Which points share a row is fixed
//! when the island is built; only numbers change after that, so ordering, fill and every place
//! a number goes to are worked out once and neither assembling, factoring nor solving
//! allocates. A frozen point is one whose values are 0 in every row, an inactive inequality a
//! row of zeros. No result depends on threads or on the machine's vector width.

mod block;
mod dense;
mod elimination;
mod graph;
mod normal;
mod order;
mod sparse;

pub use block::Pivots;
use dense::Dense;
use graph::{Graph, Lists, lower_triangle};
use normal::Normal;
use sparse::Sparse;

/// J^T J and its factor.
///
/// ```
/// use linkwork::solve::linear::NormalMatrix;
///
/// // One bar between two points, at rest along x: J = (-1, 0, 1, 0).
/// let bar: &[u32] = &[0, 1];
/// let mut normal = NormalMatrix::new(2, [bar].into_iter());
/// normal.add_row(0, &[-1.0, 0.0, 1.0, 0.0]);
/// assert_eq!(normal.nullity(1e-10), 3);
///
/// // It is to become 0.5 longer; both ends share the move.
/// normal.factor(1e-6);
/// let mut rhs = [-0.5, 0.0, 0.5, 0.0];
/// normal.solve(&mut rhs);
/// assert!((rhs[2] - 0.25).abs() < 1e-6);
/// ```
pub struct NormalMatrix {
    normal: Normal,
    factor: Factor,
}

enum Factor {
    Dense(Dense),
    Sparse { sparse: Sparse, order: Vec<u32>, ordered: Vec<f64> },
}

impl NormalMatrix {
    /// The matrix of `n_points` points that nothing acts on yet; each of `rows` lists the
    /// points of a row of J, each point once.
    pub fn new<'a>(n_points: usize, rows: impl Iterator<Item = &'a [u32]> + Clone) -> Self {
        let graph = Graph::new(n_points, rows.clone());
        let (order, lower, columns) = analyse(&graph);
        if is_better_dense(n_points, &columns) {
            let order: Vec<u32> = (0..n_points as u32).collect();
            let normal = Normal::new(&lower_triangle(&graph, &order), &order, rows);
            return Self { normal, factor: Factor::Dense(Dense::new(n_points)) };
        }
        let normal = Normal::new(&lower, &order, rows);
        let ordered = vec![0.0; 2 * n_points];
        Self { normal, factor: Factor::Sparse { sparse: Sparse::new(columns), order, ordered } }
    }

    /// How many unknowns there are: two for each point.
    pub fn n_unknowns(&self) -> usize {
        2 * self.normal.len()
    }

    /// Forgets all rows added.
    pub fn clear(&mut self) {
        self.normal.clear();
    }

    /// Adds the outer product of row `row_idx` with itself; `values` are its derivatives by
    /// (x, y) of each of its points, in the order they were given to [`NormalMatrix::new`]. A
    /// row may be added several times, with different values.
    pub fn add_row(&mut self, row_idx: usize, values: &[f64]) {
        self.normal.add_row(row_idx, values);
    }

    /// Factors J^T J + `mu` I into L D L^T.
    pub fn factor(&mut self, mu: f64) -> Pivots {
        match &mut self.factor {
            Factor::Dense(dense) => dense.factor(&self.normal, mu),
            Factor::Sparse { sparse, .. } => sparse.factor(&self.normal, mu),
        }
    }

    /// Replaces `rhs`, (x, y) for each point, by the solution for the last factor.
    pub fn solve(&mut self, rhs: &mut [f64]) {
        assert_eq!(rhs.len(), self.n_unknowns(), "a right-hand side has two values for each point");
        match &mut self.factor {
            Factor::Dense(dense) => dense.solve(rhs),
            Factor::Sparse { sparse, order, ordered } => {
                for (to, &p) in ordered.as_chunks_mut::<2>().0.iter_mut().zip(&*order) {
                    *to = [rhs[2 * p as usize], rhs[2 * p as usize + 1]];
                }
                sparse.solve(ordered);
                for (from, &p) in ordered.as_chunks::<2>().0.iter().zip(&*order) {
                    [rhs[2 * p as usize], rhs[2 * p as usize + 1]] = *from;
                }
            }
        }
    }

    /// How many independent motions of the points leave every row unchanged: the eigenvalues
    /// of J^T J below `tau`, counted by the signs of the pivots of J^T J - `tau` I.
    ///
    /// With rows of length 1 any `tau` from 1e-14 to 1e-6 gives the same count on sound scenes;
    /// 1e-10 lies in the middle.
    pub fn nullity(&mut self, tau: f64) -> usize {
        self.factor(-tau).n_negative
    }
}

/// An elimination order that follows its own tree, the lower triangle and the fill in it.
fn analyse(graph: &Graph) -> (Vec<u32>, Lists, Lists) {
    let order = order::minimum_degree(graph);
    let parent = elimination::tree(&lower_triangle(graph, &order));
    let order: Vec<u32> =
        elimination::postorder(&parent).iter().map(|&k| order[k as usize]).collect();
    let lower = lower_triangle(graph, &order);
    let parent = elimination::tree(&lower);
    let columns = elimination::fill(&lower, &parent);
    (order, lower, columns)
}

/// Whether the full matrix is factored faster than its fill, which costs indices.
fn is_better_dense(n_points: usize, columns: &Lists) -> bool {
    n_points <= 8 || (n_points <= 24 && 4 * columns.n_items() > n_points * (n_points - 1))
}
