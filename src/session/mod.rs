//! Statements become edits: every command is one transaction on a world.
//!
//! A session reads statements, resolves their names, changes its world through reversible
//! edits, lets the solver work, and hands what is to be printed or written to a [`Host`].
//! It never touches a terminal, and never leaves half an edit behind.

mod analysis;
mod bind;
mod blocks;
mod change;
mod constrain;
mod dead_point;
mod delete;
mod describe;
mod diagnose;
mod host;
mod journal;
mod limits;
mod limits_of;
mod look;
mod perform;
mod pictures;
mod points;
mod recorder;
mod restore;
mod run;
mod save;
mod scope;
mod settings;
mod subject;

use std::collections::{BTreeMap, HashMap};
use std::path::PathBuf;
use std::sync::Arc;

pub use bind::evaluate_constant;
pub use dead_point::AtDeadPoint;
pub use diagnose::{Check, Unsatisfiable};
pub use host::{Host, Nowhere};
pub use run::Summary;
pub use settings::Preferences;

use crate::diag::{Diagnostic, Kind, SourceId, Sources, Span};
use crate::lang::ast::{Definition, Statement};
use crate::solve::Solver;
use crate::world::{Edit, World};
use journal::{Change, Entry, Journal};
use recorder::Recorder;
use scope::Scope;

/// A world with everything that a user can say to it.
pub struct Session {
    host: Box<dyn Host>,
    world: World,
    solver: Solver,
    preferences: Preferences,
    definitions: BTreeMap<Arc<str>, Arc<Definition>>,
    recorders: Vec<Recorder>,
    journal: Journal,
    scopes: Vec<Scope>,
    /// Statements carried out by the command under way.
    n_statements: u64,
    /// How deep `include`, `use` and `for` are nested now.
    depth: usize,
    sources: Sources,
    /// The folder of each text that was a file, for what it includes.
    folders: HashMap<SourceId, PathBuf>,
    /// Values that the user gave from outside; they win over a `let`.
    overrides: BTreeMap<String, Override>,
    /// Files to be written when the command under way has succeeded.
    outbox: Vec<(PathBuf, Vec<u8>, Span)>,
    last_run: Option<Summary>,
}

/// A value from outside and whether some `let` took it.
#[derive(Debug, Clone)]
struct Override {
    value: f64,
    is_used: bool,
}

/// How a statement ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Flow {
    /// The next statement is to follow.
    On,
    /// The user wants to leave.
    Quit,
    /// The user stopped the command; what it did so far stays.
    Stopped,
}

impl Session {
    /// An empty world that talks to `host`.
    pub fn new(host: Box<dyn Host>) -> Self {
        Self {
            host,
            world: World::new(),
            solver: Solver::new(),
            preferences: Preferences::default(),
            definitions: BTreeMap::new(),
            recorders: Vec::new(),
            journal: Journal::default(),
            scopes: vec![Scope::default()],
            n_statements: 0,
            depth: 0,
            sources: Sources::new(),
            folders: HashMap::new(),
            overrides: BTreeMap::new(),
            outbox: Vec::new(),
            last_run: None,
        }
    }

    /// The texts read so far; places in diagnostics are places in these.
    pub const fn sources(&self) -> &Sources {
        &self.sources
    }

    /// The world as it is.
    pub const fn world(&self) -> &World {
        &self.world
    }

    /// Receipt of the last command that let time pass.
    pub const fn last_run(&self) -> Option<&Summary> {
        self.last_run.as_ref()
    }

    /// Keeps a text. `folder` is where what it includes is looked for.
    pub fn add_source(&mut self, name: &str, text: &str, folder: Option<PathBuf>) -> SourceId {
        let id = self.sources.add(name, text);
        if let Some(folder) = folder {
            self.folders.insert(id, folder);
        }
        id
    }

    /// Gives a parameter a value that wins over the scripts' own `let`.
    pub fn override_parameter(&mut self, name: &str, value: f64) {
        self.overrides.insert(name.to_owned(), Override { value, is_used: false });
    }

    /// Names given to [`override_parameter`](Self::override_parameter) that no `let` has.
    pub fn unused_overrides(&self) -> impl Iterator<Item = &str> {
        self.overrides.iter().filter(|(_, o)| !o.is_used).map(|(name, _)| name.as_str())
    }

    /// Carries out one statement, whole or not at all.
    ///
    /// # Errors
    /// What is wrong with it; the world is then as it was.
    pub fn execute(&mut self, statement: &Statement) -> Result<Flow, Diagnostic> {
        self.n_statements = 0;
        let result = self.perform(statement).and_then(|flow| {
            self.post()?;
            Ok(flow)
        });
        match result {
            Ok(flow) => {
                let label = self.label(statement.span);
                self.journal.commit(&label);
                Ok(flow)
            }
            Err(problem) => {
                self.roll_back();
                Err(problem)
            }
        }
    }

