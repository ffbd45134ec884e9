//! Edits of islands at rest that nobody has asked about yet.
//!
//! Where everything holds, before an edit and after it, nothing has to be solved, and an island need not
//! be put together anew before it has something to do again. Until then it stays as it was, and stands for
//! all that it falls apart into, or grows together with.

use std::collections::BTreeSet;

use super::Island;
use super::partition::{Home, NONE, Partition, Postponed, Was};
use super::rest::{holds, is_passive, is_plain};
use crate::constraint::{Constraint, ConstraintKind};
use crate::world::{ConstraintId, PointId, Touched, World};

impl Partition {
    /// Whether every island is what its constraints make it.
    pub fn is_laid_apart(&self) -> bool {
        self.postponed.constraints.is_empty() && self.postponed.points.is_empty()
    }

    /// Whether a constraint was put in where it holds, and is in no island yet.
    pub fn is_postponed(&self, id: ConstraintId) -> bool {
        self.postponed.constraints.get(&id).is_some_and(Option::is_some)
    }

    /// Takes those edits out of the lists that can wait: all they reach is at rest, holds as it is, and
    /// was not changed otherwise. `can_sleep` says of an island that nobody waits for it; those of which
    /// something was remembered are shown to `leave` before that is given up.
    pub fn postpone(
        &mut self,
        touched: &mut Touched,
        world: &World,
        can_sleep: &dyn Fn(u32) -> bool,
        leave: &mut dyn FnMut(&Island),
    ) {
        if touched.constraints.is_empty() && touched.points.is_empty() {
            return;
        }
        let is_one_way = self.is_one_way(touched, world);
        let busy = self.changed_otherwise(touched, world);
        let moved: BTreeSet<PointId> = touched.moved.iter().copied().collect();
        let mut wait = |partition: &mut Self, reached: Option<Vec<u32>>| {
            let Some(mut reached) = reached else { return false };
            reached.sort_unstable();
            reached.dedup();
            let can_wait = |&k: &u32| {
                let is_busy = |it: &Island| !it.inputs.is_empty() || busy.contains(&k);
                let island = partition.get(k).filter(|island| !is_busy(island));
                let may_rest =
                    |it: &Island| is_one_way && can_sleep(k) && it.is_met() && it.holds();
                island.is_some_and(|island| island.is_blank || may_rest(island))
            };
            if !reached.iter().all(can_wait) {
                return false;
            }
            for k in reached {
                partition.outdate(k, leave);
            }
            true
        };
        touched.constraints.retain(|&id| {
            let reached = self.reached_by_constraint(id, &moved, world);
            let first = reached.as_ref().and_then(|reached| reached.first().copied());
            let waits = wait(self, reached);
            if let Some(first) = first.filter(|_| waits) {
                self.postpone_constraint(id, first, world);
            }
            !waits
        });
        touched.points.retain(|&p| {
            let reached = self.reached_by_point(p, world);
            let first = reached.as_ref().and_then(|reached| reached.first().copied());
            let waits = wait(self, reached);
            if let Some(first) = first.filter(|_| waits) {
                self.postpone_point(p, first, world);
            }
            !waits
        });
    }

    /// The islands in which values were changed, or points put elsewhere.
    fn changed_otherwise(&self, touched: &Touched, world: &World) -> BTreeSet<u32> {
        let home = |id: ConstraintId| match self.home(id) {
            Home::Island(k) => Some(k),
            Home::None | Home::Checked => None,
        };
        let of_values = touched.values.iter().filter_map(|&id| home(id));
        let of_points = touched.moved.iter().flat_map(|&p| {
            self.island_of_point(p).into_iter().chain(self.holders(p, world).filter_map(home))
        });
        of_values.chain(of_points).collect()
    }

