//! What was done, so that it can be undone: every command is one transaction.

use std::collections::{BTreeSet, VecDeque};
use std::sync::Arc;

use super::recorder::{Recorder, Reel};
use crate::lang::ast::Definition;
use crate::session::preferences::Preferences;
use crate::session::quotas::{UNDO_BYTES, UNDO_COMMANDS};
use crate::session::series::SeriesList;
use crate::solve::Memory;
use crate::world::{ConstraintId, Edit, ParameterId, PointId};

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
    /// Sets what the solver remembers.
    Memory(Arc<Memory>),
    /// Begins a recording at a place in the list, or takes it out.
    Recorder(usize, Option<Box<Recorder>>),
    /// Appends a value to a series, or takes the last one away.
    Sample(Box<(Arc<str>, Option<f64>)>),
    /// Sets all series.
    Series(Box<SeriesList>),
    /// Sets what the recorders have taken.
    Reels(Box<[Reel]>),
    /// Says whether what is stated was there before.
    Restoring(bool),
}

impl Change {
    fn n_bytes(&self) -> usize {
        let inside = match self {
            Self::World(Edit::Motion(motion)) => motion.n_bytes(),
            Self::World(Edit::RestoreBatch(records)) => records.n_bytes(),
            Self::World(Edit::Constraint(_, Some(_))) => size_of::<crate::world::Record>(),
            _ => 0,
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
    /// All that running changes.
    Motion,
}

/// One command that changed something.
#[derive(Debug)]
pub struct Entry {
    /// Its text, for telling what was undone.
    pub label: String,
    /// What takes it back, in the order it was made.
    pub changes: Vec<Change>,
}

/// The commands done and undone, and the one under way.
#[derive(Debug, Default)]
pub struct Journal {
    /// What takes back the command under way, in the order it was made.
    pub current: Vec<Change>,
    /// Whether `current` holds all that running changes already: once is enough.
    pub has_motion: bool,
    /// Whether `current` holds what the solver remembered.
    pub has_memory: bool,
    /// What `current` takes back already; anew once it holds all that running changes.
    pub covered: BTreeSet<Part>,
    /// The last of `done` that the solver has not taken in, so that none of them says what it
    /// remembered before.
    n_unseen: usize,
    done: VecDeque<(Entry, usize)>,
    undone: Vec<Entry>,
    n_bytes: usize,
}

impl Journal {
    /// Ends the command under way; what was undone before can no longer be redone.
    pub fn commit(&mut self, label: &str) {
        let mut changes = self.take_current();
        if !changes.is_empty() {
            self.undone.clear();
            changes.shrink_to_fit();
            self.keep(Entry { label: label.to_owned(), changes });
        }
    }

    /// Whether there are commands that the solver has not taken in.
    pub const fn has_unseen(&self) -> bool {
        self.n_unseen > 0
    }

    /// Adds what brings the solver back to all commands that it is about to take in.
    pub fn see(&mut self, change: impl Fn() -> Change) {
        let n_unseen = std::mem::take(&mut self.n_unseen).min(self.done.len());
        for (entry, _) in self.done.range_mut(self.done.len() - n_unseen..) {
            // A long entry was shrunk to what it holds: it needs no room for more than this.
            entry.changes.reserve_exact(1);
            entry.changes.push(change());
        }
    }

    /// Ends the command under way without a trace; gives what takes it back.
    pub fn take_current(&mut self) -> Vec<Change> {
        self.has_motion = false;
        self.has_memory = false;
        self.covered.clear();
        std::mem::take(&mut self.current)
    }

    /// Keeps a command as the last one done.
    pub fn keep(&mut self, entry: Entry) {
        let is_seen = entry.changes.iter().any(|change| matches!(change, Change::Memory(_)));
        self.n_unseen = if is_seen { 0 } else { self.n_unseen + 1 };
        let n_bytes = entry.changes.iter().map(Change::n_bytes).sum();
        self.n_bytes += n_bytes;
        self.done.push_back((entry, n_bytes));
        while self.done.len() > UNDO_COMMANDS || (self.n_bytes > UNDO_BYTES && self.done.len() > 1)
        {
            if let Some((_, n_bytes)) = self.done.pop_front() {
                self.n_bytes -= n_bytes;
            }
        }
    }

    /// The last command done.
    pub fn pop_done(&mut self) -> Option<Entry> {
        let (entry, n_bytes) = self.done.pop_back()?;
        self.n_unseen = self.n_unseen.saturating_sub(1);
        self.n_bytes -= n_bytes;
        Some(entry)
    }

    /// Keeps a command for `redo`.
    pub fn push_undone(&mut self, entry: Entry) {
        self.undone.push(entry);
    }

    /// The last command undone.
    pub fn pop_undone(&mut self) -> Option<Entry> {
        self.undone.pop()
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
