//! `delete`, `clear` and `reset`.

use std::collections::BTreeSet;
use std::ops::Range;

use crate::diag::Diagnostic;
use crate::errors;
use crate::lang::ast::Name;
use crate::session::execution::Execution;
use crate::session::state::State;
use crate::session::undo::journal::Change;
use crate::solve::Memory;
use crate::world::{Edit, Entity, Formula, Mention, ParameterId, User};

impl Execution<'_> {
    /// Deletes all that is named at once: what only they use of each other is no hindrance.
    pub(crate) fn delete(&mut self, names: &[Name], cascade: bool) -> Result<(), Diagnostic> {
        let mut all: Vec<Entity> = Vec::new();
        let mut is_named: BTreeSet<Entity> = BTreeSet::new();
        let mut parts: Vec<(&Name, Range<usize>)> = Vec::new();
        for name in names {
            let members =
                match self.resolve().instance(name)? {
                    Some(instance) => self.state.members(&instance),
                    // A definition shares no name with things of the world.
                    None => match name.as_simple() {
                        Some(word)
                            if self.state.definitions.contains_key(&word.text)
                                && self.state.world.names().is_free(&word.text) =>
                        {
                            self.change(Change::Definition(Box::new((word.text.clone(), None))));
                            continue;
                        }
                        _ => {
                            let entity = self.resolve().entity(name);
                            vec![entity.map_err(|problem| {
                                self.resolve().or_word(problem, name, "cascade")
                            })?]
                        }
                    },
                };
            let first = all.len();
            all.extend(members.into_iter().filter(|member| is_named.insert(*member)));
            parts.push((name, first..all.len()));
        }
        if cascade {
            all = self.state.world.with_users(&all);
        } else {
            for (name, members) in parts {
                let users = self.state.world.users(&all[members]);
                let others = users.into_iter().filter(|user| !is_named.contains(&user.entity()));
                self.refuse_used(name, &others.collect::<Vec<_>>())?;
            }
        }
        self.remove(&all);
        Ok(())
    }

    fn refuse_used(&self, name: &Name, users: &[User]) -> Result<(), Diagnostic> {
        if users.is_empty() {
            return Ok(());
        }
        let text = self.input.sources.slice(name.span);
        let shown = &users[..users.len().min(8)];
        let list: Vec<String> = shown
            .iter()
            .map(|user| format!("`{}`", self.state.world.name_of(user.entity())))
            .collect();
        let more = users.len() - shown.len();
        let more = if more == 0 { String::new() } else { format!(" and {more} more") };
        Err(Diagnostic::error(errors::IN_USE, format!("`{text}` is in use"))
            .at(name.span, format!("used by {}{more}", list.join(", ")))
            .help(format!("`delete {text} cascade` removes these too")))
    }

    /// Deletes entities that nothing else uses.
    fn remove(&mut self, entities: &[Entity]) {
        for &entity in entities {
            match entity {
                Entity::Constraint(id) => self.edit(Edit::Constraint(id, None)),
                Entity::Parameter(id) => self.edit(Edit::Parameter(id, None)),
                Entity::Measure(id) => self.edit(Edit::Measure(id, None)),
                Entity::Point(_) => {}
            }
        }
        for &entity in entities {
            if let Entity::Point(id) = entity {
                while let Some(k) = self.state.world.traces().iter().position(|t| t.point == id) {
                    self.edit(Edit::Trace(k, None));
                }
                let counts = self.state.world.turn_counts();
                let gone = counts.map(|(t, _)| t).filter(|t| t.points().contains(&id));
                for turning in gone.collect::<Vec<_>>() {
                    self.edit(Edit::TurnCount(Box::new((turning, None))));
                }
                self.edit(Edit::Point(id, None));
            }
        }
    }

    pub(crate) fn clear(&mut self) {
        self.stop_everything();
        self.history.clear(self.state);
        self.scopes.lose_all();
    }

    /// Ends recordings, forgets definitions and settings, and what the solver remembers.
    fn stop_everything(&mut self) {
        self.stop_recording();
        self.set_memory(Memory::default());
        self.change(Change::Series(Box::default()));
        self.change(Change::Results(Box::default()));
        self.change(Change::Restoring(false));
        let definitions: Vec<_> = self.state.definitions.keys().cloned().collect();
        for name in definitions {
            self.change(Change::Definition(Box::new((name, None))));
        }
        self.change(Change::Preferences(Box::default()));
    }

    /// Time 0 again, and everything where it stood when the clock left 0.
    pub(crate) fn reset(&mut self) -> Result<(), Diagnostic> {
        self.begin_motion();
        let start = self.state.world.start();
        self.history.go_to(self.state, start);
        self.set_memory(Memory::default());
        self.state.world.refresh().map_err(|why| why.note("at time 0"))
    }
}

impl State {
    /// Everything whose name begins with `instance.`, constraints and parameters before points.
    fn members(&self, instance: &str) -> Vec<Entity> {
        let mut members: Vec<Entity> = self.world.names().members(instance).collect();
        members.sort_by_key(|entity| match entity {
            Entity::Constraint(_) => 0,
            Entity::Parameter(_) | Entity::Measure(_) => 1,
            Entity::Point(_) => 2,
        });
        members
    }

    /// Parameters whose expressions mention only what comes before them in the list: the
    /// order in which they can be made again.
    pub(crate) fn parameters_in_order(&self) -> Vec<ParameterId> {
        let mut order = Vec::new();
        let mut is_done = BTreeSet::new();
        let roots: Vec<_> = self.world.parameters().map(|(id, _)| id).collect();
        for root in roots {
            let mut stack = vec![(root, false)];
            while let Some((id, is_expanded)) = stack.pop() {
                if is_expanded {
                    order.push(id);
                } else if is_done.insert(id) {
                    stack.push((id, true));
                    let formula: &Formula =
                        &self.world.parameter(id).expect("a listed parameter lives").formula;
                    formula.mentions(&mut |mention| {
                        if let Mention::Parameter(used) = mention {
                            stack.push((used, false));
                        }
                    });
                }
            }
        }
        order
    }
}