    /// Whether all of this puts something in, or takes something out. Where that is so no island is
    /// built on the same as before, and what was remembered of it would be of no use.
    fn is_one_way(&self, touched: &Touched, world: &World) -> bool {
        let is_on = |id| world.constraint(id).is_some_and(|record| record.is_on);
        let points = world.points();
        let moves = |p| points.is_alive(p) && !points.is_frozen(p);
        let constraints =
            touched.constraints.iter().map(|&id| (self.home(id) != Home::None, is_on(id)));
        let points = touched.points.iter().map(|&p| (self.island_of_point(p).is_some(), moves(p)));
        let (mut takes_out, mut puts_in) = (false, false);
        for (was_there, is_there) in constraints.chain(points) {
            takes_out |= was_there;
            puts_in |= is_there;
        }
        takes_out != puts_in
    }

    /// The islands that the edit of a constraint reaches; none where it cannot wait.
    fn reached_by_constraint(
        &self,
        id: ConstraintId,
        moved: &BTreeSet<PointId>,
        world: &World,
    ) -> Option<Vec<u32>> {
        let mut reached = match self.home(id) {
            Home::Checked => return None,
            Home::None => Vec::new(),
            Home::Island(k) => vec![k],
        };
        if let Some(record) = world.constraint(id).filter(|record| record.is_on) {
            let (constraint, points) = (&record.constraint, world.points());
            let x = points.column();
            let may_wait =
                constraint.n_rows() > 0 && is_passive(constraint) && holds(constraint, x);
            let is_moved = constraint.points().iter().any(|&p| moved.contains(&PointId(p)));
            let mut held = constraint.points().iter().map(|&p| points.inverse_mass(PointId(p)));
            if !may_wait || is_moved || held.clone().all(|w| w == 0.0) || !held.all(is_plain) {
                return None;
            }
            let islands =
                constraint.points().iter().filter_map(|&p| self.island_of_point(PointId(p)));
            reached.extend(islands);
            if reached.is_empty() {
                // It is an island of its own.
                return None;
            }
        } else if reached.is_empty() {
            // Those that it was to join.
            let held = self.postponed.constraints.get(&id).and_then(Option::as_ref);
            let points = held.into_iter().flat_map(Constraint::points);
            reached.extend(points.filter_map(|&p| self.island_of_point(PointId(p))));
        }
        Some(reached)
    }

    /// The islands that the edit of a point reaches: it was made, deleted, frozen, thawed or given
    /// another weight; none where it cannot wait.
    fn reached_by_point(&self, p: PointId, world: &World) -> Option<Vec<u32>> {
        let points = world.points();
        if points.is_alive(p) && !is_plain(points.inverse_mass(p)) {
            return None;
        }
        let mut reached: Vec<u32> = self.island_of_point(p).into_iter().collect();
        for id in self.holders(p, world) {
            match self.home(id) {
                Home::None => {}
                Home::Checked => return None,
                Home::Island(k) => reached.push(k),
            }
        }
        let joined = self.postponed.points.contains_key(&p).then_some(&self.postponed.islands);
        reached.extend(joined.into_iter().flatten());
        Some(reached)
    }

    /// From here on an island stands for what was edited.
    fn outdate(&mut self, k: u32, leave: &mut dyn FnMut(&Island)) {
        let Some(island) = self.get_mut(k) else { return };
        if !island.is_blank {
            leave(island);
            island.rest();
        }
        if !std::mem::replace(&mut island.is_outdated, true) {
            self.postponed.islands.push(k);
        }
    }

    fn postpone_constraint(&mut self, id: ConstraintId, k: u32, world: &World) {
        self.make_room(world);
        self.set_home(id, NONE);
        let record = world.constraint(id).filter(|record| record.is_on);
        for &p in record.into_iter().flat_map(|record| record.constraint.points()) {
            self.postpone_point(PointId(p), k, world);
        }
        self.postponed.constraints.insert(id, record.map(|record| record.constraint.clone()));
    }

    fn postpone_point(&mut self, p: PointId, k: u32, world: &World) {
        self.make_room(world);
        if !world.points().is_alive(p) {
            return;
        }
        self.postponed.points.insert(p, world.points().at(p));
        if !world.points().is_frozen(p) && self.island_of_point(p).is_none() {
            self.set_island_of_point(p, k);
        }
    }

