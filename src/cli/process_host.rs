//! The host of a session that runs in a process: files, a clock, Ctrl-C.

use std::io;
use std::path::{Path, PathBuf};
use std::rc::Rc;
use std::time::Instant;

use super::args::HostArguments;
use super::progress::ProgressBar;
use super::{files, interrupt, output};
use crate::diag::{Diagnostic, Severity, Sources};
use crate::session::{Host, Wish, contained};

/// The process as a session sees it.
pub struct ProcessHost {
    out: PathBuf,
    is_quiet: bool,
    allows_any_path: bool,
    begun: Instant,
    bar: ProgressBar,
}

impl ProcessHost {
    /// The process with the user's wishes.
    pub fn new(host: &HostArguments) -> Self {
        Self {
            out: host.out.clone(),
            is_quiet: host.quiet,
            allows_any_path: host.allow_any_path,
            begun: Instant::now(),
            bar: ProgressBar::default(),
        }
    }
}

impl Host for ProcessHost {
    fn print(&mut self, line: &str) {
        output::answer(line);
    }

    fn tell(&mut self, what: &Diagnostic, sources: &Sources) {
        if !self.is_quiet || what.severity == Severity::Error {
            output::show(what, sources);
        }
    }

    fn is_listening(&self) -> bool {
        !self.is_quiet
    }

    fn is_interrupted(&self) -> bool {
        interrupt::is_asked()
    }

    fn wish_to_stop(&self) -> Option<Wish> {
        Some(Rc::new(interrupt::is_asked))
    }

    fn resolve(&self, path: &Path) -> io::Result<PathBuf> {
        let path = if self.allows_any_path { path.to_path_buf() } else { contained(path)? };
        Ok(self.out.join(path))
    }

    fn read(&mut self, path: &Path) -> io::Result<String> {
        files::read(path)
    }

    fn write(&mut self, path: &Path, bytes: &[u8]) -> io::Result<()> {
        files::write(path, bytes)
    }

    fn progress(&self, share: f64) {
        if !self.is_quiet {
            self.bar.show(share);
        }
    }

    fn seconds(&self) -> Option<f64> {
        Some(self.begun.elapsed().as_secs_f64())
    }
}
