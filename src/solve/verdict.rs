//! Whether a pose satisfies its constraints: the one answer to all who ask.

use std::borrow::Cow;

use super::island::rounding;
use super::report::Status;
use super::settings::Settings;
use crate::constraint::{ConstraintKind as _, Point};
use crate::interrupt::tick;
use crate::linalg::DisjointSets;
use crate::world::{ConstraintId, PointId, World};

/// How the constraints of a world that are switched on stand to its pose, worked out afresh from
/// positions and live values as they are now. It is for questions: no frame asks.
#[derive(Debug, Clone, PartialEq)]
pub struct Verdict {
    /// Every constraint that is switched on, in order of their handles.
    pub judged: Vec<Judged>,
    /// Converged, or unsatisfiable where what is off holds frozen points only, or else stalled:
    /// what solving would come to is not asked here.
    pub status: Status,
    /// The largest violation, relative to the size of what hangs together with it.
    pub residual: f64,
}

/// One constraint at a pose.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Judged {
    /// Which one.
    pub id: ConstraintId,
    /// How far it is from being satisfied, length units.
    pub violation: f64,
    /// How large what hangs together with it is, length units; never 0.
    pub size: f64,
    /// Up to which violation it counts as satisfied: the tolerance that is set, or what rounding
    /// leaves of numbers as large as these.
    pub tolerance: f64,
    /// Whether it holds frozen points only.
    pub is_immovable: bool,
    /// What the violation is relative to: the size, or the coordinates that it is rounding of.
    scale: f64,
    /// Which of the parts that hang together it belongs to.
    part: usize,
}

impl Judged {
    /// Whether it counts as satisfied.
    pub fn is_met(&self) -> bool {
        self.violation <= self.tolerance
    }

    /// The violation relative to the size; rounding relative to what it is of.
    pub fn residual(&self) -> f64 {
        self.violation / self.scale
    }
}

impl Verdict {
    /// Whether every constraint is satisfied.
    pub fn is_met(&self) -> bool {
        self.status == Status::Converged
    }

    /// How solving ended that came to this pose and says it ended so: nothing is solved that is
    /// off here.
    pub fn ending(&self, status: Status) -> Status {
        match (self.status, status) {
            (Status::Converged, _) => Status::Converged,
            (found, Status::Converged) | (found @ Status::Unsatisfiable, _) => found,
            (_, status) => status,
        }
    }

    /// The constraint that is off most, by what hangs together with it, if there is one.
    pub fn worst(&self) -> Option<&Judged> {
        self.judged.iter().reduce(|worst, next| {
            let is_worse = (!next.is_met(), next.residual()) > (!worst.is_met(), worst.residual());
            if is_worse { next } else { worst }
        })
    }

    /// What was found of one constraint.
    pub fn of(&self, id: ConstraintId) -> Option<&Judged> {
        self.judged.binary_search_by_key(&id, |judged| judged.id).ok().map(|k| &self.judged[k])
    }

    /// The constraints that hang together with one that is off and that a move could mend.
    pub fn unsolved(&self) -> Vec<ConstraintId> {
        let off = self.judged.iter().filter(|judged| !judged.is_met() && !judged.is_immovable);
        let mut parts: Vec<usize> = off.map(|judged| judged.part).collect();
        parts.sort_unstable();
        let here = self.judged.iter().filter(|judged| parts.binary_search(&judged.part).is_ok());
        here.map(|judged| judged.id).collect()
    }
}

/// Judges the pose of a world.
pub fn verdict(world: &World, settings: &Settings) -> Verdict {
    let (world, has_values) = present(world);
    let parts = Parts::of(&world);
    let x = world.points().column();
    let w = world.points().inverse_masses();
    let judge = |&(id, part): &(ConstraintId, usize)| {
        tick(LOOK);
        let extent = &parts.extents[part];
        let (size, farthest) = (extent.size(), extent.farthest());
        let violation = world.constraint(id).map_or(0.0, |r| r.constraint.violation(x, &w));
        let is_rounding = violation <= rounding(farthest);
        Judged {
            id,
            violation,
            size,
            tolerance: (settings.tolerance * size).max(rounding(farthest)),
            scale: if is_rounding { size.max(farthest) } else { size },
            is_immovable: extent.is_immovable,
            part,
        }
    };
    let judged: Vec<Judged> = parts.constraints.iter().map(judge).collect();
    let status = judged
        .iter()
        .filter(|judged| !judged.is_met())
        .map(|judged| if judged.is_immovable { Status::Unsatisfiable } else { Status::Stalled });
    // A value that there is not is no value that is met.
    let at_least = if has_values { Status::Converged } else { Status::Stalled };
    let status = status.fold(at_least, Ord::max);
    let residual = judged.iter().map(Judged::residual).fold(0.0, f64::max);
    Verdict { judged, status, residual }
}

