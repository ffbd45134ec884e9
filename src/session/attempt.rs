//! Statements that are tried: each takes the place of the one before, until one of them stays. A
//! slider on its way asks for that.

use super::Session;
use super::execution::Flow;
use super::host::Host;
use crate::diag::{Diagnostic, SourceId, Span};
use crate::errors;
use crate::lang::ast::Statement;
use crate::lang::parse;

/// A statement that was tried, and is still the last that was carried out.
pub struct Attempt {
    statement: Statement,
    /// Whether there is a command to be taken back.
    has_changed: bool,
}

impl Session {
    /// Carries out a statement that may be [taken back](Self::take_back) as if it had never been, or
    /// [stay](Self::keep_attempt).
    ///
    /// # Errors
    /// What is wrong with it; one that may let time pass or write files is not tried.
    pub fn attempt(
        &mut self,
        name: &str,
        text: &str,
        host: &mut dyn Host,
    ) -> Result<Attempt, Diagnostic> {
        let source = self.add_piece(name, text, 1, None);
        let mut statements = parse(source, text);
        let Some(statement) = statements.next().transpose()? else {
            return Err(refused(source, text));
        };
        if !statement.command.is_adjustment() || statements.next().is_some() {
            return Err(refused(source, text));
        }
        let before = self.history.journal.next_number();
        self.execute(&statement, host)?;
        let has_changed = self.history.journal.next_number() != before;
        Ok(Attempt { statement, has_changed })
    }

    /// Takes back what was tried last, before anything else is done.
    pub fn take_back(&mut self, attempt: &Attempt) {
        let source = attempt.statement.span.source;
        if attempt.has_changed {
            self.history.revoke(&mut self.state);
        }
        if self.sources().last().is_some_and(|(last, _)| last == source) {
            self.input.sources.forget_last();
        }
    }

    /// What was tried last stays: it counts as typed.
    pub fn keep_attempt(&mut self, attempt: &Attempt, host: &mut dyn Host) {
        if attempt.has_changed {
            self.note_typed(&attempt.statement, Flow::On, host);
        }
    }
}

fn refused(source: SourceId, text: &str) -> Diagnostic {
    Diagnostic::error(errors::ALONE, "this is not tried").at(
        Span::new(source, 0..text.len()),
        "only one `let`, `change`, `set`, `move`, `on` or `off` is",
    )
}
