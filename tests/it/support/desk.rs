//! A session without a process around it, as a user meets it: texts go in, texts come out.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use linkwork::diag::{Diagnostic, Kind, Paint, render};
use linkwork::lang::parse;
use linkwork::session::{Flow, Session};

use super::notebook::Notebook;

/// A session at a desk.
pub struct Seat {
    pub notebook: Notebook,
    pub session: Session,
}

impl Seat {
    /// An empty world; files are read from `folder`, below `golden/`.
    pub fn new(folder: &str) -> Self {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/it/golden").join(folder);
        Self { notebook: Notebook { folder, ..Notebook::default() }, session: Session::new() }
    }

    /// Carries out a text up to its first mistake.
    pub fn run(&mut self, name: &str, text: &str) -> Result<Flow, Diagnostic> {
        let source = self.session.add_source(name, text, Some(PathBuf::new()));
        self.session.execute_all(source, &mut self.notebook)
    }

    /// Carries out a text that has no mistake.
    pub fn must(&mut self, text: &str) {
        if let Err(problem) = self.run("test", text) {
            panic!("{}", self.drawn(&problem));
        }
    }

    /// Carries out a text as at a prompt: past mistakes, which are kept with what is said.
    pub fn talk(&mut self, text: &str) {
        let source = self.session.add_source("typed", text, Some(PathBuf::new()));
        for statement in parse(source, text) {
            let Self { notebook, session } = self;
            if let Err(problem) = statement.and_then(|it| session.execute(&it, notebook)) {
                let text = self.drawn(&problem);
                self.notebook.say(&text);
            }
        }
    }

    /// What was said since it was last asked for.
    pub fn said(&mut self) -> String {
        std::mem::take(&mut self.notebook.said)
    }

    /// A problem as the user sees it.
    pub fn drawn(&self, problem: &Diagnostic) -> String {
        render(problem, self.session.sources(), Paint::Plain)
    }

    /// The script that makes the world as it is: the same text, the same world.
    pub fn world(&self) -> String {
        self.session.to_script()
    }
}

/// The exit status that a batch ends with.
pub fn status(problem: &Diagnostic) -> u8 {
    match problem.kind {
        Kind::Promise => 1,
        Kind::Mistake => 2,
        Kind::Unreadable => 3,
        Kind::Interrupted => 130,
    }
}

/// Compares `got` with the file, or writes the file if `UPDATE_GOLDEN` says so.
pub fn check_golden(path: &Path, got: &str) {
    if std::env::var_os("UPDATE_GOLDEN").is_some() {
        std::fs::write(path, got).expect("the file can be written");
        return;
    }
    let wanted = std::fs::read_to_string(path).unwrap_or_default();
    assert_eq!(got, wanted, "in {}", path.display());
}

/// Compares two texts; on a difference shows the first lines that differ, not all of both.
pub fn check_same(got: &str, wanted: &str, when: &str) {
    if got == wanted {
        return;
    }
    let mut differing = String::new();
    let (mut a, mut b) = (got.lines(), wanted.lines());
    loop {
        match (a.next(), b.next()) {
            (None, None) => break,
            (a, b) if a == b => {}
            (a, b) if differing.len() < 2_000 => {
                writeln!(differing, "  is     {}\n  wanted {}", a.unwrap_or("-"), b.unwrap_or("-"))
                    .expect("writing to a string");
            }
            _ => break,
        }
    }
    panic!("{when}:\n{differing}");
}
