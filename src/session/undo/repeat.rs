//! The longest motion since the structure changed, from where it began.

use super::history::History;
use super::last_motion::{Beginning, Lap};
use crate::session::state::State;
use crate::study::RepeatableMotion;

impl History {
    /// Frames are about to pass in the command under way. What the hand holds is not yet frozen.
    pub fn begin_leg(&mut self, state: &State, n_frames: u64, is_in_block: bool) {
        let number = self.journal.next_number();
        self.last_motion.begin_leg(state, n_frames, is_in_block, number);
    }

    /// The longest motion since the structure changed, if there was one and it is still known where
    /// it began.
    pub fn repeatable_motion(&mut self, state: &mut State) -> Option<RepeatableMotion> {
        let revision = state.world.revision();
        let lap = self.last_motion.longest.take_if(|lap| lap.revision == revision)?;
        let (settings, legs) = (state.preferences.solve, lap.legs.clone());
        let motion = match &lap.beginning {
            Beginning::Within(then) => {
                let (moment, memory) = (**then).clone();
                Some(RepeatableMotion::back(&state.world, moment, memory, settings, legs))
            }
            &Beginning::Command(number) => self.before(number, state, |state| {
                let (world, memory) = (state.world.clone(), state.solver.memory());
                RepeatableMotion::from(world, memory, settings, legs)
            }),
        };
        let motion = motion.map(|motion| motion.with_frames(lap.n_frames));
        // Commands that were taken back to look and done again count as edits: the structure is the
        // same.
        self.last_motion.longest = Some(Lap { revision: state.world.revision(), ..lap });
        motion
    }
}
