//! Values given from outside (`--set`) that no script declares.

use std::collections::BTreeSet;

use super::Session;
use crate::diag::{Diagnostic, nearest, suggest};
use crate::errors;
use crate::world::Entity;

/// Names that were given values and that no `let` took, and the parameters that there are.
#[derive(Debug, Clone)]
pub struct Undeclared {
    names: BTreeSet<String>,
    known: BTreeSet<String>,
}

impl Undeclared {
    /// Those of a session so far.
    pub fn in_session(session: &Session) -> Self {
        let entities = session.world().names().iter();
        let parameters = entities.filter(|(_, entity)| matches!(entity, Entity::Parameter(_)));
        Self {
            names: session.unused_overrides().map(str::to_owned).collect(),
            known: parameters.map(|(name, _)| name.to_owned()).collect(),
        }
    }

    /// Those that neither this session declares nor another.
    #[must_use]
    pub fn and(mut self, other: Self) -> Self {
        self.names.retain(|name| other.names.contains(name));
        self.known.extend(other.known);
        self
    }

    /// What is wrong, a name each.
    pub fn problems(&self) -> impl Iterator<Item = Diagnostic> {
        self.names.iter().map(|name| self.problem(name))
    }

    fn problem(&self, name: &str) -> Diagnostic {
        let problem =
            Diagnostic::error(errors::UNKNOWN_NAME, format!("no `let` declares `{name}`"));
        let known: Vec<&str> = self.known.iter().map(String::as_str).collect();
        if nearest(name, known.iter().copied()).is_some() {
            return suggest(problem, name, known);
        }
        problem.help(match &known[..] {
            [] => format!("`let {name} = 1` in the script declares it"),
            known => format!("the script declares {}", known.join(", ")),
        })
    }
}
