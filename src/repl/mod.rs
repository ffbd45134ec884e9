//! The prompt: reads statements line by line, with history, completion and continuation lines.

mod ahead;
mod editor;
mod history;
mod look;

use rustyline::ExternalPrinter as _;
use rustyline::error::ReadlineError;

use crate::cli::process_host::ProcessHost;
use crate::cli::{graphics, interrupt, output};
use crate::session::{Flow, PROMPT, Session, Transcript, without_prompts};
use ahead::Ahead;

/// Says who is there, and what to type first.
pub fn greet() {
    output::answer_fitted(concat!(
        "linkwork ",
        env!("CARGO_PKG_VERSION"),
        "; `help` and `examples` show what there is, Ctrl-D leaves"
    ));
    output::flush();
}

/// Talks with the user until they leave.
pub fn converse(session: &mut Session, host: &mut ProcessHost) {
    let mut editor = match editor::open() {
        Ok(editor) => editor,
        Err(e) => {
            output::remark(&format!("error: no line editor on this terminal: {e}"));
            return;
        }
    };
    let history = history::file();
    history::recall(&mut editor, history.as_deref());
    let mut transcript = Transcript::conversation("<prompt>");
    let mut printer = None;
    let mut ahead = Ahead::default();
    loop {
        ahead.push(&graphics::take_typed());
        editor::prepare(&mut editor, session);
        if printer.is_none() && host.is_viewed() {
            printer = editor.create_external_printer().ok();
        }
        // What pages say stands above the line that is being typed.
        let mut told = |statement: &str| {
            if let Some(printer) = &mut printer {
                drop(printer.print(look::of_page(statement)));
            }
        };
        let line = || match ahead.next_entered() {
            Some(entered) => {
                output::answer(&format!("{PROMPT}{entered}"));
                Ok(entered)
            }
            None => interrupt::at_prompt(|| {
                editor.readline_with_initial(PROMPT, (&ahead.take_begun(), ""))
            }),
        };
        match host.meanwhile(session, &mut told, line) {
            _ if interrupt::is_ending() => return,
            Ok(line) => {
                let line = look::without_marks(&line);
                let line = without_prompts(&line);
                history::keep(&mut editor, &line, history.as_deref());
                interrupt::forget();
                let outcome = transcript.enter(&line, session, host);
                output::flush();
                if outcome.flow == Flow::Quit {
                    return;
                }
            }
            // Ctrl-C clears the line; where there is nothing to clear, its user wants more.
            Err(ReadlineError::Interrupted) => {
                if editor::was_blank(&editor) {
                    output::answer("`quit` or Ctrl-D leaves");
                    output::flush();
                }
            }
            Err(ReadlineError::Eof) => return,
            Err(e) => {
                output::remark(&format!("error: the terminal is gone: {e}"));
                return;
            }
        }
    }
}
