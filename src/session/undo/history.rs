//! What was done: to be taken back, to be studied again, to be told.

use super::journal::Journal;
use super::last_motion::LastMotion;
use super::told::Place;
use crate::session::summary::Summary;
use crate::world::World;

/// What a session keeps of the commands it carried out.
#[derive(Debug, Default)]
pub struct History {
    /// What takes each command back.
    pub journal: Journal,
    /// The longest motion since the structure changed.
    pub last_motion: LastMotion,
    /// Receipt of the last command that let time pass.
    pub last_run: Option<Summary>,
    /// The world's revision and frame at its end.
    last_run_end: (u64, u64),
    /// How far the host's journal has been told.
    pub told: Place,
}

impl History {
    /// The command under way, or done, has let time pass and came to this.
    pub fn note_run(&mut self, summary: Summary, world: &World) {
        self.last_run = Some(summary);
        self.last_run_end = end_in(world);
    }

    /// The last command that let time pass, if it led here: since then nothing was made, changed or taken
    /// back but where points are.
    pub fn run_to(&self, world: &World) -> Option<&Summary> {
        self.last_run.as_ref().filter(|_| self.last_run_end == end_in(world))
    }
}

fn end_in(world: &World) -> (u64, u64) {
    (world.revision(), world.clock().frame)
}
