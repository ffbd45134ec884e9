//! The solver as the session knows it: a world goes in as it is driven and comes out solved.

mod changes;
mod delayed;
mod rider;
mod stretch;
mod visits;

pub use rider::Stretch;
pub use stretch::Along;

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use super::dispatch::{Cause, Task, check};
use super::island::Island;
use super::island::memory::{self, Memory};
use super::island::partition::{Home, Partition};
use super::island::recall::{Kept, Notes, Recall};
use super::island::snapshot::Snapshot;
use super::parallel::Effort;
use super::report::{Budget, Counters, FrameCounts, Report, Status};
use super::settings::{Method, Settings};
use super::velocity;
use crate::constraint::Point;
use crate::diag::Diagnostic;
use crate::world::{ConstraintId, Motion, PointId, Rates, Touched, World};
use delayed::Delayed;

/// Everything the solver keeps from one call to the next.
#[derive(Default)]
pub struct Solver {
    partition: Partition,
    /// Islands to be visited in the next frame, each once.
    awake: Vec<u32>,
    is_awake: Vec<bool>,
    /// By number of an island, what visiting it was when it was last listed there.
    efforts: Vec<Effort>,
    /// Room for the lists of what changed.
    touched: Option<Box<Touched>>,
    /// Islands of which values or places were changed from outside, while that is taken in.
    edited: Vec<u32>,
    /// What the frame under way changes of islands that are yet to be visited in it.
    delayed: Delayed,
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
    /// What islands yet to be made are to remember, each under its first free point; nothing where
    /// what an island there remembers does not count.
    pending: BTreeMap<PointId, Kept>,
    /// Whether all islands are to be made anew.
    is_stale: bool,
    /// What commands take back.
    notes: Notes,
    /// How frames were found since it was made.
    counts: FrameCounts,
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

