//! A script that runs in silence, to be examined at its end.

use std::collections::HashMap;
use std::io;
use std::path::{Path, PathBuf};

use super::host::Host;
use crate::diag::{Diagnostic, Severity, Sources};

/// A host behind which a script prints nothing, and what it writes is only there for itself to
/// read. Errors reach the host, and so does the wish to stop.
pub struct Silent<'a> {
    host: &'a mut dyn Host,
    written: HashMap<PathBuf, Vec<u8>>,
}

impl<'a> Silent<'a> {
    /// Silence in front of `host`.
    pub fn new(host: &'a mut dyn Host) -> Self {
        Self { host, written: HashMap::new() }
    }
}

impl Host for Silent<'_> {
    fn behind(&self) -> Option<&dyn Host> {
        Some(&*self.host)
    }

    fn behind_mut(&mut self) -> Option<&mut dyn Host> {
        Some(&mut *self.host)
    }

    fn print(&mut self, _line: &str) {}

    fn tell(&mut self, what: &Diagnostic, sources: &Sources) {
        if what.severity == Severity::Error {
            self.host.tell(what, sources);
        }
    }

    fn is_listening(&self) -> bool {
        false
    }

    fn is_keeping(&self) -> bool {
        false
    }

    fn opening(&mut self, _path: &Path) -> io::Result<Option<Vec<u8>>> {
        Ok(None)
    }

    fn read(&mut self, path: &Path) -> io::Result<String> {
        match self.written.get(path) {
            Some(bytes) => Ok(String::from_utf8_lossy(bytes).into_owned()),
            None => self.host.read(path),
        }
    }

    fn write(&mut self, path: &Path, bytes: &[u8]) -> io::Result<()> {
        self.written.insert(path.to_path_buf(), bytes.to_vec());
        Ok(())
    }
}
