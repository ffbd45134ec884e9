//! A text from its first statement to its last: a script as a whole, or what is typed piece by
//! piece, past mistakes.

use std::path::PathBuf;

use super::Session;
use super::execution::Flow;
use super::host::Host;
use crate::diag::{Diagnostic, SourceId, Span};
use crate::lang::parse;

/// How a text went. The host was told what is wrong with it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Outcome {
    /// How its last statement ended.
    pub flow: Flow,
    /// What was wrong with the first statement that failed, if one did.
    pub failure: Option<Diagnostic>,
}

impl Session {
    /// Carries out a script up to the first error and ends the session. What was recorded up to
    /// there is not lost.
    pub fn run_script(&mut self, source: SourceId, host: &mut dyn Host) -> Outcome {
        let result = self.execute_all(source, host).and_then(|flow| {
            self.finish(host)?;
            Ok(flow)
        });
        match result {
            Ok(flow) => Outcome { flow, failure: None },
            Err(problem) => {
                host.tell(&problem, self.sources());
                if let Err(second) = self.finish(host)
                    && second != problem
                {
                    host.tell(&second, self.sources());
                }
                Outcome { flow: Flow::On, failure: Some(problem) }
            }
        }
    }
}

/// A text that is typed piece by piece.
#[derive(Debug)]
pub struct Transcript {
    name: &'static str,
    n_lines: usize,
    /// Whether somebody sees each answer before they go on.
    is_conversation: bool,
    /// Whether the pose was solved when it was looked at last.
    was_solved: bool,
}

impl Transcript {
    /// A text that errors call `name`.
    pub const fn new(name: &'static str) -> Self {
        Self { name, n_lines: 0, is_conversation: false, was_solved: true }
    }

    /// A conversation: who types is told when an edit leaves the pose unsolved.
    pub const fn conversation(name: &'static str) -> Self {
        Self { is_conversation: true, ..Self::new(name) }
    }

    /// Carries out a piece. After a mistake the rest of its line is left out, as it was typed
    /// in the belief that what stands before it works; the next line is carried out again.
    pub fn enter(&mut self, piece: &str, session: &mut Session, host: &mut dyn Host) -> Outcome {
        let folder = Some(PathBuf::new());
        let source = session.add_piece(self.name, piece, self.n_lines + 1, folder);
        self.n_lines += piece.lines().count().max(1);
        let mut outcome = Outcome { flow: Flow::On, failure: None };
        let mut left_out = 0;
        for statement in parse(source, piece) {
            let span = match &statement {
                Ok(statement) => statement.span,
                Err(problem) => problem.place().unwrap_or(Span::new(source, 0..0)),
            };
            if (span.start as usize) < left_out {
                continue;
            }
            let statement = statement.map_err(|problem| session.advise(problem));
            let is_edit = statement.as_ref().is_ok_and(|statement| statement.command.is_edit());
            match statement.and_then(|statement| session.execute(&statement, host)) {
                Ok(Flow::On) => self.look_at_pose(is_edit, session, host),
                Ok(flow) => {
                    outcome.flow = flow;
                    break;
                }
                Err(problem) => {
                    host.tell(&problem, session.sources());
                    outcome.failure.get_or_insert(problem);
                    left_out = line_end(piece, span);
                }
            }
        }
        outcome
    }
}

impl Transcript {
    /// Says once that an edit left the pose unsolved, until it is solved again.
    fn look_at_pose(&mut self, is_edit: bool, session: &Session, host: &mut dyn Host) {
        if !self.is_conversation {
            return;
        }
        let unsolved = session.unsolved();
        if let Some(note) = unsolved.as_ref().filter(|_| is_edit && self.was_solved) {
            host.tell(note, session.sources());
        }
        self.was_solved = unsolved.is_none();
    }
}

fn line_end(text: &str, span: Span) -> usize {
    let rest = text.get(span.end as usize..).unwrap_or_default();
    text.len() - rest.find('\n').map_or(0, |at| rest.len() - at)
}
