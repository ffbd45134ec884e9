//! What was done, so that it can be undone: every command is one transaction.

use std::collections::{BTreeSet, VecDeque};
use std::sync::Arc;

use super::recorder::{Recorder, Reel};
use super::told::Told;
use crate::lang::ast::Definition;
use crate::session::preferences::Preferences;
use crate::session::quotas::{Quota, Quotas};
use crate::session::results::Results;
use crate::session::series::{SeriesList, n_bytes};
use crate::solve::Recall;
use crate::world::{ConstraintId, Edit, Handles, ParameterId, PointId};

/// One reversible change of a session, small: a loop makes millions. Making it gives the change
/// that takes it back.
#[derive(Debug)]
pub enum Change {
    /// An edit of the world.
    World(Edit),
    /// Sets all settings.
    Preferences(Box<Preferences>),
    /// Sets what a definition is, or that there is none.
    Definition(Box<(Arc<str>, Option<Arc<Definition>>)>),
    /// Sets what the solver remembers of some islands.
    Memory(Box<Recall>),
    /// Begins a recording at a place in the list, or takes it out.
    Recorder(usize, Option<Box<Recorder>>),
    /// Appends a value to a series, or takes the last one away.
    Sample(Box<(Arc<str>, Option<f64>)>),
    /// Sets all series.
    Series(Box<SeriesList>),
    /// Sets what `result` has said.
    Results(Box<Results>),
    /// Sets what the recorders have taken.
    Reels(Box<[Reel]>),
    /// Says whether what is stated was there before.
    Restoring(bool),
}

impl Change {
    /// Roughly how many things it goes through.
    pub fn n_things(&self) -> usize {
        if let Self::World(edit) = self { edit.n_things() } else { 1 }
    }

    /// Roughly how many bytes it holds.
    fn n_bytes(&self) -> usize {
        let inside = match self {
            Self::World(edit) => edit.n_bytes(),
            Self::Preferences(_) => size_of::<Preferences>(),
            // The texts that definitions were read from are kept anyway.
            Self::Definition(_) => size_of::<(Arc<str>, Option<Arc<Definition>>)>(),
            Self::Memory(recall) => recall.n_bytes(),
            Self::Recorder(_, recorder) => recorder.as_ref().map_or(0, |r| r.n_bytes()),
            Self::Sample(sample) => size_of_val(&**sample),
            Self::Series(series) => n_bytes(series),
            Self::Results(results) => results.n_bytes(),
            Self::Reels(reels) => reels.iter().map(Reel::n_bytes).sum(),
            Self::Restoring(_) => 0,
        };
        size_of::<Self>() + inside
    }
}

/// What an edit sets to a value whatever it was before, so that within a command the first
/// inverse takes all of them back.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Part {
    /// Where a point is.
    Position(PointId),
    /// Whether a point is frozen.
    Freedom(PointId),
    /// How a constraint is bound to what it measures.
    Binding(ConstraintId),
    /// The weight of a point.
    Weight(PointId),
    /// A constraint that stays in being.
    Constraint(ConstraintId),
    /// Whether a constraint is on.
    Switch(ConstraintId),
    /// A parameter that stays in being.
    Parameter(ParameterId),
    /// The clock.
    Clock,
}

/// One command that changed something.
#[derive(Debug)]
pub struct Entry {
    /// Counts commands: none has the number of another.
    pub number: u64,
    /// Its text, for telling what was undone.
    pub label: String,
    /// What takes it back, in the order it was made.
    pub changes: Vec<Change>,
    /// What the host's journal was told of it, where that repeats it.
    pub told: Option<Told>,
    /// The handles that are given out once it is taken back, or done again.
    pub handles: Handles,
}

impl Entry {
    fn n_bytes(&self) -> usize {
        // Texts that it read are kept as what errors point into.
        size_of::<Self>()
            + self.label.len()
            + self.changes.iter().map(Change::n_bytes).sum::<usize>()
    }
}

/// The commands done and undone, and the one under way.
#[derive(Debug, Default)]
pub struct Journal {
    /// What takes back the command under way, in the order it was made.
    pub current: Vec<Change>,
    /// Where in `current` what the world notes of running has its place, while it does.
    pub motion: Option<usize>,
    /// Whether the solver notes what it remembered.
    pub has_memory: bool,
    /// The handles that were given out before the command under way.
    pub handles: Handles,
    /// What `current` takes back already; anew once the world notes what running changes.
    pub covered: BTreeSet<Part>,
    /// Each with the bytes it holds.
    done: VecDeque<(Entry, usize)>,
    /// The last of them is done again first.
    undone: VecDeque<(Entry, usize)>,
    /// The bytes of both.
    n_bytes: usize,
    /// Commands that changed something so far.
    n_commands: u64,
}

