//! Work side by side on all cores, where there is enough of it to pay.
//!
//! The paper's section 2 notes that all corrections can be worked out in parallel. What is
//! shared out here is such that nothing is added up in another order: the bits of a result do
//! not depend on how many cores there are.

use rayon::prelude::*;

use super::dispatch::{Task, Visit, visit};
use super::island::Island;
use super::report::{Budget, Counters};
use super::settings::Settings;

/// Less work than so many evaluations of constraints is done sooner than others are called; see
/// docs/performance.md.
const ENOUGH: u64 = 30_000;
/// Islands of which each constraint is evaluated fewer times than that are solved sooner than
/// they are handed from one core to another.
const ENOUGH_EACH: u64 = 6;
/// So many constraints of one island are shared out in each sweep.
pub(super) const ENOUGH_FOR_A_SWEEP: usize = 20_000;

/// How many constraints or points one core takes at a time in a sweep.
pub(super) const SHARE: usize = 2_048;
/// How many islands.
const ISLANDS: usize = 16;

/// Whether visiting islands is worth sharing, by the work they were last time.
pub(super) fn pays(last: &Effort) -> bool {
    last.n_evaluations >= ENOUGH
        && last.n_evaluations >= ENOUGH_EACH * last.n_constraints
        && rayon::current_num_threads() > 1
}

/// The work that islands were when they were last visited.
#[derive(Debug, Default)]
pub(super) struct Effort {
    /// The constraints they hold.
    pub n_constraints: u64,
    /// How often these were evaluated, or something that takes as long was done.
    pub n_evaluations: u64,
}

/// An island on its way through a visit.
pub(super) struct Guest {
    /// Its number.
    pub k: u32,
    /// The island.
    pub island: Box<Island>,
    /// What the visit came to.
    pub visit: Option<Visit>,
}

/// Visits islands side by side.
pub(super) fn visit_all(
    guests: &mut [Guest],
    settings: &Settings,
    tolerance: Option<f64>,
    task: Task,
) -> Counters {
    let each = |guest: &mut Guest| {
        let mut work = Counters::default();
        let budget = Budget { tolerance, stop: None };
        guest.visit = Some(visit(&mut guest.island, settings, &budget, task, &mut work));
        work
    };
    let guests = guests.par_iter_mut().with_min_len(ISLANDS);
    guests.map(each).reduce(Counters::default, |a, b| a.plus(&b))
}
