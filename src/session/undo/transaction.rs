//! A command is a transaction: what it changed can be taken back, and done again.

use std::sync::Arc;

use super::history::History;
use super::journal::{Change, Entry, Part};
use super::recorder::Recorder;
use crate::interrupt;
use crate::session::series::swap_sample;
use crate::session::state::State;
use crate::solve::{Memory, Settings, Solver};
use crate::world::{Edit, World};

impl State {
    /// Makes a reversible change; gives the change that takes it back.
    fn apply(&mut self, change: Change) -> Change {
        match change {
            Change::World(edit) => Change::World(self.world.apply(edit)),
            Change::Preferences(new) => {
                Change::Preferences(Box::new(std::mem::replace(&mut self.preferences, *new)))
            }
            Change::Definition(mut definition) => {
                let (name, it) = &mut *definition;
                *it = match it.take() {
                    Some(new) => self.definitions.insert(name.clone(), new),
                    None => self.definitions.remove(name),
                };
                Change::Definition(definition)
            }
            Change::Memory(memory) => {
                let old = Arc::new(self.solver.memory());
                self.solver.set_memory(Memory::clone(&memory));
                self.is_behind = true;
                Change::Memory(old)
            }
            Change::Recorder(idx, Some(recorder)) => {
                self.recorders.insert(idx, *recorder);
                Change::Recorder(idx, None)
            }
            Change::Recorder(idx, None) => {
                Change::Recorder(idx, Some(Box::new(self.recorders.remove(idx))))
            }
            Change::Sample(sample) => {
                let (name, value) = *sample;
                let inverse = swap_sample(&mut self.series, &name, value);
                Change::Sample(Box::new((name, inverse)))
            }
            Change::Series(new) => {
                Change::Series(Box::new(std::mem::replace(&mut self.series, *new)))
            }
            Change::Restoring(is_restoring) => {
                Change::Restoring(std::mem::replace(&mut self.is_restoring, is_restoring))
            }
            Change::Reels(reels) => Change::Reels(
                self.recorders.iter_mut().zip(reels).map(|(r, reel)| r.wind(reel)).collect(),
            ),
        }
    }

    /// Asks the solver something. What it has to take in for that, it forgets again, so that
    /// looking changes nothing of what comes after.
    pub fn look<T>(&mut self, ask: impl FnOnce(&mut Solver, &mut World, &Settings) -> T) -> T {
        let Self { solver, world, preferences, .. } = self;
        let is_behind = self.is_behind || !world.is_untouched();
        let memory = is_behind.then(|| solver.memory());
        let answer = interrupt::catch(|| ask(solver, world, &preferences.solve));
        if let Some(memory) = memory {
            solver.set_memory(memory);
            self.is_behind = true;
        }
        answer.unwrap_or_else(|stopped| interrupt::go_on(stopped))
    }
}

impl History {
    /// Makes a change that belongs to the command under way.
    pub fn change(&mut self, state: &mut State, change: Change) {
        let inverse = state.apply(change);
        self.journal.current.push(inverse);
    }

    /// Makes an edit of the world that belongs to the command under way.
    pub fn edit(&mut self, state: &mut State, edit: Edit) {
        let inverse = state.world.apply(edit);
        self.keep(&state.world, inverse);
    }

    /// Keeps the inverse of an edit that was made, unless what takes back an earlier edit of
    /// the same command takes this one back as well: a loop of a million rounds that turns one
    /// knob is taken back by one edit.
    pub fn keep(&mut self, world: &World, inverse: Edit) {
        let part = match &inverse {
            Edit::Move(..)
            | Edit::Start(..)
            | Edit::Clock(_)
            | Edit::StartState(..)
            | Edit::StartStates(_)
            | Edit::Ghost(None)
                if self.journal.has_motion =>
            {
                return;
            }
            Edit::Move(id, _) => Some(Part::Position(*id)),
            Edit::Freeze(id, _) => Some(Part::Freedom(*id)),
            Edit::Weight(id, _) => Some(Part::Weight(*id)),
            Edit::Clock(_) => Some(Part::Clock),
            Edit::Motion(_) => Some(Part::Motion),
            Edit::Switch(id, _) => Some(Part::Switch(*id)),
            Edit::Constraint(id, Some(_)) if world.constraint(*id).is_some() => {
                Some(Part::Constraint(*id))
            }
            Edit::Parameter(id, Some(_)) if world.parameter(*id).is_some() => {
                Some(Part::Parameter(*id))
            }
            _ => None,
        };
        if part.is_none()
            && let Some(Change::World(last)) = self.journal.current.last_mut()
            && last.absorb(&inverse)
        {
            return;
        }
        if part.is_none_or(|part| self.journal.covered.insert(part)) {
            self.journal.current.push(Change::World(inverse));
        }
    }

