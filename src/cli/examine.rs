//! `linkwork check`, `effects` and `accuracy`: a script runs in silence, then its scene is
//! looked at.

use std::path::Path;

use super::args::{Examination, Outside, Study};
use super::output;
use super::process_host::Process;
use super::run::{Status, begin, script};
use crate::session::{Flow, Session, Silent, Telling};

/// Says what there is to know about the mechanism at a script's end.
pub fn check(examination: &Examination) -> Status {
    let (session, _) = match rehearse(&examination.file, &examination.outside) {
        Ok(run) => run,
        Err(status) => return status,
    };
    let check = session.examine();
    if examination.json {
        output::answer(&check.to_json());
    } else {
        check.lines().iter().for_each(|line| output::answer(line));
    }
    if check.is_sound() { Status::Fine } else { Status::BrokenPromise }
}

/// Says which effects a script's scene has switched on at its end, why, and what each costs.
pub fn effects(examination: &Examination) -> Status {
    let (session, process) = match rehearse(&examination.file, &examination.outside) {
        Ok(run) => run,
        Err(status) => return status,
    };
    let effects = session.effects_on(&process);
    if examination.json {
        output::answer(&effects.to_json());
    } else {
        effects.lines().iter().for_each(|line| output::answer(line));
    }
    Status::Fine
}

/// Studies a script's motion.
pub fn accuracy(wish: &Study) -> Status {
    let (mut session, mut process) = match rehearse(&wish.file, &wish.outside) {
        Ok(run) => run,
        Err(status) => return status,
    };
    let telling = if wish.json { Telling::Json } else { Telling::Table };
    match session.study_accuracy(wish.frames, telling, &mut process) {
        Ok(Flow::Stopped) => Status::Interrupted,
        Ok(_) => Status::Fine,
        Err(problem) => {
            output::show(&problem, session.sources());
            Status::of(&problem)
        }
    }
}

/// Runs a script to its end in silence; gives the session after it, and who it talks to from
/// then on.
///
/// # Errors
/// The status of a script that failed, which has said why.
fn rehearse(file: &Path, outside: &Outside) -> Result<(Session, Process), Status> {
    let mut session = begin(outside);
    let mut process = Process::new(outside);
    match script(file, &mut session, &mut Silent::new(&mut process)) {
        Status::Fine => Ok((session, process)),
        status => Err(status),
    }
}
