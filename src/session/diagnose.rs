//! `check` and `why`: what a mechanism can do, what contradicts what, and what would mend it.

use super::run::format_rounded;
use super::{Diagnostic, Session};
use crate::constraint::{Constraint, Kind};
use crate::lang::ast::Name;
use crate::solve::mobility::{
    Analysis, Conflict, Directions, Pose, Repair, Scene, analyse, conflict_with, freedom,
};
use crate::solve::{Budget, Report, Solver, Status};
use crate::world::{ConstraintId, Entity, PointId, World};

/// What `check` finds, with names.
#[derive(Debug, Clone)]
pub struct Check {
    /// In how many independent ways the points can begin to move, motors held.
    pub degrees_of_freedom: usize,
    /// Constraints that others imply, each with those that imply it.
    pub redundant: Vec<(String, Vec<String>)>,
    /// Sets of constraints that cannot all hold, each with its residual, length units.
    pub conflicting: Vec<(Vec<String>, f64)>,
    /// Constraints of frozen points only that do not hold.
    pub unsatisfiable: Vec<String>,
    /// What the pose is.
    pub pose: Pose,
    /// How solving this pose ended.
    pub status: Status,
    /// The largest residual, relative to the scene's size.
    pub residual: f64,
    /// The smallest singular value over the largest, where it says that small errors grow.
    pub near_singular: Option<f64>,
}

impl Check {
    /// Whether every constraint can hold.
    pub fn is_sound(&self) -> bool {
        self.conflicting.is_empty() && self.unsatisfiable.is_empty()
    }

    /// The word for the pose.
    pub const fn pose_word(&self) -> &'static str {
        match self.pose {
            Pose::Regular => "regular",
            Pose::MobileSingular => "mobile-singular",
            Pose::ChangePoint => "change-point",
            Pose::Locked => "locked",
        }
    }

    /// The findings as lines of text.
    pub fn lines(&self) -> Vec<String> {
        let mut lines = vec![format!("degrees of freedom: {}", self.degrees_of_freedom)];
        for (name, depends_on) in &self.redundant {
            lines.push(match &depends_on[..] {
                [] => format!("redundant: {name}"),
                others => format!("redundant: {name}, implied by {}", others.join(", ")),
            });
        }
        for (names, residual) in &self.conflicting {
            let residual = format_rounded(*residual);
            lines.push(format!("conflicting: {}, off by {residual}", names.join(", ")));
        }
        for name in &self.unsatisfiable {
            lines.push(format!("unsatisfiable: {name}, all its points are frozen"));
        }
        lines.push(match self.pose {
            Pose::Regular => match self.near_singular {
                None => "pose: regular".to_owned(),
                Some(ratio) => format!(
                    "pose: nearly singular, small errors grow {}-fold",
                    format_rounded(1.0 / ratio)
                ),
            },
            Pose::MobileSingular => "pose: singular but mobile, by its proportions".to_owned(),
            Pose::ChangePoint => "pose: a change point, several motions meet here".to_owned(),
            Pose::Locked => "pose: locked, a dead point".to_owned(),
        });
        let status = self.status.phrase();
        lines.push(format!("status: {status}, residual {}", format_rounded(self.residual)));
        lines
    }
}

/// A settled copy of the world, as the analysis takes it.
struct Subject {
    world: World,
    report: Report,
    ids: Vec<ConstraintId>,
    constraints: Vec<Constraint>,
    w: Vec<f64>,
    size: f64,
}

impl Subject {
    fn with<T>(&self, ask: impl FnOnce(&Scene) -> T) -> T {
        let constraints: Vec<&Constraint> = self.constraints.iter().collect();
        ask(&Scene { constraints: &constraints, x: self.world.points().column(), w: &self.w })
    }

    fn name(&self, place: usize) -> String {
        self.world.name_of(Entity::Constraint(self.ids[place])).to_owned()
    }

    fn names(&self, places: &[usize]) -> Vec<String> {
        places.iter().map(|&k| self.name(k)).collect()
    }
}

impl Session {
    /// The world at rest at the present time, without touching it.
    fn subject(&self) -> Subject {
        let mut world = self.world.clone();
        let mut solver = Solver::new();
        let report = solver.settle(&mut world, &self.preferences.solve, &Budget::default());
        let on = world.constraints().filter(|(_, record)| record.is_on);
        let (ids, constraints) = on.map(|(id, record)| (id, record.constraint.clone())).unzip();
        let points = world.points();
        let w = (0..points.column().len())
            .map(|k| PointId::new(k))
            .map(|id| if points.is_alive(id) { points.inverse_mass(id) } else { 0.0 })
            .collect();
        Subject { world, report, ids, constraints, w, size: solver.size() }
    }

    /// What there is to know about the mechanism at rest at the present time.
    pub fn examine(&self) -> Check {
        let subject = self.subject();
        let found = subject.with(|scene| analyse(scene, self.slack(&subject)));
        let Analysis { degrees_of_freedom, redundant, conflicts, unsatisfiable, .. } = &found;
        let near_singular = found
            .singular_values
            .filter(|_| found.is_nearly_singular())
            .map(|(least, most)| least / most);
        Check {
            degrees_of_freedom: *degrees_of_freedom,
            redundant: redundant
                .iter()
                .map(|r| (subject.name(r.constraint), subject.names(&r.depends_on)))
                .collect(),
            conflicting: conflicts
                .iter()
                .map(|c| (subject.names(&c.constraints), c.residual))
                .collect(),
            unsatisfiable: subject.names(unsatisfiable),
            pose: found.pose,
            status: subject.report.status,
            residual: subject.report.residual,
            near_singular,
        }
    }

