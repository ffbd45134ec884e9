//! Frames in which nothing but motors turns: no live value, no count of turns, and not the first.

use super::{ConstraintId, World};

impl World {
    /// The motors that turn, if they are all that drives the scene; none if a frame evaluates or
    /// counts something besides, or is the first.
    pub fn motors_alone(&mut self) -> Option<&[ConstraintId]> {
        self.sort_parameters();
        self.sort_constraints();
        let live = &self.dependencies;
        let are_alone = self.clock.frame > 0
            && live.is_idle()
            && live.ramps().is_empty()
            && live.turned().is_empty()
            && self.turn_counts.is_empty();
        are_alone.then(|| live.motors())
    }

    /// Lets the clock go on by frames of this kind. Who moved motors and points says where they
    /// are by [`constraint_state_mut`](World::constraint_state_mut) and
    /// [`set_position`](World::set_position).
    pub fn pass(&mut self, n_frames: u64) {
        self.clock.frame += n_frames;
        self.dependencies.note_change();
    }
}
