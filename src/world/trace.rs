//! Paths that points leave behind, and ghosts of the whole mechanism.

use std::sync::Arc;

use super::PointId;
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
    pub samples: Vec<Sample>,
}

/// One place of a path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// The place.
    pub at: Point,
    /// Whether the frame missed its tolerance.
    pub missed: bool,
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

/// The end of a list that grows while running: how much of it to keep and what follows.
#[derive(Debug, Clone)]
pub(super) struct Tail<T> {
    keep: usize,
    then: Vec<T>,
}

impl<T> Tail<T> {
    /// The list as it is.
    pub fn mark(list: &[T]) -> Self {
        Self { keep: list.len(), then: Vec::new() }
    }

    /// Whether this is how the list is.
    pub fn is_all_of(&self, list: &[T]) -> bool {
        self.keep == list.len() && self.then.is_empty()
    }

    /// Nothing left of the list.
    pub const fn cleared() -> Self {
        Self { keep: 0, then: Vec::new() }
    }

    /// What follows what is kept.
    pub fn then(&self) -> &[T] {
        &self.then
    }

    /// Roughly how many bytes it holds, but for what its items point to.
    pub fn n_bytes(&self) -> usize {
        size_of_val(&*self.then)
    }

    /// Puts the list in this state; gives the state it was in.
    pub fn swap(self, list: &mut Vec<T>) -> Self {
        let keep = self.keep.min(list.len());
        let old = list.split_off(keep);
        list.extend(self.then);
        Self { keep, then: old }
    }
}
