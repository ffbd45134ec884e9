//! What an edit touched, for those who keep something worked out from the world.

use super::{ConstraintId, PointId};

/// What changed since it was last asked for.
#[derive(Debug, Clone, Default)]
pub struct Touched {
    /// Everything may have changed; the lists say nothing then.
    pub all: bool,
    /// Points made, deleted, frozen, thawed or given another weight.
    pub points: Vec<PointId>,
    /// Points put elsewhere from outside the solver.
    pub moved: Vec<PointId>,
    /// Constraints made, deleted, switched, or changed in structure.
    pub constraints: Vec<ConstraintId>,
    /// Constraints whose values changed, structure as before.
    pub values: Vec<ConstraintId>,
}

impl Touched {
    /// Whether nothing changed.
    pub fn is_empty(&self) -> bool {
        !self.all
            && self.points.is_empty()
            && self.moved.is_empty()
            && self.constraints.is_empty()
            && self.values.is_empty()
    }

    /// Nothing changed; the lists keep their room.
    pub fn clear(&mut self) {
        let Self { all, points, moved, constraints, values } = self;
        *all = false;
        points.clear();
        moved.clear();
        constraints.clear();
        values.clear();
    }

    /// Everything changed.
    pub fn everything() -> Self {
        Self { all: true, ..Self::default() }
    }
}
