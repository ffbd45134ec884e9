//! A session without a process around it: what it says and writes is kept for the test to see.

use std::cell::{Cell, RefCell};
use std::collections::BTreeMap;
use std::fmt::Write;
use std::io;
use std::path::{Path, PathBuf};
use std::rc::Rc;

use linkwork::diag::{Diagnostic, Kind, Paint, Sources, render};
use linkwork::lang::parse;
use linkwork::session::{Flow, Host, Session};

/// What a session said and wrote.
#[derive(Default)]
pub struct Desk {
    pub said: RefCell<String>,
    pub files: RefCell<BTreeMap<PathBuf, String>>,
    /// Ctrl-C is pressed when this many questions for it were asked.
    pub patience: Cell<Option<u64>>,
}

/// A session's side of a desk.
struct Chair {
    desk: Rc<Desk>,
    /// Where files that the test has not written itself are read.
    folder: PathBuf,
}

impl Host for Chair {
    fn print(&mut self, line: &str) {
        self.desk.say(line);
    }

    fn tell(&mut self, what: &Diagnostic, sources: &Sources) {
        self.desk.say(&render(what, sources, Paint::Plain));
    }

    fn is_interrupted(&self) -> bool {
        let patience = &self.desk.patience;
        patience.set(patience.get().map(|n| n.saturating_sub(1)));
        patience.get() == Some(0)
    }

    fn read(&mut self, path: &Path) -> io::Result<String> {
        if let Some(text) = self.desk.files.borrow().get(path) {
            return Ok(text.clone());
        }
        String::from_utf8(std::fs::read(self.folder.join(path))?)
            .map_err(|_| io::Error::from(io::ErrorKind::InvalidData))
    }

    fn write(&mut self, path: &Path, bytes: &[u8]) -> io::Result<()> {
        if path.starts_with("locked") {
            return Err(io::Error::from(io::ErrorKind::PermissionDenied));
        }
        let text = String::from_utf8(bytes.to_vec()).expect("all that is written is text");
        self.desk.files.borrow_mut().insert(path.to_path_buf(), text);
        Ok(())
    }

    fn written(&self, path: &Path) -> PathBuf {
        path.to_path_buf()
    }

    fn seconds(&self) -> f64 {
        0.0
    }
}

impl Desk {
    fn say(&self, text: &str) {
        writeln!(self.said.borrow_mut(), "{text}").expect("writing to a string");
    }
}

/// A session at a desk.
pub struct Seat {
    pub desk: Rc<Desk>,
    pub session: Session,
}

impl Seat {
    /// An empty world; files are read from `folder`, below `golden/`.
    pub fn new(folder: &str) -> Self {
        let desk = Rc::new(Desk::default());
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/it/golden").join(folder);
        let session = Session::new(Box::new(Chair { desk: desk.clone(), folder }));
        Self { desk, session }
    }

    /// Carries out a text up to its first mistake.
    pub fn run(&mut self, name: &str, text: &str) -> Result<Flow, Diagnostic> {
        let source = self.session.add_source(name, text, Some(PathBuf::new()));
        self.session.execute_all(source)
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
            if let Err(problem) = statement.and_then(|statement| self.session.execute(&statement)) {
                let text = self.drawn(&problem);
                self.desk.say(&text);
            }
        }
    }

    /// What was said since it was last asked for.
    pub fn said(&self) -> String {
        self.desk.said.take()
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