    /// How frames were found so far. Nothing takes that back.
    pub fn frame_counts(&self) -> FrameCounts {
        self.counts
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

    /// Solves for a place on the way of a hand: what cannot be met there is met as well as it comes. To
    /// be settled where the way ends.
    pub fn lead(&mut self, world: &mut World, settings: &Settings, budget: &Budget) -> Report {
        self.run(world, settings, budget, Task::Lead)
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
        if pulled.iter().any(|&(p, _)| self.partition.reaches_point(p)) {
            self.lay_apart(&Touched::default(), world, &mut Counters::default());
        }
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
        !self.is_stale
            && self.pending.is_empty()
            && world.is_untouched()
            && self.settings.as_ref() == Some(settings)
    }

    /// All that later results depend on besides the world and the settings.
    pub fn memory(&self) -> Memory {
        let mut memory = Memory::default();
        memory.sign(self.settings.as_ref());
        // What was brought back counts, not what was there before.
        if !self.is_stale {
            for (_, island) in self.partition.iter() {
                if !self.pending.contains_key(&island.points[0]) {
                    memory.insert(island);
                }
            }
        }
        for (first, kept) in &self.pending {
            if let Some(snapshot) = &kept.snapshot {
                memory.put(*first, snapshot.clone());
            }
        }
        memory
    }

    /// Brings back what was remembered, for a world that is as it was then.
    pub fn set_memory(&mut self, memory: Memory) {
        self.note_all();
        self.remember_settings(memory.made_by());
        self.pending.clear();
        let islands = memory.into_islands();
        self.pending.extend(islands.map(|(first, snapshot)| (first, Some(snapshot).into())));
        for &first in self.pending.keys() {
            self.notes.note_as(first, Kept::default());
        }
        self.partition = Partition::default();
        self.forget_lists();
        self.is_stale = true;
    }

    /// Makes everything anew from what is remembered: for who left it half done.
    pub fn begin_anew(&mut self) {
        self.set_memory(self.memory());
    }

    /// Adds a part of what is to be remembered, as [`Memory::to_numbers`] gave it; false if it cannot
    /// be one.
    pub fn restore(&mut self, owner: Option<PointId>, numbers: &[f64]) -> bool {
        let mut memory = Memory::default();
        if !memory.restore(owner, numbers) {
            return false;
        }
        if memory.made_by().is_some() {
            self.remember_settings(memory.made_by());
        }
        for (first, snapshot) in memory.into_islands() {
            self.notes.note_as(first, self.remembered(first).into());
            self.pending.insert(first, Some(snapshot).into());
        }
        true
    }

    fn remember_settings(&mut self, made_by: Option<(Method, f64)>) {
        if let Some((method, tolerance)) = made_by {
            let settings = self.settings.unwrap_or_default();
            self.settings = Some(Settings { method, tolerance, ..settings });
        }
    }

    fn forget_lists(&mut self) {
        self.awake.clear();
        self.is_awake.clear();
        self.edited.clear();
        self.delayed.clear();
        self.missed.clear();
        self.unsolved.clear();
        self.unsatisfiable.clear();
    }

    /// From here on what is remembered of an island is noted before it changes; gives what was noted
    /// for who asked before.
    pub fn begin_recall(&mut self) -> Option<Recall> {
        self.notes.begin(self.settings)
    }

    /// What brings back what was remembered when that was asked for; `outer` goes on.
    pub fn end_recall(&mut self, outer: Option<Recall>) -> Option<Recall> {
        self.notes.end(outer)
    }

    /// A command ends that let time pass: the next one finds where islands were in what this one keeps
    /// of the world.
    pub(crate) fn note_motion(&mut self, motion: &Motion) {
        if let Some(places) = motion.places() {
            self.notes.note_places(places.clone());
        }
    }

    /// Remembers again what was noted; gives what takes this back. The world has to be as it was, or
    /// to become so before the solver is called again.
    pub fn recall(&mut self, then: &Recall) -> Recall {
        let mut islands: Vec<(PointId, Kept)> = then.iter().collect();
        let mut others = Vec::new();
        exchange(&mut self.pending, &mut islands, |k| others.push(k));
        let others = others.into_iter().map(|k| {
            let (first, kept) = &mut islands[k];
            let now = self.remembered_by_island(*first).into();
            (*first, std::mem::replace(kept, now))
        });
        let others: Vec<(PointId, Kept)> = others.collect();
        if self.pending.is_empty() {
            self.pending = others.into_iter().collect();
        } else {
            self.pending.extend(others);
        }
        let settings = std::mem::replace(&mut self.settings, then.settings);
        self.missed.clear();
        Recall::new(islands, settings)
    }

    /// Whether what was noted is what is remembered.
    pub fn is_at(&self, recall: &Recall) -> bool {
        let counts =
            |snapshot: Option<Arc<Snapshot>>| snapshot.filter(|snapshot| !snapshot.is_new());
        recall.iter().all(|(first, then)| counts(self.remembered(first)) == counts(then.snapshot))
    }

    /// What is remembered of the island that begins with a point.
    fn remembered(&self, first: PointId) -> Option<Arc<Snapshot>> {
        let pending = self.pending.get(&first).map(|kept| kept.snapshot.clone());
        pending.unwrap_or_else(|| self.remembered_by_island(first))
    }

    /// The same, where nothing is pending for it.
    fn remembered_by_island(&self, first: PointId) -> Option<Arc<Snapshot>> {
        if self.is_stale {
            return None;
        }
        let island = self.partition.get(self.partition.island_of_point(first)?)?;
        (island.points[0] == first && !island.is_blank).then(|| memory::snapshot_of(island))
    }

    /// All that is remembered is about to change.
    fn note_all(&mut self) {
        if !self.notes.is_on() {
            return;
        }
        self.note_pending();
        if !self.is_stale {
            for (_, island) in self.partition.iter() {
                self.notes.note(island);
            }
        }
    }

    /// What is pending is about to be taken, or given up.
    fn note_pending(&mut self) {
        for (first, kept) in &self.pending {
            self.notes.note_as(*first, kept.clone());
        }
    }

    /// The size of the largest island, length units; 1 if there is none.
    pub fn size(&self, world: &World) -> f64 {
        let apart = self.partition.apart(world);
        let islands = self
            .islands()
            .filter(|island| !island.is_outdated)
            .chain(apart.iter().map(|(_, island)| island));
        islands.map(Island::size).reduce(f64::max).unwrap_or(1.0)
    }

    /// Velocities and accelerations of all points at the present pose, exact where it is a
    /// solution; motors turn, live values change, frozen points stand still.
    ///
    /// # Errors
    /// A live value that has none now.
    pub fn rates(&mut self, world: &mut World, settings: &Settings) -> Result<Rates, Diagnostic> {
        self.sync(world, settings);
        self.lay_apart(&Touched::default(), world, &mut Counters::default());
        velocity::rates(&mut self.partition, world)
    }

    /// How the island of a point ended; none for one that is frozen or on its own.
    pub fn status_of_point(&self, id: PointId) -> Option<Status> {
        Some(self.partition.get(self.partition.island_of_point(id)?)?.status)
    }

    /// How what holds a constraint ended; none for one that is switched off.
    pub fn status_of_constraint(&self, id: ConstraintId) -> Option<Status> {
        match self.partition.home(id) {
            Home::None if self.partition.is_postponed(id) => Some(Status::Converged),
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

/// How many searches in a map take as long as a way through so many of its entries.
const WAY: usize = 16;

/// Exchanges what is filed under the same point in both; tells which places of the list, which is in
/// order, are not in the map.
fn exchange(
    pending: &mut BTreeMap<PointId, Kept>,
    list: &mut [(PointId, Kept)],
    mut missing: impl FnMut(usize),
) {
    if list.len() < pending.len() / WAY {
        for (k, (first, kept)) in list.iter_mut().enumerate() {
            match pending.get_mut(first) {
                Some(there) => std::mem::swap(there, kept),
                None => missing(k),
            }
        }
        return;
    }
    let mut there = pending.iter_mut().peekable();
    for (k, (first, kept)) in list.iter_mut().enumerate() {
        while there.next_if(|(other, _)| **other < *first).is_some() {}
        match there.next_if(|(other, _)| **other == *first) {
            Some((_, there)) => std::mem::swap(there, kept),
            None => missing(k),
        }
    }
}
