//! The line editor: what it asks while a line is typed.

use rustyline::completion::{Completer, FilenameCompleter, Pair};
use rustyline::history::FileHistory;
use rustyline::validate::{ValidationContext, ValidationResult, Validator};
use rustyline::{CompletionType, Config, Context, Editor, Helper, Highlighter, Hinter};

use crate::lang::is_incomplete;
use crate::session::{Completion, Session};

/// Lines of history kept; the editor reads all of them when it starts.
const MOST_LINES: usize = 10_000;

/// The editor of the prompt.
pub type LineEditor = Editor<Prompt, FileHistory>;

/// What the editor asks while a line is typed.
#[derive(Helper, Highlighter, Hinter)]
pub struct Prompt {
    files: FilenameCompleter,
    completion: Completion,
}

impl Validator for Prompt {
    fn validate(&self, line: &mut ValidationContext<'_>) -> rustyline::Result<ValidationResult> {
        Ok(if is_incomplete(line.input()) {
            ValidationResult::Incomplete
        } else {
            ValidationResult::Valid(None)
        })
    }
}

impl Completer for Prompt {
    type Candidate = Pair;

    fn complete(
        &self,
        line: &str,
        pos: usize,
        ctx: &Context<'_>,
    ) -> rustyline::Result<(usize, Vec<Pair>)> {
        let before = &line[..pos];
        let this_line = before.rsplit('\n').next().unwrap_or_default();
        if this_line.matches('"').count() % 2 == 1 {
            return self.files.complete(line, pos, ctx);
        }
        let (start, found) = self.completion.candidates(before);
        let pairs = found.into_iter().map(|it| Pair { display: it.clone(), replacement: it });
        Ok((start, pairs.collect()))
    }
}

/// An editor on the terminal of the process.
///
/// # Errors
/// Where the terminal cannot be used so.
pub fn open() -> rustyline::Result<LineEditor> {
    let config = Config::builder()
        .auto_add_history(false)
        .max_history_size(MOST_LINES)?
        .completion_type(CompletionType::List)
        .build();
    let mut editor = Editor::with_config(config)?;
    let files = FilenameCompleter::new();
    editor.set_helper(Some(Prompt { files, completion: Completion::default() }));
    Ok(editor)
}

/// Tells the editor what there is in the session before a line is typed.
pub fn prepare(editor: &mut LineEditor, session: &Session) {
    if let Some(prompt) = editor.helper_mut() {
        prompt.completion.refresh(session.world());
    }
}
