//! The host of a session that runs in a process: files, a clock, Ctrl-C.

use std::io;
use std::path::{Path, PathBuf};
use std::time::Instant;

use super::args::HostArguments;
use super::journal::Journal;
use super::progress::ProgressBar;
use super::{files, interrupt, output};
use crate::diag::{Diagnostic, Severity, Sources};
use crate::render::Sketch;
use crate::session::{Example, Host, Kept, contained, reason};

/// The process as a session sees it.
pub struct ProcessHost {
    out: PathBuf,
    is_quiet: bool,
    allows_any_path: bool,
    has_pager: bool,
    journal: Option<Journal>,
    begun: Instant,
    bar: ProgressBar,
}

/// Where what an example includes is looked for: no folder, it comes with the program.
pub const EXAMPLES_FOLDER: &str = "<examples>";

impl ProcessHost {
    /// The process with the user's wishes.
    pub fn new(host: &HostArguments) -> Self {
        Self {
            out: host.out(),
            is_quiet: host.quiet,
            allows_any_path: host.allow_any_path,
            has_pager: !host.no_pager,
            journal: None,
            begun: Instant::now(),
            bar: ProgressBar::default(),
        }
    }
}

impl ProcessHost {
    /// From here on what is typed is kept in a journal; where that cannot be, it is not.
    pub fn begin_journal(&mut self) {
        self.journal = Journal::begin().ok();
    }

    /// The session ended in order.
    pub fn end_journal(&mut self) {
        if let Some(journal) = self.journal.take() {
            journal.end();
        }
    }
}

impl Host for ProcessHost {
    fn print(&mut self, line: &str) {
        output::answer(line);
    }

    fn print_all(&mut self, lines: &[String]) {
        if self.has_pager {
            output::page(lines);
        } else {
            lines.iter().for_each(|line| output::answer(line));
        }
    }

    fn page(&self) -> (usize, usize) {
        output::page_size()
    }

    fn draw(&mut self, sketch: &Sketch) {
        output::draw(sketch);
    }

    fn tell(&mut self, what: &Diagnostic, sources: &Sources) {
        if !self.is_quiet || what.severity == Severity::Error {
            output::show(what, sources);
        }
    }

    fn is_listening(&self) -> bool {
        !self.is_quiet
    }

    fn is_keeping(&self) -> bool {
        self.journal.is_some()
    }

    fn keep(&mut self, kept: Kept<'_>) {
        if let Some(journal) = &mut self.journal
            && let Err(e) = journal.keep(kept)
        {
            let why = format!("this session is not kept in a journal any more: {}", reason(&e));
            self.tell(&Diagnostic::warning(why), &Sources::new());
            self.journal = None;
        }
    }

    fn is_interrupted(&self) -> bool {
        interrupt::is_asked()
    }

    fn resolve(&self, path: &Path) -> io::Result<PathBuf> {
        let path = if self.allows_any_path { path.to_path_buf() } else { contained(path)? };
        Ok(self.out.join(path))
    }

    fn read(&mut self, path: &Path) -> io::Result<String> {
        match path.strip_prefix(EXAMPLES_FOLDER) {
            Ok(name) => Example::named(&name.to_string_lossy())
                .map(|example| example.text.to_owned())
                .map_err(|_| io::ErrorKind::NotFound.into()),
            Err(_) => files::read(path),
        }
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
