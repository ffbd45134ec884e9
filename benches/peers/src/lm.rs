//! The levenberg-marquardt crate with a Jacobian written by hand: only free points are unknown,
//! and each four-bar of many is a problem of its own.

use levenberg_marquardt::{LeastSquaresProblem, LevenbergMarquardt};
use nalgebra::storage::Owned;
use nalgebra::{Const, DMatrix, DVector, Dyn, SMatrix, SVector};

use crate::peer::Peer;
use crate::work::{Place, Relation, Work};

/// An end of a bar: a point that is sought, or one that is known.
#[derive(Debug, Clone, Copy)]
enum End {
    Sought(usize),
    Known(usize),
}

/// Bars with their ends and lengths.
type Bars = Vec<([End; 2], f64)>;

/// Residuals and their derivatives by the places sought, one bar after the other.
fn evaluate(
    bars: &Bars,
    known: &[Place],
    x: &[f64],
    mut row: impl FnMut(usize, f64, [(Option<usize>, Place); 2]),
) {
    let at = |end: End| match end {
        End::Sought(p) => [x[2 * p], x[2 * p + 1]],
        End::Known(p) => known[p],
    };
    let column = |end: End| match end {
        End::Sought(p) => Some(2 * p),
        End::Known(_) => None,
    };
    for (nth, (ends, length)) in bars.iter().enumerate() {
        let [a, b] = ends.map(at);
        let e = [b[0] - a[0], b[1] - a[1]];
        let l = (e[0] * e[0] + e[1] * e[1]).sqrt();
        let u = [e[0] / l, e[1] / l];
        row(nth, l - length, [(column(ends[0]), [-u[0], -u[1]]), (column(ends[1]), u)]);
    }
}

/// A problem with its sizes known when compiled.
#[derive(Clone)]
struct Small<'a, const M: usize, const N: usize> {
    bars: &'a Bars,
    known: &'a [Place],
    x: SVector<f64, N>,
}

impl<const M: usize, const N: usize> LeastSquaresProblem<f64, Const<M>, Const<N>>
    for Small<'_, M, N>
{
    type ParameterStorage = Owned<f64, Const<N>>;
    type ResidualStorage = Owned<f64, Const<M>>;
    type JacobianStorage = Owned<f64, Const<M>, Const<N>>;

    fn set_params(&mut self, x: &SVector<f64, N>) {
        self.x = *x;
    }

    fn params(&self) -> SVector<f64, N> {
        self.x
    }

    fn residuals(&self) -> Option<SVector<f64, M>> {
        let mut r = SVector::zeros();
        evaluate(self.bars, self.known, self.x.as_slice(), |nth, f, _| r[nth] = f);
        Some(r)
    }

    fn jacobian(&self) -> Option<SMatrix<f64, M, N>> {
        let mut j = SMatrix::zeros();
        evaluate(self.bars, self.known, self.x.as_slice(), |nth, _, ends| {
            for (column, u) in ends {
                if let Some(c) = column {
                    j[(nth, c)] = u[0];
                    j[(nth, c + 1)] = u[1];
                }
            }
        });
        Some(j)
    }
}

/// A problem of any size, dense.
struct Large<'a> {
    bars: &'a Bars,
    known: &'a [Place],
    x: DVector<f64>,
}

impl LeastSquaresProblem<f64, Dyn, Dyn> for Large<'_> {
    type ParameterStorage = Owned<f64, Dyn>;
    type ResidualStorage = Owned<f64, Dyn>;
    type JacobianStorage = Owned<f64, Dyn, Dyn>;

    fn set_params(&mut self, x: &DVector<f64>) {
        self.x.copy_from(x);
    }

    fn params(&self) -> DVector<f64> {
        self.x.clone()
    }

    fn residuals(&self) -> Option<DVector<f64>> {
        let mut r = DVector::zeros(self.bars.len());
        evaluate(self.bars, self.known, self.x.as_slice(), |nth, f, _| r[nth] = f);
        Some(r)
    }

    fn jacobian(&self) -> Option<DMatrix<f64>> {
        let mut j = DMatrix::zeros(self.bars.len(), self.x.len());
        evaluate(self.bars, self.known, self.x.as_slice(), |nth, _, ends| {
            for (column, u) in ends {
                if let Some(c) = column {
                    j[(nth, c)] = u[0];
                    j[(nth, c + 1)] = u[1];
                }
            }
        });
        Some(j)
    }
}

