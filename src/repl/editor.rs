//! The line editor: what it asks while a line is typed, and the keys that are ours.

use std::borrow::Cow;
use std::cell::Cell;
use std::path::PathBuf;
use std::sync::atomic::{AtomicU8, Ordering};

use rustyline::completion::{Completer, FilenameCompleter, Pair};
use rustyline::highlight::{CmdKind, Highlighter};
use rustyline::hint::{Hint, Hinter, HistoryHinter};
use rustyline::history::FileHistory;
use rustyline::validate::{ValidationContext, ValidationResult, Validator};
use rustyline::{
    Cmd, ColorMode, CompletionType, ConditionalEventHandler, Config, Context, EditMode, Editor,
    Event, EventContext, EventHandler, Helper, KeyCode, KeyEvent, Modifiers, RepeatCount,
};

use super::look::{coloured, faint};
use crate::cli::{environment, graphics, output};
use crate::lang::{depth, is_incomplete};
use crate::session::{CONTINUATION, Completion, Session};

/// Lines of history kept; the editor reads all of them when it starts.
const MOST_LINES: usize = 10_000;

/// Blanks that a line is set in by for each bracket that is open.
const INDENT: usize = 2;

/// The editor of the prompt.
pub type LineEditor = Editor<Prompt, FileHistory>;

/// What the editor asks while a line is typed.
#[derive(Helper)]
pub struct Prompt {
    files: FilenameCompleter,
    history: HistoryHinter,
    completion: Completion,
    is_coloured: bool,
    /// Whether nothing was typed when the line was shown last.
    is_blank: Cell<bool>,
}

impl Validator for Prompt {
    fn validate(&self, line: &mut ValidationContext<'_>) -> rustyline::Result<ValidationResult> {
        Ok(if wants_more(line.input()) {
            ValidationResult::Incomplete
        } else {
            ValidationResult::Valid(None)
        })
    }
}

/// Whether a statement goes on in the next line; a blank line ends it as it is.
fn wants_more(text: &str) -> bool {
    let last = text.rsplit('\n').next().unwrap_or_default();
    let is_forced = text.contains('\n') && last.trim().is_empty();
    !is_forced && is_incomplete(text)
}

impl Completer for Prompt {
    type Candidate = Pair;

    fn complete(
        &self,
        line: &str,
        pos: usize,
        ctx: &Context<'_>,
    ) -> rustyline::Result<(usize, Vec<Pair>)> {
        let offer = self.completion.offer(&line[..pos]);
        if offer.is_path {
            return self.files.complete(line, pos, ctx);
        }
        let pairs =
            offer.candidates.into_iter().map(|it| Pair { display: it.shown, replacement: it.text });
        Ok((offer.start, pairs.collect()))
    }
}

/// What is shown behind the cursor.
pub struct Grey {
    text: String,
    /// Whether it can be taken as it is: what was typed before can, a shape cannot.
    is_line: bool,
}

impl Hint for Grey {
    fn display(&self) -> &str {
        &self.text
    }

    fn completion(&self) -> Option<&str> {
        self.is_line.then_some(&*self.text)
    }
}

impl Hinter for Prompt {
    type Hint = Grey;

    fn hint(&self, line: &str, pos: usize, ctx: &Context<'_>) -> Option<Grey> {
        // Without colours nobody could tell it from what is typed.
        if !self.is_coloured || pos < line.len() || line.trim().is_empty() {
            return None;
        }
        let of_history = || self.history.hint(line, pos, ctx).filter(|hint| !hint.contains('\n'));
        if !line.contains('\n')
            && let Some(text) = of_history()
        {
            return Some(Grey { text, is_line: true });
        }
        self.completion.hint(line).map(|text| Grey { text, is_line: false })
    }
}

impl Highlighter for Prompt {
    fn highlight<'l>(&self, line: &'l str, pos: usize) -> Cow<'l, str> {
        self.is_blank.set(line.trim().is_empty());
        if self.is_coloured {
            Cow::Owned(coloured(line, &self.completion.pieces(line, pos)))
        } else if line.contains('\n') {
            Cow::Owned(coloured(line, &[]))
        } else {
            Cow::Borrowed(line)
        }
    }

    fn highlight_hint<'h>(&self, hint: &'h str) -> Cow<'h, str> {
        Cow::Owned(faint(hint))
    }

    fn highlight_char(&self, _line: &str, _pos: usize, _kind: CmdKind) -> bool {
        // A letter more may make a command of a name.
        true
    }
}

