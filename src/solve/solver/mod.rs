//! The solver as the session knows it: a world goes in as it is driven and comes out solved.

mod changes;
mod stretch;
mod visits;

pub use stretch::Stretch;

use std::collections::{BTreeMap, BTreeSet};

use super::dispatch::{Cause, Task, check};
use super::island::Island;
use super::island::memory::Memory;
use super::island::partition::{Home, Partition};
use super::report::{Budget, Counters, Report, Status};
use super::settings::{Method, Settings};
use super::velocity;
use crate::constraint::Point;
use crate::diag::Diagnostic;
use crate::world::{ConstraintId, PointId, Rates, Touched, World};

/// Everything the solver keeps from one call to the next.
#[derive(Default)]
pub struct Solver {
    partition: Partition,
    /// Islands to be visited in the next frame, each once.
    awake: Vec<u32>,
    is_awake: Vec<bool>,
    /// Room for the lists of what changed.
    touched: Option<Box<Touched>>,
    /// Room for the list of those that are visited now.
    due: Vec<u32>,
    /// Islands that could follow until the last frame and could not in it.
    missed: Vec<u32>,
    /// Islands that are not at a solution.
    unsolved: BTreeSet<u32>,
    /// Constraints that hold only frozen points and are not satisfied, and how far not.
    unsatisfiable: BTreeMap<ConstraintId, f64>,
    /// The settings of the last call: others may wake every island.
    settings: Option<Settings>,
    /// What islands yet to be made are to remember.
    pending: Memory,
    /// Whether all islands are to be made anew.
    is_stale: bool,
}

impl Solver {
    /// A solver that has seen nothing yet, whatever its world was asked before.
    pub fn new() -> Self {
        Self { is_stale: true, ..Self::default() }
    }

    /// Solves a frame: the world's values are those at its end, its points where they were at
    /// its beginning.
    pub fn frame(&mut self, world: &mut World, settings: &Settings, budget: &Budget) -> Report {
        self.run(world, settings, budget, Task::Frame)
    }

    /// Lets one frame pass: the clock ticks, live values are evaluated, the pose is solved. Points
    /// that a hand drags along in this frame are moved by `hand`, once the solver knows where they
    /// were.
    ///
    /// # Errors
    /// A live expression that has no value at this time or in this pose.
    pub fn step(
        &mut self,
        world: &mut World,
        settings: &Settings,
        budget: &Budget,
        hand: impl FnOnce(&mut World),
    ) -> Result<Report, Diagnostic> {
        self.sync(world, settings);
        hand(world);
        world.advance()?;
        let report = self.frame(world, settings, budget);
        let is_met = report.status == Status::Converged;
        match if is_met { None } else { world.failed_measure() } {
            Some(why) => Err(why),
            None => Ok(report),
        }
    }

    /// Does `n` bare iterations of the chosen method; `auto` means relaxation here.
    pub fn relax(&mut self, world: &mut World, settings: &Settings, n: u64) -> Report {
        let method = match settings.method {
            Method::Auto => Method::Relaxation,
            method => method,
        };
        let mut left = n;
        let mut report = Report::default();
        while left > 0 {
            let iterations = u32::try_from(left).unwrap_or(u32::MAX);
            left -= u64::from(iterations);
            let settings = Settings { method, iterations, ..*settings };
            let counters = report.counters;
            report = self.run(world, &settings, &Budget::default(), Task::Relax);
            report.counters.add(&counters);
        }
        report
    }

    /// Solves until everything holds, or no iteration changes anything any more.
    pub fn settle(&mut self, world: &mut World, settings: &Settings, budget: &Budget) -> Report {
        self.run(world, settings, budget, Task::Settle)
    }

