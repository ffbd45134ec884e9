//! A constraint on its way into an island, and in which order constraints lie there.

use std::cmp::Ordering;

use crate::constraint::{Carried, Constraint, ConstraintKind};
use crate::world::{ConstraintId, Record};

/// A constraint on its way into an island.
pub(crate) struct Member<'a> {
    /// Its handle.
    pub id: ConstraintId,
    /// The constraint, over handles of points.
    pub constraint: &'a Constraint,
    /// Its own coefficient.
    pub rho: Option<f64>,
    /// Whether its values change with time or with other values.
    pub is_live: bool,
}

impl<'a> Member<'a> {
    /// A constraint of the world, by its handle.
    pub fn new(id: ConstraintId, record: &'a Record) -> Self {
        let is_live = !record.drivers().is_empty();
        Self { id, constraint: &record.constraint, rho: record.rho(), is_live }
    }

    /// What tells it from another one of its kind on the same points for good; nothing where that
    /// changes by itself.
    fn rank(&self) -> Vec<u64> {
        let mut rank = vec![self.rho.map_or(0, f64::to_bits)];
        if !self.is_live && self.constraint.traits().carried == Carried::Nothing {
            self.constraint.content(&mut |word| rank.push(word));
        }
        rank
    }

    /// In which order constraints lie in an island.
    pub fn order(&self, other: &Self) -> Ordering {
        let (one, two) = (self.constraint, other.constraint);
        let kinds = one.kind().cmp(&two.kind());
        kinds
            .then_with(|| one.points().cmp(two.points()))
            .then_with(|| self.rank().cmp(&other.rank()))
            .then_with(|| self.id.cmp(&other.id))
    }
}