    /// Whether any of this is about what was postponed.
    pub fn is_reached(&self, touched: &Touched, world: &World) -> bool {
        if self.is_laid_apart() {
            return false;
        }
        let reaches_home = |id: ConstraintId| match self.home(id) {
            Home::Island(k) => self.is_outdated(k),
            Home::None | Home::Checked => self.postponed.constraints.contains_key(&id),
        };
        let reaches =
            |p: PointId| self.reaches_point(p) || self.holders(p, world).any(reaches_home);
        let reaches_constraint = |id: ConstraintId| {
            let points = world.constraint(id).map(|record| record.constraint.points());
            let mut points = points.into_iter().flatten();
            reaches_home(id) || points.any(|&p| self.reaches_point(PointId(p)))
        };
        touched.values.iter().any(|&id| reaches_home(id))
            || touched.constraints.iter().any(|&id| reaches_constraint(id))
            || touched.points.iter().chain(&touched.moved).any(|&p| reaches(p))
    }

    /// Whether what was postponed is about this point.
    pub fn reaches_point(&self, p: PointId) -> bool {
        self.postponed.points.contains_key(&p)
            || self.island_of_point(p).is_some_and(|k| self.is_outdated(k))
    }

    fn is_outdated(&self, k: u32) -> bool {
        self.get(k).is_some_and(|island| island.is_outdated)
    }

    /// Puts together what was postponed, as it was before these changes; gives the new islands.
    pub fn lay_apart(&mut self, touched: &Touched, world: &World) -> Vec<u32> {
        let was = self.before(touched);
        let Postponed { constraints, points, islands } = std::mem::take(&mut self.postponed);
        let mut loose: Vec<ConstraintId> = constraints.into_keys().collect();
        for k in islands {
            self.dissolve(k, &mut loose, &mut |_| {});
        }
        for p in points.into_keys() {
            self.set_island_of_point(p, NONE);
        }
        // What is being edited joins in after that.
        let mut edited = touched.constraints.clone();
        edited.sort_unstable();
        loose.retain(|id| edited.binary_search(id).is_err());
        self.assemble(loose, world, &was)
    }

    /// What was postponed, put together by itself, as it was before the changes that the solver has not
    /// seen.
    pub fn apart(&self, world: &World) -> Self {
        let mut apart = Self::default();
        if !self.is_laid_apart() {
            let touched = world.touched();
            let outdated = self.postponed.islands.iter().filter_map(|&k| self.get(k));
            let loose = outdated.flat_map(|island| &island.ids);
            let loose = loose.chain(self.postponed.constraints.keys());
            let loose = loose.filter(|id| !touched.constraints.contains(id)).copied().collect();
            apart.make_room(world);
            apart.assemble(loose, world, &self.before(touched));
            apart.islands_mut().for_each(Island::rest);
        }
        apart
    }

    /// What of the islands that were postponed is in the world as it is after these changes.
    fn before(&self, touched: &Touched) -> Was {
        let mut was = Was::default();
        let outdated = || self.postponed.islands.iter().filter_map(|&k| self.get(k));
        for &id in &touched.values {
            let constraint = match (self.postponed.constraints.get(&id), self.home(id)) {
                (Some(constraint), _) => constraint.clone(),
                (None, Home::Island(k)) if self.is_outdated(k) => self
                    .get(k)
                    .map(|island| island.constraint_over_handles(self.local_constraint(id))),
                _ => None,
            };
            was.constraints.extend(constraint.map(|constraint| (id, constraint)));
        }
        for &p in &touched.moved {
            let at = self.postponed.points.get(&p).copied();
            let at =
                at.or_else(|| outdated().find_map(|island| Some(island.x[island.local_point(p)?])));
            was.places.extend(at.map(|at| (p, at)));
        }
        was
    }
}

impl Island {
    /// A constraint as the world has it.
    fn constraint_over_handles(&self, c: usize) -> Constraint {
        let mut constraint = self.constraints[c].clone();
        constraint.map_points(|p| self.points[p as usize].0);
        constraint
    }
}
