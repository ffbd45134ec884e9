//! The solver as the session knows it: a world goes in as it is driven and comes out solved.

use std::collections::{BTreeMap, BTreeSet};

use super::dispatch::{Task, Visit, check, turn_back, visit, write_back};
use super::island::Island;
use super::island::partition::{Home, Topology};
use super::island::snapshot::{self, Memory};
use super::parallel::{self, Guest};
use super::report::{Budget, Counters, Report, Status};
use super::settings::{Method, Settings};
use super::velocity;
use crate::constraint::{Point, Vector};
use crate::diag::Diagnostic;
use crate::world::{ConstraintId, PointId, Rates, Touched, World};

/// Rounds until rates and what is measured on them agree. Each gains the digits by which the
/// measured value is the weaker cause.
const MEASURED_ROUNDS: u32 = 8;

/// Everything the solver keeps from one call to the next.
#[derive(Default)]
pub struct Solver {
    topology: Topology,
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

/// What changed the world.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Cause {
    /// Time went on, and what it drives.
    Clock,
    /// The user.
    Hand,
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

    /// Takes in what the user edited. To be called before the clock goes on and before a point
    /// is dragged along with it, so that a frame knows what it began with.
    pub fn sync(&mut self, world: &mut World, settings: &Settings) {
        self.apply_changes(world, settings, Cause::Hand, &mut Counters::default());
    }

