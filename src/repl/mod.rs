//! The prompt: reads statements line by line, with history, completion and continuation lines.

mod editor;
mod history;

use rustyline::error::ReadlineError;

use crate::cli::interrupt;
use crate::cli::output;
use crate::session::{Flow, Host, Session, Transcript};

/// Talks with the user until they leave.
pub fn converse(session: &mut Session, host: &mut dyn Host) {
    let mut editor = match editor::open() {
        Ok(editor) => editor,
        Err(e) => {
            eprintln!("error: no line editor on this terminal: {e}");
            return;
        }
    };
    let history = history::file();
    history::recall(&mut editor, history.as_deref());
    println!("linkwork {}; `help` for help, Ctrl-D to leave", env!("CARGO_PKG_VERSION"));
    let mut transcript = Transcript::conversation("<prompt>");
    loop {
        editor::prepare(&mut editor, session);
        match editor.readline("> ") {
            Ok(line) => {
                history::keep(&mut editor, &line, history.as_deref());
                interrupt::forget();
                let outcome = transcript.enter(&line, session, host);
                output::flush();
                if outcome.flow == Flow::Quit {
                    return;
                }
            }
            // Ctrl-C clears the line.
            Err(ReadlineError::Interrupted) => {}
            Err(ReadlineError::Eof) => return,
            Err(e) => {
                eprintln!("error: the terminal is gone: {e}");
                return;
            }
        }
    }
}
