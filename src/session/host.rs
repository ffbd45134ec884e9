//! What a session needs of the world outside: somewhere to print, files, a clock, a way to stop it.

use std::io;
use std::path::{Component, Path, PathBuf};
use std::rc::Rc;

use super::finding::Finding;
use super::spool::Spool;
use crate::diag::{Diagnostic, Sources, Span};
use crate::interrupt::Wish;
use crate::render::Drawable;
use crate::world::World;

/// What a journal is told of a session.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kept<'a> {
    /// The text of statements which, repeated, do what a command did. To be kept whole or not at all.
    Done(&'a str),
    /// All but so many of the texts that were told since the last script of all there is were taken
    /// back.
    First(u64),
    /// The script that makes all there is; what was told before is not needed any more.
    Whole(&'a str),
}

/// A statement that was carried out, or was not.
#[derive(Debug)]
pub struct Done<'a> {
    /// Where it stands.
    pub span: Span,
    /// Whether it took effect.
    pub is_ok: bool,
    /// The texts that places are in.
    pub sources: &'a Sources,
    /// The world after it.
    pub world: &'a World,
}

/// Says how many seconds have passed since some fixed moment.
pub type Clock = Rc<dyn Fn() -> f64>;

/// The outside of a session. The program gives it a terminal and files; a test gives it lists.
///
/// A host may stand before another one, whose files, clock and journal are then its own, and whose user
/// may stop it: all of that is asked of the one [behind](Self::behind) unless it answers itself. What is
/// said to it is its own affair.
pub trait Host {
    /// The host that this one stands before.
    fn behind(&self) -> Option<&dyn Host> {
        None
    }

    /// The same, to be asked for something; there where [`behind`](Self::behind) is.
    fn behind_mut(&mut self) -> Option<&mut dyn Host> {
        None
    }

    /// Takes one line of the answer, without its line end.
    fn print(&mut self, line: &str);

    /// Takes an answer of several lines that belong together: a terminal may show it page by page, and
    /// need not take the rest once the user wants to stop.
    fn print_all(&mut self, lines: &[String]) {
        lines.iter().for_each(|line| self.print(line));
    }

    /// Columns and rows of what is drawn in characters.
    fn page(&self) -> (usize, usize) {
        (72, 24)
    }

    /// Takes what is to be shown; by default in characters.
    fn draw(&mut self, what: Drawable) {
        let (n_columns, n_rows) = self.page();
        self.print_all(&what.sketch(n_columns, n_rows).lines());
    }

    /// Bytes of the answer so far, where somebody wants that to have an end.
    fn n_printed(&self) -> u64 {
        0
    }

    /// Takes talk: notes and warnings. An error is returned to who asked for the statement; who
    /// gave a whole text to carry out is told of it here.
    fn tell(&mut self, what: &Diagnostic, sources: &Sources);

    /// Whether notes and warnings reach anybody: what is worked out for their sake alone is left
    /// out otherwise.
    fn is_listening(&self) -> bool {
        true
    }

    /// Whether what statements find is wanted as data: they do not print it then.
    fn takes_findings(&self) -> bool {
        false
    }

    /// Takes what a statement found, as data.
    fn find_out(&mut self, _finding: &Finding) {}

    /// Told when a statement of a text has ended, after all that it said.
    fn done(&mut self, _done: &Done) {}

    /// Whether a journal is kept of what is typed.
    fn is_keeping(&self) -> bool {
        self.behind().is_some_and(Host::is_keeping)
    }

    /// Takes what its journal needs to bring the session back, as it was after a statement.
    fn keep(&mut self, kept: Kept<'_>) {
        if let Some(host) = self.behind_mut() {
            host.keep(kept);
        }
    }

    /// Whether the user asked to stop the running command; asked between frames.
    fn is_interrupted(&self) -> bool {
        self.behind().is_some_and(Host::is_interrupted)
    }

    /// What says the same within a long piece of work, which is then left half done and taken back;
    /// by default that is not asked.
    fn wish_to_stop(&self) -> Option<Wish> {
        self.behind()?.wish_to_stop()
    }

    /// The command that the user asked to stop has stopped: what follows was not asked to.
    fn forget_stop(&mut self) {
        if let Some(host) = self.behind_mut() {
            host.forget_stop();
        }
    }

    /// Where a file that a script names is written, and found again; by default under its own
    /// name, as [`contained`] gives it.
    ///
    /// # Errors
    /// [`PermissionDenied`](io::ErrorKind::PermissionDenied) where scripts may not write.
    fn resolve(&self, path: &Path) -> io::Result<PathBuf> {
        self.behind().map_or_else(|| contained(path), |host| host.resolve(path))
    }

    /// Reads a text; by default there is none.
    ///
    /// # Errors
    /// Where there is none, or it cannot be read.
    fn read(&mut self, path: &Path) -> io::Result<String> {
        self.behind_mut()
            .map_or_else(|| Err(io::ErrorKind::NotFound.into()), |host| host.read(path))
    }

    /// Where a file that a script reads lies; `folder` is that of the text which names it. By
    /// default it is looked for there, whatever it is.
    ///
    /// # Errors
    /// [`PermissionDenied`](io::ErrorKind::PermissionDenied) where scripts may not read.
    fn find(&self, folder: &Path, path: &Path) -> io::Result<PathBuf> {
        self.behind().map_or_else(|| Ok(folder.join(path)), |host| host.find(folder, path))
    }

