//! Work shared out to all cores.

use rayon::prelude::*;

/// How many cores there are to work with.
pub fn n_cores() -> usize {
    rayon::current_num_threads()
}

/// More cores than this are nothing that a mechanism could use.
const MOST_CORES: usize = 1024;

/// Works with so many cores from now on, at least one and at most 1024; what comes out is the same to the
/// bit. Only the first call counts, and only before there was work to share.
pub fn limit_cores(n: usize) {
    // Fails only where it was said before: a process has one crew.
    let crew = rayon::ThreadPoolBuilder::new().num_threads(n.clamp(1, MOST_CORES));
    let _ = crew.build_global();
}

/// Does something with each item, at least `n_least` of them on one core, and puts together what
/// came out. The order in which that is put together depends on the cores: `reduce` must not
/// care.
pub fn map_reduce<I: Send, T: Send + Sync + Copy>(
    items: &mut [I],
    n_least: usize,
    map: impl Fn(&mut I) -> T + Send + Sync,
    identity: T,
    reduce: impl Fn(T, T) -> T + Send + Sync,
) -> T {
    items.par_iter_mut().with_min_len(n_least).map(map).reduce(|| identity, reduce)
}

/// Does something with each piece of so many items, by its number.
pub fn for_each_chunk<T: Send>(
    items: &mut [T],
    n_each: usize,
    work: impl Fn(usize, &mut [T]) + Send + Sync,
) {
    items.par_chunks_mut(n_each).enumerate().for_each(|(k, chunk)| work(k, chunk));
}
