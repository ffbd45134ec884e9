//! What takes a command back, and does it again.

pub mod history;
pub mod journal;
pub mod last_motion;
pub mod recorder;
mod repeat;
pub mod told;
pub mod transaction;
