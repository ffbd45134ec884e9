//! A host that keeps what a session says and writes, to be looked at after.

use std::cell::Cell;
use std::collections::BTreeMap;
use std::fmt::Write;
use std::io;
use std::path::{Path, PathBuf};
use std::rc::Rc;

use linkwork::diag::{Diagnostic, Paint, Sources, render};
use linkwork::session::{Clock, Host, Kept};

/// What was said and written so far.
pub struct Notebook {
    /// The lines printed.
    pub printed: Vec<String>,
    /// The notes and warnings.
    pub told: Vec<Diagnostic>,
    /// Both in their order, as a terminal would show them.
    pub said: String,
    /// The files written, the last of a name.
    pub files: BTreeMap<PathBuf, String>,
    /// Where files are read that were not written before.
    pub folder: PathBuf,
    /// How far the clock goes on whenever it is looked at, seconds.
    pub tick: f64,
    /// How often the clock was looked at.
    pub n_looks: Rc<Cell<u64>>,
    /// The user wants to stop once the clock was looked at more often than that.
    pub patience: Option<u64>,
    /// How often it was asked whether the user wants to stop.
    pub n_polls: Rc<Cell<u64>>,
    /// The user wants to once that was asked more often.
    pub most_polls: Option<u64>,
    /// How often it counts as asked where that is within a long piece of work.
    pub polls_a_look: u64,
    /// Whether notes and warnings reach nobody.
    pub is_deaf: bool,
    /// What brings the session back, where that is kept.
    pub journal: Option<Vec<String>>,
}

impl Default for Notebook {
    fn default() -> Self {
        Self {
            printed: Vec::new(),
            told: Vec::new(),
            said: String::new(),
            files: BTreeMap::new(),
            folder: PathBuf::new(),
            tick: 0.0,
            n_looks: Rc::default(),
            patience: None,
            n_polls: Rc::default(),
            most_polls: None,
            polls_a_look: 1,
            is_deaf: false,
            journal: None,
        }
    }
}

impl Notebook {
    /// Adds to what a terminal would show.
    pub fn say(&mut self, text: &str) {
        writeln!(self.said, "{text}").expect("writing to a string");
    }

    /// The first lines of the notes and warnings since this was last asked for.
    pub fn told(&mut self) -> Vec<String> {
        let told = std::mem::take(&mut self.told);
        told.into_iter().map(|what| what.message.to_string()).collect()
    }
}

impl Host for Notebook {
    fn print(&mut self, line: &str) {
        self.say(line);
        self.printed.push(line.to_owned());
    }

    fn tell(&mut self, what: &Diagnostic, sources: &Sources) {
        self.say(&render(what, sources, Paint::Plain));
        self.told.push(what.clone());
    }

    fn is_listening(&self) -> bool {
        !self.is_deaf
    }

    fn is_keeping(&self) -> bool {
        self.journal.is_some()
    }

    fn keep(&mut self, kept: Kept<'_>) {
        let Some(journal) = &mut self.journal else { return };
        match kept {
            Kept::Done(text) => journal.push(format!("{text}\n")),
            Kept::First(n) => journal.truncate(n as usize + 1),
            Kept::Whole(script) => *journal = vec![script.to_owned()],
        }
    }

    fn is_interrupted(&self) -> bool {
        self.n_polls.set(self.n_polls.get() + 1);
        self.patience.is_some_and(|most| self.n_looks.get() > most)
            || self.most_polls.is_some_and(|most| self.n_polls.get() > most)
    }

    fn wish_to_stop(&self) -> Option<Rc<dyn Fn() -> bool>> {
        let (n_polls, most, n) = (self.n_polls.clone(), self.most_polls, self.polls_a_look);
        Some(Rc::new(move || {
            n_polls.set(n_polls.get() + n);
            most.is_some_and(|most| n_polls.get() > most)
        }))
    }

    fn read(&mut self, path: &Path) -> io::Result<String> {
        if let Some(text) = self.files.get(path) {
            return Ok(text.clone());
        }
        String::from_utf8(std::fs::read(self.folder.join(path))?)
            .map_err(|_| io::Error::from(io::ErrorKind::InvalidData))
    }

    fn write(&mut self, path: &Path, bytes: &[u8]) -> io::Result<()> {
        if path.starts_with("locked") {
            return Err(io::Error::from(io::ErrorKind::PermissionDenied));
        }
        let text = String::from_utf8(bytes.to_vec()).expect("all that is written is text");
        self.files.insert(path.to_path_buf(), text);
        Ok(())
    }

    fn seconds(&self) -> Option<f64> {
        self.n_looks.set(self.n_looks.get() + 1);
        Some(self.n_looks.get() as f64 * self.tick)
    }

    fn clock(&self) -> Option<Clock> {
        let (n_looks, tick) = (self.n_looks.clone(), self.tick);
        Some(Rc::new(move || {
            n_looks.set(n_looks.get() + 1);
            n_looks.get() as f64 * tick
        }))
    }
}