    /// Sets what the solver remembers, as part of the command under way.
    pub fn set_memory(&mut self, state: &mut State, memory: Memory) {
        self.note_memory(state);
        state.solver.set_memory(memory);
        state.is_behind = true;
    }

    /// Keeps all that running changes, before the command under way lets time pass or the
    /// solver move points. Once a command is enough.
    pub fn begin_motion(&mut self, state: &mut State) {
        if std::mem::replace(&mut self.journal.has_motion, true) {
            return;
        }
        self.journal.covered.clear();
        let reels = state.recorders.iter().map(Recorder::mark).collect();
        self.sync(state);
        let motion = Box::new(match self.last_motion.latest() {
            Some(latest) => state.world.motion_since(latest),
            None => state.world.motion(),
        });
        self.journal.current.push(Change::World(Edit::Motion(motion)));
        self.journal.current.push(Change::Reels(reels));
    }

    /// Keeps what the solver remembers, before the command under way has it take in an edit.
    fn note_memory(&mut self, state: &State) {
        if !std::mem::replace(&mut self.journal.has_memory, true) {
            self.note_unseen(state);
            let memory = Arc::new(state.solver.memory());
            self.journal.current.push(Change::Memory(memory));
        }
    }

    /// Commands that the solver has not seen yet are taken back to what it remembers now.
    fn note_unseen(&mut self, state: &State) {
        if self.journal.has_unseen() {
            let memory = Arc::new(state.solver.memory());
            self.journal.see(|| Change::Memory(memory.clone()));
        }
    }

    /// Lets the solver take in what was edited, as part of the command under way.
    pub fn sync(&mut self, state: &mut State) {
        self.note_memory(state);
        state.is_behind = false;
        state.solver.sync(&mut state.world, &state.preferences.solve);
    }

    /// Ends the command under way. One that left everything as it was is none to be taken back.
    pub fn commit(&mut self, state: &State, label: &str) {
        let changes = &self.journal.current;
        let is_idle = changes.iter().all(|change| match change {
            Change::World(edit) => state.world.is_already(edit),
            Change::Preferences(preferences) => **preferences == state.preferences,
            Change::Reels(reels) => {
                reels.len() == state.recorders.len()
                    && state.recorders.iter().zip(reels).all(|(r, reel)| r.is_at(reel))
            }
            // Looked at below: it takes the longest.
            Change::Memory(_) => true,
            _ => false,
        });
        let is_idle = is_idle
            && changes.iter().all(|change| match change {
                Change::Memory(memory) => memory.is_same(&state.solver.memory()),
                _ => true,
            });
        if is_idle {
            self.journal.take_current();
        } else {
            self.journal.commit(label);
        }
    }

    /// Takes back what the command under way did.
    pub fn roll_back(&mut self, state: &mut State) {
        self.last_motion.give_up();
        for change in self.journal.take_current().into_iter().rev() {
            state.apply(change);
        }
    }

    /// Takes back the last command; gives its text, if there was one.
    pub fn undo(&mut self, state: &mut State) -> Option<String> {
        let inverse = invert(state, self.journal.pop_done()?);
        let label = inverse.label.clone();
        self.journal.push_undone(inverse);
        Some(label)
    }

    /// Does the command that was taken back last again; gives its text, if there was one.
    pub fn redo(&mut self, state: &mut State) -> Option<String> {
        let inverse = invert(state, self.journal.pop_undone()?);
        let label = inverse.label.clone();
        self.journal.keep(inverse);
        Some(label)
    }
}

/// Takes back one command, or does it again; gives what takes that back.
fn invert(state: &mut State, entry: Entry) -> Entry {
    let changes = entry.changes.into_iter().rev().map(|change| state.apply(change)).collect();
    Entry { label: entry.label, changes }
}
