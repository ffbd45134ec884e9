//! Running scripts in batch, and the session.

use std::collections::BTreeSet;
use std::io::{self, BufRead, IsTerminal};
use std::path::Path;
use std::process::ExitCode;
use std::sync::mpsc::{Receiver, sync_channel};

use super::args::{HostArguments, RunArguments};
use super::process_host::ProcessHost;
use super::{files, interrupt, output};
use crate::diag::{Diagnostic, Kind, Sources};
use crate::errors;
use crate::lang::Growing;
use crate::session::{Flow, Host, Outcome, Quota, Session, Transcript, reason};

/// What the process says of how it went.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum ExitStatus {
    /// Everything was done.
    Fine = 0,
    /// An `assert` failed, or what a run promised did not hold.
    BrokenPromise = 1,
    /// A statement asked for something that cannot be done.
    Mistake = 2,
    /// A file could not be read or written.
    Unreadable = 3,
    /// The user stopped it.
    Interrupted = interrupt::STATUS as isize,
}

impl ExitStatus {
    pub fn of(problem: &Diagnostic) -> Self {
        match problem.kind {
            Kind::Promise => Self::BrokenPromise,
            Kind::Mistake => Self::Mistake,
            Kind::Unreadable => Self::Unreadable,
            Kind::Interrupted => Self::Interrupted,
        }
    }
}

impl From<ExitStatus> for ExitCode {
    fn from(status: ExitStatus) -> Self {
        Self::from(status as u8)
    }
}

/// Runs scripts up to the first error.
pub fn batch(batch: &RunArguments) -> ExitStatus {
    let mut unused: Option<BTreeSet<String>> = None;
    for (k, file) in batch.files.iter().enumerate() {
        let mut session = begin(&batch.host);
        let mut process = ProcessHost::new(&batch.host, files::folder_of(file));
        let status = script(file, &mut session, &mut process);
        if status != ExitStatus::Fine {
            return status;
        }
        let here: BTreeSet<String> = session.unused_overrides().map(str::to_owned).collect();
        unused = Some(unused.map_or(here.clone(), |all| &all & &here));
        if k + 1 == batch.files.len() {
            // The process ends and its memory with it: taking a large scene apart piece by
            // piece first would take as long as solving it.
            std::mem::forget(session);
        }
    }
    for name in unused.unwrap_or_default() {
        let warning = Diagnostic::warning(format!("no `let` took `--set {name}=...`"));
        ProcessHost::new(&batch.host, Path::new(".")).tell(&warning, &Sources::new());
    }
    ExitStatus::Fine
}

/// Runs one script, `-` from standard input, and says what went wrong.
pub fn script(file: &Path, session: &mut Session, host: &mut dyn Host) -> ExitStatus {
    let is_stdin = file == Path::new("-");
    let name = if is_stdin { "<stdin>".into() } else { file.to_string_lossy() };
    let text = if is_stdin { read_stdin() } else { interrupt::while_waiting(|| files::read(file)) };
    let text = match text {
        Ok(text) => text,
        Err(e) => {
            let why = reason(&e);
            let problem =
                Diagnostic::error(errors::CANNOT_READ, format!("cannot read `{name}`: {why}"));
            output::show(&problem, session.sources());
            return ExitStatus::Unreadable;
        }
    };
    let folder = file.parent().map(Path::to_path_buf).unwrap_or_default();
    let source = session.add_source(&name, &text, Some(folder));
    let Outcome { flow, failure } = session.run_script(source, host);
    match (failure, flow) {
        (Some(problem), _) => ExitStatus::of(&problem),
        (None, Flow::Stopped) => ExitStatus::Interrupted,
        (None, _) => ExitStatus::Fine,
    }
}

fn read_stdin() -> io::Result<String> {
    let (to, text) = sync_channel(1);
    std::thread::spawn(move || drop(to.send(files::read_text(io::stdin().lock()))));
    interrupt::next_from(&text).unwrap_or_else(|| Err(io::ErrorKind::Interrupted.into()))
}

/// Lines read ahead of what works on them.
const LINES_AHEAD: usize = 1024;

/// The lines of standard input with their ends, up to the end or the first that cannot be read. They
/// are read by a thread of their own, so that who waits for one can be woken.
fn lines_of_stdin() -> Receiver<io::Result<Vec<u8>>> {
    let (to, lines) = sync_channel(LINES_AHEAD);
    std::thread::spawn(move || {
        loop {
            let mut line = Vec::new();
            let result = io::stdin().lock().read_until(b'\n', &mut line);
            let is_last = !matches!(result, Ok(1..));
            if matches!(result, Ok(0)) || to.send(result.map(|_| line)).is_err() || is_last {
                return;
            }
        }
    });
    lines
}

/// An empty session.
pub(super) fn begin(host: &HostArguments) -> Session {
    if let Some(n) = host.threads {
        crate::solve::limit_cores(n.into());
    }
    let mut session = Session::new();
    for &(quota, most) in &host.limits {
        session.limit(quota, most);
        if quota == Quota::SourceBytes {
            files::limit_bytes(most);
        }
    }
    for (name, value) in &host.set {
        session.override_parameter(name, *value);
    }
    session
}

/// Runs a session: a prompt on a terminal, statements typed ahead on a pipe.
pub fn session(host: &HostArguments) -> ExitStatus {
    let mut session = begin(host);
    let mut process = ProcessHost::new(host, Path::new("."));
    let status = if io::stdin().is_terminal() {
        crate::repl::converse(&mut session, &mut process);
        ExitStatus::Fine
    } else {
        typed_ahead(&mut session, &mut process)
    };
    match session.finish(&mut process) {
        Ok(()) => status,
        Err(problem) => {
            output::show(&problem, session.sources());
            ExitStatus::of(&problem)
        }
    }
}

/// Statements from a pipe, carried out as they come: goes on after an error as a terminal would,
/// and says at the end what the first one was.
fn typed_ahead(session: &mut Session, host: &mut dyn Host) -> ExitStatus {
    let mut transcript = Transcript::new("<stdin>");
    let mut status = ExitStatus::Fine;
    let mut piece = Growing::default();
    let mut is_first = true;
    let lines = lines_of_stdin();
    loop {
        let line = match interrupt::next_from(&lines).unwrap_or_else(|| Ok(Vec::new())) {
            Ok(line) => line,
            Err(e) => {
                let problem = Diagnostic::error(
                    errors::CANNOT_READ,
                    format!("cannot read standard input: {e}"),
                );
                output::show(&problem, session.sources());
                return ExitStatus::Unreadable;
            }
        };
        let is_end = line.is_empty();
        let mark = files::BYTE_ORDER_MARK;
        let typed_line = if is_first { line.strip_prefix(mark) } else { None };
        let is_whole = piece.add(&String::from_utf8_lossy(typed_line.unwrap_or(&line)));
        is_first = false;
        if !is_end && !is_whole {
            continue;
        }
        let Outcome { flow, failure } = transcript.enter(&piece.take(), session, host);
        output::flush();
        if status == ExitStatus::Fine {
            status = failure.as_ref().map_or(ExitStatus::Fine, ExitStatus::of);
        }
        match flow {
            Flow::On if is_end => return status,
            Flow::On => {}
            Flow::Quit => return status,
            Flow::Stopped => return ExitStatus::Interrupted,
        }
    }
}
