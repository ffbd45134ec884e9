//! What uses an entity.

use super::{ConstraintId, Entity, MeasureId, ParameterId};

/// Something that uses an entity.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum User {
    /// A constraint that holds it or mentions it in a value.
    Constraint(ConstraintId),
    /// A parameter whose expression mentions it.
    Parameter(ParameterId),
    /// A measure whose expression mentions it.
    Measure(MeasureId),
}

impl User {
    /// The first of all in order.
    pub(super) const FIRST: Self = Self::Constraint(ConstraintId(0));
    /// The last of all in order.
    pub(super) const LAST: Self = Self::Measure(MeasureId(u32::MAX));

    /// The user as an entity.
    pub const fn entity(self) -> Entity {
        match self {
            Self::Constraint(id) => Entity::Constraint(id),
            Self::Parameter(id) => Entity::Parameter(id),
            Self::Measure(id) => Entity::Measure(id),
        }
    }
}
