//! The motion of the last long command, kept so that it can be done again.

use crate::session::state::State;
use crate::solve::Memory;
use crate::study::{Hand, Leg, RepeatableMotion};
use crate::world::Moment;

/// The motions that are kept.
#[derive(Debug, Default)]
pub(crate) struct LastMotion {
    /// The longest since the structure last changed; of equals the first.
    longest: Option<Lap>,
    /// That of the command under way.
    current: Option<Lap>,
}

/// A motion: where it began, and what happened.
#[derive(Debug)]
struct Lap {
    moment: Moment,
    memory: Memory,
    legs: Vec<Leg>,
    n_frames: u64,
    /// The world's revision at its end.
    revision: u64,
}

/// Stretches of a motion beyond which no more are kept.
const MOST_LEGS: usize = 4096;

impl LastMotion {
    /// Forgets the command under way.
    pub fn give_up(&mut self) {
        self.current = None;
    }

    /// The command under way is done, and this the world's revision at its end.
    pub fn end(&mut self, revision: u64) {
        if let Some(lap) = self.current.take()
            && lap.n_frames > self.n_longest(revision)
        {
            self.longest = Some(lap);
        }
    }

    /// Frames are about to pass in the command under way. What the hand holds is not yet frozen.
    /// In a block more frames may follow.
    pub fn begin_leg(&mut self, state: &State, n_frames: u64, is_in_block: bool) {
        let revision = state.world.revision();
        if self.current.as_ref().is_some_and(|lap| lap.revision == revision) {
            return;
        }
        self.end(revision);
        if is_in_block || n_frames > self.n_longest(revision) {
            self.current = Some(Lap {
                moment: state.world.moment(),
                memory: state.solver.memory(),
                legs: Vec::new(),
                n_frames: 0,
                revision,
            });
        }
    }

    /// Frames have passed: `n_done` of the `n_frames` that were to. The hand has let go.
    pub fn end_leg(&mut self, state: &State, n_frames: u64, n_done: u64, hands: Vec<Hand>) {
        let Some(lap) = &mut self.current else { return };
        lap.revision = state.world.revision();
        if lap.legs.len() >= MOST_LEGS {
            return;
        }
        lap.n_frames += n_done;
        match lap.legs.last_mut() {
            Some(last) if last.hands.is_empty() && hands.is_empty() => last.n_frames += n_frames,
            _ => lap.legs.push(Leg { n_frames, hands }),
        }
    }

    /// The longest motion since the structure changed, if there was one.
    pub fn repeatable_motion(&self, state: &State) -> Option<RepeatableMotion> {
        let lap = self.longest.as_ref()?;
        if lap.revision != state.world.revision() {
            return None;
        }
        let (moment, memory) = (lap.moment.clone(), lap.memory.clone());
        let settings = state.preferences.solve;
        let repeatable =
            RepeatableMotion::back(&state.world, moment, memory, settings, lap.legs.clone());
        Some(repeatable.with_frames(lap.n_frames))
    }

    fn n_longest(&self, revision: u64) -> u64 {
        self.longest.as_ref().filter(|lap| lap.revision == revision).map_or(0, |lap| lap.n_frames)
    }
}