    /// The distance up to which a constraint counts as satisfied here. Wider than the
    /// tolerance: what is told apart is sound from contradictory, not exact from nearly so.
    fn slack(&self, subject: &Subject) -> f64 {
        self.preferences.solve.tolerance.max(1e-9) * subject.size
    }

    pub(super) fn check(&mut self) {
        for line in self.examine().lines() {
            self.host.print(&line);
        }
    }

    pub(super) fn why(&mut self, name: &Name) -> Result<(), Diagnostic> {
        let lines = match self.entity(name)? {
            Entity::Constraint(id) => self.why_constraint(id),
            Entity::Point(id) => self.why_point(id),
            Entity::Parameter(id) => {
                let text = self.parameter_text(id);
                return Err(Diagnostic::error("`why` asks about a constraint or a point")
                    .at(name.span, format!("this is a parameter: `{text}`")));
            }
        };
        lines.iter().for_each(|line| self.host.print(line));
        Ok(())
    }

    fn why_constraint(&self, id: ConstraintId) -> Vec<String> {
        let name = self.world.name_of(Entity::Constraint(id));
        if self.world.constraint(id).is_some_and(|record| !record.is_on) {
            return vec![format!("{name} is off")];
        }
        let subject = self.subject();
        let slack = self.slack(&subject);
        let place = subject.ids.iter().position(|&other| other == id).expect("it is on");
        let violation = self.violation_of(&subject, place);
        let found = subject.with(|scene| analyse(scene, slack));
        if found.unsatisfiable.contains(&place) {
            return vec![
                format!(
                    "{name} holds frozen points only and is off by {}",
                    format_rounded(violation)
                ),
                format!("thaw one of its points, change it, or drop {name}"),
            ];
        }
        if violation <= slack {
            let mut lines =
                vec![format!("{name} is satisfied, residual {}", format_rounded(violation))];
            for r in found.redundant.iter().filter(|r| r.constraint == place) {
                let others = subject.names(&r.depends_on).join(", ");
                lines.push(format!("it is redundant: {others} imply it"));
            }
            return lines;
        }
        let mut lines = vec![format!("{name} is off by {}", format_rounded(violation))];
        match subject.with(|scene| conflict_with(scene, place, slack)) {
            Some(conflict) => lines.extend(self.describe_conflict(&subject, &conflict, name)),
            None if subject.report.status == Status::Stalled => {
                lines.push("the pose is not at rest; `solve` goes on".to_owned());
            }
            None => lines.push("nothing contradicts it: the pose is a poor start".to_owned()),
        }
        lines
    }

    fn violation_of(&self, subject: &Subject, place: usize) -> f64 {
        use crate::constraint::Relation as _;
        subject.constraints[place].violation(subject.world.points().column(), &subject.w)
    }

    fn describe_conflict(&self, subject: &Subject, conflict: &Conflict, name: &str) -> Vec<String> {
        let others: Vec<String> =
            subject.names(&conflict.constraints).into_iter().filter(|n| n != name).collect();
        let mut lines = Vec::new();
        if others.is_empty() {
            lines.push("it contradicts itself".to_owned());
        } else {
            lines.push(format!("it cannot hold together with {}", others.join(", ")));
        }
        let mut ways: Vec<String> =
            conflict.repairs.iter().map(|repair| self.describe_repair(subject, *repair)).collect();
        let drops: Vec<String> =
            subject.names(&conflict.constraints).iter().map(|n| format!("drop {n}")).collect();
        ways.extend(drops);
        for (k, way) in ways.iter().enumerate() {
            lines.push(if k == 0 { format!("either {way}") } else { format!("or {way}") });
        }
        lines
    }

    fn describe_repair(&self, subject: &Subject, repair: Repair) -> String {
        let name = subject.name(repair.constraint);
        let amount = |value: f64| super::run::format_digits(value.abs(), 5);
        let is_more = repair.change > 0.0;
        match subject.constraints[repair.constraint].kind() {
            Kind::Length => {
                let verb = if is_more { "lengthen" } else { "shorten" };
                format!("{verb} {name} by {}", amount(repair.change))
            }
            Kind::Orientation => {
                let side = if is_more { "counter-clockwise" } else { "clockwise" };
                format!("turn {name} {side} by {} deg", amount(repair.change.to_degrees()))
            }
            _ => {
                let verb = if is_more { "increase" } else { "decrease" };
                format!("{verb} {name} by {}", amount(repair.change))
            }
        }
    }

    fn why_point(&self, id: PointId) -> Vec<String> {
        let name = self.world.points().name(id);
        if self.world.points().is_frozen(id) {
            return vec![format!("{name} is frozen")];
        }
        let subject = self.subject();
        let found = subject.with(|scene| freedom(scene, id.0));
        let held = subject.names(&found.held_by);
        let held = match &held[..] {
            [] => String::new(),
            names => format!(", held by {}", names.join(", ")),
        };
        vec![match found.directions {
            Directions::All => format!("{name} can move in every direction"),
            Directions::None => format!("{name} cannot move{held}"),
            Directions::Along(v) => {
                let angle = super::run::format_digits(v.angle().to_degrees(), 5);
                format!("{name} can move along {angle} deg only{held}")
            }
        }]
    }
}
