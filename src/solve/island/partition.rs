//! Which constraints and points make which island, kept up to date edit by edit.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::OnceLock;

use super::Island;
use super::member::Member;
use crate::constraint::{Constraint, ConstraintKind, Point};
use crate::interrupt::tick;
use crate::linalg::DisjointSets;
use crate::world::marks::Marks;
use crate::world::{ConstraintId, PointId, Touched, World};

/// Not in any island.
pub(super) const NONE: u32 = u32::MAX;
/// All points are frozen: in no island, but to be checked.
const CHECKED: u32 = u32::MAX - 1;

/// What finding the island of a constraint takes, and then putting it in, in ticks.
const CONSTRAINT: usize = 500;

/// Where a constraint is looked after.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Home {
    /// Nowhere: it is switched off, or new.
    None,
    /// With those that only frozen points hold.
    Checked,
    /// In this island.
    Island(u32),
}

/// All islands.
#[derive(Default)]
pub(crate) struct Partition {
    islands: Vec<Option<Box<Island>>>,
    vacant: Vec<u32>,
    /// By handle of a point: its island, if it is free.
    of_point: Vec<u32>,
    /// By handle of a constraint: its island, and its local index there.
    of_constraint: Vec<u32>,
    local_constraint: Vec<u32>,
    /// Constraints that hold only frozen points.
    checked: BTreeSet<ConstraintId>,
    /// What holds each frozen point. Made when it is first asked for, which a scene in which no
    /// frozen point is moved never does, and kept up from then on.
    holders: OnceLock<BTreeSet<(PointId, ConstraintId)>>,
    /// Room for putting islands together: a column by handle of a point, of which each use reads what
    /// it wrote.
    by_point: Vec<u32>,
    marks: Marks,
    /// Edits that are not taken in yet.
    pub(super) postponed: Postponed,
}

/// What is to be taken in before one of these islands, or of these points, is asked about.
#[derive(Default)]
pub(super) struct Postponed {
    /// The constraints that were edited: as they are, or that they are in no island any more.
    pub constraints: BTreeMap<ConstraintId, Option<Constraint>>,
    /// The points of these, and those that were edited themselves, with their places.
    pub points: BTreeMap<PointId, Point>,
    /// The islands that are as they were before.
    pub islands: Vec<u32>,
}

/// What of a world was otherwise when islands are put together: values of constraints, over handles, and
/// places.
#[derive(Default)]
pub(super) struct Was {
    pub constraints: BTreeMap<ConstraintId, Constraint>,
    pub places: BTreeMap<PointId, Point>,
}

impl Partition {
    /// The islands that exist, with their numbers.
    pub fn iter(&self) -> impl Iterator<Item = (u32, &Island)> {
        let islands = self.islands.iter().enumerate();
        islands.filter_map(|(k, island)| Some((k as u32, &**island.as_ref()?)))
    }

    /// One island, if it still exists.
    pub fn get(&self, k: u32) -> Option<&Island> {
        self.islands.get(k as usize)?.as_deref()
    }

    /// The same, for a change.
    pub fn get_mut(&mut self, k: u32) -> Option<&mut Island> {
        self.islands.get_mut(k as usize)?.as_deref_mut()
    }

    pub(super) fn islands_mut(&mut self) -> impl Iterator<Item = &mut Island> {
        self.islands.iter_mut().filter_map(Option::as_deref_mut)
    }

    /// Takes an island out, to be given back before anything else is asked.
    pub fn lend(&mut self, k: u32) -> Option<Box<Island>> {
        self.islands.get_mut(k as usize)?.take()
    }

    /// Puts a lent island back.
    pub fn give_back(&mut self, k: u32, island: Box<Island>) {
        self.islands[k as usize] = Some(island);
    }

    /// The island a free point is in.
    pub fn island_of_point(&self, id: PointId) -> Option<u32> {
        self.of_point.get(id.idx()).copied().filter(|&k| k != NONE)
    }

    /// Where a constraint is looked after.
    pub fn home(&self, id: ConstraintId) -> Home {
        match self.of_constraint.get(id.idx()).copied().unwrap_or(NONE) {
            NONE => Home::None,
            CHECKED => Home::Checked,
            k => Home::Island(k),
        }
    }

    /// The local index of a constraint in its island.
    pub fn local_constraint(&self, id: ConstraintId) -> usize {
        self.local_constraint[id.idx()] as usize
    }

