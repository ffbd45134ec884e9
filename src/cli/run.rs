//! Running scripts in batch, and the session.

use std::io::{self, IsTerminal, Read};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use super::args::{Batch, Outside};
use super::outside::Process;
use super::{files, interrupt, talk};
use crate::diag::{Diagnostic, Kind};
use crate::session::{Flow, Session};

/// What the process says of how it went.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Status {
    Fine = 0,
    BrokenPromise = 1,
    Mistake = 2,
    Unreadable = 3,
    Interrupted = 130,
}

impl Status {
    const fn of(problem: &Diagnostic) -> Self {
        match problem.kind {
            Kind::Promise => Self::BrokenPromise,
            Kind::Mistake => Self::Mistake,
            Kind::Unreadable => Self::Unreadable,
            Kind::Interrupted => Self::Interrupted,
        }
    }
}

impl From<Status> for ExitCode {
    fn from(status: Status) -> Self {
        Self::from(status as u8)
    }
}

/// Runs scripts up to the first error.
pub fn batch(batch: &Batch) -> ExitCode {
    interrupt::listen();
    for file in &batch.files {
        let (status, _) = script(file, &batch.outside);
        if status != Status::Fine {
            talk::flush();
            return status.into();
        }
    }
    talk::flush();
    Status::Fine.into()
}

/// Runs a script; gives what there is at its end, if it could be read.
pub(super) fn script(file: &Path, outside: &Outside) -> (Status, Option<Session>) {
    let (name, text, folder) = if file == Path::new("-") {
        let mut bytes = Vec::new();
        let read = io::stdin().lock().read_to_end(&mut bytes).and_then(|_| {
            String::from_utf8(bytes).map_err(|_| io::Error::from(io::ErrorKind::InvalidData))
        });
        ("<stdin>".to_owned(), read, PathBuf::new())
    } else {
        let folder = file.parent().map(Path::to_path_buf).unwrap_or_default();
        (file.to_string_lossy().into_owned(), files::read(file), folder)
    };
    let text = match text {
        Ok(text) => text,
        Err(e) => {
            let why = if e.kind() == io::ErrorKind::InvalidData {
                "not a text in UTF-8".to_owned()
            } else {
                e.to_string()
            };
            eprintln!("error: cannot read `{name}`: {why}");
            return (Status::Unreadable, None);
        }
    };
    let mut session = begin(outside);
    let source = session.add_source(&name, &text, Some(folder));
    let result = session.execute_all(source).and_then(|flow| {
        session.finish()?;
        Ok(flow)
    });
    let status = match result {
        Ok(Flow::Stopped) => Status::Interrupted,
        Ok(_) => Status::Fine,
        Err(problem) => {
            talk::show(&problem, session.sources());
            // What was recorded up to here is not lost.
            if let Err(problem) = session.finish() {
                talk::show(&problem, session.sources());
            }
            return (Status::of(&problem), Some(session));
        }
    };
    for name in session.unused_overrides() {
        talk::flush();
        eprintln!("warning: no `let` took `--set {name}`");
    }
    (status, Some(session))
}

fn begin(outside: &Outside) -> Session {
    let mut session = Session::new(Box::new(Process::new(outside)));
    for (name, value) in &outside.set {
        session.override_parameter(name, *value);
    }
    session
}

/// Runs a session: a prompt on a terminal, statements typed ahead on a pipe.
pub fn session(outside: &Outside) -> ExitCode {
    interrupt::listen();
    let mut session = begin(outside);
    let folder = Some(PathBuf::from("."));
    let status = if io::stdin().is_terminal() {
        crate::repl::converse(&mut session, folder);
        Status::Fine
    } else {
        typed_ahead(&mut session)
    };
    let status = match session.finish() {
        Ok(()) => status,
        Err(problem) => {
            talk::show(&problem, session.sources());
            Status::of(&problem)
        }
    };
    talk::flush();
    status.into()
}

/// Statements from a pipe: goes on after an error as a terminal would.
fn typed_ahead(session: &mut Session) -> Status {
    let mut bytes = Vec::new();
    if let Err(e) = io::stdin().lock().read_to_end(&mut bytes) {
        eprintln!("error: cannot read standard input: {e}");
        return Status::Unreadable;
    }
    let text = String::from_utf8_lossy(&bytes);
    let source = session.add_source("<stdin>", &text, Some(PathBuf::from(".")));
    let mut status = Status::Fine;
    for statement in crate::lang::parse(source, &text) {
        match statement.and_then(|statement| session.execute(&statement)) {
            Ok(Flow::On) => {}
            Ok(Flow::Quit) => break,
            Ok(Flow::Stopped) => return Status::Interrupted,
            Err(problem) => {
                talk::show(&problem, session.sources());
                status = Status::Mistake;
            }
        }
    }
    status
}
