//! Work side by side on all cores, where there is enough of it to pay.
//!
//! The paper's section 2 notes that all corrections can be worked out in parallel. What is
//! shared out here is such that nothing is added up in another order: the bits of a result do
//! not depend on how many cores there are.

use rayon::prelude::*;

use super::island::Island;
use super::settings::Settings;
use super::status::{Budget, Counters};
use super::visit::{Task, Visit, visit};

/// Less work than visiting so many constraints, or half a dozen times as many sweeps over
/// them, is done sooner than others are called: see docs/performance.md.
const ENOUGH: usize = 4_000;
/// The same for one sweep over the constraints of an island.
const ENOUGH_FOR_A_SWEEP: usize = 20_000;

/// How many constraints or points one core takes at a time.
pub(super) const SHARE: usize = 2_048;
/// How many islands.
const ISLANDS: usize = 16;

/// Whether visiting islands with so many constraints is worth sharing.
pub(super) fn pays(n_constraints: usize) -> bool {
    n_constraints >= ENOUGH && rayon::current_num_threads() > 1
}

/// Whether one sweep over so many constraints is worth sharing.
pub(super) fn pays_for_a_sweep(n_constraints: usize) -> bool {
    n_constraints >= ENOUGH_FOR_A_SWEEP && rayon::current_num_threads() > 1
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
