//! Work side by side on all cores, where there is enough of it to pay.
//!
//! The paper's section 2 notes that all corrections can be worked out in parallel. What is
//! shared out here is such that nothing is added up in another order: the bits of a result do
//! not depend on how many cores there are.

use rayon::prelude::*;

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
pub(super) const ISLANDS: usize = 16;

/// The work that islands were when they were last visited.
#[derive(Debug, Default)]
pub(super) struct Effort {
    /// The constraints they hold.
    pub n_constraints: u64,
    /// How often these were evaluated, or something that takes as long was done.
    pub n_evaluations: u64,
}

/// Whether visiting islands is worth sharing, by the work they were last time.
pub(super) fn pays(last: &Effort) -> bool {
    last.n_evaluations >= ENOUGH
        && last.n_evaluations >= ENOUGH_EACH * last.n_constraints
        && rayon::current_num_threads() > 1
}

/// Does something with each item, at least `n_least` of them on one core, and puts together what
/// came out. The order in which that is put together depends on the cores: `reduce` must not
/// care.
pub(super) fn map_reduce<I: Send, T: Send + Sync + Copy>(
    items: &mut [I],
    n_least: usize,
    map: impl Fn(&mut I) -> T + Send + Sync,
    identity: T,
    reduce: impl Fn(T, T) -> T + Send + Sync,
) -> T {
    items.par_iter_mut().with_min_len(n_least).map(map).reduce(|| identity, reduce)
}

/// Does something with each piece of so many items, by its number.
pub(super) fn for_each_chunk<T: Send>(
    items: &mut [T],
    n_each: usize,
    work: impl Fn(usize, &mut [T]) + Send + Sync,
) {
    items.par_chunks_mut(n_each).enumerate().for_each(|(k, chunk)| work(k, chunk));
}