    /// Brings points as near to places as the constraints allow, from a pose that meets them:
    /// nothing is torn, and no time passes.
    ///
    /// # Errors
    /// A live expression that has no value in the new pose.
    pub fn pull(
        &mut self,
        world: &mut World,
        settings: &Settings,
        budget: &Budget,
        pulled: &[(PointId, Point)],
    ) -> Result<Report, Diagnostic> {
        self.sync(world, settings);
        let report = self.pull_islands(world, settings, budget, pulled);
        let is_met = report.status == Status::Converged;
        match if is_met { None } else { world.failed_measure() } {
            Some(why) => Err(why),
            None => Ok(report),
        }
    }

    /// Takes in what the user edited. To be called before the clock goes on and before a point
    /// is dragged along with it, so that a frame knows what it began with.
    pub fn sync(&mut self, world: &mut World, settings: &Settings) {
        // Asked here as well: each frame asks, and few find anything.
        if !self.is_up_to_date(world, settings) {
            self.apply_changes(world, settings, Cause::Hand, &mut Counters::default());
        }
    }

    /// Whether nothing was edited or set since the last call.
    #[inline]
    fn is_up_to_date(&self, world: &World, settings: &Settings) -> bool {
        !self.is_stale && world.is_untouched() && self.settings.as_ref() == Some(settings)
    }

    /// All that later results depend on besides the world and the settings.
    pub fn memory(&self) -> Memory {
        let mut memory = self.pending.clone();
        memory.sign(self.settings.as_ref());
        // What was brought back counts, not what was there before.
        if !self.is_stale {
            for (_, island) in self.partition.iter() {
                memory.insert(island);
            }
        }
        memory
    }

    /// Brings back what was remembered, for a world that is as it was then.
    pub fn set_memory(&mut self, memory: Memory) {
        let settings = match memory.made_by() {
            Some((method, tolerance)) => {
                Some(Settings { method, tolerance, ..self.settings.unwrap_or_default() })
            }
            None => self.settings,
        };
        *self = Self { pending: memory, settings, is_stale: true, ..Self::new() };
    }

    /// The size of the largest island, length units; 1 if there is none.
    pub fn size(&self) -> f64 {
        let sizes = self.partition.iter().map(|(_, island)| island.size());
        sizes.reduce(f64::max).unwrap_or(1.0)
    }

    /// Velocities and accelerations of all points at the present pose, exact where it is a
    /// solution; motors turn, live values change, frozen points stand still.
    ///
    /// # Errors
    /// A live value that has none now.
    pub fn rates(&mut self, world: &mut World, settings: &Settings) -> Result<Rates, Diagnostic> {
        self.sync(world, settings);
        velocity::rates(&mut self.partition, world)
    }

    /// How the island of a point ended; none for one that is frozen or on its own.
    pub fn status_of_point(&self, id: PointId) -> Option<Status> {
        Some(self.partition.get(self.partition.island_of_point(id)?)?.status)
    }

    /// How what holds a constraint ended; none for one that is switched off.
    pub fn status_of_constraint(&self, id: ConstraintId) -> Option<Status> {
        match self.partition.home(id) {
            Home::None => None,
            Home::Island(k) => Some(self.partition.get(k)?.status),
            Home::Checked if self.unsatisfiable.contains_key(&id) => Some(Status::Unsatisfiable),
            Home::Checked => Some(Status::Converged),
        }
    }

    /// How far a constraint is from being satisfied, length units.
    pub fn violation(&self, world: &World, id: ConstraintId) -> f64 {
        world.constraint(id).map_or(0.0, |record| check(world, &record.constraint).violation)
    }

    pub(super) fn missed_islands(&self) -> impl Iterator<Item = &Island> {
        self.missed.iter().filter_map(|&k| self.partition.get(k))
    }

    pub(super) fn islands(&self) -> impl Iterator<Item = &Island> {
        self.partition.iter().map(|(_, island)| island)
    }

    /// The islands that the next frame will visit, as far as the last one tells.
    pub(super) fn awake_islands(&self) -> impl Iterator<Item = &Island> {
        self.awake.iter().filter_map(|&k| self.partition.get(k))
    }

    /// The islands there are, and how many of them the next frame will visit.
    pub fn n_islands(&self) -> (usize, usize) {
        (self.partition.iter().count(), self.awake.len())
    }
}
