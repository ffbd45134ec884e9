//! What a session answers to a text: a host that keeps it all.

use std::collections::BTreeMap;
use std::fmt;
use std::io;
use std::path::{Path, PathBuf};

use super::host::Host;
use crate::diag::{Diagnostic, Severity, Sources};

/// All that a session printed, told and wrote, in memory. It has no clock: receipts say nothing of
/// time, and what promises or measures it is refused.
#[derive(Debug, Clone, Default)]
pub struct Answer {
    /// The lines printed.
    pub lines: Vec<String>,
    /// Notes and warnings, in their order.
    pub told: Vec<Diagnostic>,
    /// Files written, the last of each name. A text may `load` and `include` them again.
    pub files: BTreeMap<PathBuf, Vec<u8>>,
}

impl Answer {
    /// What took effect with a reservation.
    pub fn warnings(&self) -> impl Iterator<Item = &Diagnostic> {
        self.told.iter().filter(|what| what.severity == Severity::Warning)
    }
}

impl fmt::Display for Answer {
    /// The lines printed, as a terminal would show them.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.lines.iter().try_for_each(|line| writeln!(f, "{line}"))
    }
}

impl Host for Answer {
    fn print(&mut self, line: &str) {
        self.lines.push(line.to_owned());
    }

    fn tell(&mut self, what: &Diagnostic, _sources: &Sources) {
        self.told.push(what.clone());
    }

    fn read(&mut self, path: &Path) -> io::Result<String> {
        let bytes = self.files.get(path).ok_or(io::ErrorKind::NotFound)?;
        String::from_utf8(bytes.clone()).map_err(|_| io::ErrorKind::InvalidData.into())
    }

    fn read_back(&mut self, path: &Path) -> io::Result<String> {
        self.read(path)
    }

    fn write(&mut self, path: &Path, bytes: &[u8]) -> io::Result<()> {
        self.files.insert(path.to_path_buf(), bytes.to_vec());
        Ok(())
    }

    fn seconds(&self) -> Option<f64> {
        None
    }
}