/// One problem: its bars, and the places it seeks.
struct Problem {
    bars: Bars,
    x: Vec<f64>,
    /// Where the places sought stand among all points.
    free: Vec<usize>,
}

/// Solves a problem whose sizes are known when compiled. The crate's bounds on sizes hold for
/// numbers only, so this cannot be a generic function.
macro_rules! small {
    ($problem:expr, $known:expr, $m:literal, $n:literal) => {{
        let x = SVector::from_column_slice(&$problem.x);
        let target = Small::<$m, $n> { bars: &$problem.bars, known: $known, x };
        let (found, report) = LevenbergMarquardt::new().minimize(target);
        $problem.x.copy_from_slice(found.x.as_slice());
        report.termination.was_successful()
    }};
}

fn large(problem: &mut Problem, known: &[Place]) -> bool {
    let x = DVector::from_column_slice(&problem.x);
    let target = Large { bars: &problem.bars, known, x };
    let (found, report) = LevenbergMarquardt::new().minimize(target);
    problem.x.copy_from_slice(found.x.as_slice());
    report.termination.was_successful()
}

pub struct Lm<'a> {
    work: &'a Work,
    known: Vec<Place>,
    problems: Vec<Problem>,
}

impl<'a> Lm<'a> {
    /// None where the work has another relation than lengths or fewer of them than unknowns,
    /// which the crate refuses, or too many for dense matrices.
    pub fn start(work: &'a Work) -> Option<Self> {
        let free = work.free();
        if work.relations.len() < 2 * free.len() {
            return None;
        }
        // Four-bars: each its own problem, of one free point.
        let n_parts = if work.driven.len() > 1 { work.driven.len() } else { 1 };
        let n_bars = work.relations.len() / n_parts;
        let mut problems = Vec::new();
        for (free, relations) in
            free.chunks(free.len() / n_parts).zip(work.relations.chunks(n_bars))
        {
            let end = |p: usize| match free.iter().position(|&q| q == p) {
                Some(k) => End::Sought(k),
                None => End::Known(p),
            };
            let mut bars = Vec::new();
            for relation in relations {
                let Relation::Length(a, b, l) = *relation else { return None };
                bars.push(([end(a), end(b)], l));
            }
            let x = free.iter().flat_map(|&p| work.start[p]).collect();
            problems.push(Problem { bars, x, free: free.to_vec() });
        }
        // Dense matrices grow as the cube: beyond this a frame takes seconds.
        let is_small = problems.iter().all(|p| p.x.len() <= 200);
        is_small.then(|| Self { work, known: work.start.clone(), problems })
    }
}

impl Peer for Lm<'_> {
    fn frame(&mut self, k: usize) -> bool {
        for &(p, about) in &self.work.driven {
            self.known[p] = self.work.target(about, k);
        }
        let mut is_solved = true;
        for problem in &mut self.problems {
            is_solved &= match (problem.bars.len(), problem.x.len()) {
                (2, 2) => small!(problem, &self.known, 2, 2),
                (10, 10) => small!(problem, &self.known, 10, 10),
                (6, 6) => small!(problem, &self.known, 6, 6),
                (5, 4) => small!(problem, &self.known, 5, 4),
                _ => large(problem, &self.known),
            };
        }
        is_solved
    }

    fn pose(&mut self) -> Vec<Place> {
        let mut pose = self.known.clone();
        for problem in &self.problems {
            for (&p, at) in problem.free.iter().zip(problem.x.chunks_exact(2)) {
                pose[p] = [at[0], at[1]];
            }
        }
        pose
    }
}