/// The least tolerance that can be promised in a world: below it rounding decides.
pub fn least_tolerance(world: &World) -> f64 {
    let extents = Parts::of(world).extents;
    extents.iter().map(|extent| rounding(extent.farthest()) / extent.size()).fold(0.0, f64::max)
}

/// A world with its live values as they are at this time and pose, and whether all of them have
/// one; those that have none are as they were.
pub fn present(world: &World) -> (Cow<'_, World>, bool) {
    if world.constraints().all(|(_, record)| record.live().is_empty()) {
        return (Cow::Borrowed(world), true);
    }
    let mut now = world.clone();
    let has_values = now.refresh().is_ok();
    (Cow::Owned(now), has_values)
}

/// What a look at a constraint takes, in ticks.
const LOOK: usize = 50;

/// What hangs together through points that are not frozen.
struct Parts {
    /// The constraints that are switched on, each with its part.
    constraints: Vec<(ConstraintId, usize)>,
    extents: Vec<Extent>,
}

impl Parts {
    fn of(world: &World) -> Self {
        let points = world.points();
        let moves = |p: &&u32| !points.is_frozen(PointId(**p));
        let mut sets = DisjointSets::default();
        let on = || world.constraints().filter(|(_, record)| record.is_on);
        for (_, record) in on() {
            let mut moving = record.constraint.points().iter().filter(moves);
            if let Some(&first) = moving.next() {
                moving.for_each(|&p| sets.join(first as usize, p as usize));
            }
        }
        let mut parts = Self { constraints: Vec::new(), extents: Vec::new() };
        let mut part_of = vec![usize::MAX; points.column().len()];
        for (id, record) in on() {
            tick(LOOK);
            let held = record.constraint.points();
            let root = held.iter().find(moves).map(|&p| sets.least(p as usize));
            let part = match root {
                Some(root) if part_of[root] != usize::MAX => part_of[root],
                _ => parts.extents.len(),
            };
            if part == parts.extents.len() {
                parts.extents.push(Extent::new(root.is_none()));
            }
            if let Some(root) = root {
                part_of[root] = part;
            }
            let extent = &mut parts.extents[part];
            held.iter().for_each(|&p| extent.include(points.at(PointId(p))));
            extent.wanted = extent.wanted.max(record.constraint.nominal_length());
            parts.constraints.push((id, part));
        }
        parts
    }
}

/// How far a part extends.
struct Extent {
    lo: Point,
    hi: Point,
    /// The longest length that a constraint asks for.
    wanted: f64,
    /// Whether all its points are frozen.
    is_immovable: bool,
}

impl Extent {
    fn new(is_immovable: bool) -> Self {
        let (lo, hi) = (f64::INFINITY, f64::NEG_INFINITY);
        Self { lo: Point::new(lo, lo), hi: Point::new(hi, hi), wanted: 0.0, is_immovable }
    }

    fn include(&mut self, at: Point) {
        self.lo = Point::new(self.lo.x.min(at.x), self.lo.y.min(at.y));
        self.hi = Point::new(self.hi.x.max(at.x), self.hi.y.max(at.y));
    }

    fn size(&self) -> f64 {
        let size = (self.hi.x - self.lo.x).max(self.hi.y - self.lo.y).max(self.wanted);
        if size > 0.0 && size.is_finite() { size } else { 1.0 }
    }

    fn farthest(&self) -> f64 {
        self.lo.x.abs().max(self.lo.y.abs()).max(self.hi.x.abs()).max(self.hi.y.abs())
    }
}