    /// All that later results depend on besides the world and the settings.
    pub fn memory(&self) -> Memory {
        let mut memory = self.pending.clone();
        memory.sign(self.settings.as_ref());
        // What was brought back counts, not what was there before.
        if !self.is_stale {
            for (_, island) in self.topology.iter() {
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

    /// Whether what was remembered waits for [`Solver::sync`].
    pub(super) fn is_behind(&self) -> bool {
        self.is_stale
    }

    /// The size of the largest island, length units; 1 if there is none.
    pub fn size(&self) -> f64 {
        let sizes = self.topology.iter().map(|(_, island)| island.size());
        sizes.reduce(f64::max).unwrap_or(1.0)
    }

    /// Velocities and accelerations of all points at the present pose, exact where it is a
    /// solution; motors turn, live values change, frozen points stand still.
    ///
    /// # Errors
    /// A live value that has none now.
    pub fn rates(&mut self, world: &mut World, settings: &Settings) -> Result<Rates, Diagnostic> {
        self.sync(world, settings);
        let n = world.points().column().len();
        let still = || vec![Vector::ZERO; n];
        let mut rates = Rates { velocity: still(), acceleration: still() };
        // What is measured on moving points changes as they move, which moves them.
        let n_rounds = if world.is_mutual() { MEASURED_ROUNDS } else { 1 };
        for _ in 0..n_rounds {
            let mut fields = world.field_rates(&rates)?;
            fields.sort_by_key(|(id, ..)| *id);
            let all: Vec<u32> = self.topology.iter().map(|(k, _)| k).collect();
            for k in all {
                if let Some(island) = self.topology.get_mut(k) {
                    velocity::solve(island, &fields, &mut rates);
                }
            }
        }
        Ok(rates)
    }

    /// How the island of a point ended; none for one that is frozen or on its own.
    pub fn status_of_point(&self, id: PointId) -> Option<Status> {
        Some(self.topology.get(self.topology.island_of_point(id)?)?.status)
    }

    /// How what holds a constraint ended; none for one that is switched off.
    pub fn status_of_constraint(&self, id: ConstraintId) -> Option<Status> {
        match self.topology.home(id) {
            Home::None => None,
            Home::Island(k) => Some(self.topology.get(k)?.status),
            Home::Checked if self.unsatisfiable.contains_key(&id) => Some(Status::Unsatisfiable),
            Home::Checked => Some(Status::Converged),
        }
    }

    /// How far a constraint is from being satisfied, length units.
    pub fn violation(&self, world: &World, id: ConstraintId) -> f64 {
        world.constraint(id).map_or(0.0, |record| check(world, &record.constraint).0)
    }

    pub(super) fn missed_islands(&self) -> impl Iterator<Item = &Island> {
        self.missed.iter().filter_map(|&k| self.topology.get(k))
    }

    pub(super) fn islands(&self) -> impl Iterator<Item = &Island> {
        self.topology.iter().map(|(_, island)| island)
    }

    /// The islands there are, and how many of them the next frame will visit.
    pub fn n_islands(&self) -> (usize, usize) {
        (self.topology.iter().count(), self.awake.len())
    }

    fn run(
        &mut self,
        world: &mut World,
        settings: &Settings,
        budget: &Budget,
        task: Task,
    ) -> Report {
        let mut report = Report::default();
        let cause = if task == Task::Frame { Cause::Clock } else { Cause::Hand };
        let made = self.apply_changes(world, settings, cause, &mut report.counters);
        if task == Task::Frame {
            for &k in &made {
                if let Some(island) = self.topology.get_mut(k) {
                    turn_back(island, world.clock().dt);
                }
            }
        }
        if task == Task::Settle
            && let Some(tolerance) = budget.tolerance
        {
            self.invalidate(|island| island.residual > tolerance);
        }
        self.missed.clear();
        let mut due = std::mem::take(&mut self.due);
        std::mem::swap(&mut due, &mut self.awake);
        for &k in &due {
            self.is_awake[k as usize] = false;
        }
        let can_share = budget.stop.is_none() && due.len() > 1;
        if can_share && parallel::pays(&self.topology.effort_of(&due)) {
            self.visit_side_by_side(&due, world, settings, budget, task, &mut report);
        } else {
            for &k in &due {
                if budget.is_spent() {
                    report.is_interrupted = true;
                    self.wake(k);
                } else if let Some(island) = self.topology.get_mut(k) {
                    let visit = visit(island, settings, budget, task, &mut report.counters);
                    self.close(k, &visit, world, &mut report);
                }
            }
        }
        due.clear();
        self.due = due;
        let tolerance = budget.tolerance.unwrap_or(settings.tolerance);
        for &violation in self.unsatisfiable.values() {
            let is_met = violation <= tolerance;
            let status = if is_met { Status::Converged } else { Status::Unsatisfiable };
            report.include(status, 0, violation);
        }
        for &k in &self.unsolved {
            if let Some(island) = self.topology.get(k) {
                let is_met = island.residual <= tolerance;
                let status = if is_met { Status::Converged } else { island.status };
                report.include(status, 0, island.residual);
            }
        }
        report
    }

    /// Brings the islands up to date with what changed in the world; gives the new ones.
    fn apply_changes(
        &mut self,
        world: &mut World,
        settings: &Settings,
        cause: Cause,
        work: &mut Counters,
    ) -> Vec<u32> {
        if !self.is_stale && world.is_untouched() && self.settings.as_ref() == Some(settings) {
            return Vec::new();
        }
        let before = self.settings.replace(*settings);
        let is_doubtful = before.is_some_and(|before| {
            (before.method, before.tolerance) != (settings.method, settings.tolerance)
        });
        if is_doubtful {
            self.invalidate(|_| true);
        }
        let mut touched = world.take_touched(self.touched.take().unwrap_or_default());
        if std::mem::take(&mut self.is_stale) {
            // What is remembered is what counts: forget the rest.
            self.topology = Topology::default();
            *touched = Touched::everything();
        }
        if !touched.constraints.is_empty() {
            // A constraint that was changed but holds as many equations on the same points as
            // before leaves its island as it is.
            let (values, others): (Vec<_>, Vec<_>) =
                touched.constraints.iter().partition(|&&id| self.is_same_but_for_values(world, id));
            touched.values.extend(values);
            touched.constraints = others;
        }
        let is_changed = !touched.is_empty();
        let mut made = Vec::new();
        if touched.all || !touched.points.is_empty() || !touched.constraints.is_empty() {
            made = self.topology.update(&touched, world, &mut self.pending);
            work.islands_rebuilt += made.len() as u64;
            for &k in &made {
                self.restore_island(k);
            }
            self.pending = Memory::default();
            if touched.all {
                self.awake.clear();
                self.is_awake.fill(false);
            }
            for &k in &made {
                // One that was asleep when it was remembered sleeps on.
                if self.topology.get(k).is_some_and(|island| island.is_awake) {
                    self.wake(k);
                }
            }
            if is_doubtful {
                // What was brought back is as doubtful as what was there.
                self.invalidate(|_| true);
            }
            let topology = &self.topology;
            // An island that takes the place of one that was awake is to be woken again.
            let is_awake = &mut self.is_awake;
            self.awake.retain(|&k| {
                is_awake[k as usize] = topology.get(k).is_some();
                is_awake[k as usize]
            });
            self.unsolved.retain(|&k| topology.get(k).is_some());
            self.unsatisfiable.clear();
            let checked: Vec<ConstraintId> = topology.checked().collect();
            for id in checked {
                self.check(world, id, settings);
            }
        }
        for &id in &touched.values {
            match self.topology.home(id) {
                Home::None => {}
                Home::Checked => self.check(world, id, settings),
                Home::Island(k) => self.apply_values(world, k, id),
            }
        }
        for &p in &touched.moved {
            self.apply_move(world, p, settings);
        }
        if cause == Cause::Hand && is_changed {
            for k in self.awake.clone() {
                if let Some(island) = self.topology.get_mut(k)
                    && !island.inputs.is_empty()
                {
                    island.note_edit(island.inputs.is_disturbed);
                }
            }
        }
        // What makes islands may have touched everything: that much room is not needed again.
        self.touched = made.is_empty().then_some(touched);
        made
    }

    /// Gives a new island the memory that waits for it.
    fn restore_island(&mut self, k: u32) {
        let Some(island) = self.topology.get_mut(k) else { return };
        if let Some(remembered) = self.pending.take(island) {
            snapshot::restore(island, &remembered);
            if island.status != Status::Converged {
                self.unsolved.insert(k);
            }
        }
    }

    /// What counted as solved may not any more.
    fn invalidate(&mut self, is_doubtful: impl Fn(&Island) -> bool) {
        let all: Vec<u32> = self.topology.iter().map(|(k, _)| k).collect();
        for k in all {
            if let Some(island) = self.topology.get_mut(k)
                && is_doubtful(island)
            {
                island.status = Status::Stalled;
                island.remembered.take();
                self.wake(k);
            }
        }
    }

    fn is_same_but_for_values(&self, world: &World, id: ConstraintId) -> bool {
        let Some(record) = world.constraint(id).filter(|record| record.is_on) else {
            return false;
        };
        let Home::Island(k) = self.topology.home(id) else { return false };
        let c = self.topology.local_constraint(id);
        self.topology.get(k).is_some_and(|island| island.has_same(c, record))
    }

    fn apply_values(&mut self, world: &World, k: u32, id: ConstraintId) {
        let c = self.topology.local_constraint(id);
        if let (Some(island), Some(record)) = (self.topology.get_mut(k), world.constraint(id)) {
            island.set_values(c, &record.constraint);
            self.wake(k);
        }
    }

    fn apply_move(&mut self, world: &World, p: PointId, settings: &Settings) {
        if p.idx() >= world.points().column().len() || !world.points().is_alive(p) {
            return;
        }
        let at = world.points().at(p);
        if let Some(k) = self.topology.island_of_point(p) {
            self.put_point(k, p, at);
        }
        let holders: Vec<ConstraintId> = self.topology.holders(p, world).collect();
        for id in holders {
            match self.topology.home(id) {
                Home::None => {}
                Home::Checked => self.check(world, id, settings),
                Home::Island(k) => self.put_point(k, p, at),
            }
        }
    }

    fn put_point(&mut self, k: u32, p: PointId, at: Point) {
        if let Some(island) = self.topology.get_mut(k)
            && let Some(p) = island.local_point(p)
            && island.x[p] != at
        {
            island.set_point(p, at);
            self.wake(k);
        }
    }

    fn wake(&mut self, k: u32) {
        let at = k as usize;
        if at >= self.is_awake.len() {
            self.is_awake.resize(at + 1, false);
        }
        if !std::mem::replace(&mut self.is_awake[at], true) {
            self.awake.push(k);
            if let Some(island) = self.topology.get_mut(k) {
                island.is_awake = true;
            }
        }
    }

    /// Notes whether a constraint between frozen points holds.
    fn check(&mut self, world: &World, id: ConstraintId, settings: &Settings) {
        self.unsatisfiable.remove(&id);
        if let Some(record) = world.constraint(id) {
            let (violation, size) = check(world, &record.constraint);
            if violation > settings.tolerance * size {
                self.unsatisfiable.insert(id, violation / size);
            }
        }
    }

    /// Visits islands on all cores, and takes in what that came to in their order.
    fn visit_side_by_side(
        &mut self,
        due: &[u32],
        world: &mut World,
        settings: &Settings,
        budget: &Budget,
        task: Task,
        report: &mut Report,
    ) {
        let islands = due.iter().filter_map(|&k| Some((k, self.topology.lend(k)?)));
        let mut guests: Vec<Guest> =
            islands.map(|(k, island)| Guest { k, island, visit: None }).collect();
        let work = parallel::visit_all(&mut guests, settings, budget.tolerance, task);
        report.counters.add(&work);
        for Guest { k, island, visit } in guests {
            self.topology.give_back(k, island);
            if let Some(visit) = visit {
                self.close(k, &visit, world, report);
            }
        }
    }

    /// Takes in what a visit came to.
    fn close(&mut self, k: u32, visit: &Visit, world: &mut World, report: &mut Report) {
        let (Some(island), Some(outcome)) = (self.topology.get_mut(k), visit.outcome) else {
            return;
        };
        write_back(island, world);
        let is_awake = island.is_awake;
        if let Some(p) = island.turned_over.take() {
            let id = island.points[p as usize];
            report.turned_over = Some(report.turned_over.map_or(id, |first| first.min(id)));
        }
        if island.before.is_some() {
            self.missed.push(k);
        }
        if outcome.is_converged() {
            if !self.unsolved.is_empty() {
                self.unsolved.remove(&k);
            }
            let residual = outcome.worst / visit.size;
            report.include(Status::Converged, outcome.n_iterations.into(), residual);
        } else {
            self.unsolved.insert(k);
            report.iterations = report.iterations.max(outcome.n_iterations.into());
        }
        report.lowered_rho = match (report.lowered_rho, visit.lowered) {
            (Some(a), Some(b)) => Some(a.min(b)),
            (a, b) => a.or(b),
        };
        if is_awake {
            self.wake(k);
        }
    }
}
