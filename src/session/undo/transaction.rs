//! A command is a transaction: what it changed can be taken back, and done again.

use std::sync::Arc;

use super::journal::{Change, Entry, Part};
use super::recorder::Recorder;
use crate::session::Session;
use crate::solve::{Memory, Settings, Solver};
use crate::world::{Edit, World};

impl Session {
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
                let (series, value) = *sample;
                self.swap_sample(series, value)
            }
            Change::Series(new) => {
                Change::Series(Box::new(std::mem::replace(&mut self.series, *new)))
            }
            Change::Reels(reels) => Change::Reels(
                self.recorders.iter_mut().zip(reels).map(|(r, reel)| r.wind(reel)).collect(),
            ),
        }
    }

    /// Makes a change that belongs to the command under way.
    pub(crate) fn change(&mut self, change: Change) {
        let inverse = self.apply(change);
        self.journal.current.push(inverse);
    }

    /// Makes an edit of the world that belongs to the command under way.
    pub(crate) fn edit(&mut self, edit: Edit) {
        let inverse = self.world.apply(edit);
        self.keep(inverse);
    }

    /// Keeps the inverse of an edit that was made, unless what takes back an earlier edit of
    /// the same command takes this one back as well: a loop of a million rounds that turns one
    /// knob is taken back by one edit.
    pub(crate) fn keep(&mut self, inverse: Edit) {
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
            Edit::Constraint(id, Some(_)) if self.world.constraint(*id).is_some() => {
                Some(Part::Constraint(*id))
            }
            Edit::Parameter(id, Some(_)) if self.world.parameter(*id).is_some() => {
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
    pub(crate) fn set_memory(&mut self, memory: Memory) {
        self.note_memory();
        self.solver.set_memory(memory);
        self.is_behind = true;
    }

    /// Keeps all that running changes, before the command under way lets time pass or the
    /// solver move points. Once a command is enough.
    pub(crate) fn begin_motion(&mut self) {
        if std::mem::replace(&mut self.journal.has_motion, true) {
            return;
        }
        self.journal.covered.clear();
        let reels = self.recorders.iter().map(Recorder::mark).collect();
        self.sync();
        let motion = Box::new(match self.last_motion.latest() {
            Some(latest) => self.world.motion_since(latest),
            None => self.world.motion(),
        });
        self.journal.current.push(Change::World(Edit::Motion(motion)));
        self.journal.current.push(Change::Reels(reels));
    }

    /// Keeps what the solver remembers, before the command under way has it take in an edit.
    pub(crate) fn note_memory(&mut self) {
        if !std::mem::replace(&mut self.journal.has_memory, true) {
            self.note_unseen();
            let memory = Arc::new(self.solver.memory());
            self.journal.current.push(Change::Memory(memory));
        }
    }

    /// Commands that the solver has not seen yet are taken back to what it remembers now.
    fn note_unseen(&mut self) {
        if self.journal.has_unseen() {
            let memory = Arc::new(self.solver.memory());
            self.journal.see(|| Change::Memory(memory.clone()));
        }
    }

    /// Lets the solver take in what was edited, as part of the command under way.
    pub(crate) fn sync(&mut self) {
        self.note_memory();
        self.is_behind = false;
        let Self { solver, world, preferences, .. } = self;
        solver.sync(world, &preferences.solve);
    }

    /// Asks the solver something. What it has to take in for that, it forgets again, so that
    /// looking changes nothing of what comes after.
    pub(crate) fn look<T>(
        &mut self,
        ask: impl FnOnce(&mut Solver, &mut World, &Settings) -> T,
    ) -> T {
        let Self { solver, world, preferences, .. } = self;
        let is_behind = self.is_behind || !world.is_untouched();
        let memory = is_behind.then(|| solver.memory());
        let answer = ask(solver, world, &preferences.solve);
        if let Some(memory) = memory {
            solver.set_memory(memory);
            self.is_behind = true;
        }
        answer
    }

    /// Ends the command under way. One that left everything as it was is none to be taken back.
    pub(crate) fn commit(&mut self, label: &str) {
        let changes = &self.journal.current;
        let is_idle = changes.iter().all(|change| match change {
            Change::World(edit) => self.world.is_already(edit),
            Change::Preferences(preferences) => **preferences == self.preferences,
            Change::Reels(reels) => {
                reels.len() == self.recorders.len()
                    && self.recorders.iter().zip(reels).all(|(r, reel)| r.is_at(reel))
            }
            // Looked at below: it takes the longest.
            Change::Memory(_) => true,
            _ => false,
        });
        let is_idle = is_idle
            && changes.iter().all(|change| match change {
                Change::Memory(memory) => memory.is_same(&self.solver.memory()),
                _ => true,
            });
        if is_idle {
            self.journal.take_current();
        } else {
            self.journal.commit(label);
        }
    }

    /// Takes back what the command under way did.
    pub(crate) fn roll_back(&mut self) {
        self.outbox.clear();
        self.run = None;
        self.last_motion.give_up();
        self.scopes.truncate(1);
        self.depth = 0;
        self.n_rounds = 1.0;
        self.included.clear();
        let scope = self.scopes.last_mut().expect("the outermost scope is never left");
        scope.bindings.clear();
        for change in self.journal.take_current().into_iter().rev() {
            self.apply(change);
        }
    }

    /// Takes back one command, or does it again: gives what was taken back.
    fn invert(&mut self, entry: Entry) -> Entry {
        let changes = entry.changes.into_iter().rev().map(|change| self.apply(change)).collect();
        Entry { label: entry.label, changes }
    }

    /// Takes back up to `n` commands; gives how many there were.
    pub(crate) fn undo(&mut self, n: usize) -> usize {
        for done in 0..n {
            let Some(entry) = self.journal.pop_done() else { return done };
            let inverse = self.invert(entry);
            self.note(format!("undid `{}`", inverse.label));
            self.journal.push_undone(inverse);
        }
        n
    }

    /// Does up to `n` commands again; gives how many there were.
    pub(crate) fn redo(&mut self, n: usize) -> usize {
        for done in 0..n {
            let Some(entry) = self.journal.pop_undone() else { return done };
            let inverse = self.invert(entry);
            self.note(format!("did `{}` again", inverse.label));
            self.journal.keep(inverse);
        }
        n
    }
}
