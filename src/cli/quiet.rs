//! A script that runs in silence, to be examined at its end.

use std::cell::Cell;
use std::collections::HashMap;
use std::io;
use std::path::{Path, PathBuf};
use std::rc::Rc;

use super::args::Outside;
use super::process_host::Process;
use super::run::{self, Status};
use crate::diag::{Diagnostic, Severity, Sources};
use crate::session::{Host, Session};

/// The process, but a script that runs here prints nothing, and what it writes is only there
/// for itself to read.
struct Rehearsal {
    process: Process,
    is_over: Rc<Cell<bool>>,
    written: HashMap<PathBuf, Vec<u8>>,
}

impl Host for Rehearsal {
    fn print(&mut self, line: &str) {
        if self.is_over.get() {
            self.process.print(line);
        }
    }

    fn tell(&mut self, what: &Diagnostic, sources: &Sources) {
        if self.is_over.get() || what.severity == Severity::Error {
            self.process.tell(what, sources);
        }
    }

    fn is_interrupted(&self) -> bool {
        self.process.is_interrupted()
    }

    fn read(&mut self, path: &Path) -> io::Result<String> {
        match self.written.get(path) {
            Some(bytes) => Ok(String::from_utf8_lossy(bytes).into_owned()),
            None => self.process.read(path),
        }
    }

    fn write(&mut self, path: &Path, bytes: &[u8]) -> io::Result<()> {
        if self.is_over.get() {
            return self.process.write(path, bytes);
        }
        self.written.insert(self.process.written(path), bytes.to_vec());
        Ok(())
    }

    fn written(&self, path: &Path) -> PathBuf {
        self.process.written(path)
    }

    fn allows_any_path(&self) -> bool {
        self.process.allows_any_path()
    }

    fn progress(&self, share: f64) {
        if self.is_over.get() {
            self.process.progress(share);
        }
    }

    fn seconds(&self) -> f64 {
        self.process.seconds()
    }
}

/// Runs a script to its end; the session after it talks and writes as usual.
///
/// # Errors
/// The status of a script that failed, which has said why.
pub fn rehearse(file: &Path, outside: &Outside) -> Result<Session, Status> {
    let is_over = Rc::new(Cell::new(false));
    let process = Process::new(outside);
    let host = Rehearsal { process, is_over: is_over.clone(), written: HashMap::new() };
    let mut session = Session::new(Box::new(host));
    for (name, value) in &outside.set {
        session.override_parameter(name, *value);
    }
    let status = run::script(file, &mut session);
    is_over.set(true);
    if status == Status::Fine { Ok(session) } else { Err(status) }
}