    /// Carries out a whole text, statement by statement, up to the first error.
    ///
    /// # Errors
    /// The first thing that is wrong. The statements before it keep their effect.
    pub fn execute_all(&mut self, source: SourceId) -> Result<Flow, Diagnostic> {
        let text = self.sources.get(source).map(|s| s.text.clone()).unwrap_or_default();
        for statement in crate::lang::parse(source, &text) {
            let flow = self.execute(&statement?)?;
            if flow != Flow::On {
                return Ok(flow);
            }
        }
        Ok(Flow::On)
    }

    /// Ends the session: recordings still running are written.
    ///
    /// # Errors
    /// Where a file cannot be written.
    pub fn finish(&mut self) -> Result<(), Diagnostic> {
        let span = Span { source: SourceId(u32::MAX), start: 0, end: 0 };
        self.stop_recording(span)?;
        self.post()?;
        self.journal.commit("");
        Ok(())
    }

    /// Writes the files of a command that succeeded.
    fn post(&mut self) -> Result<(), Diagnostic> {
        for (path, bytes, span) in std::mem::take(&mut self.outbox) {
            self.host.write(&path, &bytes).map_err(|e| {
                Diagnostic::error(format!("cannot write `{}`: {e}", path.display()))
                    .kind(Kind::Unreadable)
                    .at(span, "")
            })?;
        }
        Ok(())
    }

    /// The first line of a statement, for telling what was undone.
    fn label(&self, span: Span) -> String {
        let text = self.sources.slice(span);
        let line = text.lines().next().unwrap_or_default();
        match line.char_indices().nth(60) {
            Some((end, _)) => format!("{}...", &line[..end]),
            None => line.to_owned(),
        }
    }

    /// Makes a reversible change; gives the change that takes it back.
    fn apply(&mut self, change: Change) -> Change {
        match change {
            Change::World(edit) => Change::World(self.world.apply(edit)),
            Change::Preferences(new) => {
                Change::Preferences(Box::new(std::mem::replace(&mut self.preferences, *new)))
            }
            Change::Definition(name, Some(new)) => {
                let old = self.definitions.insert(name.clone(), new);
                Change::Definition(name, old)
            }
            Change::Definition(name, None) => {
                let old = self.definitions.remove(&name);
                Change::Definition(name, old)
            }
            Change::Memory(memory) => {
                let old = self.solver.memory();
                self.solver.set_memory(*memory);
                Change::Memory(Box::new(old))
            }
            Change::Recorders(new) => {
                Change::Recorders(std::mem::replace(&mut self.recorders, new))
            }
            Change::Reels(reels) => Change::Reels(
                self.recorders.iter_mut().zip(reels).map(|(r, reel)| r.wind(reel)).collect(),
            ),
        }
    }

    /// Makes a change that belongs to the command under way.
    fn change(&mut self, change: Change) {
        let inverse = self.apply(change);
        self.journal.current.push(inverse);
    }

    /// Makes an edit of the world that belongs to the command under way.
    fn edit(&mut self, edit: Edit) {
        let inverse = self.world.apply(edit);
        self.journal.current.push(Change::World(inverse));
    }

    /// Keeps all that running changes, before the command under way lets time pass or the
    /// solver move points. Once a command is enough.
    fn begin_motion(&mut self) {
        if std::mem::replace(&mut self.journal.has_motion, true) {
            return;
        }
        let reels = self.recorders.iter().map(Recorder::mark).collect();
        let motion = Box::new(self.world.motion());
        self.journal.current.push(Change::Memory(Box::new(self.solver.memory())));
        self.journal.current.push(Change::World(Edit::Motion(motion)));
        self.journal.current.push(Change::Reels(reels));
    }

    /// Takes back what the command under way did.
    fn roll_back(&mut self) {
        self.outbox.clear();
        self.journal.has_motion = false;
        self.scopes.truncate(1);
        self.depth = 0;
        let scope = self.scopes.last_mut().expect("the outermost scope is never left");
        scope.bindings.clear();
        for change in std::mem::take(&mut self.journal.current).into_iter().rev() {
            self.apply(change);
        }
    }

    /// Takes back one command, or does it again: gives what was taken back.
    fn invert(&mut self, entry: Entry) -> Entry {
        let mut changes: Vec<Change> = Vec::with_capacity(entry.changes.len());
        for change in entry.changes.into_iter().rev() {
            changes.push(self.apply(change));
        }
        Entry { label: entry.label, changes }
    }

    fn undo(&mut self, n: usize) -> usize {
        for done in 0..n {
            let Some(entry) = self.journal.pop_done() else { return done };
            let inverse = self.invert(entry);
            self.note(format!("undid `{}`", inverse.label));
            self.journal.push_undone(inverse);
        }
        n
    }

    fn redo(&mut self, n: usize) -> usize {
        for done in 0..n {
            let Some(entry) = self.journal.pop_undone() else { return done };
            let inverse = self.invert(entry);
            self.note(format!("did `{}` again", inverse.label));
            self.journal.keep(inverse);
        }
        n
    }

    /// Tells the user something that is not an answer.
    fn note(&mut self, text: impl Into<String>) {
        self.host.tell(&Diagnostic::note_only(text), &self.sources);
    }

    /// Warns the user.
    fn warn(&mut self, warning: &Diagnostic) {
        self.host.tell(warning, &self.sources);
    }
}
