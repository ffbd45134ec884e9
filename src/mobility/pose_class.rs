//! Whether a pose is one where the count of freedoms jumps, and what that means.

use super::dependence::Dependence;
use super::motions::{Random, motions};
use super::projector::Projector;
use super::system::{ConstraintSystem, UnitRow, UnitRows};
use crate::constraint::{ConstraintKind, Point, Vector};
use nalgebra::{DMatrix, DVector};

/// What becomes of the motions a pose seems to allow.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum PoseClass {
    /// The rows are as independent here as anywhere near.
    Regular,
    /// They are less so, and yet all motions go on, as far as a step along them was followed: the
    /// mechanism lives by its proportions.
    MobileSingular,
    /// Several motions cross here, and it is not said which one will go on.
    ChangePoint,
    /// Some motion is possible at the first instant only: a dead point, or shaky.
    Locked,
}

/// Second derivatives below this, for unit motions in units of the scene's size, are 0.
const FLAT: f64 = 1e-5;

/// Of more free motions than this a random selection is examined.
const MOST_MOTIONS: usize = 24;

/// Examines an island whose rows all hold, given its dependent rows.
///
/// For each stress y that the rows bear among themselves, a motion v goes on only if
/// `v^T (sum_a y_a hess f_a) v = 0` (Connelly and Whiteley, "Second-order rigidity and prestress
/// stability for tensegrity frameworks", SIAM J. Discrete Math. 9, 1996). If some stress makes
/// this form definite, nothing moves; if all forms vanish, everything does.
pub fn classify(
    scene: &ConstraintSystem,
    island: &UnitRows,
    dependences: &[Dependence],
) -> PoseClass {
    let mut projector = Projector::of(island);
    let n_motions = projector.nullity();
    if dependences.is_empty() || n_motions == 0 || is_generic(scene, island, n_motions) {
        return PoseClass::Regular;
    }
    let motions = motions(&mut projector, island.n_unknowns(), n_motions.min(MOST_MOTIONS));
    let forms = forms(scene, island, dependences, &motions);
    let size = extent(scene, island);
    let forms: Vec<_> = forms.into_iter().filter(|q| q.amax() * size > FLAT).collect();
    if forms.is_empty() {
        PoseClass::MobileSingular
    } else if some_sum_is_definite(&without_kernel(&forms, FLAT / size)) {
        PoseClass::Locked
    } else {
        PoseClass::ChangePoint
    }
}

/// Whether there are as many motions at a pose chosen at random nearby, where coincident
/// points and the like are left together.
fn is_generic(scene: &ConstraintSystem, island: &UnitRows, n_motions: usize) -> bool {
    // What is linear and asks for no length holds in every affine image of the mechanism.
    let straight = island.filtered(|row| {
        let constraint = scene.constraints[row.source.0];
        constraint.traits().is_linear && constraint.nominal_length() == 0.0
    });
    let mut random = Random::new();
    let mut y: Vec<f64> = (0..island.n_unknowns()).map(|_| random.next()).collect();
    if !straight.rows.is_empty() {
        Projector::of(&straight).onto_motions(&mut y);
    }
    let most = y.iter().fold(0.0, |most: f64, y| most.max(y.abs()));
    if most == 0.0 {
        return true;
    }
    let k = 0.05 * extent(scene, island) / most;
    let moves = scene.displacements(&island.points, &y);
    let x: Vec<Point> = scene.x.iter().zip(&moves).map(|(x, d)| *x + *d * k).collect();
    let nearby = ConstraintSystem { x: &x, ..*scene }.rows_like(island);
    Projector::of(&nearby).nullity() >= n_motions
}

/// How far a motion is followed before it is said to go on, as a part of the extent of what moves.
const FOLLOWED: f64 = 1e-2;
/// How many motions are.
const MOST_FOLLOWED: usize = 3;
/// Newton steps onto the motion double the digits; what needs more is pulled back.
const MOST_STEPS: usize = 8;
/// Their damping: rows that resist by less than its root are not felt, and FINE is far below.
const DAMPING: f64 = 1e-13;

