//! Paths that points leave behind, and ghosts of the whole mechanism.

use std::sync::Arc;

use super::{PointId, SampleList};
use crate::constraint::Point;

/// The path of one point.
#[derive(Debug, Clone)]
pub struct Trace {
    /// Whose path.
    pub point: PointId,
    /// What the path is called, if not as its point.
    pub label: Option<Arc<str>>,
    /// A place is kept every so many frames.
    pub every: u64,
    /// Whether it is as long as it will be.
    pub is_ended: bool,
    /// The places, in order of time.
    pub samples: SampleList,
}

/// The mechanism as it stood at one time: the positions of all points.
#[derive(Debug, Clone, PartialEq)]
pub struct Ghost {
    /// By handle, with the points that lived then.
    pub at: Vec<(PointId, Point)>,
}

impl Ghost {
    /// Roughly how many bytes it holds.
    pub fn n_bytes(&self) -> usize {
        size_of::<Self>() + size_of_val(&*self.at)
    }
}

/// A list that grows at its end while running.
pub(super) trait Growing: Default {
    fn len(&self) -> usize;
    /// Leaves so many, and gives the others.
    fn split_off(&mut self, n: usize) -> Self;
    fn append(&mut self, others: Self);
}

impl<T> Growing for Vec<T> {
    fn len(&self) -> usize {
        self.len()
    }

    fn split_off(&mut self, n: usize) -> Self {
        self.split_off(n)
    }

    fn append(&mut self, others: Self) {
        self.extend(others);
    }
}

impl Growing for SampleList {
    fn len(&self) -> usize {
        self.len()
    }

    fn split_off(&mut self, n: usize) -> Self {
        self.split_off(n)
    }

    fn append(&mut self, others: Self) {
        self.extend(others.iter().copied());
    }
}

/// The end of a list that grows while running: how much of it to keep and what follows.
#[derive(Debug, Clone)]
pub(super) struct Tail<L> {
    keep: usize,
    then: L,
}

impl<L: Growing> Tail<L> {
    /// The list as it is.
    pub fn mark(list: &L) -> Self {
        Self { keep: list.len(), then: L::default() }
    }

    /// Whether this is how the list is.
    pub fn is_all_of(&self, list: &L) -> bool {
        self.keep == list.len() && self.then.len() == 0
    }

    /// Nothing left of the list.
    pub fn cleared() -> Self {
        Self { keep: 0, then: L::default() }
    }

    /// What follows what is kept.
    pub const fn then(&self) -> &L {
        &self.then
    }

    /// Puts the list in this state; gives the state it was in.
    pub fn swap(self, list: &mut L) -> Self {
        let keep = self.keep.min(list.len());
        let old = list.split_off(keep);
        list.append(self.then);
        Self { keep, then: old }
    }
}
