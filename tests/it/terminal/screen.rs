//! A terminal with the program at it: keys go in, and what a person would see comes out.

use std::io::{Read, Write};
use std::num::NonZero;
use std::path::Path;
use std::process::{Child, ExitStatus};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use pty_process::Size;
use pty_process::blocking::{Command, Pty, open};

/// How long something is waited for that is to be seen. Machines may be slow; what never comes is
/// a failure.
const PATIENCE: Duration = Duration::from_mins(1);

/// What came out so far.
struct Output {
    screen: vt100::Parser,
    bytes: Vec<u8>,
}

/// The program at a terminal of its own.
pub struct Terminal {
    pty: Arc<Pty>,
    output: Arc<Mutex<Output>>,
    child: Child,
}

/// How the program is started.
pub struct Start<'a> {
    /// Arguments.
    pub args: &'a [&'a str],
    /// What it finds in its environment, besides `HOME`, `PATH` and a capable `TERM`.
    pub env: &'a [(&'a str, &'a str)],
    /// Rows and columns of the terminal.
    pub size: (u16, u16),
}

impl Default for Start<'_> {
    fn default() -> Self {
        Self { args: &[], env: &[], size: (24, 80) }
    }
}

impl Terminal {
    /// The program in a folder that is its home, too.
    pub fn start(home: &Path, start: &Start) -> Self {
        let (rows, columns) = start.size;
        let (pty, there) = open().expect("a terminal");
        pty.resize(Size::new(rows, columns)).expect("its size");
        let child = Command::new(env!("CARGO_BIN_EXE_linkwork"))
            .current_dir(home)
            .env_clear()
            .env("HOME", home)
            .env("PATH", std::env::var_os("PATH").unwrap_or_default())
            .env("TERM", "xterm-256color")
            .env("PAGER", "cat")
            .envs(start.env.iter().copied())
            .args(start.args)
            .spawn(there)
            .expect("the program starts");
        let pty = Arc::new(pty);
        let screen = vt100::Parser::new(side(rows), side(columns), 0);
        let output = Arc::new(Mutex::new(Output { screen, bytes: Vec::new() }));
        let (source, sink) = (pty.clone(), output.clone());
        thread::spawn(move || {
            let mut piece = [0; 4096];
            // Ends with the program.
            while let Ok(n @ 1..) = (&*source).read(&mut piece) {
                let mut sink = sink.lock().unwrap_or_else(PoisonError::into_inner);
                sink.screen.process(&piece[..n]);
                sink.bytes.extend(&piece[..n]);
            }
        });
        Self { pty, output, child }
    }

    /// A session at its first prompt.
    pub fn session(home: &Path) -> Self {
        let terminal = Self::start(home, &Start::default());
        terminal.wait_for("Ctrl-D leaves");
        terminal.wait_for_prompt();
        terminal
    }

    /// Presses keys, one after the other.
    pub fn press(&self, keys: &str) {
        (&*self.pty).write_all(keys.as_bytes()).expect("it takes keys");
    }

    /// Types at an empty prompt, and waits until it is there.
    #[track_caller]
    pub fn type_in(&self, text: &str) {
        self.press(text);
        self.wait_for_line(&format!("> {text}"));
    }

    /// Types a line and waits for the next prompt.
    #[track_caller]
    pub fn enter(&self, line: &str) {
        self.type_in(line);
        self.press("\r");
        self.wait_for_prompt();
    }

    /// Types a line and waits until it is carried out: the terminal is the program's no more, Ctrl-C is
    /// no key but stops what runs, and what is typed waits.
    #[track_caller]
    pub fn begin(&self, line: &str) {
        self.type_in(line);
        self.press("\r");
        let typed = format!("> {line}");
        self.wait("the line left", |it| it.line() != typed);
    }

    /// Leaves the line that is being typed, and waits for the next.
    #[track_caller]
    pub fn clear(&self) {
        self.press("\x03");
        self.wait_for_prompt();
    }

    /// What is on the screen, line by line, without the blanks behind.
    pub fn screen(&self) -> String {
        let output = self.output.lock().unwrap_or_else(PoisonError::into_inner);
        let lines: Vec<String> =
            output.screen.screen().contents().lines().map(str::to_owned).collect();
        lines.join("\n")
    }

