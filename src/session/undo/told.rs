//! What the host's journal was told of each command, so that it goes with `undo` and `redo` by as much as
//! these change.

use std::path::PathBuf;
use std::sync::Arc;

use crate::diag::{Sources, Span};
use crate::lang::ast::{Building, Command};
use crate::session::resolve::unbind::{quoted, text_of};

/// A file that a statement has read, so that it finds the same where it is repeated.
#[derive(Debug, Clone)]
pub struct FileRead {
    /// Where it was found.
    pub path: PathBuf,
    /// What was in it.
    pub text: Arc<str>,
}

impl FileRead {
    /// The line that brings it back for the statement behind it.
    pub fn restored(&self) -> String {
        let path = quoted(&self.path.to_string_lossy());
        let text = quoted(&self.text);
        text_of(&Command::Building(Building::RestoreFile { path, text }))
    }
}

/// A statement that did something, and what it takes to repeat it.
#[derive(Debug, Clone)]
pub struct Deed {
    /// Where it stands.
    pub statement: Span,
    /// How far it came, where the user stopped it.
    pub stopped_after: Option<u64>,
    /// What it read.
    pub files: Arc<[FileRead]>,
}

impl Deed {
    /// The text that does the same.
    pub fn text(&self, sources: &Sources) -> String {
        let mut text = String::new();
        self.files.iter().for_each(|file| text.extend([&*file.restored(), "\n"]));
        if let Some(n_done) = self.stopped_after {
            text.push_str(&restored_stop(n_done));
        }
        text.push_str(sources.slice(self.statement));
        text
    }
}

/// The line that has the statement behind it stopped again when it has done so much.
pub fn restored_stop(n_done: u64) -> String {
    format!("restore stop = {n_done}\n")
}

/// How far a journal has been told.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Place {
    /// Which one: how many scripts of all there is it was told, each of which begins it anew.
    pub journal: u64,
    /// How many texts since the last of them.
    pub texts: u64,
    /// The bytes of these.
    pub bytes: u64,
}

impl Place {
    /// A text was told.
    pub fn pass(&mut self, text: &str) {
        self.texts += 1;
        self.bytes += text.len() as u64;
    }
}

/// What it was told of a command.
#[derive(Debug, Clone)]
pub struct Told {
    /// Where that stands.
    pub at: Place,
    /// What it was.
    pub deed: Deed,
}

/// So many commands were taken back, or done again.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Walk {
    /// By `undo`.
    Back(usize),
    /// By `redo`.
    Forth(usize),
}
