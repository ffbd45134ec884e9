//! What changed in a world since the solver saw it last, island by island.

use super::Solver;
use crate::constraint::Point;
use crate::interrupt::tick;
use crate::solve::dispatch::{Alone, Cause, check};
use crate::solve::island::Island;
use crate::solve::island::memory;
use crate::solve::island::partition::{Home, Partition};
use crate::solve::island::recall::Kept;
use crate::solve::parallel::Effort;
use crate::solve::report::{Counters, Status};
use crate::solve::settings::Settings;
use crate::world::{ConstraintId, PointId, Touched, World, same_place};

/// What looking whether a constraint holds takes, in ticks.
const CONSTRAINT: usize = 100;

impl Solver {
    /// Brings the islands up to date with what changed in the world; gives the new ones.
    pub(super) fn apply_changes(
        &mut self,
        world: &mut World,
        settings: &Settings,
        cause: Cause,
        work: &mut Counters,
    ) -> Vec<u32> {
        if self.is_up_to_date(world, settings) {
            return Vec::new();
        }
        self.note_pending();
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
            self.partition = Partition::default();
            *touched = Touched::everything();
        }
        if !touched.all && !self.pending.is_empty() {
            self.lay_apart(&touched, world, work);
        }
        if !touched.constraints.is_empty() {
            // A constraint that was changed but holds as many equations on the same points as
            // before leaves its island as it is.
            let (values, others): (Vec<_>, Vec<_>) =
                touched.constraints.iter().partition(|&&id| self.is_same_but_for_values(world, id));
            touched.values.extend(values);
            touched.constraints = others;
        }
        if !touched.all {
            if self.pending.is_empty() {
                self.postpone(&mut touched, world);
            }
            if self.partition.is_reached(&touched, world) {
                self.lay_apart(&touched, world, work);
            }
        }
        let mut made = Vec::new();
        let is_outdated = !self.pending.is_empty();
        if touched.all
            || is_outdated
            || !touched.points.is_empty()
            || !touched.constraints.is_empty()
        {
            made = self.make_islands(&touched, world, work);
            work.islands_rebuilt += made.len() as u64;
            if is_doubtful {
                // What was brought back is as doubtful as what was there.
                self.invalidate(|_| true);
            }
            let partition = &self.partition;
            self.unsatisfiable.clear();
            let checked: Vec<ConstraintId> = partition.checked().collect();
            for id in checked {
                self.check(world, id, settings);
            }
        }
        for &id in &touched.values {
            match self.partition.home(id) {
                Home::None => {}
                Home::Checked => self.check(world, id, settings),
                // One that sleeps is woken if the values are others.
                Home::Island(k) if cause == Cause::Clock && self.is_awake(k) => {
                    self.delayed.push(k, (id, self.partition.local_constraint(id)));
                }
                Home::Island(k) => self.apply_values(world, k, id),
            }
        }
        for &p in &touched.moved {
            self.apply_move(world, p, settings);
        }
        while let Some(k) = self.edited.pop() {
            if cause == Cause::Hand
                && let Some(island) = self.partition.get_mut(k)
                && !island.inputs.is_empty()
            {
                island.note_edit(island.inputs.is_disturbed);
                if island.is_new && self.rest(k, work) {
                    self.awake.retain(|&other| other != k);
                    self.is_awake[k as usize] = false;
                }
            }
        }
        // What makes islands may have touched everything: that much room is not needed again.
        self.touched = made.is_empty().then_some(touched);
        made
    }

    /// Makes the islands anew that were touched, or that are to remember something else; gives them.
    fn make_islands(&mut self, touched: &Touched, world: &World, work: &mut Counters) -> Vec<u32> {
        let outdated: Vec<PointId> = self.pending.keys().copied().collect();
        let Self { partition, pending, notes, .. } = self;
        let made = partition.update(touched, &outdated, world, &mut |island| {
            let is_remembered = !island.is_new && !island.is_blank;
            notes.note(island);
            pending
                .entry(island.points[0])
                .or_insert_with(|| is_remembered.then(|| memory::snapshot_of(island)).into());
        });
        for &k in &made {
            self.is_awake.resize(self.is_awake.len().max(k as usize + 1), false);
            self.is_awake[k as usize] = false;
            self.unsolved.remove(&k);
            self.restore_island(k, work);
        }
        self.pending.clear();
        let (partition, is_awake) = (&self.partition, &mut self.is_awake);
        self.awake.retain(|&k| {
            is_awake[k as usize] &= partition.get(k).is_some();
            is_awake[k as usize]
        });
        self.unsolved.retain(|&k| partition.get(k).is_some());
        for &k in &made {
            // One that was asleep when it was remembered sleeps on.
            if self.partition.get(k).is_some_and(|island| island.is_awake) {
                self.wake(k);
            }
        }
        made
    }

    /// Leaves for later what edits of islands at rest come to.
    fn postpone(&mut self, touched: &mut Touched, world: &World) {
        let Self { partition, notes, is_awake, .. } = self;
        let can_sleep = |k: u32| !is_awake.get(k as usize).is_some_and(|is_awake| *is_awake);
        partition.postpone(touched, world, &can_sleep, &mut |island| notes.note(island));
    }

    /// Puts together what was left for later, as it was before these changes.
    pub(super) fn lay_apart(&mut self, touched: &Touched, world: &World, work: &mut Counters) {
        if self.partition.is_laid_apart() {
            return;
        }
        for k in self.partition.lay_apart(touched, world) {
            work.islands_rebuilt += 1;
            if let Some(island) = self.partition.get_mut(k) {
                island.rest();
            }
        }
    }

    /// Gives a new island the memory that waits for it. One without is at rest where everything holds.
    fn restore_island(&mut self, k: u32, work: &mut Counters) {
        let Some(island) = self.partition.get_mut(k) else { return };
        let first = island.points[0];
        let remembered = self.pending.remove(&first).and_then(|kept| kept.snapshot);
        // What was remembered under this point before is noted already.
        self.notes.note_as(first, Kept::default());
        if let Some(remembered) = remembered {
            memory::restore(island, &remembered);
        }
        if island.is_new && island.inputs.is_empty() {
            self.rest(k, work);
        } else if !island.is_new && island.status != Status::Converged {
            self.unsolved.insert(k);
        }
    }

    /// Leaves an island that was never solved as it is, if everything holds there.
    fn rest(&mut self, k: u32, work: &mut Counters) -> bool {
        let Some(island) = self.partition.get_mut(k) else { return false };
        work.evaluations += island.constraints.len() as u64;
        tick(CONSTRAINT * island.constraints.len());
        let holds = island.holds();
        if holds {
            island.rest();
        }
        holds
    }

    /// What counted as solved may not any more.
    pub(super) fn invalidate(&mut self, is_doubtful: impl Fn(&Island) -> bool) {
        let all: Vec<u32> = self.partition.iter().map(|(k, _)| k).collect();
        for k in all {
            // What holds as exactly as can be told does so whatever is asked for.
            if let Some(island) = self.partition.get_mut(k)
                && !island.is_blank
                && is_doubtful(island)
            {
                self.notes.note(island);
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
        let Home::Island(k) = self.partition.home(id) else { return false };
        let c = self.partition.local_constraint(id);
        self.partition.get(k).is_some_and(|island| island.has_same(c, record))
    }

    fn apply_values(&mut self, world: &World, k: u32, id: ConstraintId) {
        let c = self.partition.local_constraint(id);
        if let (Some(island), Some(record)) = (self.partition.get_mut(k), world.constraint(id)) {
            self.notes.note_visit(island, world);
            if island.set_values(c, &record.constraint) {
                self.wake(k);
                self.edited.push(k);
            }
        }
    }

    /// An island is about to be visited: it takes in what the frame changes of it.
    pub(super) fn prepare_visit(&mut self, world: &World, k: u32) {
        let Self { partition, notes, delayed, .. } = self;
        let Some(island) = partition.get_mut(k) else { return };
        if notes.is_on() {
            notes.note_visit(island, world);
        }
        while let Some((id, c)) = delayed.pop(k) {
            if let Some(record) = world.constraint(id) {
                island.set_values(c, &record.constraint);
            }
        }
    }

    fn is_awake(&self, k: u32) -> bool {
        self.is_awake.get(k as usize).copied().unwrap_or(false)
    }

    fn apply_move(&mut self, world: &World, p: PointId, settings: &Settings) {
        if p.idx() >= world.points().column().len() || !world.points().is_alive(p) {
            return;
        }
        let at = world.points().at(p);
        if let Some(k) = self.partition.island_of_point(p) {
            self.put_point(k, p, at);
        }
        let holders: Vec<ConstraintId> = self.partition.holders(p, world).collect();
        for id in holders {
            match self.partition.home(id) {
                Home::None => {}
                Home::Checked => self.check(world, id, settings),
                Home::Island(k) => self.put_point(k, p, at),
            }
        }
    }

    fn put_point(&mut self, k: u32, p: PointId, at: Point) {
        if let Some(island) = self.partition.get_mut(k)
            && let Some(p) = island.local_point(p)
            && !same_place(&island.x[p], &at)
        {
            self.notes.note(island);
            island.set_point(p, at);
            self.wake(k);
            self.edited.push(k);
        }
    }

    pub(super) fn wake(&mut self, k: u32) {
        let at = k as usize;
        if at >= self.is_awake.len() {
            self.is_awake.resize(at + 1, false);
        }
        if !std::mem::replace(&mut self.is_awake[at], true) {
            self.awake.push(k);
            if at >= self.efforts.len() {
                self.efforts.resize(at + 1, Effort::default());
            }
            if let Some(island) = self.partition.get_mut(k) {
                island.is_awake = true;
                self.efforts[at] = Effort {
                    n_constraints: island.constraints.len() as u64,
                    n_evaluations: island.n_evaluations.into(),
                };
            }
        }
    }

    /// Notes whether a constraint between frozen points holds.
    pub(super) fn check(&mut self, world: &World, id: ConstraintId, settings: &Settings) {
        self.unsatisfiable.remove(&id);
        if let Some(record) = world.constraint(id) {
            let Alone { violation, size, rounding } = check(world, &record.constraint);
            if violation > (settings.tolerance * size).max(rounding) {
                self.unsatisfiable.insert(id, violation / size);
            }
        }
    }
}