    /// How a file begins that is to be replaced, up to some kilobytes; none where there is none, or
    /// where any file may be replaced. By default all files are the session's own.
    ///
    /// # Errors
    /// Where what is there is no file, or cannot be read.
    fn opening(&mut self, path: &Path) -> io::Result<Option<Vec<u8>>> {
        self.behind_mut().map_or(Ok(None), |host| host.opening(path))
    }

    /// Writes a file whole or not at all, at a place that [`resolve`](Self::resolve) gave;
    /// makes the folders it needs. By default there is nowhere to write it.
    ///
    /// # Errors
    /// Where it cannot be written.
    fn write(&mut self, path: &Path, bytes: &[u8]) -> io::Result<()> {
        let nowhere = || Err(io::ErrorKind::Unsupported.into());
        self.behind_mut().map_or_else(nowhere, |host| host.write(path, bytes))
    }

    /// Writes a file as [`write`](Self::write) does, piece by piece: it may be larger than memory.
    ///
    /// # Errors
    /// Where it cannot be written, and what `content` says.
    fn write_in_pieces(
        &mut self,
        path: &Path,
        content: &mut dyn FnMut(&mut dyn io::Write) -> io::Result<()>,
    ) -> io::Result<()> {
        let mut bytes = Vec::new();
        content(&mut bytes)?;
        self.write(path, &bytes)
    }

    /// Reads a text back that was written at a place that [`resolve`](Self::resolve) gave; by default
    /// nothing was.
    ///
    /// # Errors
    /// [`NotFound`](io::ErrorKind::NotFound) where nothing was written, or where a link lies in the way
    /// since.
    fn read_back(&mut self, path: &Path) -> io::Result<String> {
        self.behind_mut()
            .map_or_else(|| Err(io::ErrorKind::NotFound.into()), |host| host.read_back(path))
    }

    /// Somewhere to put what a recording takes until it is written; by default in memory.
    ///
    /// # Errors
    /// Where there is no room for it.
    fn spool(&mut self) -> io::Result<Box<dyn Spool>> {
        match self.behind_mut() {
            Some(host) => host.spool(),
            None => Ok(Box::new(Vec::new())),
        }
    }

    /// Lets a page look at the session from here on; gives its address.
    ///
    /// # Errors
    /// [`Unsupported`](io::ErrorKind::Unsupported) where nothing follows the statement, or there are
    /// no pages.
    fn view(&mut self) -> io::Result<String> {
        Err(io::ErrorKind::Unsupported.into())
    }

    /// Told how much of a long piece of work is done, from 0 to 1.
    fn progress(&self, _share: f64) {}

    /// Seconds of wall time since some fixed moment, none where there is no clock, as by default; for
    /// promises and receipts only.
    fn seconds(&self) -> Option<f64> {
        self.behind()?.seconds()
    }

    /// What says the same within a long piece of work, which is left where the time of its command is
    /// up; by default that is asked between statements and frames alone.
    fn clock(&self) -> Option<Clock> {
        self.behind()?.clock()
    }
}

/// What is wrong where time is to be measured and [`Host::seconds`] has none.
pub(super) const NO_CLOCK: &str = "there is no clock here";

/// A relative path that stays below the folder it starts from, without its idle dots.
///
/// # Errors
/// [`PermissionDenied`](io::ErrorKind::PermissionDenied) where it leads elsewhere.
///
/// ```
/// use std::path::Path;
/// use linkwork::session::contained;
///
/// assert_eq!(contained(Path::new("./out/a.svg")).unwrap(), Path::new("out/a.svg"));
/// assert!(contained(Path::new("../a.svg")).is_err());
/// assert!(contained(Path::new("/a.svg")).is_err());
/// ```
pub fn contained(path: &Path) -> io::Result<PathBuf> {
    let mut inside = PathBuf::new();
    for part in path.components() {
        match part {
            Component::Normal(name) => inside.push(name),
            Component::CurDir => {}
            _ => return Err(io::Error::from(io::ErrorKind::PermissionDenied)),
        }
    }
    Ok(inside)
}

/// Why a file could not be read or written, in a few words.
pub fn reason(error: &io::Error) -> String {
    match error.kind() {
        io::ErrorKind::NotFound => "no such file or folder".to_owned(),
        io::ErrorKind::InvalidData => "not a text in UTF-8".to_owned(),
        io::ErrorKind::PermissionDenied => "permission denied".to_owned(),
        io::ErrorKind::IsADirectory => "this is a folder".to_owned(),
        io::ErrorKind::AlreadyExists => "a file is where a folder has to be".to_owned(),
        io::ErrorKind::NotADirectory => "part of the path is not a folder".to_owned(),
        io::ErrorKind::InvalidInput => "this is no regular file".to_owned(),
        io::ErrorKind::FileTooLarge => "it is larger than the limit `source-bytes`".to_owned(),
        io::ErrorKind::StorageFull => "the disk is full".to_owned(),
        _ => error.to_string(),
    }
}

/// An outside that says nothing, keeps nothing and has no files.
#[derive(Debug, Clone, Copy, Default)]
pub struct Nowhere;

impl Host for Nowhere {
    fn print(&mut self, _line: &str) {}

    fn tell(&mut self, _what: &Diagnostic, _sources: &Sources) {}

    fn is_listening(&self) -> bool {
        false
    }

    fn write(&mut self, _path: &Path, _bytes: &[u8]) -> io::Result<()> {
        Ok(())
    }
}
