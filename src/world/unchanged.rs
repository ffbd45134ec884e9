//! Edits that would change nothing.

use super::same::{are_same_states, bits, is_same_number, is_same_record, same_place};
use super::{Edit, World};

impl World {
    /// Whether an edit would leave everything as it is. Says no where that is not seen at once.
    pub fn is_already(&self, edit: &Edit) -> bool {
        match edit {
            Edit::Move(id, at) => same_place(&self.points.at(*id), at),
            Edit::Start(id, at) => same_place(&self.points.start(*id), at),
            Edit::Freeze(id, is_frozen) => self.points.is_frozen(*id) == *is_frozen,
            Edit::Refreeze(it) => {
                let is_bound = |(id, then): &(_, _)| {
                    self.constraint(*id).is_some_and(|now| is_same_record(now, then))
                };
                self.points.is_frozen(it.point) == it.is_frozen && it.bound.iter().all(is_bound)
            }
            Edit::Weight(id, weight) => self.points.weight(*id) == *weight,
            Edit::Switch(id, is_on) => self.constraint(*id).is_some_and(|r| r.is_on == *is_on),
            Edit::Constraint(id, Some(then)) => {
                self.constraint(*id).is_some_and(|now| is_same_record(now, then))
            }
            Edit::Parameter(id, Some(then)) => {
                self.parameter(*id).is_some_and(|now| is_same_number(now, then))
            }
            Edit::Clock(clock) => **clock == self.clock,
            Edit::StartState(id, state) => {
                self.start_states.get(id).map(|state| bits(state)) == state.as_deref().map(bits)
            }
            Edit::StartStates(states) => are_same_states(states, &self.start_states),
            Edit::Motion(motion) => self.is_at(motion),
            Edit::Everything(world) => world.is_blank() && self.is_blank(),
            _ => false,
        }
    }
}
