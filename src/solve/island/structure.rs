//! What an island is built on: its parts without their values.

use crate::constraint::{Constraint, ConstraintKind, PointIdx};

/// What an island is built on of a constraint: as long as this is the same, another one in its
/// place differs in its values alone.
pub(crate) struct Structure<'a> {
    pub constraint: &'a Constraint,
    /// Its own coefficient.
    pub rho: Option<f64>,
}

impl Structure<'_> {
    /// All of it, its points called by these numbers.
    pub fn words(&self, point: impl Fn(PointIdx) -> u32) -> impl Iterator<Item = u64> {
        let head = [self.constraint.kind() as u64, self.constraint.traits().n_firm_rows as u64];
        let points = self.constraint.points().iter().map(move |&p| u64::from(point(p)));
        head.into_iter().chain(points).chain([self.rho.map_or(0, f64::to_bits)])
    }
}
