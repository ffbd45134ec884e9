//! The prompt: reads statements line by line, with history and continuation lines.

use std::path::PathBuf;

use rustyline::error::ReadlineError;
use rustyline::history::FileHistory;
use rustyline::validate::{ValidationContext, ValidationResult, Validator};
use rustyline::{Completer, Config, Editor, Helper, Highlighter, Hinter};

use crate::cli::{interrupt, talk};
use crate::diag::Severity;
use crate::lang::{is_incomplete, parse};
use crate::session::{Flow, Session};

/// What the editor asks while a line is typed.
#[derive(Helper, Completer, Highlighter, Hinter)]
struct Prompt;

impl Validator for Prompt {
    fn validate(&self, line: &mut ValidationContext<'_>) -> rustyline::Result<ValidationResult> {
        Ok(if is_incomplete(line.input()) {
            ValidationResult::Incomplete
        } else {
            ValidationResult::Valid(None)
        })
    }
}

/// Talks with the user until they leave.
pub fn converse(session: &mut Session, folder: Option<PathBuf>) {
    let config = Config::builder().auto_add_history(false).build();
    let mut editor = match Editor::<Prompt, FileHistory>::with_config(config) {
        Ok(editor) => editor,
        Err(e) => {
            eprintln!("linkwork: no line editor on this terminal: {e}");
            return;
        }
    };
    editor.set_helper(Some(Prompt));
    let history = history_file();
    if let Some(file) = &history {
        // There is none at the first start.
        drop(editor.load_history(file));
    }
    println!("linkwork {}; `help` for help, Ctrl-D to leave", env!("CARGO_PKG_VERSION"));
    let mut n_lines = 0;
    loop {
        match editor.readline("> ") {
            Ok(line) => {
                n_lines += 1;
                if !line.trim().is_empty() {
                    keep(&mut editor, &line, history.as_ref());
                }
                if obey(session, &line, n_lines, folder.clone()) == Flow::Quit {
                    return;
                }
            }
            // Ctrl-C clears the line.
            Err(ReadlineError::Interrupted) => {}
            Err(ReadlineError::Eof) => return,
            Err(e) => {
                eprintln!("linkwork: the terminal is gone: {e}");
                return;
            }
        }
    }
}

fn obey(session: &mut Session, line: &str, n_lines: usize, folder: Option<PathBuf>) -> Flow {
    interrupt::forget();
    let source = session.add_source(&format!("line {n_lines}"), line, folder);
    for statement in parse(source, line) {
        match statement.and_then(|statement| session.execute(&statement)) {
            Ok(Flow::On) => {}
            Ok(Flow::Quit) => return Flow::Quit,
            Ok(Flow::Stopped) => break,
            Err(mut problem) => {
                problem.severity = Severity::Error;
                talk::show(&problem, session.sources());
                break;
            }
        }
    }
    talk::flush();
    Flow::On
}

/// Keeps a line in the history, and on disk at once, so that a crash loses nothing.
fn keep(editor: &mut Editor<Prompt, FileHistory>, line: &str, file: Option<&PathBuf>) {
    if matches!(editor.add_history_entry(line), Ok(true))
        && let Some(file) = file
    {
        // A history that cannot be kept is no reason to stop.
        drop(editor.append_history(file));
    }
}

/// Where the history is kept across sessions.
fn history_file() -> Option<PathBuf> {
    let state = std::env::var_os("XDG_STATE_HOME").map(PathBuf::from);
    let home = || std::env::var_os("HOME").map(|home| PathBuf::from(home).join(".local/state"));
    let folder = state.filter(|path| path.is_absolute()).or_else(home)?.join("linkwork");
    std::fs::create_dir_all(&folder).ok()?;
    Some(folder.join("history"))
}
