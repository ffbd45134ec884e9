//! Points and constraints that were made one after the other, as one edit: a loop that makes a
//! million of them is taken back by a few numbers.

use std::ops::Range;

use super::{PointRecord, Record};

/// Which points and constraints: handles that follow each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Batch {
    /// The points.
    pub(super) points: HandleRange,
    /// The constraints.
    pub(super) constraints: HandleRange,
}

/// Handles in a batch at most: who goes through many looks between them whether that is still wanted.
const MOST: u32 = 4096;

impl Batch {
    /// How many points and constraints they are.
    pub(super) const fn len(self) -> usize {
        self.points.len() + self.constraints.len()
    }
}

/// Handles `first..end`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) struct HandleRange {
    first: u32,
    end: u32,
}

impl HandleRange {
    /// The handles, in order.
    pub const fn handles(self) -> Range<u32> {
        self.first..self.end
    }

    const fn len(self) -> usize {
        (self.end - self.first) as usize
    }

    /// Takes in a handle; false, and no change, if it does not follow the last, or there are many.
    pub fn extend(&mut self, handle: u32) -> bool {
        if self.first == self.end {
            *self = Self { first: handle, end: handle + 1 };
        } else if self.end == handle && self.end - self.first < MOST {
            self.end += 1;
        } else {
            return false;
        }
        true
    }
}

/// A batch with all that makes it.
#[derive(Debug, Clone)]
pub struct BatchRecords {
    pub(super) batch: Batch,
    pub(super) points: Vec<PointRecord>,
    pub(super) constraints: Vec<Record>,
}

impl BatchRecords {
    /// How many points and constraints they are.
    pub(super) const fn len(&self) -> usize {
        self.batch.len()
    }

    /// Roughly how many bytes it holds.
    pub fn n_bytes(&self) -> usize {
        size_of_val(&*self.points) + self.constraints.iter().map(Record::n_bytes).sum::<usize>()
    }
}
