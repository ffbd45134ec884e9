//! Points and constraints that were made one after the other, as one edit: a loop that makes a
//! million of them is taken back by a few numbers.

use std::ops::Range;

use super::{ConstraintId, Edit, PointId, PointRecord, Record, World};

/// Which points and constraints: handles that follow each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Batch {
    points: Span,
    constraints: Span,
}

/// Handles `first..end`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
struct Span {
    first: u32,
    end: u32,
}

impl Span {
    const fn handles(self) -> Range<u32> {
        self.first..self.end
    }

    /// Whether the span, with this handle added, is one.
    fn extend(&mut self, handle: u32) -> bool {
        if self.first == self.end {
            *self = Self { first: handle, end: handle + 1 };
        } else if self.end == handle {
            self.end += 1;
        } else {
            return false;
        }
        true
    }
}

/// The same with all that makes them.
#[derive(Debug, Clone)]
pub struct Made {
    batch: Batch,
    points: Vec<PointRecord>,
    constraints: Vec<Record>,
}

impl Made {
    /// Roughly how many bytes it holds.
    pub fn n_bytes(&self) -> usize {
        size_of_val(&*self.points) + size_of_val(&*self.constraints)
    }
}

impl Edit {
    /// What an edit that deletes points or constraints deletes.
    fn deletes(&self) -> Option<Batch> {
        let mut batch = Batch::default();
        match self {
            Self::Point(id, None) => batch.points.extend(id.0),
            Self::Constraint(id, None) => batch.constraints.extend(id.0),
            Self::Unmake(batch) => return Some(*batch),
            _ => return None,
        };
        Some(batch)
    }

    /// Takes in what deletes the point or constraint that was made right after those this one
    /// deletes; false if that is not what `next` does.
    pub fn absorb(&mut self, next: &Self) -> bool {
        let Some(mut batch) = self.deletes() else { return false };
        let fits = match next {
            Self::Point(id, None) => batch.points.extend(id.0),
            Self::Constraint(id, None) => batch.constraints.extend(id.0),
            _ => false,
        };
        if fits {
            *self = Self::Unmake(batch);
        }
        fits
    }
}

impl World {
    pub(super) fn unmake(&mut self, batch: Batch) -> Made {
        let constraints = batch.constraints.handles();
        let constraints = constraints.filter_map(|k| self.swap_constraint(ConstraintId(k), None));
        let constraints = constraints.map(|record| *record).collect();
        let points = batch.points.handles();
        let points = points.filter_map(|k| self.swap_point(PointId(k), None));
        Made { batch, constraints, points: points.map(|record| *record).collect() }
    }

    pub(super) fn make(&mut self, made: Made) -> Batch {
        let Made { batch, points, constraints } = made;
        for (k, record) in batch.points.handles().zip(points) {
            self.swap_point(PointId(k), Some(Box::new(record)));
        }
        for (k, record) in batch.constraints.handles().zip(constraints) {
            self.swap_constraint(ConstraintId(k), Some(Box::new(record)));
        }
        batch
    }
}
