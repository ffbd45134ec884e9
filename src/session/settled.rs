//! A copy of the world at rest, for questions that must not touch the world itself.

use super::state::State;
use crate::constraint::{Constraint, ConstraintKind as _, Quantity};
use crate::diag::format_rounded;
use crate::mobility::ConstraintSystem;
use crate::solve::{Budget, Settings, Solver, Status, Verdict, verdict};
use crate::world::{ConstraintId, Entity, PointId, Record, World};

/// A settled copy of the world, as the analysis takes it.
pub(super) struct Settled {
    pub world: World,
    /// How solving ended.
    pub status: Status,
    /// How the pose stands that it came to.
    pub verdict: Verdict,
    pub parts: Parts,
    /// The distance up to which a constraint counts as satisfied here. Wider than the
    /// tolerance: what is told apart is sound from contradictory, not exact from nearly so.
    pub slack: f64,
    size: f64,
    settings: Settings,
}

/// The constraints of a world that are switched on, and the inverse masses of its points.
pub(super) struct Parts {
    pub ids: Vec<ConstraintId>,
    pub constraints: Vec<Constraint>,
    pub w: Vec<f64>,
}

impl Parts {
    pub fn of(world: &World) -> Self {
        Self::among(world, |_| true)
    }

    /// Those that `keep` chooses.
    pub fn among(world: &World, keep: impl Fn(ConstraintId) -> bool) -> Self {
        let on = world.constraints().filter(|(id, record)| record.is_on && keep(*id));
        let (ids, constraints) = on.map(|(id, record)| (id, record.constraint.clone())).unzip();
        Self { ids, constraints, w: world.points().inverse_masses() }
    }

    /// The place of a constraint, if it is switched on.
    pub fn place(&self, id: ConstraintId) -> Option<usize> {
        self.ids.binary_search(&id).ok()
    }

    pub fn with<T>(
        &self,
        x: &[crate::constraint::Point],
        ask: impl FnOnce(&ConstraintSystem) -> T,
    ) -> T {
        let constraints: Vec<&Constraint> = self.constraints.iter().collect();
        ask(&ConstraintSystem { constraints: &constraints, x, w: &self.w })
    }
}

impl Settled {
    /// A world brought to rest.
    pub fn new(mut world: World, settings: &Settings) -> Self {
        let mut solver = Solver::new();
        // What has no value now is not met: the verdict says so.
        let _ = world.refresh_driven();
        let report = solver.settle(&mut world, settings, &Budget::default());
        let size = solver.size(&world);
        let slack = settings.tolerance.max(1e-9) * size;
        let verdict = verdict(&world, settings);
        let status = verdict.ending(report.status);
        let parts = Parts::of(&world);
        Self { parts, world, status, verdict, slack, size, settings: *settings }
    }

    /// Another world brought to rest by the same settings.
    pub fn with_world(&self, world: World) -> Self {
        Self::new(world, &self.settings)
    }

    pub fn with<T>(&self, ask: impl FnOnce(&ConstraintSystem) -> T) -> T {
        self.parts.with(self.world.points().column(), ask)
    }

    pub fn name(&self, place: usize) -> String {
        self.world.name_of(Entity::Constraint(self.parts.ids[place])).to_owned()
    }

    pub fn names(&self, places: &[usize]) -> Vec<String> {
        places.iter().map(|&k| self.name(k)).collect()
    }

    /// The settings it was brought to rest by.
    pub const fn settings(&self) -> &Settings {
        &self.settings
    }

    /// The size of what hangs together most widely, length units.
    pub const fn size(&self) -> f64 {
        self.size
    }

    /// By how much a constraint is missed, in its own unit: length units, or degrees.
    pub fn miss(&self, place: usize) -> String {
        miss(&self.world, &self.parts.constraints[place])
    }

    /// How far a constraint is from being satisfied, length units.
    pub fn violation(&self, place: usize) -> f64 {
        self.parts.constraints[place].violation(self.world.points().column(), &self.parts.w)
    }
}

/// By how much a constraint is missed, in its own unit: length units, or degrees.
pub(super) fn miss(world: &World, constraint: &Constraint) -> String {
    let missed = constraint.residual(world.points().column()).abs();
    match constraint.traits().quantity {
        Quantity::Angle => format!("{} deg", format_rounded(missed.to_degrees())),
        Quantity::Length | Quantity::Number => format_rounded(missed),
    }
}

/// The points of a constraint, each once.
pub(super) fn points_of(world: &World, record: &Record) -> Vec<PointId> {
    let mut points: Vec<_> = record.constraint.points().iter().map(|&p| PointId(p)).collect();
    points.sort_unstable();
    points.dedup();
    points.retain(|&p| world.points().is_alive(p));
    points
}

impl State {
    /// The world at rest at the present time.
    pub(super) fn settled(&self) -> Settled {
        Settled::new(self.world.clone(), &self.preferences.solve)
    }
}
