//! What was done: to be taken back, to be studied again, to be told.

use super::journal::Journal;
use super::last_motion::LastMotion;
use super::told::Place;
use crate::session::summary::Summary;

/// What a session keeps of the commands it carried out.
#[derive(Debug, Default)]
pub struct History {
    /// What takes each command back.
    pub journal: Journal,
    /// The longest motion since the structure changed.
    pub last_motion: LastMotion,
    /// Receipt of the last command that let time pass.
    pub last_run: Option<Summary>,
    /// How far the host's journal has been told.
    pub told: Place,
}
