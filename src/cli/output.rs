//! What the program says: answers on standard output, everything else on standard error.

use std::io::{self, BufWriter, IsTerminal, Stdout, Write};
use std::process::{Command, Stdio};
use std::sync::{Mutex, MutexGuard, OnceLock, PoisonError};

use clap::ValueEnum;
use terminal_size::{Height, Width, terminal_size_of};

use super::wrap::wrapped;
use super::{environment, graphics, progress};
use crate::diag::{Diagnostic, Paint, Sources, render_within, short, visible};
use crate::render::{Cell, Drawable, Ink};

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
    progress::clear();
    let mut answers = answers();
    let line = if answers.is_terminal { visible(line) } else { line.into() };
    answers.n_bytes += line.len() as u64 + 1;
    answers.write(|out| out.write_all(line.as_bytes()).and_then(|()| out.write_all(b"\n")));
}

/// Writes a line of the answer for readers: on a terminal it is broken at words.
pub fn answer_fitted(line: &str) {
    match columns(terminal_size_of(io::stdout())) {
        Some(n_columns) => wrapped(line, n_columns).lines().for_each(answer),
        None => answer(line),
    }
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

/// Whether answers go to a terminal.
pub fn is_terminal() -> bool {
    io::stdout().is_terminal()
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
    complain(&format!("{}\n", fitted(line)));
}

/// Columns for what is said: those of the terminal, or of a wide page.
fn n_columns() -> usize {
    columns(terminal_size_of(io::stderr())).unwrap_or(WIDE)
}

/// Columns of a terminal, if there is one.
fn columns(size: Option<(Width, Height)>) -> Option<usize> {
    let (Width(n), _) = size?;
    (n > 0).then_some(n.into())
}

/// What is said, its lines broken at words where it goes to a terminal.
fn fitted(text: &str) -> String {
    match columns(terminal_size_of(io::stderr())) {
        Some(n_columns) => {
            let lines: Vec<String> = text.lines().map(|line| wrapped(line, n_columns)).collect();
            lines.join("\n")
        }
        None => text.to_owned(),
    }
}

/// Columns where there is no terminal to say.
const WIDE: usize = 140;

/// Shows a problem, underlined in its text.
pub fn show(problem: &Diagnostic, sources: &Sources) {
    flush();
    let mut text = match FORMAT.get() {
        Some(MessageFormat::Short) => short(problem, sources),
        _ => fitted(&render_within(problem, sources, paint(), n_columns())),
    };
    if !text.ends_with('\n') {
        text.push('\n');
    }
    complain(&text);
}

/// Writes the lines of a long answer: page by page where they are more than a terminal shows.
pub fn page(lines: &[String]) {
    let Some((width, height)) = terminal_size_of(io::stdout()) else {
        return lines.iter().for_each(|line| answer(line));
    };
    let text: Vec<String> = lines.iter().map(|line| wrapped(line, width.0.into())).collect();
    let lines: Vec<&str> = text.iter().flat_map(|line| line.split('\n')).collect();
    let fits = lines.len() < usize::from(height.0);
    if fits || !is_capable() || environment::is_empty("PAGER") || show_pages(&lines).is_err() {
        lines.iter().for_each(|line| answer(line));
    }
}

/// Columns and rows of what is drawn in characters: most of the terminal, and less than two pages.
pub fn page_size() -> (usize, usize) {
    match terminal_size_of(io::stdout()) {
        Some((width, height)) => {
            let rows = usize::from(height.0).saturating_sub(3);
            (usize::from(width.0).clamp(20, 120), rows.clamp(8, 40))
        }
        None => (72, 24),
    }
}

/// Draws a picture: as the terminal can, on one in colours at least.
pub fn draw(what: Drawable) {
    flush();
    progress::clear();
    let (n_columns, n_rows) = page_size();
    if let Some(picture) = graphics::picture(what, [n_columns, n_rows], wants_colours()) {
        let mut answers = answers();
        answers.n_bytes += picture.len() as u64;
        return answers.write(|out| out.write_all(&picture));
    }
    let sketch = what.sketch(n_columns, n_rows);
    if io::stdout().is_terminal() && wants_colours() {
        // The colours are ours, what is written in the picture is not.
        let lines: String = sketch.rows().map(|row| coloured(row) + "\n").collect();
        answers().write(|out| out.write_all(lines.as_bytes()));
    } else {
        sketch.lines().iter().for_each(|line| answer(line));
    }
}

/// A row of a picture with its colours.
fn coloured(row: &[Cell]) -> String {
    let n = row.iter().rposition(|cell| *cell != Cell::default()).map_or(0, |last| last + 1);
    row[..n].iter().map(painted).collect()
}

/// A character of a picture with its colours.
fn painted(cell: &Cell) -> String {
    match (cell.letter, cell.upper, cell.lower) {
        (None, Some(upper), Some(lower)) if upper != lower => {
            let (over, under) = (colour(upper), colour(lower) + 10);
            format!("\x1b[{over};{under}m\u{2580}\x1b[0m")
        }
        (None, Some(ink), _) | (None, None, Some(ink)) => {
            format!("\x1b[{}m{}\x1b[0m", colour(ink), cell.char())
        }
        _ => visible(cell.char().encode_utf8(&mut [0; 4])).into_owned(),
    }
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
fn show_pages(lines: &[&str]) -> io::Result<()> {
    flush();
    let pager = environment::text("PAGER").unwrap_or_else(|| "less".to_owned());
    let mut words = pager.split_whitespace();
    let program = words.next().ok_or(io::ErrorKind::NotFound)?;
    let mut command = Command::new(program);
    command.args(words).stdin(Stdio::piped());
    if environment::variable("LESS").is_none() {
        // Ends at once where all fits, and leaves on the screen what was read.
        command.env("LESS", "FRX");
    }
    let mut child = command.spawn()?;
    if let Some(mut pages) = child.stdin.take() {
        // Who has read enough closes the pager, which is no failure.
        drop(lines.iter().try_for_each(|line| writeln!(pages, "{}", visible(line))));
    }
    child.wait().map(drop)
}

/// Whether the terminal understands more than a printer would.
pub fn is_capable() -> bool {
    environment::variable("TERM").is_none_or(|term| term != "dumb")
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
    environment::variable("NO_COLOR").is_none() && is_capable()
}
