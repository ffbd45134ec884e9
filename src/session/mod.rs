//! Statements become edits: every command is one transaction on a world.
//!
//! A session reads statements, resolves their names, changes its world through reversible
//! edits, lets the solver work, and hands what is to be printed or written to a [`Host`].
//! It never touches a terminal, and never leaves half an edit behind.

mod commands;
mod dispatch;
mod host;
mod overrides;
mod quotas;
mod report;
mod resolve;
mod scene_hash;
mod settled;
mod undo;

use std::collections::{BTreeMap, HashMap};
use std::path::PathBuf;
use std::sync::Arc;

pub use commands::accuracy::Telling;
pub use commands::dead_point::AtDeadPoint;
pub use commands::diagnose::{Check, Unsatisfiable};
pub use commands::effects::{Effects, Row as EffectRow};
pub use commands::settings::{Preferences, SETTINGS};
pub use host::{Host, Nowhere, reason};
pub use overrides::evaluate_binding;
pub use report::{Summary, Way};

use crate::diag::{Diagnostic, Kind, SourceId, Sources, Span};
use crate::lang::ast::{Definition, Statement};
use crate::solve::Solver;
use crate::world::World;
use commands::plot::SeriesList;
use overrides::Override;
use resolve::scope::Scope;
use undo::journal::Journal;
use undo::last_motion::LastMotion;
use undo::recorder::Recorder;

/// A world with everything that a user can say to it.
pub struct Session {
    host: Box<dyn Host>,
    world: World,
    solver: Solver,
    /// Whether the solver has yet to take in what it was told to remember.
    is_behind: bool,
    preferences: Preferences,
    definitions: BTreeMap<Arc<str>, Arc<Definition>>,
    recorders: Vec<Recorder>,
    journal: Journal,
    scopes: Vec<Scope>,
    /// Room for the text of a name.
    spelling: String,
    /// Statements carried out by the command under way.
    n_statements: u64,
    /// Rounds of the loops under way, multiplied.
    n_rounds: f64,
    /// Files being included, the outermost first.
    included: Vec<PathBuf>,
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
    /// What the command under way has run so far.
    run: Option<Summary>,
    last_motion: LastMotion,
    series: SeriesList,
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
            is_behind: false,
            preferences: Preferences::default(),
            definitions: BTreeMap::new(),
            recorders: Vec::new(),
            journal: Journal::default(),
            scopes: vec![Scope::default()],
            spelling: String::new(),
            n_statements: 0,
            n_rounds: 1.0,
            included: Vec::new(),
            depth: 0,
            sources: Sources::new(),
            folders: HashMap::new(),
            overrides: BTreeMap::new(),
            outbox: Vec::new(),
            last_run: None,
            run: None,
            last_motion: LastMotion::default(),
            series: SeriesList::new(),
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
        self.add_piece(name, text, 1, folder)
    }

    /// Keeps a piece of a text that is typed piece by piece; it begins at line `first_line`.
    pub fn add_piece(
        &mut self,
        name: &str,
        text: &str,
        first_line: usize,
        folder: Option<PathBuf>,
    ) -> SourceId {
        let id = self.sources.add_piece(name, text, first_line);
        if let Some(folder) = folder {
            self.folders.insert(id, folder);
        }
        id
    }

    /// Carries out one statement, whole or not at all.
    ///
    /// # Errors
    /// What is wrong with it; the world is then as it was.
    pub fn execute(&mut self, statement: &Statement) -> Result<Flow, Diagnostic> {
        self.n_statements = 0;
        let result = self.dispatch(statement).and_then(|flow| {
            self.flush_outbox()?;
            Ok(flow)
        });
        match result {
            Ok(flow) => {
                self.end_legs();
                self.report_run();
                let label = self.label(statement.span);
                self.commit(&label);
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
        if !self.stop_recording() {
            self.drop_recordings();
            return Err(Diagnostic::error("stopped before the recording was written")
                .kind(Kind::Interrupted));
        }
        self.flush_outbox()?;
        self.commit("");
        Ok(())
    }

    /// Writes the files of a command that succeeded. One that cannot be written keeps no
    /// other back.
    fn flush_outbox(&mut self) -> Result<(), Diagnostic> {
        let mut result = Ok(());
        for (path, bytes, span) in std::mem::take(&mut self.outbox) {
            if let Err(e) = self.host.write(&path, &bytes)
                && result.is_ok()
            {
                let problem = Diagnostic::error(format!("cannot write `{}`", path.display()));
                let why = reason(&e);
                result = Err(problem.kind(Kind::Unreadable).at(span, why));
            }
        }
        result
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

    /// Tells the user something that is not an answer.
    fn note(&mut self, text: impl Into<String>) {
        self.host.tell(&Diagnostic::note_only(text), &self.sources);
    }

    /// Warns the user.
    fn warn(&mut self, warning: &Diagnostic) {
        self.host.tell(warning, &self.sources);
    }
}