/// Enter where a statement goes on: a new line, set in.
struct GoOn;

impl ConditionalEventHandler for GoOn {
    fn handle(&self, _: &Event, _: RepeatCount, _: bool, ctx: &EventContext) -> Option<Cmd> {
        let line = ctx.line();
        let is_at_end = ctx.pos() == line.trim_end_matches(' ').len() || ctx.pos() == line.len();
        if !is_at_end || !wants_more(line) {
            return None;
        }
        let blanks = " ".repeat(CONTINUATION.len() + INDENT * depth(line));
        Some(Cmd::Insert(1, format!("\n{blanks}")))
    }
}

/// Keys that the numbers of an answer take at most.
const LONGEST_ANSWER: u8 = 48;

/// Swallows the answer of a terminal that comes when nobody waits for it any more: what the editor takes for
/// an unknown key, and the numbers behind it that it takes for typed.
#[derive(Default)]
struct Swallow {
    /// How many keys may still belong to an answer that has begun.
    n_left: AtomicU8,
}

impl ConditionalEventHandler for Swallow {
    fn handle(&self, event: &Event, _: RepeatCount, _: bool, _: &EventContext) -> Option<Cmd> {
        let Event::KeySeq(keys) = event else { return None };
        let [KeyEvent(key, Modifiers::NONE)] = keys[..] else { return None };
        if !graphics::is_answer_due() {
            return None;
        }
        let n_left = self.n_left.load(Ordering::Relaxed);
        let n_left = match key {
            KeyCode::UnknownEscSeq => LONGEST_ANSWER,
            KeyCode::Char('0'..='9' | ';') if n_left > 0 => n_left - 1,
            // The size of a letter, and what the terminal is: that ends it.
            KeyCode::Char('t') if n_left > 0 => 0,
            KeyCode::Char('c') if n_left > 0 => {
                graphics::forget_answer();
                0
            }
            _ => {
                self.n_left.store(0, Ordering::Relaxed);
                return None;
            }
        };
        self.n_left.store(n_left, Ordering::Relaxed);
        Some(Cmd::Noop)
    }
}

/// An editor on the terminal of the process.
///
/// # Errors
/// Where the terminal cannot be used so.
pub fn open() -> rustyline::Result<LineEditor> {
    let is_capable = output::is_capable();
    let config = Config::builder()
        .auto_add_history(false)
        .max_history_size(MOST_LINES)?
        .completion_type(CompletionType::List)
        .edit_mode(edit_mode())
        // The continuation prompts are ours; whether there are colours is decided here.
        .color_mode(if is_capable { ColorMode::Forced } else { ColorMode::Disabled })
        .build();
    let mut editor = Editor::with_config(config)?;
    editor.set_helper(Some(Prompt {
        files: FilenameCompleter::new(),
        history: HistoryHinter::new(),
        completion: Completion::default(),
        is_coloured: output::wants_colours(),
        is_blank: Cell::new(true),
    }));
    // What was typed while a command ran ends its lines with the other of the two.
    for key in [KeyEvent(KeyCode::Enter, Modifiers::NONE), KeyEvent::ctrl('J')] {
        editor.bind_sequence(key, EventHandler::Conditional(Box::new(GoOn)));
    }
    editor.bind_sequence(Event::Any, EventHandler::Conditional(Box::new(Swallow::default())));
    Ok(editor)
}

/// Whether nothing was typed in the line that was left.
pub fn was_blank(editor: &LineEditor) -> bool {
    editor.helper().is_none_or(|prompt| prompt.is_blank.get())
}

/// Tells the editor what there is in the session before a line is typed.
pub fn prepare(editor: &mut LineEditor, session: &Session) {
    if let Some(prompt) = editor.helper_mut() {
        prompt.completion.refresh(session);
        prompt.is_blank.set(true);
    }
}

/// Keys as the user has them elsewhere: `set editing-mode vi` of readline's own file.
fn edit_mode() -> EditMode {
    let home = || environment::variable("HOME").map(|home| PathBuf::from(home).join(".inputrc"));
    let file = environment::variable("INPUTRC").map(PathBuf::from).or_else(home);
    let text = file.and_then(|file| std::fs::read_to_string(file).ok()).unwrap_or_default();
    let is_vi = |line: &str| line.split_whitespace().eq(["set", "editing-mode", "vi"]);
    if text.lines().any(is_vi) { EditMode::Vi } else { EditMode::Emacs }
}
