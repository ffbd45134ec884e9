//! The host of a session that runs in a process: files, a clock, Ctrl-C.

use std::collections::{BTreeMap, BTreeSet};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::rc::Rc;
use std::time::Instant;

use super::args::HostArguments;
use super::journal::{self, Journal};
use super::progress::ProgressBar;
use super::seen::Seen;
use super::spool::FileSpool;
use super::view::View;
use super::{files, interrupt, output};
use crate::diag::{Diagnostic, Severity, Sources};
use crate::render::Drawable;
use crate::session::{
    Clock, Example, Host, Kept, Session, Spool, Wish, contained, problem_alone, reason,
};

/// The process as a session sees it.
#[expect(clippy::struct_excessive_bools, reason = "each is a wish of its own")]
pub struct ProcessHost {
    /// Where files are written.
    out: PathBuf,
    /// Where files may be read, symbolic links followed.
    readable: Vec<PathBuf>,
    /// Where what is not beside its script is looked for.
    libraries: Vec<PathBuf>,
    /// Folders in which nothing is left of runs that were killed.
    tidy: BTreeSet<PathBuf>,
    /// What was written, and where that really lies.
    written: BTreeMap<PathBuf, PathBuf>,
    may_replace_any: bool,
    is_quiet: bool,
    /// Whether what is said is read by a program.
    speaks_json: bool,
    allows_any_path: bool,
    has_pager: bool,
    journal: Option<Journal>,
    begun: Instant,
    bar: ProgressBar,
    /// What was read, where somebody wants to know.
    seen: Option<Seen>,
    /// Whether it goes on after a statement, so that pages may look at the session.
    pub(super) may_view: bool,
    /// The pages that do.
    view: Option<View>,
}

thread_local! {
    /// Says whether the user wants to stop; each statement asks for it.
    static WISH: Wish = Rc::new(interrupt::is_asked);
}

/// Where what an example includes is looked for: no folder, it comes with the program.
pub const EXAMPLES_FOLDER: &str = "<examples>";

impl ProcessHost {
    /// The process with the user's wishes, for a script in a folder.
    pub fn new(host: &HostArguments, folder: &Path) -> Self {
        let mut readable = vec![folder.to_path_buf(), host.out()];
        readable.extend(host.libraries.iter().cloned());
        Self {
            out: host.out(),
            readable,
            libraries: host.libraries.clone(),
            tidy: BTreeSet::new(),
            written: BTreeMap::new(),
            may_replace_any: host.force,
            is_quiet: host.quiet,
            speaks_json: host.json,
            allows_any_path: host.allow_any_path,
            has_pager: !host.no_pager,
            journal: None,
            begun: Instant::now(),
            bar: ProgressBar::default(),
            seen: None,
            may_view: false,
            view: None,
        }
    }

    /// From here on it is noted which files are read. Nobody is there to turn pages.
    pub fn watch(&mut self, seen: Seen) {
        self.seen = Some(seen);
        self.has_pager = false;
    }

    /// The files that were read since then.
    pub fn seen(self) -> Seen {
        self.seen.unwrap_or_default()
    }
}

impl ProcessHost {
    /// Lets pages look at the session, at a port or at any that is free; gives where.
    ///
    /// # Errors
    /// Where the port is not to be had.
    pub fn open_view(&mut self, port: Option<u16>) -> io::Result<String> {
        let view = match self.view.take() {
            Some(view) => view,
            None => View::open(port)?,
        };
        Ok(self.view.insert(view).address().to_owned())
    }

    /// Whether pages look at the session.
    pub const fn is_viewed(&self) -> bool {
        self.view.is_some()
    }

    /// Waits for something while pages, if there are any, have the session; `told` is told their
    /// statements.
    pub fn meanwhile<T>(
        &mut self,
        session: &mut Session,
        told: &mut (dyn FnMut(&str) + Send),
        wait: impl FnOnce() -> T,
    ) -> T {
        let Some(mut view) = self.view.take() else { return wait() };
        let result = view.meanwhile(session, self, told, wait);
        self.view = Some(view);
        result
    }

    /// From here on what is typed is kept in a journal; where that cannot be, it is not.
    pub fn begin_journal(&mut self) {
        self.journal = Journal::begin().ok();
        // Those that others left may be loaded.
        self.readable.extend(journal::folder());
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
        output::answer_fitted(line);
    }

