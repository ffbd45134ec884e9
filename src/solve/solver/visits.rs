//! A call of the solver: the islands that it visits, and what that comes to.

use std::collections::BTreeMap;

use super::Solver;
use crate::constraint::Point;
use crate::interrupt;
use crate::solve::dispatch::{Cause, Task, Visit, take_back, turn_back, visit, write_back};
use crate::solve::frame::pull::{Pulled, pull};
use crate::solve::island::Island;
use crate::solve::parallel::{self, Effort, ISLANDS};
use crate::solve::report::{Budget, Counters, Report, Status};
use crate::solve::settings::Settings;
use crate::world::{PointId, World};

/// Islands that are visited side by side before it is asked whether to stop.
const ROUND: usize = 2048;

/// Ticks of an evaluation of a constraint, with the steps that it is for.
const TICKS: usize = 16;

/// An island on its way through a visit.
struct Guest {
    /// Its number.
    k: u32,
    island: Box<Island>,
    /// What the visit came to.
    visit: Option<Visit>,
}

/// Visits islands side by side; gives the work that was.
fn visit_all(guests: &mut [Guest], settings: &Settings, budget: &Budget, task: Task) -> Counters {
    // What stops the work cannot be asked on another core; it is looked after before.
    let (tolerance, known_error) = (budget.tolerance, budget.known_error);
    let each = |guest: &mut Guest| {
        let budget = Budget { tolerance, stop: None, known_error };
        let mut work = Counters::default();
        guest.visit = Some(visit(&mut guest.island, settings, &budget, task, &mut work));
        work
    };
    parallel::map_reduce(guests, ISLANDS, each, Counters::default(), |a, b| a.plus(&b))
}

impl Solver {
    pub(super) fn run(
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
                if let Some(island) = self.partition.get_mut(k) {
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
        if can_share && parallel::pays(&self.effort_of(&due)) {
            self.visit_side_by_side(&due, world, settings, budget, task, &mut report);
        } else {
            for &k in &due {
                self.prepare_visit(world, k);
                if budget.is_spent() {
                    report.is_interrupted = true;
                    self.wake(k);
                } else if let Some(island) = self.partition.get_mut(k) {
                    let visit = visit(island, settings, budget, task, &mut report.counters);
                    self.close(k, &visit, world, &mut report);
                }
            }
        }
        self.delayed.clear();
        due.clear();
        self.due = due;
        world.follow_turns();
        let tolerance = budget.tolerance_of(settings);
        for &violation in self.unsatisfiable.values() {
            let is_met = violation <= tolerance;
            let status = if is_met { Status::Converged } else { Status::Unsatisfiable };
            report.include(status, 0, violation);
        }
        for &k in &self.unsolved {
            if let Some(island) = self.partition.get(k) {
                let is_met = island.residual <= tolerance;
                let status = if is_met { Status::Converged } else { island.status };
                report.include(status, 0, island.residual);
            }
        }
        report
    }

    /// Brings points as near to places as the constraints allow, from a pose that meets them, and
    /// gives the largest residual that leaves. What is not solved stays where it is.
    pub(super) fn pull_islands(
        &mut self,
        world: &mut World,
        settings: &Settings,
        budget: &Budget,
        pulled: &[(PointId, Point)],
    ) -> Report {
        let mut report = Report::default();
        let mut by_island: BTreeMap<u32, Vec<Pulled>> = BTreeMap::new();
        for &(id, to) in pulled {
            match self.partition.island_of_point(id) {
                // Nothing holds it.
                None => world.set_position(id, to),
                Some(k) => {
                    let local = self.partition.get(k).and_then(|island| island.local_point(id));
                    by_island.entry(k).or_default().extend(local.map(|p| (p, to)));
                }
            }
        }
        for (k, pulled) in by_island {
            let Some(island) = self.partition.get_mut(k) else { continue };
            if island.status == Status::Converged {
                self.notes.note(island);
                island.begin_change();
                island.leave_closed_form();
                let limits = island.limits(settings, budget);
                pull(island, &pulled, &limits, &mut report.counters);
                report.include(island.status, 0, island.residual);
                write_back(island, world);
            }
        }
        world.follow_turns();
        report
    }

    /// What visiting these islands was last time.
    fn effort_of(&self, islands: &[u32]) -> Effort {
        let mut effort = Effort::default();
        for of_one in islands.iter().filter_map(|&k| self.efforts.get(k as usize)) {
            effort.n_constraints += of_one.n_constraints;
            effort.n_evaluations += of_one.n_evaluations;
        }
        effort
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
        // Who may stop the work is asked between rounds.
        let n_at_once = if interrupt::is_heard() { ROUND } else { due.len() };
        for due in due.chunks(n_at_once) {
            due.iter().for_each(|&k| self.prepare_visit(world, k));
            let islands = due.iter().filter_map(|&k| Some((k, self.partition.lend(k)?)));
            let mut guests: Vec<Guest> =
                islands.map(|(k, island)| Guest { k, island, visit: None }).collect();
            let work = visit_all(&mut guests, settings, budget, task);
            report.counters.add(&work);
            for Guest { k, island, visit } in guests {
                self.partition.give_back(k, island);
                if let Some(visit) = visit {
                    self.close(k, &visit, world, report);
                }
            }
            interrupt::tick(
                TICKS * usize::try_from(work.evaluations).unwrap_or(usize::MAX / TICKS),
            );
        }
    }

    /// Takes in what a visit came to.
    fn close(&mut self, k: u32, visit: &Visit, world: &mut World, report: &mut Report) {
        if let Some(by_steps) = visit.by_steps {
            self.counts.count(by_steps);
        }
        let (Some(island), Some(mut outcome)) = (self.partition.get_mut(k), visit.outcome) else {
            return;
        };
        if !island.x[..island.n_free].iter().all(|p| p.is_in_reach()) {
            // What has run away to where squares are no numbers meets nothing.
            take_back(island, world);
            outcome.status = Status::Stalled;
        }
        write_back(island, world);
        let is_awake = island.is_awake;
        for (of_island, of_all) in [
            (&mut island.turned_over, &mut report.turned_over),
            (&mut island.chosen, &mut report.chosen),
        ] {
            if let Some(p) = of_island.take() {
                let id = island.points[p as usize];
                *of_all = Some(of_all.map_or(id, |first| first.min(id)));
            }
        }
        report.position_error = report.position_error.max(island.position_error);
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
