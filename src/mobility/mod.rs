//! What a mechanism can do at a pose: its freedoms, what is redundant, what conflicts, where
//! it is stuck.
//!
//! Everything is worked out on rows of length 1, island by island, from sparse factors: no
//! matrix here is as large as the scene squared.

mod conflict;
mod dependence;
mod driver;
mod freedom;
mod motions;
mod pose_class;
mod projector;
mod range;
mod repair;
mod settle;
mod system;
mod tracer;
mod travel;

pub use conflict::{Conflict, Repair, conflict_with};
pub use driver::{Driven, Driver};
pub use freedom::{Directions, Freedom, freedom};
pub use motions::motion_of;
pub use pose_class::PoseClass;
pub use range::{DriverRange, RangeEnd, Reach, dead_end, range};
pub use repair::repair;
pub use system::ConstraintSystem;

use dependence::{Dependence, dependences};
use projector::{FINE, Projector, TAU};
use system::UnitRows;

/// What there is to say about a scene at a pose.
#[derive(Debug, Clone, PartialEq)]
pub struct Analysis {
    /// In how many independent ways the points can begin to move.
    pub degrees_of_freedom: usize,
    /// How many equations say nothing that the others do not say.
    pub n_redundant: usize,
    /// The constraints they belong to: each could be left out, as the others imply it.
    pub redundant: Vec<Redundant>,
    /// The constraints that cannot all hold.
    pub conflicts: Vec<Conflict>,
    /// Those that hold frozen points only, and do not hold.
    pub unsatisfiable: Vec<usize>,
    /// Whether some motion is not what it seems.
    pub pose: PoseClass,
    /// The smallest and the largest singular value of the rows, if there are any; dependences
    /// do not count. Of islands the one where they are farthest apart.
    pub singular_values: Option<(f64, f64)>,
}

/// A constraint with an equation that others imply.
#[derive(Debug, Clone, PartialEq)]
pub struct Redundant {
    /// Which constraint: the latest of those that depend on each other.
    pub constraint: usize,
    /// Those that imply it.
    pub depends_on: Vec<usize>,
}

/// Rows are nearly dependent if their singular values are farther apart than this. Sound
/// linkages have .07 to .34.
const NEARLY_SINGULAR: f64 = 1e-3;

/// What may be left of a row that depends on others: what counts as a freedom, see
/// [`projector::TAU`], leaves such a row. Dependent rows of sound scenes leave less
/// than 1e-12, independent ones more than 1e-2.
const NOTHING: f64 = 1e-5;

impl Analysis {
    /// Whether a small error of a length can become a large one of a position.
    pub fn is_nearly_singular(&self) -> bool {
        self.singular_values.is_some_and(|(least, most)| least < NEARLY_SINGULAR * most)
    }

    /// How far points may be from where they belong, if constraints are off by `residual`:
    /// an estimate, for a scene without freedoms.
    pub fn position_error(&self, residual: f64) -> Option<f64> {
        let (least, _) = self.singular_values.filter(|_| self.degrees_of_freedom == 0)?;
        Some(residual / least)
    }
}

/// Analyses a scene at a converged pose or a best fit; distances up to `tolerance` count as 0.
///
/// ```
/// use linkwork::constraint::{Bounds, Constraint, Length, Point};
/// use linkwork::mobility::{ConstraintSystem, analyse};
///
/// let bar = |a, b, l| Constraint::from(Length { points: [a, b], bounds: Bounds::exactly(l) });
/// let x = [(0.0, 0.0), (4.0, 0.0), (4.0, 3.0)].map(|(x, y)| Point::new(x, y));
/// let triangle = [bar(0, 1, 4.0), bar(1, 2, 3.0), bar(2, 0, 5.0), bar(2, 0, 5.0)];
/// let constraints: Vec<&Constraint> = triangle.iter().collect();
///
/// let found = analyse(&ConstraintSystem { constraints: &constraints, x: &x, w: &[1.0; 3] }, 1e-9);
/// assert_eq!(found.degrees_of_freedom, 3);
/// assert_eq!(found.redundant[0].constraint, 3);
/// assert_eq!(found.redundant[0].depends_on, [2]);
/// ```
pub fn analyse(scene: &ConstraintSystem, tolerance: f64) -> Analysis {
    let (rows, unsatisfiable) = scene.rows(tolerance);
    let mut analysis = Analysis {
        degrees_of_freedom: 0,
        n_redundant: 0,
        redundant: Vec::new(),
        conflicts: Vec::new(),
        unsatisfiable,
        pose: PoseClass::Regular,
        singular_values: None,
    };
    for island in rows.islands() {
        analysis.add(scene, &island, tolerance);
    }
    for constraint in scene.identities(tolerance) {
        analysis.n_redundant += 1;
        analysis.redundant.push(Redundant { constraint, depends_on: Vec::new() });
    }
    analysis.redundant.sort_by_key(|redundant| redundant.constraint);
    analysis.redundant.dedup_by(|later, first| {
        let is_same = later.constraint == first.constraint;
        if is_same {
            first.depends_on.append(&mut later.depends_on);
        }
        is_same
    });
    for redundant in &mut analysis.redundant {
        redundant.depends_on.sort_unstable();
        redundant.depends_on.dedup();
    }
    analysis.conflicts.sort_by_key(|conflict| conflict.constraints[0]);
    analysis
}