    /// All bytes that came out so far.
    pub fn bytes(&self) -> Vec<u8> {
        self.output.lock().unwrap_or_else(PoisonError::into_inner).bytes.clone()
    }

    /// The line of the cursor up to it, with the rows before it that it did not fit in.
    pub fn line(&self) -> String {
        let output = self.output.lock().unwrap_or_else(PoisonError::into_inner);
        let screen = output.screen.screen();
        let (last, column) = screen.cursor_position();
        let first = (0..last).rev().take_while(|&row| screen.row_wrapped(row)).last();
        let width = screen.size().1.get();
        let columns = |row| if row < last { 0..width } else { 0..column };
        let cells = (first.unwrap_or(last)..=last)
            .flat_map(|row| columns(row).filter_map(move |column| screen.cell(row, column)));
        cells.map(|cell| if cell.has_contents() { cell.contents() } else { " " }).collect()
    }

    /// Waits until something holds of the screen.
    #[track_caller]
    pub fn wait(&self, what: &str, holds: impl Fn(&Self) -> bool) {
        let begun = Instant::now();
        while !holds(self) {
            let is_late = begun.elapsed() > PATIENCE;
            assert!(!is_late, "{what} is not to be seen:\n{}", self.screen());
            thread::sleep(Duration::from_millis(5));
        }
    }

    /// Waits until a text is on the screen.
    #[track_caller]
    pub fn wait_for(&self, text: &str) {
        self.wait(&format!("{text:?}"), |it| it.screen().contains(text));
    }

    /// Waits until the line of the cursor reads so up to it.
    #[track_caller]
    pub fn wait_for_line(&self, text: &str) {
        self.wait(&format!("the line {text:?}"), |it| it.line() == text);
    }

    /// Waits for an empty prompt.
    #[track_caller]
    pub fn wait_for_prompt(&self) {
        self.wait_for_line("> ");
    }

    /// How the letters of a text look where it is seen last: each a colour, bold, underlined.
    #[track_caller]
    pub fn look(&self, text: &str) -> (vt100::Color, bool, bool) {
        let output = self.output.lock().unwrap_or_else(PoisonError::into_inner);
        let screen = output.screen.screen();
        let (rows, columns) = screen.size();
        let (rows, columns) = (rows.get(), columns.get());
        let n = text.chars().count() as u16;
        for row in (0..rows).rev() {
            for column in 0..columns.saturating_sub(n) {
                let cells: Vec<_> =
                    (column..column + n).filter_map(|column| screen.cell(row, column)).collect();
                let letter = |cell: &&vt100::Cell| match cell.contents() {
                    "" => " ".to_owned(),
                    letter => letter.to_owned(),
                };
                if cells.iter().map(letter).collect::<String>() == text {
                    let looks: Vec<_> = cells
                        .iter()
                        .map(|cell| (cell.fgcolor(), cell.bold(), cell.underline()))
                        .collect();
                    assert!(looks.iter().all(|look| *look == looks[0]), "{text:?}: {looks:?}");
                    return looks[0];
                }
            }
        }
        panic!("{text:?} is not on the screen")
    }

    /// Gives the terminal another size.
    pub fn resize(&self, rows: u16, columns: u16) {
        let mut output = self.output.lock().unwrap_or_else(PoisonError::into_inner);
        output.screen.screen_mut().set_size(side(rows), side(columns));
        self.pty.resize(Size::new(rows, columns)).expect("another size");
    }

    /// Ends the program as `kill -9` does.
    pub fn kill(mut self) {
        self.child.kill().expect("it runs");
        self.child.wait().expect("it ends");
    }

    /// Waits until the program has ended.
    pub fn end(mut self) -> ExitStatus {
        let begun = Instant::now();
        loop {
            if let Some(status) = self.child.try_wait().expect("it can be waited for") {
                return status;
            }
            assert!(begun.elapsed() < PATIENCE, "the program goes on:\n{}", self.screen());
            thread::sleep(Duration::from_millis(5));
        }
    }
}

/// A side of a terminal has a letter at least.
fn side(n: u16) -> NonZero<u16> {
    NonZero::new(n).expect("a side")
}

impl Drop for Terminal {
    fn drop(&mut self) {
        // Of a test that failed.
        drop(self.child.kill());
        drop(self.child.wait());
    }
}
