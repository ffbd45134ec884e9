//! The line editor: what it asks while a line is typed.

use rustyline::history::FileHistory;
use rustyline::validate::{ValidationContext, ValidationResult, Validator};
use rustyline::{Completer, Config, Editor, Helper, Highlighter, Hinter};

use crate::lang::is_incomplete;
use crate::session::Session;

/// The editor of the prompt.
pub type LineEditor = Editor<Prompt, FileHistory>;

/// What the editor asks while a line is typed.
#[derive(Debug, Default, Helper, Completer, Highlighter, Hinter)]
pub struct Prompt;

impl Validator for Prompt {
    fn validate(&self, line: &mut ValidationContext<'_>) -> rustyline::Result<ValidationResult> {
        Ok(if is_incomplete(line.input()) {
            ValidationResult::Incomplete
        } else {
            ValidationResult::Valid(None)
        })
    }
}

/// An editor on the terminal of the process.
///
/// # Errors
/// Where the terminal cannot be used so.
pub fn open() -> rustyline::Result<LineEditor> {
    let config = Config::builder()
        .auto_add_history(false)
        .max_history_size(super::history::MOST_LINES)?
        .build();
    let mut editor = Editor::with_config(config)?;
    editor.set_helper(Some(Prompt));
    Ok(editor)
}

/// Tells the editor what there is in the session before a line is typed.
pub fn prepare(_editor: &mut LineEditor, _session: &Session) {}
