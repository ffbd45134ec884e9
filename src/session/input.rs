//! What comes from outside: texts, where they lie, and values that win over theirs.

use std::collections::{BTreeMap, HashMap, VecDeque};
use std::ops::Range;
use std::path::PathBuf;
use std::sync::Arc;

use super::quotas::Quotas;
use super::undo::told::{FileRead, Walk};
use crate::diag::{SourceId, Sources, Span};

/// What a session was given to read. Nothing of it is ever taken back: places in diagnostics and
/// in live expressions are places in these texts.
#[derive(Debug)]
pub struct Input {
    /// The texts read so far.
    pub sources: Sources,
    /// The folder of each text that was a file, for what it includes.
    folders: HashMap<SourceId, PathBuf>,
    /// Values that the user gave from outside; they win over a `let`.
    pub overrides: BTreeMap<String, Override>,
    /// The statements that were typed and carried out, and whether they changed something.
    typed: Vec<(Span, bool)>,
    /// Whether the statement under way depends on more than what was typed and read: on the clock, on
    /// values from outside.
    pub is_unrepeatable: bool,
    /// The files that the statement under way has read, where a journal is kept.
    pub files_read: Vec<FileRead>,
    /// The bytes of these.
    pub n_bytes_read: u64,
    /// What is to be read next in place of files: what was read when it was carried out first.
    pub next_files: VecDeque<FileRead>,
    /// How far the statement under way came in putting what a file makes in the place of all there was.
    pub loaded: Option<Loaded>,
    /// How the last statement went through what was done, if it did.
    pub walk: Option<Walk>,
    /// How far the last command came, where the user stopped it and what it did stays.
    pub stopped_after: Option<u64>,
    /// How far the next statement is to come, which was stopped when it was carried out first.
    pub next_stop: Option<u64>,
    /// Whether the last command changed something that `undo` takes back.
    pub is_change: bool,
    /// How many frames or iterations the last command did, where it was stopped on its way.
    pub n_done: Option<u64>,
    /// How much is allowed.
    pub quotas: Quotas,
    /// The statement of a text that was reached last.
    pub reached: Span,
    /// Files that were written so far.
    pub n_files: u64,
    /// What was written to them, bytes.
    pub n_file_bytes: u64,
}

impl Default for Input {
    fn default() -> Self {
        Self {
            sources: Sources::default(),
            folders: HashMap::new(),
            overrides: BTreeMap::new(),
            typed: Vec::new(),
            is_unrepeatable: false,
            files_read: Vec::new(),
            n_bytes_read: 0,
            next_files: VecDeque::new(),
            loaded: None,
            walk: None,
            stopped_after: None,
            next_stop: None,
            is_change: false,
            n_done: None,
            quotas: Quotas::default(),
            reached: Span::new(SourceId(0), 0..0),
            n_files: 0,
            n_file_bytes: 0,
        }
    }
}

/// How far a `load` came.
#[derive(Debug, Clone, Default)]
pub struct Loaded {
    /// Where the statement lies that it came to, in bytes of the text; empty before the first.
    pub reached: Range<usize>,
    /// How much the command had done before that.
    pub n_done_before: u64,
}

/// A value from outside and whether some `let` took it.
#[derive(Debug, Clone)]
pub struct Override {
    /// What it is.
    pub value: f64,
    /// Whether it was taken.
    pub is_used: bool,
}

/// As many letters of a statement are told where it was undone.
const LONGEST_LABEL: usize = 60;

impl Input {
    /// Keeps a piece of a text, which begins at line `first_line` of it.
    pub fn add_piece(
        &mut self,
        name: &str,
        text: impl Into<Arc<str>>,
        first_line: usize,
        folder: Option<PathBuf>,
    ) -> SourceId {
        let id = self.sources.add_piece(name, text, first_line);
        if let Some(folder) = folder {
            self.folders.insert(id, folder);
        }
        id
    }

    /// Keeps a text of one statement; gives all of it.
    pub fn add_whole(&mut self, name: &str, text: &str) -> Span {
        let source = self.add_piece(name, text, 1, None);
        Span::new(source, 0..text.len())
    }

    /// Keeps a text that others keep too.
    pub fn add_shared(&mut self, name: Arc<str>, text: Arc<str>, folder: PathBuf) -> SourceId {
        let id = self.sources.add(name, text);
        self.folders.insert(id, folder);
        id
    }

    /// Keeps a text, unless it is the one that was kept last: a program may say the same again
    /// and again.
    pub fn add_once(&mut self, name: &str, text: &str) -> SourceId {
        match self.sources.last() {
            Some((id, last)) if *last.name == *name && *last.text == *text => id,
            _ => self.add_piece(name, text, 1, None),
        }
    }

    /// A statement is about to be carried out.
    pub fn begin_statement(&mut self) {
        self.is_unrepeatable = false;
        self.stopped_after = None;
        self.files_read.clear();
        self.n_bytes_read = 0;
        self.loaded = None;
        self.walk = None;
    }

    /// Remembers a statement that was typed and carried out.
    pub fn note_typed(&mut self, statement: Span, leaves_a_mark: bool) {
        self.typed.push((statement, leaves_a_mark));
    }

    /// How many were typed and carried out.
    pub fn n_typed(&self) -> usize {
        self.typed.len()
    }

    /// Those from the `n`th on that changed something.
    pub fn changes_since(&self, n: usize) -> impl Iterator<Item = &str> {
        let since = self.typed[n.min(self.typed.len())..].iter();
        since.filter(|(_, leaves_a_mark)| *leaves_a_mark).map(|&(span, _)| self.sources.slice(span))
    }

    /// What was typed and carried out, statement by statement.
    pub fn typed(&self) -> impl Iterator<Item = &str> {
        self.typed.iter().map(|&(span, _)| self.sources.slice(span))
    }

    /// Where what a text includes is looked for.
    pub fn folder(&self, text: SourceId) -> PathBuf {
        self.folders.get(&text).cloned().unwrap_or_default()
    }

    /// The first line of a statement, for telling what was undone.
    pub fn label(&self, span: Span) -> String {
        let text = self.sources.slice(span);
        let line = text.lines().next().unwrap_or_default();
        // One that has no more bytes has no more letters either.
        let cut =
            if line.len() > LONGEST_LABEL { line.char_indices().nth(LONGEST_LABEL) } else { None };
        match cut {
            Some((end, _)) => format!("{}...", &line[..end]),
            None => line.to_owned(),
        }
    }
}
