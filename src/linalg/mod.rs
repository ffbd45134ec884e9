//! The linear algebra of an island: J^T J + mu I, gathered from rows, factored, solved.
//!
//! The unknowns are pairs, the two coordinates of a point. Which points share a row is fixed
//! when the island is built; only numbers change after that, so ordering, fill and every place
//! a number goes to are worked out once and neither assembling, factoring nor solving
//! allocates. A frozen point is one whose values are 0 in every row, an inactive inequality a
//! row of zeros. No result depends on threads or on the machine's vector width.

mod block;
mod disjoint_sets;
mod elimination;
mod graph;
mod kernel;
mod normal;
mod order;
mod orthogonal;
mod sparse;
mod square;
mod supernodal;

pub use block::Pivots;
pub use disjoint_sets::DisjointSets;
use graph::{Graph, Lists, lower_triangle};
use normal::Normal;
pub use orthogonal::RowBasis;
use sparse::Sparse;
pub use square::{MOST_UNKNOWNS, Square};
use supernodal::Supernodal;

/// J^T J and its factor.
///
/// ```
/// use linkwork::linalg::NormalMatrix;
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
    /// The points in elimination order, and room for a right-hand side in it.
    order: Vec<u32>,
    ordered: Vec<f64>,
}

/// How the factor of a [`NormalMatrix`] is stored and computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Storage {
    /// Row by row, block by block: mechanisms, chains, trees, small nets.
    Sparse,
    /// By dense fronts: large nets.
    Supernodal,
}

enum Factor {
    Sparse(Sparse),
    Supernodal(Supernodal),
}

impl NormalMatrix {
    /// The matrix of `n_points` points that nothing acts on yet, stored as suits its pattern;
    /// each of `rows` lists the points of a row of J, each point once.
    pub fn new<'a>(n_points: usize, rows: impl Iterator<Item = &'a [u32]> + Clone) -> Self {
        let analysis = SymbolicAnalysis::new(&Graph::new(n_points, rows.clone()));
        let storage = analysis.suitable_storage();
        Self::stored(storage, analysis, rows)
    }

    /// The same with a storage of the caller's choice.
    pub fn with_storage<'a>(
        storage: Storage,
        n_points: usize,
        rows: impl Iterator<Item = &'a [u32]> + Clone,
    ) -> Self {
        let analysis = SymbolicAnalysis::new(&Graph::new(n_points, rows.clone()));
        Self::stored(storage, analysis, rows)
    }

    fn stored<'a>(
        storage: Storage,
        analysis: SymbolicAnalysis,
        rows: impl Iterator<Item = &'a [u32]>,
    ) -> Self {
        let SymbolicAnalysis { order, lower, columns } = analysis;
        let ordered = vec![0.0; 2 * order.len()];
        let factor = match storage {
            Storage::Sparse => Factor::Sparse(Sparse::new(columns)),
            Storage::Supernodal => Factor::Supernodal(Supernodal::new(&lower, columns)),
        };
        let normal = Normal::new(&lower, &order, rows);
        Self { normal, factor, order, ordered }
    }

    /// How many unknowns there are: two for each point.
    pub fn n_unknowns(&self) -> usize {
        2 * self.normal.len()
    }

    /// How the factor is stored.
    pub fn storage(&self) -> Storage {
        match self.factor {
            Factor::Sparse(_) => Storage::Sparse,
            Factor::Supernodal(_) => Storage::Supernodal,
        }
    }

    /// How many numbers the factor stores.
    pub fn n_stored(&self) -> usize {
        match &self.factor {
            Factor::Sparse(sparse) => sparse.n_stored(),
            Factor::Supernodal(supernodal) => supernodal.n_stored(),
        }
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

    /// Adds a symmetric matrix over the points of row `row_idx`, in their order: what the
    /// curvature of its equation adds to J^T J. `matrix` holds it row by row, 2 n by 2 n for n
    /// points.
    pub fn add_symmetric(&mut self, row_idx: usize, matrix: &[f64]) {
        self.normal.add_symmetric(row_idx, matrix);
    }

    /// Factors J^T J + `mu` I into L D L^T.
    pub fn factor(&mut self, mu: f64) -> Pivots {
        match &mut self.factor {
            Factor::Sparse(sparse) => sparse.factor(&self.normal, mu),
            Factor::Supernodal(supernodal) => supernodal.factor(&self.normal, mu),
        }
    }

    /// Replaces `rhs`, (x, y) for each point, by the solution for the last factor.
    pub fn solve(&mut self, rhs: &mut [f64]) {
        assert_eq!(rhs.len(), self.n_unknowns(), "a right-hand side has two values for each point");
        let (rhs, _) = rhs.as_chunks_mut::<2>();
        for (to, &p) in self.ordered.as_chunks_mut::<2>().0.iter_mut().zip(&self.order) {
            *to = rhs[p as usize];
        }
        match &mut self.factor {
            Factor::Sparse(sparse) => sparse.solve(&mut self.ordered),
            Factor::Supernodal(supernodal) => supernodal.solve(&mut self.ordered),
        }
        for (from, &p) in self.ordered.as_chunks::<2>().0.iter().zip(&self.order) {
            rhs[p as usize] = *from;
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

/// Products for each block of the factor from which on fronts are faster; see the table in
/// docs/linear-algebra.md. Choosing wrongly near the limit costs a few percent.
const FRONTS_PAY: usize = 20;

/// An elimination order that follows its own tree, the lower triangle, and the fill in it.
struct SymbolicAnalysis {
    order: Vec<u32>,
    lower: Lists,
    columns: Lists,
}

impl SymbolicAnalysis {
    fn new(graph: &Graph) -> Self {
        let order = order::minimum_degree(graph);
        let parent = elimination::tree(&lower_triangle(graph, &order));
        let order: Vec<u32> =
            elimination::postorder(&parent).iter().map(|&k| order[k as usize]).collect();
        let lower = lower_triangle(graph, &order);
        let parent = elimination::tree(&lower);
        let columns = elimination::fill(&lower, &parent);
        Self { order, lower, columns }
    }

    /// Fronts pay where each block of the factor is used many times.
    fn suitable_storage(&self) -> Storage {
        let rows = self.columns.transposed();
        let n_products: usize = (0..rows.len()).map(|k| rows.get(k).len().pow(2)).sum();
        if n_products > FRONTS_PAY * self.columns.n_items() {
            Storage::Supernodal
        } else {
            Storage::Sparse
        }
    }
}
