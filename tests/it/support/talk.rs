//! A session and all that it says, driven by texts.

use std::path::PathBuf;

use linkwork::diag::{Diagnostic, Paint, SourceId, Sources, render};
use linkwork::lang::ast::Statement;
use linkwork::lang::parse;
use linkwork::session::{Flow, Session};
use linkwork::world::World;

use super::notebook::Notebook;

/// A session, and what it says.
#[derive(Default)]
pub struct Talking {
    pub session: Session,
    pub talk: Notebook,
}

impl Talking {
    /// An empty world; files are read below `folder`.
    pub fn reading(folder: PathBuf) -> Self {
        Self { talk: Notebook { folder, ..Notebook::default() }, ..Self::default() }
    }

    /// After a script without mistakes.
    #[track_caller]
    pub fn after(script: &str) -> Self {
        let mut talking = Self::default();
        talking.run(script);
        talking
    }

    /// Adds a text; the files it includes are found from `folder`.
    pub fn add(&mut self, name: &str, text: &str, folder: impl Into<PathBuf>) -> SourceId {
        self.session.add_source(name, text, Some(folder.into()))
    }

    /// Carries out a script without mistakes.
    #[track_caller]
    pub fn run(&mut self, script: &str) {
        if let Err(problem) = self.execute(script) {
            panic!("{}\n{script}", self.drawn(&problem));
        }
    }

    /// Carries out a script up to its first mistake.
    pub fn execute(&mut self, script: &str) -> Result<Flow, Diagnostic> {
        let source = self.add("test", script, PathBuf::new());
        self.execute_all(source)
    }

    /// Carries out a text that was added, up to its first mistake.
    pub fn execute_all(&mut self, source: SourceId) -> Result<Flow, Diagnostic> {
        self.session.execute_all(source, &mut self.talk)
    }

    /// Carries out one statement of a text that was added.
    pub fn execute_one(&mut self, statement: &Statement) -> Result<Flow, Diagnostic> {
        self.session.execute(statement, &mut self.talk)
    }

    /// Carries out a text as at a prompt, past mistakes; gives what a user sees.
    pub fn type_in(&mut self, text: &str) -> String {
        self.talk.said.clear();
        let source = self.add("typed", text, PathBuf::new());
        for statement in parse(source, text) {
            let statement = statement.map_err(|problem| self.session.advise(problem));
            if let Err(problem) = statement.and_then(|statement| self.execute_one(&statement)) {
                let drawn = self.drawn(&problem);
                self.talk.say(&drawn);
            }
        }
        std::mem::take(&mut self.talk.said)
    }

    /// What a command prints.
    #[track_caller]
    pub fn ask(&mut self, command: &str) -> Vec<String> {
        self.talk.printed.clear();
        self.run(command);
        std::mem::take(&mut self.talk.printed)
    }

    /// A problem as the user sees it.
    pub fn drawn(&self, problem: &Diagnostic) -> String {
        render(problem, self.session.sources(), Paint::Plain)
    }

    /// Checks that what is loaded from its file says the same of itself, now and after `then`.
    #[track_caller]
    pub fn assert_goes_on_from_its_file(&mut self, then: &str) {
        let kept = self.script();
        let mut again = Self::after(&kept);
        assert_eq!(again.script(), kept);
        self.run(then);
        again.run(then);
        assert_eq!(again.script(), self.script(), "after {then}");
    }

    pub fn world(&self) -> &World {
        self.session.world()
    }

    /// The script that makes the world as it is: the same text, the same world.
    pub fn script(&self) -> String {
        self.session.to_script()
    }
}

/// Whether a text is made of statements, whatever they do.
pub fn is_read(text: &str) -> bool {
    let mut sources = Sources::new();
    let source = sources.add("test", text);
    parse(source, text).all(|statement| statement.is_ok())
}
