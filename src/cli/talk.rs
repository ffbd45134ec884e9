//! What the program says: answers on standard output, everything else on standard error.

use std::io::{self, IsTerminal, Write};

use crate::diag::{Diagnostic, Paint, Sources, render};

/// Writes one line of the answer. A reader that has gone away ends the process quietly.
pub fn answer(line: &str) {
    let mut out = io::stdout().lock();
    if let Err(e) = out.write_all(line.as_bytes()).and_then(|()| out.write_all(b"\n")) {
        end_on(&e);
    }
}

/// Writes what is still held back.
pub fn flush() {
    if let Err(e) = io::stdout().lock().flush() {
        end_on(&e);
    }
}

fn end_on(error: &io::Error) {
    if error.kind() == io::ErrorKind::BrokenPipe {
        std::process::exit(0);
    }
    eprintln!("linkwork: cannot write the answer: {error}");
    std::process::exit(3);
}

/// Shows a problem, underlined in its text.
pub fn show(problem: &Diagnostic, sources: &Sources) {
    flush();
    let mut text = render(problem, sources, paint());
    if !text.ends_with('\n') {
        text.push('\n');
    }
    // Nobody is left to tell if standard error is gone.
    drop(io::stderr().lock().write_all(text.as_bytes()));
}

/// Colours on a terminal, unless the user asked for none.
fn paint() -> Paint {
    let is_unwanted = std::env::var_os("NO_COLOR").is_some_and(|v| !v.is_empty());
    if io::stderr().is_terminal() && !is_unwanted { Paint::Coloured } else { Paint::Plain }
}
