//! What accuracy costs in time: a motion done again with every method over a ladder of settings.
//!
//! A [`RepeatableMotion`] is what is studied; [`study`] repeats it on copies of its world, once for
//! each rung of the [`ladder`], and compares every frame with a reference solved as exactly as
//! doubles allow. Nothing here knows statements, files or the clock on the wall: the time comes
//! from the caller.

mod advice;
mod hand;
mod host;
mod measure;
mod picture;
mod reference;
mod reference_run;
mod repeatable_motion;
mod report;
mod sample;
mod setting_ladder;
mod table;

pub use advice::{Advice, Wish};
pub use hand::{Hand, move_by};
pub use host::StudyHost;
pub use measure::study;
pub use picture::picture;
pub use reference_run::freedoms;
pub use repeatable_motion::{Leg, RepeatableMotion};
pub use report::{RungResult, Study};
pub use setting_ladder::ladder;
pub use table::{CSV_HEADING, csv, table};
