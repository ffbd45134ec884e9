//! A session whose talk is kept, for questions in the middle of a test.

use std::path::PathBuf;

use linkwork::diag::Diagnostic;
use linkwork::session::{Flow, Session};

use super::notebook::Notebook;

/// A session, and what it says.
pub struct Talking {
    pub session: Session,
    pub talk: Notebook,
}

impl Talking {
    /// After a script without mistakes.
    pub fn after(script: &str) -> Self {
        let mut talking = Self { session: Session::new(), talk: Notebook::default() };
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
        self.session.execute_all(source, &mut self.talk)
    }

    /// What a command prints.
    pub fn ask(&mut self, command: &str) -> Vec<String> {
        self.talk.printed.clear();
        self.run(command);
        std::mem::take(&mut self.talk.printed)
    }
}
