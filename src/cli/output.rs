//! What the program says: answers on standard output, everything else on standard error.

use std::io::{self, BufWriter, IsTerminal, Stdout, Write};
use std::sync::{Mutex, MutexGuard, OnceLock, PoisonError};

use clap::ValueEnum;

use crate::diag::{Diagnostic, Paint, Sources, render_within, short, visible};

/// Answers not yet written: to a file or a pipe they go in large pieces. Nothing once they cannot be
/// written any more.
struct Answers {
    out: BufWriter<Stdout>,
    is_terminal: bool,
    state: State,
    /// Bytes so far, those that reached nobody included.
    n_bytes: u64,
}

/// Whether answers still reach anybody.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum State {
    Open,
    /// The reader has gone away, as `head` does: what it does not want is no failure.
    Closed,
    /// They could not be written, which the user was told.
    Failed,
}

fn answers() -> MutexGuard<'static, Answers> {
    static ANSWERS: OnceLock<Mutex<Answers>> = OnceLock::new();
    let answers = ANSWERS.get_or_init(|| {
        Mutex::new(Answers {
            out: BufWriter::with_capacity(1 << 16, io::stdout()),
            is_terminal: io::stdout().is_terminal(),
            state: State::Open,
            n_bytes: 0,
        })
    });
    answers.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Answers {
    fn write(&mut self, write: impl FnOnce(&mut BufWriter<Stdout>) -> io::Result<()>) {
        if self.state != State::Open {
            return;
        }
        match write(&mut self.out) {
            Ok(()) => {}
            Err(e) if e.kind() == io::ErrorKind::BrokenPipe => self.state = State::Closed,
            Err(e) => {
                self.state = State::Failed;
                complain(&format!("error: cannot write the answer: {e}\n"));
            }
        }
    }
}

/// Writes one line of the answer. A reader that has gone away is no reason to stop: what else is
/// done still counts.
pub fn answer(line: &str) {
    let mut answers = answers();
    let line = if answers.is_terminal { visible(line) } else { line.into() };
    answers.n_bytes += line.len() as u64 + 1;
    answers.write(|out| out.write_all(line.as_bytes()).and_then(|()| out.write_all(b"\n")));
}

/// Writes what is still held back: before anything else is said, before waiting for input,
/// and at the end.
pub fn flush() {
    answers().write(Write::flush);
}

/// Bytes of the answer so far.
pub fn n_bytes() -> u64 {
    answers().n_bytes
}

/// Whether an answer could not be written though somebody wanted it.
pub fn has_failed() -> bool {
    answers().state == State::Failed
}

/// The form of errors, warnings and notes.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub enum MessageFormat {
    /// With the text they are about, the place underlined.
    #[default]
    Full,
    /// A line each, `file:line:column: error[E0201]: ...`, for editors.
    Short,
}

/// How problems are written; set once, from the command line.
static FORMAT: OnceLock<MessageFormat> = OnceLock::new();

/// Has problems written so from here on.
pub fn set_format(format: MessageFormat) {
    FORMAT.get_or_init(|| format);
}

/// Begins on an empty page; what is no terminal keeps all.
pub fn clear_page() {
    flush();
    if io::stdout().is_terminal() && wants_colours() {
        answers().write(|out| out.write_all(b"\x1b[2J\x1b[H").and_then(|()| out.flush()));
    }
}

/// Says something beside the answer, on standard error.
pub fn remark(line: &str) {
    flush();
    complain(&format!("{line}\n"));
}

/// Columns for what is said: those of the terminal, or of a wide page.
fn n_columns() -> usize {
    match terminal_size::terminal_size_of(io::stderr()) {
        Some((terminal_size::Width(n), _)) if n > 0 => n.into(),
        _ => WIDE,
    }
}

/// Columns where there is no terminal to say.
const WIDE: usize = 140;

/// Shows a problem, underlined in its text.
pub fn show(problem: &Diagnostic, sources: &Sources) {
    flush();
    let mut text = match FORMAT.get() {
        Some(MessageFormat::Short) => short(problem, sources),
        _ => render_within(problem, sources, paint(), n_columns()),
    };
    if !text.ends_with('\n') {
        text.push('\n');
    }
    complain(&text);
}

fn complain(text: &str) {
    // Nobody is left to tell if standard error is gone.
    drop(io::stderr().lock().write_all(text.as_bytes()));
}

/// Colours on a terminal, unless the user asked for none.
fn paint() -> Paint {
    if io::stderr().is_terminal() && wants_colours() { Paint::Coloured } else { Paint::Plain }
}

/// Whether the user has nothing against colours where there is a terminal.
pub fn wants_colours() -> bool {
    let is_unwanted = std::env::var_os("NO_COLOR").is_some_and(|v| !v.is_empty());
    let is_dumb = std::env::var_os("TERM").is_some_and(|term| term == "dumb");
    !is_unwanted && !is_dumb
}
