//! The motion of the last long command, kept so that it can be done again.

use crate::session::state::State;
use crate::solve::Memory;
use crate::study::{Hand, Leg};
use crate::world::Moment;

/// The motions that are kept.
#[derive(Debug, Default)]
pub(crate) struct LastMotion {
    /// The longest since the structure last changed; of equals the first.
    pub(super) longest: Option<Lap>,
    /// That of the command under way.
    current: Option<Lap>,
}

/// A motion: where it began, and what happened.
#[derive(Debug)]
pub(super) struct Lap {
    pub beginning: Beginning,
    pub legs: Vec<Leg>,
    pub n_frames: u64,
    /// The world's revision at its end.
    pub revision: u64,
}

/// Where a motion began.
#[derive(Debug)]
pub(super) enum Beginning {
    /// Before the command of this number.
    Command(u64),
    /// In the middle of a command.
    Within(Box<(Moment, Memory)>),
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
    /// In a block more frames may follow; else they are all of the command of this number.
    pub fn begin_leg(&mut self, state: &State, n_frames: u64, is_in_block: bool, number: u64) {
        let revision = state.world.revision();
        if self.current.as_ref().is_some_and(|lap| lap.revision == revision) {
            return;
        }
        self.end(revision);
        if is_in_block || n_frames > self.n_longest(revision) {
            let beginning = if is_in_block {
                Beginning::Within(Box::new((state.world.moment(), state.solver.memory())))
            } else {
                Beginning::Command(number)
            };
            self.current = Some(Lap { beginning, legs: Vec::new(), n_frames: 0, revision });
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

    fn n_longest(&self, revision: u64) -> u64 {
        self.longest.as_ref().filter(|lap| lap.revision == revision).map_or(0, |lap| lap.n_frames)
    }
}