    fn print_all(&mut self, lines: &[String]) {
        if self.has_pager {
            output::page(lines);
        } else {
            let goes_on = |_: &&String| !self.is_interrupted();
            lines.iter().take_while(goes_on).for_each(|line| output::answer_fitted(line));
        }
    }

    fn page(&self) -> (usize, usize) {
        output::page_size()
    }

    fn draw(&mut self, what: Drawable) {
        output::draw(what);
    }

    fn n_printed(&self) -> u64 {
        output::n_bytes()
    }

    fn tell(&mut self, what: &Diagnostic, sources: &Sources) {
        if self.speaks_json {
            // What stands beside an answer that stands alone.
            if what.severity != Severity::Note {
                output::answer(&problem_alone(what, sources));
            }
        } else if !self.is_quiet || what.severity == Severity::Error {
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

    fn wish_to_stop(&self) -> Option<Wish> {
        Some(WISH.with(Clone::clone))
    }

    fn forget_stop(&mut self) {
        interrupt::forget();
    }

    fn resolve(&self, path: &Path) -> io::Result<PathBuf> {
        if self.allows_any_path {
            return Ok(self.out.join(path));
        }
        let place = self.out.join(contained(path)?);
        // In a folder that is still to be made there is no link yet.
        if !self.out.exists() || files::is_below(&self.out, &place)? {
            Ok(place)
        } else {
            Err(io::ErrorKind::PermissionDenied.into())
        }
    }

    fn find(&self, folder: &Path, path: &Path) -> io::Result<PathBuf> {
        let folders = std::iter::once(folder).chain(self.libraries.iter().map(PathBuf::as_path));
        let mut places = folders.map(|folder| folder.join(path));
        let beside = folder.join(path);
        if folder == Path::new(EXAMPLES_FOLDER) {
            return Ok(beside);
        }
        let place = places.find(|place| place.exists()).unwrap_or(beside);
        if self.allows_any_path {
            return Ok(place);
        }
        for folder in &self.readable {
            if files::is_below(folder, &place)? {
                return Ok(place);
            }
        }
        Err(io::ErrorKind::PermissionDenied.into())
    }

    fn read(&mut self, path: &Path) -> io::Result<String> {
        if let Ok(name) = path.strip_prefix(EXAMPLES_FOLDER) {
            let example = Example::named(&name.to_string_lossy());
            return example
                .map(|example| example.text.to_owned())
                .map_err(|_| io::ErrorKind::NotFound.into());
        }
        if let Some(seen) = &mut self.seen {
            seen.note(path);
        }
        if files::is_regular(path)? {
            files::read(path)
        } else {
            Err(io::ErrorKind::NotFound.into())
        }
    }

    fn opening(&mut self, path: &Path) -> io::Result<Option<Vec<u8>>> {
        if self.may_replace_any {
            return files::is_regular(path).map(|_| None);
        }
        files::opening(path)
    }

    fn write(&mut self, path: &Path, bytes: &[u8]) -> io::Result<()> {
        self.write_in_pieces(path, &mut |out| out.write_all(bytes))
    }

    fn write_in_pieces(
        &mut self,
        path: &Path,
        content: &mut dyn FnMut(&mut dyn Write) -> io::Result<()>,
    ) -> io::Result<()> {
        let folder = files::folder_of(path);
        if self.tidy.insert(folder.to_path_buf()) {
            files::remove_leftovers(folder);
        }
        let within = (!self.allows_any_path).then_some(&*self.out);
        files::write_in_pieces(path, within, content)?;
        if let Ok(place) = path.canonicalize() {
            self.written.insert(path.to_path_buf(), place);
        }
        Ok(())
    }

    fn read_back(&mut self, path: &Path) -> io::Result<String> {
        let place = self.written.get(path).ok_or(io::ErrorKind::NotFound)?;
        files::read_at(place)
    }

    fn spool(&mut self) -> io::Result<Box<dyn Spool>> {
        Ok(Box::new(FileSpool::new(files::nameless(&self.out)?)))
    }

    fn progress(&self, share: f64) {
        if !self.is_quiet && !self.speaks_json {
            self.bar.show(share);
        }
    }

    fn view(&mut self) -> io::Result<String> {
        if self.may_view { self.open_view(None) } else { Err(io::ErrorKind::Unsupported.into()) }
    }

    fn seconds(&self) -> Option<f64> {
        Some(self.begun.elapsed().as_secs_f64())
    }

    fn clock(&self) -> Option<Clock> {
        let begun = self.begun;
        Some(Rc::new(move || begun.elapsed().as_secs_f64()))
    }
}
