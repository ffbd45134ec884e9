//! Which constraints are to blame for a pose that is not solved.

use super::settled::{Parts, Settled, miss, points_of};
use super::state::State;
use crate::constraint::{Carried, ConstraintKind as _};
use crate::diag::{Diagnostic, format_rounded, listed};
use crate::mobility::{Conflict, analyse};
use crate::solve::{Judged, Settings, Status, Verdict, present, verdict};
use crate::world::{ConstraintId, Edit, Entity, PointId, World};

/// More culprits than this are counted.
const MOST_NAMED: usize = 3;
/// What hangs together with more constraints than this is not tested for a contradiction unless
/// somebody asks: the test solves subsets of it.
const LARGE: usize = 500;
/// In worlds of more constraints than this no point is thawed for a trial: each trial solves all.
const LARGE_WORLD: usize = 2000;

/// What keeps a pose from being solved, in words.
#[derive(Debug, Clone)]
pub struct Culprits {
    /// How solving ended, once a contradiction was looked for.
    pub status: Status,
    /// Who is to blame, a sentence each.
    pub notes: Vec<String>,
    /// What would help.
    pub helps: Vec<String>,
}

impl Culprits {
    /// Says it with a problem.
    pub fn explain(&self, problem: Diagnostic) -> Diagnostic {
        let problem = self.notes.iter().fold(problem, Diagnostic::note);
        self.helps.iter().fold(problem, Diagnostic::help)
    }
}

impl State {
    /// As [`Session::unsolved`](super::Session::unsolved).
    pub(super) fn unsolved(&self) -> Option<Diagnostic> {
        let State { world, preferences, .. } = self;
        let verdict = verdict(world, &preferences.solve);
        if verdict.is_met() || preferences.is_live {
            return None;
        }
        let (world, _) = present(world);
        let off = worst_first(&verdict, |_| true);
        let record = world.constraint(off.first()?.id)?;
        let others = match off.len() - 1 {
            0 => String::new(),
            n => format!(", {n} more are off"),
        };
        let miss = miss(&world, &record.constraint);
        let note = format!("not solved yet: {} is off by {miss}{others}", record.name);
        Some(
            Diagnostic::note_only(note)
                .help("`solve` solves it; `set live on` does so after each edit"),
        )
    }
}

impl State {
    /// Who is to blame for the present pose, where solving ended so; `held` are points that a hand
    /// holds now.
    pub(super) fn culprits(&self, status: Status, held: &[PointId]) -> Culprits {
        let (world, _) = present(&self.world);
        let settings = &self.preferences.solve;
        let verdict = verdict(&world, settings);
        let mut found = Culprits { status, notes: Vec::new(), helps: Vec::new() };
        found.name_immovable(&world, &verdict, held);
        let unsolved = verdict.unsolved();
        let conflicts = if status == Status::BestFit || status == Status::Unsatisfiable {
            conflicts_among(&world, settings, &unsolved)
        } else {
            Vec::new()
        };
        if conflicts.is_empty() {
            found.name_worst(&world, &verdict);
            return found;
        }
        found.status = status.max(Status::Contradictory);
        found.name_conflict(&world, settings, &conflicts, held);
        found
    }
}

/// The sets of constraints among some that cannot all hold; none where there are too many to
/// look.
fn conflicts_among(
    world: &World,
    settings: &Settings,
    among: &[ConstraintId],
) -> Vec<(Vec<ConstraintId>, Conflict)> {
    if among.is_empty() || among.len() > LARGE {
        return Vec::new();
    }
    let parts = Parts::among(world, |id| among.binary_search(&id).is_ok());
    let size = verdict(world, settings).of(among[0]).map_or(1.0, |judged| judged.size);
    let slack = settings.tolerance.max(1e-9) * size;
    let found = parts.with(world.points().column(), |scene| analyse(scene, slack));
    let ids = |set: &Conflict| set.constraints.iter().map(|&k| parts.ids[k]).collect();
    found.conflicts.into_iter().map(|set| (ids(&set), set)).collect()
}

impl Culprits {
    /// Constraints of frozen points only.
    fn name_immovable(&mut self, world: &World, verdict: &Verdict, held: &[PointId]) {
        let off = worst_first(verdict, |judged| judged.is_immovable);
        for judged in off.iter().take(MOST_NAMED) {
            let Some(record) = world.constraint(judged.id) else { continue };
            let points = points_of(world, record);
            let names: Vec<&str> = points.iter().map(|&p| world.points().name(p)).collect();
            let verb = if names.len() == 1 { "is" } else { "are" };
            let off = miss(world, &record.constraint);
            self.notes.push(format!(
                "{} is off by {off}: {} {verb} frozen",
                record.name,
                listed(&names, "and")
            ));
            let thaws = points.iter().filter(|p| !held.contains(p));
            self.help_to_thaw(world, thaws);
        }
        if off.len() > MOST_NAMED {
            self.notes.push(format!("{} more hold frozen points only", off.len() - MOST_NAMED));
        }
    }

