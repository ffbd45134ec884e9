//! The same work on one core, where there are no threads.

/// How many cores there are to work with.
pub const fn n_cores() -> usize {
    1
}

/// Works with so many cores from now on: there is one, whatever `n` says.
pub const fn limit_cores(_n: usize) {}

/// Does something with each item, and puts together what came out.
pub fn map_reduce<I, T>(
    items: &mut [I],
    _n_least: usize,
    map: impl Fn(&mut I) -> T,
    identity: T,
    reduce: impl Fn(T, T) -> T,
) -> T {
    items.iter_mut().map(map).fold(identity, reduce)
}

/// Does something with each piece of so many items, by its number.
pub fn for_each_chunk<T>(items: &mut [T], n_each: usize, work: impl Fn(usize, &mut [T])) {
    items.chunks_mut(n_each).enumerate().for_each(|(k, chunk)| work(k, chunk));
}
