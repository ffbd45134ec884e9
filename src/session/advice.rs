//! What to type instead, where only the world knows what a name is.

use super::Session;
use super::resolve::said::pattern_of;
use super::state::State;
use crate::diag::{Diagnostic, SourceId, Sources};
use crate::errors;
use crate::lang::ast::Role;
use crate::lang::catalogue::Slot;
use crate::lang::parse;
use crate::world::Entity;

impl Session {
    /// What is wrong with a text, said to who has this world in front of them: `coupler = 4` asks
    /// for a `change` where `coupler` is a constraint, and `A B` begins with no misspelt command where
    /// `A` is a point.
    #[must_use]
    pub fn advise(&self, problem: Diagnostic) -> Diagnostic {
        self.state.advise(problem, self.sources())
    }
}

impl State {
    /// As [`Session::advise`].
    pub(super) fn advise(&self, mut problem: Diagnostic, sources: &Sources) -> Diagnostic {
        let Some(place) = problem.place() else { return problem };
        let Some(text) = sources.get(place.source).map(|source| &*source.text) else {
            return problem;
        };
        let (before, name) = (&text[..place.range().start], &text[place.range()]);
        let rest = statement_end(&text[place.range().end..]);
        let help = match problem.code {
            Some(errors::ASSIGNMENT) => self.instead_of_assignment(name, assigned(rest)),
            Some(errors::UNKNOWN_COMMAND) if begins_statement(before) => {
                self.instead_of_name(name, rest)
            }
            _ => None,
        };
        if let Some(help) = help {
            problem.helps = vec![help];
        }
        problem
    }

    /// What to type for `name = value`, where something has that name or its owner's.
    fn instead_of_assignment(&self, name: &str, value: &str) -> Option<String> {
        let find = |name: &str| self.world.names().get(name);
        let Some(entity) = find(name) else {
            let (owner, part) = name.rsplit_once('.')?;
            let Entity::Constraint(_) = find(owner)? else { return None };
            return changed(owner, &format!("{part} {value}"));
        };
        let (what, statement) = match entity {
            Entity::Point(_) => ("to put the point elsewhere", format!("move {name} to {value}")),
            Entity::Parameter(_) => {
                ("to give the parameter another value", format!("let {name} = {value}"))
            }
            Entity::Measure(_) => ("to begin it anew", format!("measure {name} = {value}")),
            Entity::Constraint(id) => {
                let record = self.world.constraint(id).expect("it is named");
                let pattern = pattern_of(&record.constraint);
                let Some(word) = value_word(pattern.slots) else {
                    return Some(pattern.takes.to_owned());
                };
                ("to give it another value", format!("change {name} {word} {value}"))
            }
        };
        Some(format!("{what}, write `{statement}`"))
    }

    /// What to type for a statement that begins with a name, where something has it.
    fn instead_of_name(&self, name: &str, rest: &str) -> Option<String> {
        let noun = self.world.names().get(name)?.noun();
        let shown = || format!("`{name}` is a {noun}: `show {name}` tells of it");
        Some(changed(name, rest).unwrap_or_else(shown))
    }
}

/// Whether a statement begins behind a text.
fn begins_statement(before: &str) -> bool {
    let before = before.trim_end_matches([' ', '\t']);
    before.is_empty() || before.ends_with(['\n', ';', '{'])
}

/// What gives parts of a constraint other values, if that is what stands behind its name.
fn changed(name: &str, parts: &str) -> Option<String> {
    let statement = format!("change {name} {}", parts.trim());
    let mut statements = parse(SourceId(0), &statement);
    let is_one = matches!((statements.next(), statements.next()), (Some(Ok(_)), None));
    is_one.then(|| format!("to change it, write `{statement}`"))
}

/// What stands before the value of a constraint; none where it has none, or several.
fn value_word(slots: &[Slot]) -> Option<&'static str> {
    if slots.iter().any(|slot| matches!(slot, Slot::Relation { .. })) {
        return Some("=");
    }
    let mut words = slots.iter().filter_map(|slot| match slot {
        Slot::Value(role) | Slot::Optional(role, _) | Slot::Place(role) => Some(role.word()),
        Slot::Gearing => Some(Role::Ratio.word()),
        _ => None,
    });
    words.next().filter(|_| words.next().is_none())
}

/// A text up to the end of its first statement.
fn statement_end(text: &str) -> &str {
    text[..text.find(['\n', ';', '#']).unwrap_or(text.len())].trim()
}

/// The value behind the `=` that the rest of a statement begins with.
fn assigned(rest: &str) -> &str {
    rest.trim_start_matches('=').trim()
}
