//! Pieces of work on several threads, what comes of them taken in order.

use std::collections::BTreeMap;
use std::io;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::thread;
use std::time::Duration;

use crate::cli::interrupt;

/// Pieces that may be done before one that is not: more would be kept in memory.
const MOST_AHEAD: u64 = 4096;
/// Pieces that may be done before anybody takes them.
const MOST_WAITING: usize = 64;

/// Pieces to be done, and how far that is.
struct Order {
    n: u64,
    next: AtomicU64,
    n_taken: AtomicU64,
    is_over: AtomicBool,
}

impl Order {
    /// The piece to be done next; waits while those before it are too far behind. None where there is no
    /// other, or nobody wants it any more.
    fn next(&self) -> Option<u64> {
        let number = self.next.fetch_add(1, Ordering::Relaxed);
        let is_too_early = || number > self.n_taken.load(Ordering::Relaxed) + MOST_AHEAD;
        let is_over = || self.is_over.load(Ordering::Relaxed) || interrupt::is_asked();
        while number < self.n && is_too_early() && !is_over() {
            thread::sleep(Duration::from_millis(1));
        }
        (number < self.n && !self.is_over.load(Ordering::Relaxed)).then_some(number)
    }
}

/// Does `n` pieces of work on so many threads, each with what `begin` makes for it, and has what came of
/// them taken in order, as many as there are. Whether that was all: `work` that gives nothing ends.
///
/// # Errors
/// Where something could not be taken; no other piece is begun then.
pub fn in_order<T: Send, S>(
    n: u64,
    n_threads: u64,
    begin: impl Fn() -> S + Sync,
    work: impl Fn(&mut S, u64) -> Option<T> + Sync,
    mut take: impl FnMut(Vec<T>) -> io::Result<()>,
) -> io::Result<bool> {
    let order = &Order {
        n,
        next: AtomicU64::new(0),
        n_taken: AtomicU64::new(0),
        is_over: AtomicBool::new(false),
    };
    let (sender, done) = sync_channel(MOST_WAITING);
    let worker = |sender: SyncSender<(u64, T)>| {
        let mut state = begin();
        while let Some(number) = order.next() {
            let Some(piece) = work(&mut state, number) else { return };
            if sender.send((number, piece)).is_err() {
                return;
            }
        }
    };
    thread::scope(|scope| {
        for _ in 0..n_threads.min(n) {
            let sender = sender.clone();
            scope.spawn(|| worker(sender));
        }
        drop(sender);
        let taken = take_in_order(order, done, &mut take);
        // Who waits for the table to come nearer would wait for ever.
        order.is_over.store(true, Ordering::Relaxed);
        taken.map(|()| order.n_taken.load(Ordering::Relaxed) == n)
    })
}

fn take_in_order<T>(
    order: &Order,
    done: Receiver<(u64, T)>,
    take: &mut impl FnMut(Vec<T>) -> io::Result<()>,
) -> io::Result<()> {
    let mut waiting: BTreeMap<u64, T> = BTreeMap::new();
    let mut n_taken = 0;
    for (number, piece) in done {
        waiting.insert(number, piece);
        let mut ready = Vec::new();
        while let Some(piece) = waiting.remove(&(n_taken + ready.len() as u64)) {
            ready.push(piece);
        }
        n_taken += ready.len() as u64;
        if !ready.is_empty() {
            take(ready)?;
            order.n_taken.store(n_taken, Ordering::Relaxed);
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Waits until something was counted that far.
    fn wait_for(count: &AtomicU64, n: u64) {
        while count.load(Ordering::Relaxed) < n {
            thread::yield_now();
        }
    }

    #[test]
    fn what_is_done_out_of_order_is_taken_in_order() {
        let n_done = AtomicU64::new(0);
        let mut taken = Vec::new();
        let work = |(): &mut (), number| {
            // The first waits for others, no further ahead than they go.
            if number == 0 {
                wait_for(&n_done, 100);
            }
            n_done.fetch_add(1, Ordering::Relaxed);
            Some(number)
        };
        let take = |pieces: Vec<u64>| {
            taken.extend(pieces);
            Ok(())
        };
        assert!(in_order(1000, 2, || (), work, take).unwrap());
        assert_eq!(taken, (0..1000).collect::<Vec<_>>());
    }

    #[test]
    fn what_cannot_be_taken_ends_all_work() {
        let n_done = AtomicU64::new(0);
        // The other is as far ahead as it may be, and waits, when the first cannot be taken.
        let work = |(): &mut (), number| {
            if number == 0 {
                wait_for(&n_done, MOST_AHEAD);
            }
            n_done.fetch_add(1, Ordering::Relaxed);
            Some(number)
        };
        let full = |_| Err(io::Error::from(io::ErrorKind::StorageFull));
        let problem = in_order(10 * MOST_AHEAD, 2, || (), work, full).unwrap_err();
        assert_eq!(problem.kind(), io::ErrorKind::StorageFull);
        assert!(n_done.into_inner() <= MOST_AHEAD + 2);
    }

    #[test]
    fn work_that_ends_is_not_whole() {
        let work = |(): &mut (), number| (number < 5).then_some(number);
        let mut n_taken = 0;
        let take = |pieces: Vec<u64>| {
            n_taken += pieces.len();
            Ok(())
        };
        assert!(!in_order(10, 1, || (), work, take).unwrap());
        assert_eq!(n_taken, 5);
    }
}