    /// The constraints that hold a frozen point, as far as they are looked after.
    pub fn holders<'a>(
        &'a self,
        p: PointId,
        world: &'a World,
    ) -> impl Iterator<Item = ConstraintId> {
        let all = self.holders.get_or_init(|| {
            let islands = self.iter().flat_map(|(_, island)| frozen_points(island));
            let checked = self.checked.iter().flat_map(|&id| points_of(id, world));
            islands.chain(checked).collect()
        });
        let here = all.range((p, ConstraintId(0))..=(p, ConstraintId(u32::MAX)));
        // One that changed since may hold it no longer.
        here.map(|&(_, id)| id).filter(move |&id| points_of(id, world).any(|(q, _)| q == p))
    }

    /// The constraints that hold only frozen points.
    pub fn checked(&self) -> impl Iterator<Item = ConstraintId> {
        self.checked.iter().copied()
    }

    /// Takes apart what an edit touched, and the islands of these free points, and puts it together
    /// anew; gives the new islands. Those taken apart are shown to `leave` before.
    pub fn update(
        &mut self,
        touched: &Touched,
        outdated: &[PointId],
        world: &World,
        leave: &mut dyn FnMut(&Island),
    ) -> Vec<u32> {
        self.make_room(world);
        let mut loose = Vec::new();
        if touched.all {
            self.islands.iter().flatten().for_each(|island| leave(island));
            self.clear();
            loose.extend(world.constraints().map(|(id, _)| id));
        } else {
            for &p in outdated {
                if let Some(k) = self.island_of_point(p) {
                    self.dissolve(k, &mut loose, leave);
                }
            }
            self.loosen(touched, world, &mut loose, leave);
        }
        self.assemble(loose, world, &Was::default())
    }

    /// Makes room for all that there is.
    pub(super) fn make_room(&mut self, world: &World) {
        // Islands of what was taken back may be there yet.
        let n_points = world.points().column().len().max(self.of_point.len());
        let n_constraints = world.next_constraint().idx().max(self.of_constraint.len());
        self.of_point.resize(n_points, NONE);
        self.of_constraint.resize(n_constraints, NONE);
        self.local_constraint.resize(n_constraints, NONE);
        self.by_point.resize(n_points, NONE);
    }

    /// Notes where a constraint is looked after, or that it is nowhere.
    pub(super) fn set_home(&mut self, id: ConstraintId, k: u32) {
        self.of_constraint[id.idx()] = k;
    }

    /// Notes the island of a free point, or that it is in none.
    pub(super) fn set_island_of_point(&mut self, p: PointId, k: u32) {
        self.of_point[p.idx()] = k;
    }

    fn clear(&mut self) {
        self.postponed = Postponed::default();
        self.islands.clear();
        self.vacant.clear();
        self.of_point.fill(NONE);
        self.of_constraint.fill(NONE);
        self.checked.clear();
        self.holders = OnceLock::new();
    }

    /// Collects all constraints whose island may change.
    fn loosen(
        &mut self,
        touched: &Touched,
        world: &World,
        loose: &mut Vec<ConstraintId>,
        leave: &mut dyn FnMut(&Island),
    ) {
        for &id in &touched.constraints {
            self.dissolve_home(id, loose, leave);
            loose.push(id);
        }
        for &p in &touched.points {
            if let Some(k) = self.island_of_point(p) {
                self.dissolve(k, loose, leave);
            }
            let holders: Vec<ConstraintId> = self.holders(p, world).collect();
            for id in holders {
                if self.home(id) != Home::None {
                    self.dissolve_home(id, loose, leave);
                    loose.push(id);
                }
            }
        }
        // What a changed constraint ties to an island becomes part of the same; those of an island
        // that was taken apart hold no other points than its own.
        for &id in &touched.constraints {
            let Some(record) = world.constraint(id) else { continue };
            for &p in record.constraint.points() {
                if let Some(k) = self.island_of_point(PointId(p)) {
                    self.dissolve(k, loose, leave);
                }
            }
        }
    }

    fn dissolve_home(
        &mut self,
        id: ConstraintId,
        loose: &mut Vec<ConstraintId>,
        leave: &mut dyn FnMut(&Island),
    ) {
        match self.home(id) {
            Home::None => {}
            Home::Island(k) => self.dissolve(k, loose, leave),
            Home::Checked => {
                self.of_constraint[id.idx()] = NONE;
                self.checked.remove(&id);
                loose.push(id);
            }
        }
    }

    /// Takes an island apart: its constraints, some of which may be there already, belong to none for the
    /// moment. `leave` takes a last look at it.
    pub(super) fn dissolve(
        &mut self,
        k: u32,
        loose: &mut Vec<ConstraintId>,
        leave: &mut dyn FnMut(&Island),
    ) {
        let Some(island) = self.islands[k as usize].take() else { return };
        self.vacant.push(k);
        leave(&island);
        for p in &island.points[..island.n_free] {
            self.of_point[p.idx()] = NONE;
        }
        for id in &island.ids {
            self.of_constraint[id.idx()] = NONE;
        }
        loose.extend_from_slice(&island.ids);
        if let Some(holders) = self.holders.get_mut() {
            for holder in frozen_points(&island) {
                holders.remove(&holder);
            }
        }
    }

    /// Puts loose constraints together to islands, by the free points they share.
    pub(super) fn assemble(
        &mut self,
        mut loose: Vec<ConstraintId>,
        world: &World,
        was: &Was,
    ) -> Vec<u32> {
        loose.sort_unstable();
        loose.dedup();
        // One that was switched off or deleted may have been in one of the islands taken apart.
        loose.retain(|&id| world.constraint(id).is_some_and(|record| record.is_on));
        let points = world.points();
        let is_free = |p: u32| !points.is_frozen(PointId(p));
        let mut by_point = std::mem::take(&mut self.by_point);
        self.marks.begin();
        let numbers = DisjointSets::default();
        let mut sets =
            Sets { by_point: &mut by_point, marks: &mut self.marks, n_entered: 0, numbers };
        let mut members: Vec<(u32, ConstraintId)> = Vec::with_capacity(loose.len());
        for &id in &loose {
            tick(CONSTRAINT);
            let constraint = &world.constraint(id).expect("a loose constraint lives").constraint;
            if constraint.n_rows() == 0 {
                // A circle asks for nothing.
                continue;
            }
            let mut free = constraint.points().iter().copied().filter(|&p| is_free(p));
            let Some(first) = free.next() else {
                self.of_constraint[id.idx()] = CHECKED;
                self.checked.insert(id);
                if let Some(holders) = self.holders.get_mut() {
                    holders.extend(points_of(id, world));
                }
                continue;
            };
            let set = sets.enter(first);
            for p in free {
                let other = sets.enter(p);
                sets.join(set, other);
            }
            members.push((set, id));
        }
        for (set, _) in &mut members {
            *set = sets.least(*set);
        }
        members.sort_unstable();
        let mut made = Vec::new();
        for group in members.chunk_by(|a, b| a.0 == b.0) {
            tick(CONSTRAINT * group.len());
            let mut group: Vec<Member> = group
                .iter()
                .map(|&(_, id)| {
                    let record = world.constraint(id).expect("a loose constraint lives");
                    let constraint = was.constraints.get(&id).unwrap_or(&record.constraint);
                    Member { constraint, ..Member::new(id, record) }
                })
                .collect();
            let island = Island::new(
                &mut group,
                |p| was.places.get(&p).copied().unwrap_or_else(|| points.at(p)),
                |p| points.inverse_mass(p),
                &mut by_point,
            );
            let k = self.vacant.pop().unwrap_or_else(|| {
                self.islands.push(None);
                self.islands.len() as u32 - 1
            });
            for p in &island.points[..island.n_free] {
                self.of_point[p.idx()] = k;
            }
            if let Some(holders) = self.holders.get_mut() {
                holders.extend(frozen_points(&island));
            }
            for (c, id) in island.ids.iter().enumerate() {
                self.of_constraint[id.idx()] = k;
                self.local_constraint[id.idx()] = c as u32;
            }
            self.islands[k as usize] = Some(Box::new(island));
            made.push(k);
        }
        self.by_point = by_point;
        made
    }
}

