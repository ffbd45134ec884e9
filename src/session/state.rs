//! All that commands change and `undo` takes back.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::preferences::Preferences;
use super::results::Results;
use super::series::SeriesList;
use super::undo::recorder::Recorder;
use crate::lang::ast::Definition;
use crate::solve::Solver;
use crate::world::World;

/// A world with all that belongs to it. Whatever changes one of these is a
/// [`Change`](super::undo::journal::Change), or is kept by one that takes it back.
pub struct State {
    /// The mechanism.
    pub world: World,
    /// What solves it, with what that remembers.
    pub solver: Solver,
    /// What `set` sets.
    pub preferences: Preferences,
    /// What `define` defines, by name.
    pub definitions: BTreeMap<Arc<str>, Arc<Definition>>,
    /// Recordings under way.
    pub recorders: Vec<Recorder>,
    /// What `sample` collects.
    pub series: SeriesList,
    /// What `result` said.
    pub results: Results,
    /// Whether what is stated was there before, in a world that `save` wrote: how it stands now is
    /// then no reason to refuse it.
    pub is_restoring: bool,
}

impl State {
    /// An empty world.
    pub fn new() -> Self {
        Self {
            world: World::new(),
            solver: Solver::new(),
            preferences: Preferences::default(),
            definitions: BTreeMap::new(),
            recorders: Vec::new(),
            series: SeriesList::new(),
            results: Results::default(),
            is_restoring: false,
        }
    }
}
