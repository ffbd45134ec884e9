//! A command is a transaction: what it changed can be taken back, and done again.

use super::history::History;
use super::journal::{Change, Entry, Part};
use super::recorder::Recorder;
use crate::interrupt::{self, Stopped};
use crate::session::quotas::Quotas;
use crate::session::series::swap_sample;
use crate::session::state::State;
use crate::solve::{Memory, Settings, Solver};
use crate::world::{Edit, Moment, PointId, World};

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
            Change::Memory(recall) => Change::Memory(Box::new(self.solver.recall(&recall))),
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
            Change::Results(new) => {
                Change::Results(Box::new(std::mem::replace(&mut self.results, *new)))
            }
            Change::Restoring(is_restoring) => {
                Change::Restoring(std::mem::replace(&mut self.is_restoring, is_restoring))
            }
            Change::Reels(reels) => Change::Reels(
                self.recorders.iter_mut().zip(reels).map(|(r, reel)| r.wind(reel)).collect(),
            ),
        }
    }

    /// Whether a change would leave everything as it is. Says no where that is not seen at once.
    fn is_at(&self, change: &Change) -> bool {
        match change {
            Change::World(edit) => self.world.is_already(edit),
            Change::Preferences(preferences) => **preferences == self.preferences,
            Change::Reels(reels) => {
                reels.len() == self.recorders.len()
                    && self.recorders.iter().zip(reels).all(|(r, reel)| r.is_at(reel))
            }
            Change::Memory(recall) => self.solver.is_at(recall),
            Change::Results(results) => **results == self.results,
            _ => false,
        }
    }

    /// Asks the solver something. What it has to take in for that, it forgets again, so that
    /// looking changes nothing of what comes after.
    pub fn look<T>(&mut self, ask: impl FnOnce(&mut Solver, &mut World, &Settings) -> T) -> T {
        let Self { solver, world, preferences, .. } = self;
        let outer = solver.begin_recall();
        let answer = interrupt::catch(|| ask(solver, world, &preferences.solve));
        if let Some(recall) = solver.end_recall(outer) {
            solver.recall(&recall);
        }
        answer.unwrap_or_else(|stopped| {
            solver.begin_anew();
            interrupt::go_on(stopped)
        })
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
        let made = match &edit {
            Edit::Constraint(id, Some(_)) if !state.world.start_states().contains_key(id) => {
                Some(*id)
            }
            _ => None,
        };
        let inverse = state.world.apply(edit);
        self.keep(&state.world, inverse);
        if let Some(id) = made
            && state.world.start_states().contains_key(&id)
        {
            self.keep(&state.world, Edit::StartState(id, None));
        }
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
                if self.journal.motion.is_some() =>
            {
                return;
            }
            Edit::Move(id, _) => Some(Part::Position(*id)),
            Edit::Freeze(id, _) => Some(Part::Freedom(*id)),
            Edit::Refreeze(it) => {
                let parts = it.bound.iter().map(|(id, _)| Part::Binding(*id));
                let parts = parts.chain([Part::Freedom(it.point)]);
                // Each is to be covered: another constraint may be bound otherwise this time.
                if parts.filter(|part| self.journal.covered.insert(*part)).count() > 0 {
                    self.journal.current.push(Change::World(inverse));
                }
                return;
            }
            Edit::Weight(id, _) => Some(Part::Weight(*id)),
            Edit::Clock(_) => Some(Part::Clock),
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
    }

    /// Adds a part to what the solver remembers, as part of the command under way; false if it cannot
    /// be one.
    pub fn restore_memory(
        &mut self,
        state: &mut State,
        owner: Option<PointId>,
        numbers: &[f64],
    ) -> bool {
        self.note_memory(state);
        state.solver.restore(owner, numbers)
    }

    /// Keeps what running changes from here on, before the command under way lets time pass or the
    /// solver move points, and lets the solver take in what was edited. Once a command is enough for what is
    /// kept.
    pub fn begin_motion(&mut self, state: &mut State) {
        if self.journal.motion.is_some() {
            return self.sync(state);
        }
        self.journal.covered.clear();
        self.journal.motion = Some(self.journal.current.len());
        state.world.begin_motion();
        let reels = state.recorders.iter().map(Recorder::mark).collect();
        self.journal.current.push(Change::Reels(reels));
        self.sync(state);
    }

    /// Puts everything as it was at a moment, as part of the command under way.
    pub fn go_to(&mut self, state: &mut State, moment: Moment) {
        self.begin_motion(state);
        let before = state.world.go_to(moment);
        if before.has_paths() {
            self.journal.current.push(Change::World(Edit::Motion(Box::new(before))));
        }
    }

    /// Puts an empty world in the place of the one there is, as part of the command under way.
    pub fn clear(&mut self, state: &mut State) {
        self.end_motion(state);
        self.journal.covered.clear();
        self.edit(state, Edit::Everything(Box::default()));
    }

    /// What running changed so far is kept; what it changes from here on is another matter.
    fn end_motion(&mut self, state: &mut State) {
        if let (Some(place), Some(motion)) = (self.journal.motion.take(), state.world.end_motion())
        {
            state.solver.note_motion(&motion);
            self.journal.current.insert(place, Change::World(Edit::Motion(motion)));
        }
    }

    /// Keeps what the solver remembers from here on, before the command under way has it take in an
    /// edit.
    fn note_memory(&mut self, state: &mut State) {
        if !std::mem::replace(&mut self.journal.has_memory, true) {
            state.solver.begin_recall();
        }
    }

    /// Lets the solver take in what was edited, as part of the command under way.
    pub fn sync(&mut self, state: &mut State) {
        self.note_memory(state);
        state.solver.sync(&mut state.world, &state.preferences.solve);
    }

    /// All that takes back the command under way, in the order it was made.
    fn gather(&mut self, state: &mut State) {
        self.end_motion(state);
        if std::mem::take(&mut self.journal.has_memory)
            && let Some(recall) = state.solver.end_recall(None)
        {
            self.journal.current.push(Change::Memory(Box::new(recall)));
        }
    }

    /// Ends the command under way, whose text is that; whether it changed something. One that left
    /// everything as it was is none to be taken back.
    pub fn commit(
        &mut self,
        state: &mut State,
        label: impl FnOnce() -> String,
        quotas: &Quotas,
    ) -> bool {
        self.gather(state);
        let changes = &self.journal.current;
        // What was changed of a world that is gone is not to be looked for in this one.
        let is_another =
            |it: &Change| matches!(it, Change::World(Edit::Everything(_))) && !state.is_at(it);
        let is_change =
            changes.iter().any(is_another) || !changes.iter().all(|change| state.is_at(change));
        if is_change {
            self.journal.commit(label(), quotas);
        } else {
            self.journal.take_current();
        }
        is_change
    }

    /// Takes back what the command under way did.
    pub fn roll_back(&mut self, state: &mut State) {
        self.last_motion.give_up();
        self.gather(state);
        for change in self.journal.take_current().into_iter().rev() {
            if let Change::Reels(reels) = &change {
                state.recorders.iter().zip(reels).for_each(|(recorder, reel)| recorder.cut(reel));
            }
            state.apply(change);
        }
        state.world.set_handles(self.journal.handles);
    }

    /// A command begins, or goes on that has begun.
    pub fn begin(&mut self, state: &State) {
        if self.journal.is_idle() {
            self.journal.handles = state.world.handles();
        }
    }

    /// Takes back the last command; gives its text, if there was one.
    ///
    /// # Errors
    /// Where the user stopped that: everything is as it was.
    pub fn undo(&mut self, state: &mut State, quotas: &Quotas) -> Result<Option<String>, Stopped> {
        let label = self.step_back(state);
        self.journal.forget_oldest(quotas);
        label
    }

    /// Does the command that was taken back last again; gives its text, if there was one.
    ///
    /// # Errors
    /// Where the user stopped that: everything is as it was.
    pub fn redo(&mut self, state: &mut State, quotas: &Quotas) -> Result<Option<String>, Stopped> {
        let label = self.step_forth(state);
        self.journal.forget_oldest(quotas);
        label
    }

    /// Takes back the last command as if it had never been.
    pub fn revoke(&mut self, state: &mut State) {
        if let Some(mut entry) = self.journal.pop_done() {
            let done = interrupt::undisturbed(|| invert(state, &mut entry, Way::Back));
            debug_assert!(done.is_ok(), "nobody is asked");
        }
    }

    fn step_back(&mut self, state: &mut State) -> Result<Option<String>, Stopped> {
        let Some(mut entry) = self.journal.pop_done() else { return Ok(None) };
        let result = invert(state, &mut entry, Way::Back);
        let label = result.map(|()| Some(entry.label.clone()));
        match label {
            Ok(_) => self.journal.push_undone(entry),
            Err(_) => self.journal.keep(entry),
        }
        label
    }

    fn step_forth(&mut self, state: &mut State) -> Result<Option<String>, Stopped> {
        let Some(mut entry) = self.journal.pop_undone() else { return Ok(None) };
        let result = invert(state, &mut entry, Way::Forth);
        let label = result.map(|()| Some(entry.label.clone()));
        match label {
            Ok(_) => self.journal.keep(entry),
            Err(_) => self.journal.push_undone(entry),
        }
        label
    }

    /// Asks something of the state as it was before a command, or would be once it is the next to be
    /// done again; none where that is forgotten, or a command is under way.
    pub(super) fn before<T>(
        &mut self,
        number: u64,
        state: &mut State,
        ask: impl FnOnce(&State) -> T,
    ) -> Option<T> {
        if !self.journal.current.is_empty() {
            return None;
        }
        let (n_back, n_forth) = self.journal.way_before(number)?;
        interrupt::undisturbed(|| {
            (0..n_back).for_each(|_| drop(self.step_back(state)));
            (0..n_forth).for_each(|_| drop(self.step_forth(state)));
        });
        let answer = ask(state);
        interrupt::undisturbed(|| {
            (0..n_forth).for_each(|_| drop(self.step_back(state)));
            (0..n_back).for_each(|_| drop(self.step_forth(state)));
        });
        Some(answer)
    }
}

/// Whether a command is taken back, or done again.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Way {
    Back,
    Forth,
}

/// What the change of a thing takes, in ticks.
const THING: usize = 200;

/// Takes back one command, or does it again: what it then holds takes that back. Where the user wants to
/// stop before half of it is done, everything is put back as it was; from there on the way to the end is
/// the shorter one.
fn invert(state: &mut State, entry: &mut Entry, way: Way) -> Result<(), Stopped> {
    let before = state.world.handles();
    if way == Way::Forth {
        // Where things move is put back before they are.
        state.world.set_handles(before.max(entry.handles));
    }
    let changes = &mut entry.changes;
    let mut inverse = Vec::with_capacity(changes.len());
    while let Some(change) = changes.pop() {
        let n_things = change.n_things();
        inverse.push(state.apply(change));
        if inverse.len() <= changes.len() && interrupt::is_to_stop(THING * n_things) {
            while let Some(change) = inverse.pop() {
                changes.push(state.apply(change));
            }
            state.world.set_handles(before);
            return Err(Stopped);
        }
    }
    entry.changes = inverse;
    state.world.set_handles(entry.handles);
    entry.handles = before;
    Ok(())
}