/// The points of a constraint, each with the constraint.
fn points_of(id: ConstraintId, world: &World) -> impl Iterator<Item = (PointId, ConstraintId)> {
    let points = world.constraint(id).map(|record| record.constraint.points());
    points.into_iter().flatten().map(move |&p| (PointId(p), id))
}

/// The frozen points of an island, each with a constraint that holds it.
fn frozen_points(island: &Island) -> impl Iterator<Item = (PointId, ConstraintId)> {
    let constraints = island.constraints.iter().zip(&island.ids);
    constraints.flat_map(move |(constraint, &id)| {
        let frozen = constraint.points().iter().filter(|&&p| p as usize >= island.n_free);
        frozen.map(move |&p| (island.points[p as usize], id))
    })
}

/// Disjoint sets of points, as far as they are named.
struct Sets<'a> {
    /// The numbers of those that are marked.
    by_point: &'a mut [u32],
    marks: &'a mut Marks,
    n_entered: u32,
    numbers: DisjointSets,
}

impl Sets<'_> {
    /// The number of a point, which is the next one if it has none.
    fn enter(&mut self, p: u32) -> u32 {
        let number = &mut self.by_point[p as usize];
        if self.marks.mark(p as usize) {
            *number = self.n_entered;
            self.n_entered += 1;
        }
        *number
    }

    fn join(&mut self, a: u32, b: u32) {
        self.numbers.join(a as usize, b as usize);
    }

    fn least(&mut self, set: u32) -> u32 {
        self.numbers.least(set as usize) as u32
    }
}
