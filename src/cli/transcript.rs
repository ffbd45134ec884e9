//! What a session does with a piece of what is typed: statement by statement, past mistakes.

use std::path::PathBuf;

use super::output;
use super::run::Status;
use crate::diag::Span;
use crate::lang::parse;
use crate::session::{Flow, Session};

/// A text that is typed piece by piece.
pub struct Typed {
    name: &'static str,
    n_lines: usize,
}

/// How a piece went.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Outcome {
    /// How its last statement ended.
    pub flow: Flow,
    /// What a batch would end with at the first statement that failed, if one did.
    pub failure: Option<Status>,
}

impl Typed {
    /// A text that errors call `name`.
    pub const fn new(name: &'static str) -> Self {
        Self { name, n_lines: 0 }
    }

    /// Carries out a piece. After a mistake the rest of its line is left out, as it was typed
    /// in the belief that what stands before it works; the next line is carried out again.
    pub fn obey(&mut self, session: &mut Session, piece: &str) -> Outcome {
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
            match statement.and_then(|statement| session.execute(&statement)) {
                Ok(Flow::On) => {}
                Ok(flow) => {
                    outcome.flow = flow;
                    break;
                }
                Err(problem) => {
                    output::show(&problem, session.sources());
                    outcome.failure.get_or_insert(Status::of(&problem));
                    left_out = line_end(piece, span);
                }
            }
        }
        output::flush();
        outcome
    }
}

fn line_end(text: &str, span: Span) -> usize {
    let rest = text.get(span.end as usize..).unwrap_or_default();
    text.len() - rest.find('\n').map_or(0, |at| rest.len() - at)
}
