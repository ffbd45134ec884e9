//! A session whose talk is kept, for tests.

use std::cell::{Cell, RefCell};
use std::io;
use std::path::{Path, PathBuf};
use std::rc::Rc;

use linkwork::diag::{Diagnostic, Sources};
use linkwork::session::{Flow, Host, Session};

/// A file that was written: where, and what.
pub type Written = (PathBuf, Vec<u8>);

/// What a session printed and told.
#[derive(Clone, Default)]
pub struct Talk {
    printed: Rc<RefCell<Vec<String>>>,
    told: Rc<RefCell<Vec<String>>>,
    written: Rc<RefCell<Vec<Written>>>,
    clock: Rc<Cell<f64>>,
    tick: Rc<Cell<f64>>,
}

impl Talk {
    /// The lines printed since this was last asked for.
    pub fn printed(&self) -> Vec<String> {
        self.printed.take()
    }

    /// The files written since this was last asked for.
    pub fn files(&self) -> Vec<Written> {
        self.written.take()
    }

    /// Lets the clock go on so many seconds whenever it is looked at; it stands still otherwise.
    pub fn tick(&self, seconds: f64) {
        self.tick.set(seconds);
    }

    /// The notes and warnings since this was last asked for, first lines only.
    pub fn told(&self) -> Vec<String> {
        self.told.take()
    }
}

impl Host for Talk {
    fn print(&mut self, line: &str) {
        self.printed.borrow_mut().push(line.to_owned());
    }

    fn tell(&mut self, what: &Diagnostic, _sources: &Sources) {
        self.told.borrow_mut().push(what.message.to_string());
    }

    fn read(&mut self, path: &Path) -> io::Result<String> {
        std::fs::read_to_string(path)
    }

    fn write(&mut self, path: &Path, bytes: &[u8]) -> io::Result<()> {
        self.written.borrow_mut().push((path.to_path_buf(), bytes.to_vec()));
        Ok(())
    }

    fn written(&self, path: &Path) -> PathBuf {
        path.to_path_buf()
    }

    fn seconds(&self) -> f64 {
        self.clock.set(self.clock.get() + self.tick.get());
        self.clock.get()
    }
}

/// A session, and what it says.
pub struct Talking {
    pub session: Session,
    pub talk: Talk,
}

impl Talking {
    /// After a script without mistakes.
    pub fn after(script: &str) -> Self {
        let talk = Talk::default();
        let mut talking = Self { session: Session::new(Box::new(talk.clone())), talk };
        talking.run(script);
        talking
    }

    /// Carries out a script without mistakes.
    pub fn run(&mut self, script: &str) {
        if let Err(problem) = self.execute(script) {
            panic!("{}: {:?}\n{script}", problem.message, problem.labels);
        }
    }

    /// Carries out a script.
    pub fn execute(&mut self, script: &str) -> Result<Flow, Diagnostic> {
        let source = self.session.add_source("test", script, Some(PathBuf::new()));
        self.session.execute_all(source)
    }

    /// What a command prints.
    pub fn ask(&mut self, command: &str) -> Vec<String> {
        self.talk.printed();
        self.run(command);
        self.talk.printed()
    }
}