/// A command of no more changes is taken back from a copy.
const FEW_CHANGES: usize = 16;

impl Journal {
    /// Ends the command under way; what was undone before can no longer be redone.
    pub fn commit(&mut self, label: String, quotas: &Quotas) {
        let changes = self.take_current();
        if !changes.is_empty() {
            self.n_bytes -= self.undone.drain(..).map(|(_, n_bytes)| n_bytes).sum::<usize>();
            let number = self.n_commands;
            self.n_commands += 1;
            let handles = self.handles;
            self.keep(Entry { number, label, changes, told: None, handles });
            self.forget_oldest(quotas);
        }
    }

    /// The texts of the command that would be taken back next, and of the one that would be done again.
    pub fn next_labels(&self) -> [Option<&str>; 2] {
        [&self.done, &self.undone].map(|list| list.back().map(|(entry, _)| &*entry.label))
    }

    /// Whether the command under way has done nothing yet.
    pub fn is_idle(&self) -> bool {
        self.current.is_empty() && self.motion.is_none() && !self.has_memory
    }

    /// What the host's journal was told of the last command done.
    pub fn told_of_last(&mut self) -> Option<&mut Option<Told>> {
        self.done.back_mut().map(|(entry, _)| &mut entry.told)
    }

    /// The same of the one that would be done again next.
    pub fn told_of_next(&self) -> Option<&Told> {
        self.undone.back()?.0.told.as_ref()
    }

    /// The same of the last commands done, the oldest first.
    pub fn told_of_last_ones(&mut self, n: usize) -> impl Iterator<Item = &mut Option<Told>> {
        let first = self.done.len().saturating_sub(n);
        self.done.iter_mut().skip(first).map(|(entry, _)| &mut entry.told)
    }

    /// The number that the command under way will have.
    pub const fn next_number(&self) -> u64 {
        self.n_commands
    }

    /// How many commands are to be taken back, or else to be done again, until a command is the next
    /// one to be done; none where it is forgotten.
    pub fn way_before(&self, number: u64) -> Option<(usize, usize)> {
        let place = |list: &VecDeque<(Entry, usize)>| {
            list.iter().rev().position(|(entry, _)| entry.number == number)
        };
        let back = place(&self.done).map(|n| (n + 1, 0));
        back.or_else(|| Some((0, place(&self.undone)?)))
    }

    /// Ends the command under way without a trace; gives what takes it back, in no more room than it needs.
    pub fn take_current(&mut self) -> Vec<Change> {
        self.covered.clear();
        if self.current.len() <= FEW_CHANGES && self.current.capacity() <= 4 * FEW_CHANGES {
            // The room stays for the next one.
            return self.current.drain(..).collect();
        }
        let mut changes = std::mem::take(&mut self.current);
        changes.shrink_to_fit();
        changes
    }

    /// Keeps a command as the last one done.
    pub fn keep(&mut self, entry: Entry) {
        let n_bytes = entry.n_bytes();
        self.n_bytes += n_bytes;
        self.done.push_back((entry, n_bytes));
    }

    /// Forgets what is farthest from now, where there is more than is kept.
    pub fn forget_oldest(&mut self, quotas: &Quotas) {
        let most_commands = quotas.of(Quota::UndoCommands);
        let most_bytes = quotas.of(Quota::UndoBytes);
        while self.done.len() as u64 > most_commands
            || self.n_bytes as u64 > most_bytes && self.done.len() + self.undone.len() > 1
        {
            let farthest = if self.done.len() >= self.undone.len() {
                self.done.pop_front()
            } else {
                self.undone.pop_front()
            };
            self.n_bytes -= farthest.map_or(0, |(_, n_bytes)| n_bytes);
        }
    }

    /// Roughly how many bytes all of it holds.
    pub const fn n_bytes(&self) -> usize {
        self.n_bytes
    }

    /// The last command done.
    pub fn pop_done(&mut self) -> Option<Entry> {
        let (entry, n_bytes) = self.done.pop_back()?;
        self.n_bytes -= n_bytes;
        Some(entry)
    }

    /// Keeps a command for `redo`.
    pub fn push_undone(&mut self, entry: Entry) {
        let n_bytes = entry.n_bytes();
        self.n_bytes += n_bytes;
        self.undone.push_back((entry, n_bytes));
    }

    /// The last command undone.
    pub fn pop_undone(&mut self) -> Option<Entry> {
        let (entry, n_bytes) = self.undone.pop_back()?;
        self.n_bytes -= n_bytes;
        Some(entry)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn changes_are_small() {
        assert_eq!([size_of::<Edit>(), size_of::<Change>()], [24, 24]);
    }
}
