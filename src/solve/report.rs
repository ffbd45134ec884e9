//! How solving ended, and what it took.

use super::settings::Settings;
use crate::world::PointId;

/// How solving ended. The order is from good to bad.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub enum Status {
    /// Every constraint holds to the tolerance.
    #[default]
    Converged,
    /// No small move lowers the sum of squares. Whether the constraints contradict each other, or
    /// hold in another place, was not asked.
    BestFit,
    /// The same, and a set of constraints was found that cannot all hold. Solving itself never
    /// ends so: it takes a test of its own.
    Contradictory,
    /// Neither; more iterations may help.
    Stalled,
    /// A constraint that holds only frozen points is not satisfied: nothing can help.
    Unsatisfiable,
}

impl Status {
    /// One word for it, for other programs.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Converged => "converged",
            Self::BestFit => "no-solution-found",
            Self::Contradictory => "best-fit",
            Self::Stalled => "stalled",
            Self::Unsatisfiable => "unsatisfiable",
        }
    }

    /// What it means, in the user's words.
    pub const fn phrase(self) -> &'static str {
        match self {
            Self::Converged => "converged",
            Self::BestFit => "no solution found from here",
            Self::Contradictory => "best fit: the constraints contradict each other",
            Self::Stalled => "stalled: not solved, and not known to be unsolvable",
            Self::Unsatisfiable => "unsatisfiable: a constraint holds frozen points only",
        }
    }
}

/// What one call of the solver came to.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Report {
    /// The worst ending of all islands.
    pub status: Status,
    /// The iterations of the island that took most.
    pub iterations: u64,
    /// The largest distance to satisfaction of all constraints, relative to the size of what
    /// hangs together with it.
    pub residual: f64,
    /// The relaxation coefficient used, where the user's would have diverged.
    pub lowered_rho: Option<f64>,
    /// A point that may be on another branch than before: it changed sides, and no motion
    /// from there to here was found.
    pub turned_over: Option<PointId>,
    /// A point whose motion began in a pose where branches meet: nothing told which to take.
    pub chosen: Option<PointId>,
    /// How far points may be from where they belong, length units, in islands that ended next to a
    /// singular pose; 0 if none did.
    pub position_error: f64,
    /// How many islands are not at a solution.
    pub n_unsolved_islands: u32,
    /// Whether the caller's budget ran out before the work was done.
    pub is_interrupted: bool,
    /// The work done.
    pub counters: Counters,
}

impl Report {
    /// Takes in the ending of one more part of the scene.
    pub(super) fn include(&mut self, status: Status, iterations: u64, residual: f64) {
        self.status = self.status.max(status);
        self.iterations = self.iterations.max(iterations);
        self.residual = self.residual.max(residual);
        self.n_unsolved_islands += u32::from(status != Status::Converged);
    }
}

/// The work of one call, in units that do not depend on the machine.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub struct Counters {
    /// Islands looked at.
    pub islands_visited: u64,
    /// Islands taken apart and put together anew.
    pub islands_rebuilt: u64,
    /// Constraints evaluated, with or without their rows.
    pub evaluations: u64,
    /// Cog wheel pairs and racks among them.
    pub wheel_evaluations: u64,
    /// Factorisations of a matrix.
    pub factorisations: u64,
    /// Substeps into which frames were divided.
    pub substeps: u64,
}

impl Counters {
    /// The work of this call and another.
    #[must_use]
    pub fn plus(mut self, other: &Self) -> Self {
        self.add(other);
        self
    }

    /// Adds the work of another call.
    pub fn add(&mut self, other: &Self) {
        self.islands_visited += other.islands_visited;
        self.islands_rebuilt += other.islands_rebuilt;
        self.evaluations += other.evaluations;
        self.wheel_evaluations += other.wheel_evaluations;
        self.factorisations += other.factorisations;
        self.substeps += other.substeps;
    }
}

/// How often islands that something drove were followed through a frame by `auto`, by the way that
/// their poses were found. The same on every machine.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct FrameCounts {
    /// By a list of closed steps.
    pub closed: u64,
    /// How many of these were found side by side.
    pub abreast: u64,
    /// As any motion is: the first frame, or the first after an edit.
    pub first: u64,
    /// The same, where a step holds a value that changed.
    pub changed: u64,
    /// Where some points have no closed form.
    pub open: u64,
    /// Next to a singular pose, and where it was not proved that none lay on the way.
    pub unproved: u64,
}

impl FrameCounts {
    /// All of them.
    pub fn total(&self) -> u64 {
        let Self { closed, abreast: _, first, changed, open, unproved } = self;
        closed + first + changed + open + unproved
    }

    /// Counts a frame for which the list of steps was asked.
    pub(super) fn count(&mut self, found: Result<(), NoStep>) {
        *match found {
            Ok(()) => &mut self.closed,
            Err(NoStep::First) => &mut self.first,
            Err(NoStep::Changed) => &mut self.changed,
            Err(NoStep::Open) => &mut self.open,
            Err(NoStep::Unproved) => &mut self.unproved,
        } += 1;
    }
}

/// Why a frame is not found by closed steps, see [`FrameCounts`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum NoStep {
    First,
    Changed,
    Open,
    Unproved,
}

/// What limits the work of one call.
#[derive(Clone, Copy, Default)]
pub struct Budget<'a> {
    /// Solved to this tolerance is enough, in place of the one that is set.
    pub tolerance: Option<f64>,
    /// Asked between iterations; true ends the work where it stands.
    pub stop: Option<&'a dyn Fn() -> bool>,
    /// The largest position error of this run that is known already: a smaller one is not worked
    /// out.
    pub known_error: f64,
}

impl Budget<'_> {
    /// The tolerance that is enough.
    pub(super) fn tolerance_of(&self, settings: &Settings) -> f64 {
        self.tolerance.unwrap_or(settings.tolerance)
    }

    /// Whether the caller wants an end.
    pub(super) fn is_spent(&self) -> bool {
        self.stop.is_some_and(|stop| stop())
    }
}