/// Whether the motions an island seems to have really go on: a step along each is followed by
/// Newton steps onto where the rows hold as exactly as they do here, and that is not back at the
/// start.
pub fn goes_on(
    scene: &ConstraintSystem,
    island: &UnitRows,
    projector: &mut Projector,
    n_motions: usize,
) -> bool {
    let moving = || island.points.iter().map(|&p| scene.x[p as usize].to_vector());
    let first = moving().next().unwrap_or(Vector::ZERO);
    let width = moving().map(|p| (p - first).norm()).fold(0.0, f64::max);
    let size = if width > 0.0 { width } else { extent(scene, island) };
    // Row by row: to what rounding leaves of those of a large scene, small ones hold anywhere.
    let holds = |there: &UnitRow| {
        let here = island.rows.binary_search_by_key(&there.source, |row| row.source);
        let here = here.map_or(0.0, |k| island.rows[k].f.abs());
        there.f.abs() <= 10.0 * there.rounding.max(1e-13 * size).max(here)
    };
    let motions = motions(projector, island.n_unknowns(), n_motions.min(MOST_FOLLOWED));
    let rows_at = |way: &[f64]| {
        let moves = scene.displacements(&island.points, way);
        let x: Vec<Point> = scene.x.iter().zip(&moves).map(|(x, d)| *x + *d).collect();
        ConstraintSystem { x: &x, ..*scene }.rows_like(island)
    };
    motions.iter().all(|motion| {
        let moves = scene.displacements(&island.points, motion.as_slice());
        let most = moves.iter().map(|d| d.norm()).fold(0.0, f64::max);
        let h = FOLLOWED * size / most;
        let mut way: Vec<f64> = motion.iter().map(|v| v * h).collect();
        for _ in 0..MOST_STEPS {
            let there = rows_at(&way);
            if there.rows.iter().all(holds) {
                let along: f64 = way.iter().zip(motion.iter()).map(|(a, b)| a * b).sum();
                return along >= 0.5 * h;
            }
            let mut step = vec![0.0; there.n_unknowns()];
            there.rows.iter().for_each(|row| row.add_to(-row.f, &mut step));
            Projector::of(&there).solve_damped(DAMPING, &mut step);
            way.iter_mut().zip(&step).for_each(|(way, step)| *way += step);
        }
        false
    })
}

/// The largest distance of a point of the island from their middle.
fn extent(scene: &ConstraintSystem, island: &UnitRows) -> f64 {
    let constraints = island.rows.chunk_by(|a, b| a.source.0 == b.source.0);
    let points = || {
        let held =
            constraints.clone().flat_map(|rows| scene.constraints[rows[0].source.0].points());
        held.map(|&p| scene.x[p as usize].to_vector())
    };
    let n = points().count().max(1) as f64;
    let middle = points().fold(Vector::ZERO, |sum, p| sum + p) / n;
    let extent = points().map(|p| (p - middle).norm()).fold(0.0, f64::max);
    if extent > 0.0 { extent } else { 1.0 }
}

/// For each stress, scaled to length 1, the second derivatives of what it weighs the rows
/// with, over the given motions.
fn forms(
    scene: &ConstraintSystem,
    island: &UnitRows,
    dependences: &[Dependence],
    motions: &[DVector<f64>],
) -> Vec<DMatrix<f64>> {
    let n = motions.len();
    let mut forms = vec![DMatrix::zeros(n, n); dependences.len()];
    for i in 0..n {
        for j in 0..=i {
            // d2f(u, v) = (d2f(u + v, u + v) - d2f(u - v, u - v)) / 4
            let sum = scene.curvatures(island, (&motions[i] + &motions[j]).as_slice());
            let difference = scene.curvatures(island, (&motions[i] - &motions[j]).as_slice());
            for (form, dependence) in forms.iter_mut().zip(dependences) {
                let squared: f64 = dependence.stress().map(|(_, y)| y * y).sum();
                let bent = dependence.stress().map(|(row, y)| y * (sum[row] - difference[row]));
                let value = 0.25 * bent.sum::<f64>() / squared.sqrt();
                form[(i, j)] = value;
                form[(j, i)] = value;
            }
        }
    }
    forms
}

/// The forms over those motions that some form resists; the others really go on.
fn without_kernel(forms: &[DMatrix<f64>], flat: f64) -> Vec<DMatrix<f64>> {
    let n = forms[0].nrows();
    let squares = forms.iter().fold(DMatrix::zeros(n, n), |sum, q| sum + q * q);
    let eigen = squares.symmetric_eigen();
    let kept: Vec<_> = (0..n).filter(|&k| eigen.eigenvalues[k] > flat * flat).collect();
    let basis = eigen.eigenvectors.select_columns(&kept);
    forms.iter().map(|q| basis.transpose() * q * &basis).collect()
}

/// Whether some sum of multiples of the forms is positive definite: a perceptron that adds
/// what raises the least eigenvalue, and ends in time if there is one.
fn some_sum_is_definite(forms: &[DMatrix<f64>]) -> bool {
    const N_ROUNDS: usize = 300;
    let mut multiples: Vec<f64> = forms.iter().map(DMatrix::trace).collect();
    for _ in 0..N_ROUNDS {
        let n = forms[0].nrows();
        let sum = forms.iter().zip(&multiples).fold(DMatrix::zeros(n, n), |s, (q, &m)| s + q * m);
        let size = sum.amax();
        let eigen = sum.symmetric_eigen();
        let (least, value) = eigen.eigenvalues.argmin();
        if value > 1e-6 * size {
            return true;
        }
        let v = eigen.eigenvectors.column(least);
        for (m, q) in multiples.iter_mut().zip(forms) {
            *m += v.dot(&(q * v));
        }
    }
    false
}
