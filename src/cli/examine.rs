//! `linkwork check`, `effects` and `accuracy`: a script runs in silence, then its scene is
//! looked at.

use std::path::Path;

use super::args::{AccuracyArguments, ExamineArguments, HostArguments};
use super::process_host::ProcessHost;
use super::run::{ExitStatus, begin, refuse, script};
use super::{files, output};
use crate::session::{Flow, Host as _, Session, Silent, Telling, Undeclared};

/// Says what there is to know about the mechanism at a script's end.
pub fn check(arguments: &ExamineArguments) -> ExitStatus {
    let (session, _) = match run_in_silence(&arguments.file, &arguments.host) {
        Ok(run) => run,
        Err(status) => return status,
    };
    let check = session.examine();
    if arguments.host.json {
        output::answer(&check.to_json());
    } else {
        check.lines().iter().for_each(|line| output::answer_fitted(line));
    }
    if check.is_sound() { ExitStatus::Fine } else { ExitStatus::BrokenPromise }
}

/// Says which effects a script's scene has switched on at its end, why, and what each costs.
pub fn effects(arguments: &ExamineArguments) -> ExitStatus {
    let (session, process) = match run_in_silence(&arguments.file, &arguments.host) {
        Ok(run) => run,
        Err(status) => return status,
    };
    let effects = session.effects_on(&process);
    if arguments.host.json {
        output::answer(&effects.to_json());
    } else {
        effects.lines(output::page_size().0).iter().for_each(|line| output::answer_fitted(line));
    }
    ExitStatus::Fine
}

/// Studies a script's motion.
pub fn accuracy(wish: &AccuracyArguments) -> ExitStatus {
    let (mut session, mut process) = match run_in_silence(&wish.file, &wish.host) {
        Ok(run) => run,
        Err(status) => return status,
    };
    let telling = if wish.host.json { Telling::Json } else { Telling::Table };
    match session.study_accuracy(wish.frames, telling, &mut process) {
        Ok(Flow::Stopped) => ExitStatus::Interrupted,
        Ok(_) => ExitStatus::Fine,
        Err(problem) => {
            process.tell(&problem, session.sources());
            ExitStatus::of(&problem)
        }
    }
}

/// Runs a script to its end in silence; gives the session after it, and who it talks to from
/// then on.
///
/// # Errors
/// The status of a script that failed, which has said why.
fn run_in_silence(file: &Path, host: &HostArguments) -> Result<(Session, ProcessHost), ExitStatus> {
    let mut session = begin(host);
    let mut process = ProcessHost::new(host, files::folder_of(file));
    let status = match script(file, &mut session, &mut Silent::new(&mut process)) {
        ExitStatus::Fine => refuse(&Undeclared::in_session(&session), &mut process),
        status => status,
    };
    if status == ExitStatus::Fine { Ok((session, process)) } else { Err(status) }
}
