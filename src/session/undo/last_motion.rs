//! The motion of the last long command, kept so that it can be done again.

use crate::session::Session;
use crate::solve::Memory;
use crate::study::{Course, Hand, Leg};
use crate::world::Motion;

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
    motion: Motion,
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

    /// Where the command under way began to let time pass, or the longest did.
    pub fn latest(&self) -> Option<&Motion> {
        self.current.as_ref().or(self.longest.as_ref()).map(|lap| &lap.motion)
    }

    fn n_longest(&self, revision: u64) -> u64 {
        self.longest.as_ref().filter(|lap| lap.revision == revision).map_or(0, |lap| lap.n_frames)
    }

    fn end(&mut self, revision: u64) {
        if let Some(lap) = self.current.take()
            && lap.n_frames > self.n_longest(revision)
        {
            self.longest = Some(lap);
        }
    }
}

impl Session {
    /// Frames are about to pass. What the hand holds is not yet frozen.
    pub(crate) fn begin_leg(&mut self, n_frames: u64) {
        let revision = self.world.revision();
        if self.last_motion.current.as_ref().is_some_and(|lap| lap.revision == revision) {
            return;
        }
        self.last_motion.end(revision);
        // In a loop more frames may follow.
        if self.depth > 0 || n_frames > self.last_motion.n_longest(revision) {
            self.last_motion.current = Some(Lap {
                motion: self.world.motion(),
                memory: self.solver.memory(),
                legs: Vec::new(),
                n_frames: 0,
                revision,
            });
        }
    }

    /// Frames have passed: `n_done` of the `n_frames` that were to. The hand has let go.
    pub(crate) fn end_leg(&mut self, n_frames: u64, n_done: u64, hands: Vec<Hand>) {
        let revision = self.world.revision();
        let Some(lap) = &mut self.last_motion.current else { return };
        lap.revision = revision;
        if lap.legs.len() >= MOST_LEGS {
            return;
        }
        lap.n_frames += n_done;
        match lap.legs.last_mut() {
            Some(last) if last.hands.is_empty() && hands.is_empty() => last.n_frames += n_frames,
            _ => lap.legs.push(Leg { n_frames, hands }),
        }
    }

    /// The command under way is done.
    pub(crate) fn end_legs(&mut self) {
        self.last_motion.end(self.world.revision());
    }

    /// The longest motion since the structure changed, if there was one.
    pub(crate) fn last_course(&self) -> Option<Course> {
        let lap = self.last_motion.longest.as_ref()?;
        if lap.revision != self.world.revision() {
            return None;
        }
        let (motion, memory) = (lap.motion.clone(), lap.memory.clone());
        let settings = self.preferences.solve;
        let course = Course::back(&self.world, motion, memory, settings, lap.legs.clone());
        Some(course.with_frames(lap.n_frames))
    }
}
