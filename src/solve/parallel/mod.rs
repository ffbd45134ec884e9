//! Work side by side on all cores, where there is enough of it to pay.
//!
//! The paper's section 2 notes that all corrections can be worked out in parallel. What is
//! shared out here is such that nothing is added up in another order: the bits of a result do
//! not depend on how many cores there are.

#[cfg(feature = "parallel")]
mod cores;
#[cfg(not(feature = "parallel"))]
mod one_core;

#[cfg(feature = "parallel")]
use cores as work;
#[cfg(not(feature = "parallel"))]
use one_core as work;

pub use work::limit_cores;
pub(super) use work::{for_each_chunk, map_reduce, n_cores};

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
#[derive(Debug, Clone, Copy, Default)]
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
        && n_cores() > 1
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sharing_does_what_one_after_the_other_does() {
        let mut items: Vec<u64> = (0..1000).collect();
        let take = |item: &mut u64| {
            *item += 1;
            *item
        };
        assert_eq!(map_reduce(&mut items, 7, take, 0, u64::max), 1000);
        for_each_chunk(&mut items, 300, |k, chunk| chunk.fill(k as u64));
        assert_eq!([0, 299, 300, 999].map(|k| items[k]), [0, 0, 1, 3]);
    }
}