    fn help_to_thaw<'a>(&mut self, world: &World, points: impl Iterator<Item = &'a PointId>) {
        let thaws: Vec<String> =
            points.map(|&p| format!("`thaw {}`", world.points().name(p))).collect();
        let help = format!("{} lets it give way", listed(&thaws, "or"));
        if !thaws.is_empty() && !self.helps.contains(&help) {
            self.helps.push(help);
        }
    }

    /// Those that are off most, where nothing says why.
    fn name_worst(&mut self, world: &World, verdict: &Verdict) {
        let off = worst_first(verdict, |judged| !judged.is_immovable);
        let told = off.iter().take(MOST_NAMED).filter_map(|judged| {
            let record = world.constraint(judged.id)?;
            Some(format!("{} by {}", record.name, miss(world, &record.constraint)))
        });
        let mut told: Vec<String> = told.collect();
        if off.len() > MOST_NAMED {
            told.push(format!("{} more", off.len() - MOST_NAMED));
        }
        if !told.is_empty() {
            self.notes.push(format!("off now: {}", listed(&told, "and")));
        }
    }

    fn name_conflict(
        &mut self,
        world: &World,
        settings: &Settings,
        conflicts: &[(Vec<ConstraintId>, Conflict)],
        held: &[PointId],
    ) {
        let (ids, conflict) = &conflicts[0];
        let name = |&id: &ConstraintId| world.name_of(Entity::Constraint(id)).to_owned();
        let mut names: Vec<String> = ids.iter().take(MOST_NAMED).map(name).collect();
        let first = names[0].clone();
        if ids.len() > MOST_NAMED {
            names.push(format!("{} more", ids.len() - MOST_NAMED));
        }
        let off = format_rounded(conflict.residual);
        self.notes.push(match &names[..] {
            [alone] => format!("{alone} cannot hold at all, off by {off}"),
            names => format!("{} cannot hold together, off by {off}", listed(names, "and")),
        });
        match conflicts.len() - 1 {
            0 => {}
            1 => self.notes.push("`check` names one set more".to_owned()),
            n => self.notes.push(format!("`check` names {n} sets more")),
        }
        if let Some(shape) = ids.iter().find(|id| keeps_a_shape(world, **id)).map(name) {
            self.notes.push(format!(
                "{shape} keeps the shape that it was made with; taken from a pose that was not \
                 solved, it contradicts the rest: `solve` first"
            ));
        }
        let thaws = thaws(world, settings, ids, held);
        self.help_to_thaw(world, thaws.iter());
        self.helps.push(format!("`why {first}` tells the ways out"));
    }
}

/// Whether a constraint asks for what it found when it was made.
fn keeps_a_shape(world: &World, id: ConstraintId) -> bool {
    world.constraint(id).is_some_and(|record| {
        let traits = record.constraint.traits();
        let is_fixed = traits.carried == Carried::Nothing && !traits.is_wheel;
        is_fixed && !record.constraint.captured().is_empty()
    })
}

/// What is off, the worst by what hangs together with it first.
fn worst_first(verdict: &Verdict, keep: impl Fn(&Judged) -> bool) -> Vec<Judged> {
    let off = verdict.judged.iter().filter(|judged| !judged.is_met() && keep(judged));
    let mut off: Vec<Judged> = off.copied().collect();
    off.sort_by(|a, b| b.residual().total_cmp(&a.residual()).then(a.id.cmp(&b.id)));
    off
}

/// The frozen points of some constraints with which thawed they can all hold, each tried alone;
/// those that are `held` stay where they are.
pub(super) fn thaws(
    world: &World,
    settings: &Settings,
    ids: &[ConstraintId],
    held: &[PointId],
) -> Vec<PointId> {
    if world.n_constraints() > LARGE_WORLD {
        return Vec::new();
    }
    let records = ids.iter().filter_map(|&id| world.constraint(id));
    let mut points: Vec<PointId> = records.flat_map(|record| points_of(world, record)).collect();
    points.sort_unstable();
    points.dedup();
    points.retain(|p| world.points().is_frozen(*p) && !held.contains(p));
    points.truncate(MOST_NAMED);
    points.retain(|&p| {
        let mut world = world.clone();
        world.apply(Edit::Freeze(p, false));
        let after = Settled::new(world, settings);
        let holds = |id: &ConstraintId| after.verdict.of(*id).is_some_and(Judged::is_met);
        ids.iter().all(holds)
    });
    points
}
