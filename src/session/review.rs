//! What is wrong with a script, found without letting time pass: for who writes it.

use super::execution::Flow;
use super::{Host, Session};
use crate::diag::{Diagnostic, SourceId, Sources};
use crate::errors;
use crate::lang::ast::Command;
use crate::lang::parse;

impl Session {
    /// Builds what a text says and gives all that is wrong with it, past mistakes. Nothing runs,
    /// is printed or drawn; a loop that takes long is left when the host is interrupted.
    pub fn review(&mut self, source: SourceId, host: &mut dyn Host) -> Vec<Diagnostic> {
        let text = self.sources().get(source).map(|s| s.text.clone()).unwrap_or_default();
        let mut problems: Vec<Diagnostic> = Vec::new();
        let mut is_stopped = false;
        for statement in parse(source, &text) {
            let problem = match statement {
                Err(problem) => Some(self.advise(problem)),
                Ok(statement) if is_stopped || !builds(&statement.command) => None,
                Ok(statement) => match self.execute(&statement, host) {
                    Ok(flow) => {
                        is_stopped = flow == Flow::Stopped;
                        None
                    }
                    Err(problem) => Some(problem),
                },
            };
            problems.extend(problem.filter(|new| !follows(new, &problems, self.sources())));
        }
        problems
    }
}

/// Whether later statements may need what a command makes.
fn builds(command: &Command) -> bool {
    // Definitions and files are looked into where they are used, and settings are of the scene.
    command.is_edit() || matches!(command, Command::Building(_) | Command::Changing(_))
}

/// Whether it is told that a name is unknown which an earlier mistake kept from being made.
fn follows(new: &Diagnostic, earlier: &[Diagnostic], sources: &Sources) -> bool {
    let Some(place) = new.place().filter(|_| new.code == Some(errors::UNKNOWN_NAME)) else {
        return false;
    };
    let name = sources.slice(place);
    earlier.iter().filter_map(Diagnostic::place).any(|at| {
        let Some(source) = sources.get(at.source).filter(|_| at.source == place.source) else {
            return false;
        };
        let start = source.text[..at.range().start].rfind('\n').map_or(0, |end| end + 1);
        let line = source.text[start..].lines().next().unwrap_or_default();
        line.split(|char: char| !char.is_alphanumeric() && char != '_').any(|word| word == name)
    })
}
