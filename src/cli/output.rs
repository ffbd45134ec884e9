//! What the program says: answers on standard output, everything else on standard error.

use std::io::{self, BufWriter, IsTerminal, Stdout, Write};
use std::process::{Command, Stdio};
use std::sync::{Mutex, MutexGuard, OnceLock, PoisonError};

use super::progress;
use crate::diag::{Diagnostic, Paint, Sources, render};
use crate::render::{Cell, Ink, Sketch};

/// Answers not yet written: to a file or a pipe they go in large pieces.
fn out() -> MutexGuard<'static, BufWriter<Stdout>> {
    static OUT: OnceLock<Mutex<BufWriter<Stdout>>> = OnceLock::new();
    let out = OUT.get_or_init(|| Mutex::new(BufWriter::with_capacity(1 << 16, io::stdout())));
    out.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Writes one line of the answer. A reader that has gone away ends the process quietly.
pub fn answer(line: &str) {
    progress::clear();
    let mut out = out();
    if let Err(e) = out.write_all(line.as_bytes()).and_then(|()| out.write_all(b"\n")) {
        end_on(&e);
    }
}

/// Writes what is still held back: before anything else is said, before waiting for input,
/// and at the end.
pub fn flush() {
    if let Err(e) = out().flush() {
        end_on(&e);
    }
}

fn end_on(error: &io::Error) -> ! {
    if error.kind() == io::ErrorKind::BrokenPipe {
        std::process::exit(0);
    }
    complain(&format!("error: cannot write the answer: {error}\n"));
    std::process::exit(3);
}

/// Shows a problem, underlined in its text.
pub fn show(problem: &Diagnostic, sources: &Sources) {
    flush();
    let mut text = render(problem, sources, paint());
    if !text.ends_with('\n') {
        text.push('\n');
    }
    complain(&text);
}

/// Writes the lines of a long answer: page by page where they are more than a terminal shows.
pub fn page(lines: &[String]) {
    let fits = match terminal_size::terminal_size_of(io::stdout()) {
        Some((_, height)) => lines.len() < usize::from(height.0),
        None => true,
    };
    if fits || !is_capable() || show_pages(lines).is_err() {
        lines.iter().for_each(|line| answer(line));
    }
}

/// Columns and rows of what is drawn in characters: most of the terminal, and less than two pages.
pub fn page_size() -> (usize, usize) {
    match terminal_size::terminal_size_of(io::stdout()) {
        Some((width, height)) => {
            let rows = usize::from(height.0).saturating_sub(3);
            (usize::from(width.0).clamp(20, 120), rows.clamp(8, 40))
        }
        None => (72, 24),
    }
}

/// Draws a picture, on a terminal in colours.
pub fn draw(sketch: &Sketch) {
    if io::stdout().is_terminal() && wants_colours() {
        sketch.rows().for_each(|row| answer(&coloured(row)));
    } else {
        sketch.lines().iter().for_each(|line| answer(line));
    }
}

/// A row of a picture with its colours.
fn coloured(row: &[Cell]) -> String {
    let n = row.iter().rposition(|cell| *cell != Cell::default()).map_or(0, |last| last + 1);
    let mut text = String::new();
    for cell in &row[..n] {
        match (cell.letter, cell.upper, cell.lower) {
            (None, Some(upper), Some(lower)) if upper != lower => {
                let (over, under) = (colour(upper), colour(lower) + 10);
                text.push_str(&format!("\x1b[{over};{under}m\u{2580}\x1b[0m"));
            }
            (None, Some(ink), _) | (None, None, Some(ink)) => {
                text.push_str(&format!("\x1b[{}m{}\x1b[0m", colour(ink), cell.char()));
            }
            _ => text.push(cell.char()),
        }
    }
    text
}

/// The colour of an ink, as terminals number those of letters.
const fn colour(ink: Ink) -> u8 {
    match ink {
        Ink::Guide => 90,
        // Blue, red, green, magenta, cyan.
        Ink::Path(number) => [94, 91, 92, 95, 96][number % 5],
        Ink::Body => 37,
        Ink::Drive => 33,
        Ink::Joint => 97,
    }
}

/// Gives lines to the user's pager: `$PAGER`, or `less`.
///
/// # Errors
/// Where there is none.
fn show_pages(lines: &[String]) -> io::Result<()> {
    flush();
    let pager = std::env::var("PAGER").unwrap_or_else(|_| "less".to_owned());
    let mut words = pager.split_whitespace();
    let program = words.next().ok_or(io::ErrorKind::NotFound)?;
    let mut command = Command::new(program);
    command.args(words).stdin(Stdio::piped());
    if std::env::var_os("LESS").is_none() {
        // Ends at once where all fits, and leaves on the screen what was read.
        command.env("LESS", "FRX");
    }
    let mut child = command.spawn()?;
    if let Some(mut pages) = child.stdin.take() {
        // Who has read enough closes the pager, which is no failure.
        drop(lines.iter().try_for_each(|line| writeln!(pages, "{line}")));
    }
    child.wait().map(drop)
}

/// Whether the terminal understands more than a printer would.
pub fn is_capable() -> bool {
    std::env::var_os("TERM").is_none_or(|term| term != "dumb")
}

fn complain(text: &str) {
    progress::clear();
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
    !is_unwanted && is_capable()
}
