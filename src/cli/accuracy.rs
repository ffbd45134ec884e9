//! `linkwork accuracy`: runs a script in silence, then studies its motion.

use super::args::Study;
use super::output;
use super::quiet::rehearse;
use super::run::Status;
use crate::session::{Flow, Telling};

/// Studies a script's motion.
pub fn accuracy(wish: &Study) -> Status {
    let mut session = match rehearse(&wish.file, &wish.outside) {
        Ok(session) => session,
        Err(status) => return status,
    };
    let telling = if wish.json { Telling::Json } else { Telling::Table };
    match session.study_accuracy(wish.frames, telling) {
        Ok(Flow::Stopped) => Status::Interrupted,
        Ok(_) => Status::Fine,
        Err(problem) => {
            output::show(&problem, session.sources());
            Status::of(&problem)
        }
    }
}
