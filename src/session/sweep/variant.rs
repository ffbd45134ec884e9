//! One variant of a sweep: a session of its own, from a script that was read once for all of them.

use std::path::PathBuf;
use std::sync::Arc;

use super::grid::Grid;
use crate::diag::{Diagnostic, SourceId, Sources};
use crate::lang::ast::Statement;
use crate::lang::parse;
use crate::render::{Options, svg};
use crate::session::host::Host;
use crate::session::quiet::Quiet;
use crate::session::results::Results;
use crate::session::{Quota, Session};
use crate::solve::{Status, verdict};

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

/// A variant that was run.
pub(super) struct Ran {
    /// As it was left.
    pub session: Session,
    /// What came of it.
    pub variant: Variant,
}

impl Ran {
    /// A picture of the pose that it ended in.
    pub fn picture(&self, options: &Options) -> String {
        svg(&self.session.scene(), options)
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
    pub(super) fn run_to_its_end(
        &self,
        grid: &Grid,
        number: u64,
        host: &mut dyn Host,
    ) -> Option<Ran> {
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
                // A row of the table is a line of it.
                let text = text.replace(['\n', '\r'], " ");
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
        Some(Ran { session, variant })
    }
}
