//! A script that runs in silence, to be examined at its end.

use std::collections::HashMap;
use std::io;
use std::path::{Path, PathBuf};

use super::host::{Clock, Host};
use super::spool::Spool;
use crate::diag::{Diagnostic, Severity, Sources};
use crate::interrupt::Wish;

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
    fn print(&mut self, _line: &str) {}

    fn tell(&mut self, what: &Diagnostic, sources: &Sources) {
        if what.severity == Severity::Error {
            self.host.tell(what, sources);
        }
    }

    fn is_listening(&self) -> bool {
        false
    }

    fn wish_to_stop(&self) -> Option<Wish> {
        self.host.wish_to_stop()
    }

    fn is_interrupted(&self) -> bool {
        self.host.is_interrupted()
    }

    fn resolve(&self, path: &Path) -> io::Result<PathBuf> {
        self.host.resolve(path)
    }

    fn read(&mut self, path: &Path) -> io::Result<String> {
        match self.written.get(path) {
            Some(bytes) => Ok(String::from_utf8_lossy(bytes).into_owned()),
            None => self.host.read(path),
        }
    }

    fn find(&self, folder: &Path, path: &Path) -> io::Result<PathBuf> {
        self.host.find(folder, path)
    }

    fn write(&mut self, path: &Path, bytes: &[u8]) -> io::Result<()> {
        self.written.insert(path.to_path_buf(), bytes.to_vec());
        Ok(())
    }

    fn spool(&mut self) -> io::Result<Box<dyn Spool>> {
        self.host.spool()
    }

    fn seconds(&self) -> Option<f64> {
        self.host.seconds()
    }

    fn clock(&self) -> Option<Clock> {
        self.host.clock()
    }
}
