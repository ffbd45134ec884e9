//! What to type instead, where only the world knows what a name is.

use super::Session;
use super::resolve::said::pattern_of;
use super::state::State;
use crate::diag::{Diagnostic, Sources};
use crate::errors;
use crate::lang::ast::Role;
use crate::lang::catalogue::Slot;
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
        let name = sources.slice(place);
        let Some(entity) = self.world.names().get(name) else { return problem };
        let before = sources.get(place.source).map_or("", |it| &it.text[..place.range().start]);
        let begins = before.trim_end_matches([' ', '\t']);
        let is_first = begins.is_empty() || begins.ends_with(['\n', ';', '{']);
        if problem.code == Some(errors::UNKNOWN_COMMAND) && is_first {
            problem.helps =
                vec![format!("`{name}` is {}: `show {name}` tells of it", noun(entity))];
        }
        if problem.code != Some(errors::ASSIGNMENT) {
            return problem;
        }
        let text = sources.get(place.source).map_or("", |source| &source.text);
        let value = assigned(&text[place.range().end..]);
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
                    problem.helps = vec![pattern.takes.to_owned()];
                    return problem;
                };
                ("to give it another value", format!("change {name} {word} {value}"))
            }
        };
        problem.helps = vec![format!("{what}, write `{statement}`")];
        problem
    }
}

/// What a thing is, as a sentence ends.
const fn noun(entity: Entity) -> &'static str {
    match entity {
        Entity::Point(_) => "a point",
        Entity::Parameter(_) => "a parameter",
        Entity::Constraint(_) => "a constraint",
        Entity::Measure(_) => "a measure",
    }
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

/// The value behind the `=` that a text begins with, up to the end of the statement.
fn assigned(text: &str) -> &str {
    let value = text.trim_start().trim_start_matches('=');
    value[..value.find(['\n', ';', '#']).unwrap_or(value.len())].trim()
}