impl Analysis {
    fn add(&mut self, scene: &ConstraintSystem, island: &UnitRows, tolerance: f64) {
        let mut projector = Projector::of(island);
        let rank = Rank::of(scene, island, &mut projector, tolerance);
        self.degrees_of_freedom += rank.n_free;
        self.n_redundant += rank.n_redundant(island);
        self.pose = self.pose.max(rank.pose);
        if let Some(found) = projector.extreme_singular_values(rank.cut) {
            let ratio = |(least, most): (f64, f64)| least / most;
            if self.singular_values.is_none_or(|known| ratio(found) < ratio(known)) {
                self.singular_values = Some(found);
            }
        }
        self.conflicts.extend(conflict::conflicts(scene, island, tolerance));
        for mut dependence in rank.dependences {
            if dependence.misfit(&island.rows).abs() > tolerance {
                // It is not implied but contradicted.
                continue;
            }
            if rank.pose > PoseClass::Regular {
                dependence.keep_above(AT_SINGULAR_POSE);
            }
            let source = |row: usize| island.rows[row].source.0;
            let constraint = source(dependence.row);
            let mut depends_on: Vec<_> =
                dependence.on.iter().map(|&(row, _)| source(row)).collect();
            depends_on.retain(|&c| c != constraint);
            self.redundant.push(Redundant { constraint, depends_on });
        }
    }
}

/// At a singular pose positions are known to the root of what residuals are, and multiples of rows
/// that have no part in a dependence are as large.
const AT_SINGULAR_POSE: f64 = 1e-6;

/// How many motions the rows of an island leave, and which rows depend on others.
struct Rank {
    n_free: usize,
    /// Eigenvalues of `J^T J` below this count as 0.
    cut: f64,
    dependences: Vec<Dependence>,
    pose: PoseClass,
}

impl Rank {
    fn of(
        scene: &ConstraintSystem,
        island: &UnitRows,
        projector: &mut Projector,
        tolerance: f64,
    ) -> Self {
        let regular =
            |n_free, cut| Self { n_free, cut, dependences: Vec::new(), pose: PoseClass::Regular };
        let mut rank = regular(projector.nullity(), TAU);
        if rank.n_redundant(island) == 0 {
            return rank;
        }
        rank.dependences = dependences(island, NOTHING);
        if island.worst() > tolerance {
            return rank;
        }
        rank.pose = pose_class::classify(scene, island, &rank.dependences);
        if rank.pose != PoseClass::MobileSingular
            || pose_class::goes_on(scene, island, projector, rank.n_free)
        {
            return rank;
        }
        // Something holds it, if only weakly: more closely looked at it is no freedom.
        let mut closer = regular(projector.count_below(FINE), FINE);
        if closer.n_free == rank.n_free {
            return Self { pose: PoseClass::Locked, ..rank };
        }
        if closer.n_redundant(island) > 0 {
            closer.dependences = dependences(island, FINE.sqrt());
        }
        closer
    }

    fn n_redundant(&self, island: &UnitRows) -> usize {
        (island.rows.len() + self.n_free).saturating_sub(island.n_unknowns())
    }
}
