//! One variant of a sweep: a session of its own, from a script that was read once for all of them.

use std::path::PathBuf;
use std::sync::Arc;

use super::grid::Grid;
use super::quiet::Quiet;
use crate::diag::{Diagnostic, SourceId, Sources};
use crate::lang::ast::Statement;
use crate::lang::parse;
use crate::render::{Options, svg};
use crate::session::host::Host;
use crate::session::results::Results;
use crate::session::{Quota, Session};
use crate::solve::{Status, verdict};
use crate::world::Entity;

/// A script, read once.
#[derive(Debug, Clone)]
pub struct SweepScript {
    name: Arc<str>,
    text: Arc<str>,
    folder: PathBuf,
    statements: Arc<[Statement]>,
    limits: Vec<(Quota, u64)>,
}

/// What came of a variant.
#[derive(Debug, Clone)]
pub struct Variant {
    /// Its number in the grid, from 0.
    pub number: u64,
    /// The values of its parameters.
    pub values: Vec<f64>,
    /// What it said its run is for.
    pub results: Results,
    /// How the worst of its runs ended, or how its pose stands.
    pub status: Status,
    /// The largest residual, relative to the scene's size.
    pub residual: f64,
    /// Frames that missed their tolerance.
    pub n_missed: u64,
    /// How often a motor could not go on.
    pub n_dead_points: u64,
    /// What was wrong, where a statement failed.
    pub failure: Option<Failure>,
}

/// Why a variant came to no end.
#[derive(Debug, Clone)]
pub struct Failure {
    /// In a line, with the line of the script.
    pub text: String,
    /// The whole of it.
    pub problem: Diagnostic,
    /// The texts that its places are in.
    pub sources: Sources,
}

impl Variant {
    /// How it ended, in one word.
    pub const fn word(&self) -> &'static str {
        if self.failure.is_some() { "error" } else { self.status.word() }
    }
}

impl SweepScript {
    /// Reads a script.
    ///
    /// # Errors
    /// The first statement that cannot be read, and the texts that its places are in.
    pub fn read(
        name: &str,
        text: &str,
        folder: PathBuf,
        limits: Vec<(Quota, u64)>,
    ) -> Result<Self, (Diagnostic, Sources)> {
        // Each session counts its texts from 0.
        let statements: Result<Vec<Statement>, Diagnostic> = parse(SourceId(0), text).collect();
        match statements {
            Ok(statements) => Ok(Self {
                name: name.into(),
                text: text.into(),
                folder,
                statements: statements.into(),
                limits,
            }),
            Err(problem) => {
                let mut sources = Sources::new();
                sources.add(name, text);
                Err((problem, sources))
            }
        }
    }

    /// The parameters of a grid that no `let` takes when the first variant runs, and those that there
    /// are then. A run that fails says nothing of what comes after.
    pub fn unused(&self, grid: &Grid, host: &mut dyn Host) -> (Vec<String>, Vec<String>) {
        let Some((session, variant)) = self.run_to_its_end(grid, 0, host) else {
            return Default::default();
        };
        if variant.failure.is_some() {
            return Default::default();
        }
        let names = session.world().names().iter();
        let parameters = names.filter(|(_, entity)| matches!(entity, Entity::Parameter(_)));
        let known = parameters.map(|(name, _)| name.to_owned()).collect();
        (session.unused_overrides().map(str::to_owned).collect(), known)
    }

    fn begin(&self, grid: &Grid, values: &[f64]) -> Session {
        let mut session = Session::new();
        // What is done once is never taken back.
        session.limit(Quota::UndoCommands, 0);
        for &(quota, most) in &self.limits {
            session.limit(quota, most);
        }
        session.input.add_shared(self.name.clone(), self.text.clone(), self.folder.clone());
        for (axis, &value) in grid.axes.iter().zip(values) {
            session.override_parameter(&axis.name, value);
        }
        session
    }

    /// Runs a variant; none where the user stops it.
    pub fn run(&self, grid: &Grid, number: u64, host: &mut dyn Host) -> Option<Variant> {
        self.run_to_its_end(grid, number, host).map(|(_, variant)| variant)
    }

    /// A picture of the pose that a variant ends in.
    pub fn picture(
        &self,
        grid: &Grid,
        number: u64,
        options: &Options,
        host: &mut dyn Host,
    ) -> Option<String> {
        let (session, _) = self.run_to_its_end(grid, number, host)?;
        Some(svg(&session.scene(), options))
    }

    fn run_to_its_end(
        &self,
        grid: &Grid,
        number: u64,
        host: &mut dyn Host,
    ) -> Option<(Session, Variant)> {
        let values = grid.values(number);
        let mut session = self.begin(grid, &values);
        let mut quiet = Quiet::new(host);
        let mut failure = None;
        for statement in &*self.statements {
            let result = session.execute(statement, &mut quiet);
            if quiet.is_interrupted() {
                return None;
            }
            if let Err(problem) = result {
                let line = problem.place().and_then(|place| session.sources().place(place));
                let text = match line {
                    Some(place) => format!("line {}: {problem}", place.line),
                    None => problem.to_string(),
                };
                failure = Some(Failure { text, problem, sources: session.sources().clone() });
                break;
            }
        }
        let (status, residual) = quiet.worst.unwrap_or_else(|| {
            let found = verdict(session.world(), &session.state.preferences.solve);
            (found.status, found.residual)
        });
        let (n_missed, n_dead_points) = (quiet.n_missed, quiet.n_dead_points);
        let results = session.results().clone();
        let variant =
            Variant { number, values, results, status, residual, n_missed, n_dead_points, failure };
        Some((session, variant))
    }
}
