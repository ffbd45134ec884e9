//! `check` and `why`: what a mechanism can do, what contradicts what, and what would mend it.

use std::borrow::Cow;
use std::collections::BTreeSet;

use crate::constraint::{Bounds, Constraint, ConstraintKind as _, Field, Kind};
use crate::diag::{Diagnostic, format_digits, listed, listed_first, listed_ways};
use crate::errors;
use crate::lang::ast::{Changing, Name, Part};
use crate::mobility::{Analysis, Conflict, Directions, analyse, conflict_with, freedom, repair};
use crate::session::check::{Check, FromHere, Unsatisfiable};
use crate::session::culprits::thaws;
use crate::session::execution::Execution;
use crate::session::finding::Finding;
use crate::session::resolve::said::pattern_of;
use crate::session::resolve::unbind::{Unbind, named, text_of};
use crate::session::settled::{Settled, miss};
use crate::session::state::State;
use crate::solve::{Judged, Status, Verdict, present, verdict};
use crate::world::{ConstraintId, Drivers, Edit, Entity, PointId, Record, World};

impl State {
    /// What there is to know about the mechanism at rest at the present time.
    pub fn examine(&self) -> Check {
        let subject = self.settled();
        let found = subject.with(|scene| analyse(scene, subject.slack));
        let Analysis { degrees_of_freedom, redundant, conflicts, unsatisfiable, .. } = &found;
        let status = match subject.status {
            Status::BestFit if !conflicts.is_empty() => Status::Contradictory,
            status => status,
        };
        let solved = (status, subject.verdict.residual);
        let drawn = self.as_drawn(&subject);
        let (status, residual) =
            drawn.as_ref().map_or(solved, |drawn| (drawn.verdict.status, drawn.verdict.residual));
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
            unsatisfiable: unsatisfiable
                .iter()
                .map(|&k| Unsatisfiable {
                    constraint: subject.name(k),
                    frozen: subject.points_of(k),
                    miss: subject.miss(k),
                })
                .collect(),
            pose: found.pose,
            status,
            residual,
            from_here: drawn.map(|drawn| FromHere {
                as_drawn: drawn.worst(),
                status: solved.0,
                residual: solved.1,
            }),
            near_singular,
        }
    }

    /// The pose that there is, where solving from there changes the verdict.
    fn as_drawn(&self, subject: &Settled) -> Option<Drawn<'_>> {
        let (world, _) = present(&self.world);
        let verdict = verdict(&self.world, &self.preferences.solve);
        let (before, after) = (verdict.residual, subject.verdict.residual);
        let is_other =
            subject.verdict.is_met() || (before - after).abs() > SAME * before.max(after);
        (!verdict.is_met() && is_other).then_some(Drawn { world, verdict })
    }

    fn why_constraint(&self, id: ConstraintId) -> Vec<String> {
        let name = self.world.name_of(Entity::Constraint(id));
        if self.world.constraint(id).is_some_and(|record| !record.is_on) {
            return vec![format!("{name} is switched off")];
        }
        let subject = self.settled();
        let slack = subject.slack;
        let place = subject.parts.place(id).expect("it is on");
        let found = subject.with(|scene| analyse(scene, slack));
        let drawn = self.as_drawn(&subject);
        let off_as_drawn = drawn.as_ref().and_then(|drawn| drawn.miss(id));
        let is_met = subject.verdict.of(id).is_none_or(Judged::is_met);
        let off = match (&off_as_drawn, is_met) {
            (None, true) => format!("{name} is satisfied"),
            (None, false) => format!("{name} is off by {}", subject.miss(place)),
            (Some(before), true) => {
                format!("as drawn: {name} is off by {before}; solved from here: satisfied")
            }
            (Some(before), false) => format!(
                "as drawn: {name} is off by {before}; solved from here: off by {}",
                subject.miss(place)
            ),
        };
        if found.unsatisfiable.contains(&place) {
            let points = subject.points_of(place);
            let mut ways = subject.repairs_of_frozen(place);
            ways.push(format!("thaw {}", listed(&points, "or")));
            ways.push(format!("drop {name}"));
            return vec![
                format!("{off}: all its points are frozen"),
                format!("{}, or {}", ways[..ways.len() - 1].join(", "), ways[ways.len() - 1]),
            ];
        }
        // What `check` names, every member of a set says alike.
        let known = found.conflicts.iter().find(|set| set.constraints.contains(&place)).cloned();
        let search = || subject.with(|scene| conflict_with(scene, place, slack));
        match known.or_else(|| if is_met { None } else { search() }) {
            Some(conflict) => {
                let others = subject.names(&conflict.constraints);
                let others: Vec<_> = others.into_iter().filter(|other| other != name).collect();
                let why = match &others[..] {
                    [] => "it cannot hold at all".to_owned(),
                    others => format!("it cannot hold together with {}", listed(others, "and")),
                };
                let mut lines = vec![format!("{off}: {why}")];
                lines.extend(subject.ways_out(&conflict));
                lines
            }
            None if is_met => {
                let mut lines = vec![off];
                for r in found.redundant.iter().filter(|r| r.constraint == place) {
                    let others = listed(&subject.names(&r.depends_on), "and");
                    lines.push(match r.depends_on.len() {
                        0 => "it is redundant: it holds whatever the pose".to_owned(),
                        1 => format!("it is redundant: {others} implies it"),
                        _ => format!("it is redundant: {others} imply it"),
                    });
                }
                lines
            }
            None if subject.status == Status::Stalled => {
                vec![off, "the pose is not at rest: `solve` goes on".to_owned()]
            }
            None => vec![off, "nothing contradicts it: another start may reach it".to_owned()],
        }
    }

    fn why_point(&self, id: PointId) -> Vec<String> {
        let name = self.world.points().name(id);
        if self.world.points().is_frozen(id) {
            return vec![format!("{name} is frozen")];
        }
        let subject = self.settled();
        let found = subject.with(|scene| freedom(scene, id.0));
        let held = subject.names(&found.held_by);
        let verb =
            |one: &str, more: &str| if held.len() == 1 { one.to_owned() } else { more.to_owned() };
        let held_by = listed_first(&held);
        let mut lines: Vec<String> = Vec::new();
        if let Some(drawn) = self.as_drawn(&subject) {
            lines.push(format!("as drawn: off by {}; solved from here:", drawn.worst()));
        }
        lines.push(match found.directions {
            Directions::All => format!("{name} can move in every direction"),
            Directions::None if held.is_empty() => format!("{name} cannot move"),
            Directions::None => {
                format!("{name} cannot move: {held_by} {} it", verb("holds", "hold"))
            }
            Directions::Along(v) => {
                // Both senses are meant: the angle of the one that points to the right.
                let angle = v.angle().to_degrees();
                let angle = if angle <= -90.0 {
                    angle + 180.0
                } else if angle > 90.0 {
                    angle - 180.0
                } else {
                    angle
                };
                let angle = format_digits(if angle.abs() < 1e-9 { 0.0 } else { angle }, 5);
                let stops = verb("stops", "stop");
                format!(
                    "{name} can move along {angle} deg and back only: {held_by} {stops} it across"
                )
            }
        });
        lines
    }
}

impl Drawn<'_> {
    /// By how much a constraint is missed, in its own unit, if it is.
    fn miss(&self, id: ConstraintId) -> Option<String> {
        let judged = self.verdict.of(id).filter(|judged| !judged.is_met())?;
        Some(miss(&self.world, &self.world.constraint(judged.id)?.constraint))
    }

    /// By how much the worst constraint is missed, and which it is.
    fn worst(&self) -> String {
        let worst = self.verdict.worst();
        let told = worst.and_then(|worst| Some((self.miss(worst.id)?, worst.id)));
        told.map_or("a live value that there is not".to_owned(), |(miss, id)| {
            format!("{miss} ({})", self.world.name_of(Entity::Constraint(id)))
        })
    }
}

impl Settled {
    /// The names of a constraint's points, each once.
    fn points_of(&self, place: usize) -> Vec<String> {
        let mut points = self.parts.constraints[place].points().to_vec();
        points.sort_unstable();
        points.dedup();
        points.iter().map(|&p| self.world.points().name(PointId(p)).to_owned()).collect()
    }

    /// What would settle a conflict, in one line, and the same as commands.
    fn ways_out(&self, conflict: &Conflict) -> Vec<String> {
        let mut repairs: Vec<Mend> = conflict
            .repairs
            .iter()
            .filter_map(|repair| self.mend(conflict, repair.constraint))
            .collect();
        repairs.sort_by(|a, b| a.effort.total_cmp(&b.effort));
        repairs.truncate(MOST_REPAIRS);
        let mut ways: Vec<String> = repairs.iter().map(|mend| mend.text.clone()).collect();
        let ids: Vec<_> = conflict.constraints.iter().map(|&k| self.parts.ids[k]).collect();
        let thaws = thaws(&self.world, self.settings(), &ids, &[]);
        if !thaws.is_empty() {
            let points = thaws.iter().map(|&p| self.world.points().name(p));
            ways.push(format!("thaw {}", listed(&points.collect::<Vec<_>>(), "or")));
        }
        let names = self.names(&conflict.constraints);
        ways.push(format!("drop {}", listed(&names, "or")));
        let mut lines = vec![listed_ways(&ways)];
        lines.extend(repairs.into_iter().map(|mend| format!("    {}", mend.command)));
        lines
    }

    /// The change of one constraint that settles a conflict, if there is one that was seen to.
    fn mend(&self, conflict: &Conflict, place: usize) -> Option<Mend> {
        let field = changeable(&self.parts.constraints[place])?;
        let island = self.with(|scene| scene.neighbours(&BTreeSet::from([place])));
        // All that hangs together with it is to hold; if other conflicts are in there, at
        // least those of this one are.
        [&island[..], &conflict.constraints[..]].into_iter().find_map(|among| {
            let change = self.with(|scene| repair(scene, place, among, 1e-3 * self.slack))?;
            let mend = self.mend_by(place, field(change), change)?;
            // A change that was not seen to work is none.
            let mut world = self.world.clone();
            world.apply(Edit::Constraint(
                self.parts.ids[place],
                Some(Box::new(mend.record.clone())),
            ));
            let after = self.with_world(world);
            let holds = |&k: &usize| after.violation(k) <= after.slack;
            conflict.constraints.iter().all(holds).then_some(mend)
        })
    }

    /// A constraint with some bounds moved by `change`.
    fn mend_by(&self, place: usize, fields: &[Field], change: f64) -> Option<Mend> {
        let name = self.name(place);
        let mut record = self.world.constraint(self.parts.ids[place])?.clone();
        record.replace_drivers(fields, Drivers::new());
        for &field in fields {
            let value = record.constraint.get(field)?;
            record.constraint.set(field, value + change);
        }
        let amount = |value: f64| format_digits(value.abs(), 5);
        let is_more = change > 0.0;
        let kind = record.constraint.kind();
        let text = match kind {
            Kind::Length => {
                let verb = if is_more { "lengthen" } else { "shorten" };
                format!("{verb} {name} by {}", amount(change))
            }
            Kind::Orientation => {
                let side = if is_more { "counter-clockwise" } else { "clockwise" };
                format!("turn {name} {side} by {} deg", amount(change.to_degrees()))
            }
            _ => {
                let verb = if is_more { "increase" } else { "decrease" };
                format!("{verb} {name} by {}", amount(change))
            }
        };
        let is_angle = kind == Kind::Orientation;
        let bounds =
            Bounds { lo: record.constraint.get(Field::Lo)?, hi: record.constraint.get(Field::Hi)? };
        let parts =
            vec![Part::Relation(Unbind::of(&self.world).relation(&record, bounds, is_angle))];
        let command = text_of(&Changing::Change { name: named(&name), parts }.into());
        // A radian counts as the length of what hangs together.
        let effort = if is_angle { change.abs() * self.size() } else { change.abs() };
        Some(Mend { text, command, record, effort })
    }

    /// The change that makes a constraint between frozen points hold.
    fn repairs_of_frozen(&self, place: usize) -> Vec<String> {
        let constraint = &self.parts.constraints[place];
        let change = constraint.residual(self.world.points().column());
        let fields = changeable(constraint).map(|field| field(change));
        let mend = fields.and_then(|fields| self.mend_by(place, fields, change));
        mend.into_iter().map(|mend| mend.text).collect()
    }
}

impl Execution<'_> {
    pub(crate) fn check(&mut self) {
        let check = self.state.examine();
        if self.host.takes_findings() {
            return self.host.find_out(&Finding::Checked(&check));
        }
        check.lines().iter().for_each(|line| self.host.print(line));
    }

    pub(crate) fn why(&mut self, name: &Name) -> Result<(), Diagnostic> {
        let lines = match self.resolve().entity(name)? {
            Entity::Constraint(id) => self.state.why_constraint(id),
            Entity::Point(id) => self.state.why_point(id),
            Entity::Parameter(id) => {
                let text = Unbind::of(&self.state.world).parameter_text(id);
                return Err(Diagnostic::error(
                    errors::WRONG_SORT,
                    "`why` asks about a constraint or a point",
                )
                .at(name.span, format!("this is a parameter: `{text}`")));
            }
            Entity::Measure(_) => {
                return Err(Diagnostic::error(
                    errors::WRONG_SORT,
                    "`why` asks about a constraint or a point",
                )
                .at(name.span, "this is a measure"));
            }
        };
        lines.iter().for_each(|line| self.host.print(line));
        Ok(())
    }
}

/// Two residuals that differ by no more than this part are one verdict.
const SAME: f64 = 1e-3;

/// The pose that there is.
struct Drawn<'a> {
    /// With its live values as they are now.
    world: Cow<'a, World>,
    verdict: Verdict,
}

/// More ways out of a conflict than this are not listed.
const MOST_REPAIRS: usize = 3;

/// A change of one constraint.
struct Mend {
    text: String,
    command: String,
    record: Record,
    /// How much of a change it is, length units.
    effort: f64,
}

/// Which values of a constraint a user can change to make up for a residual; none for what has
/// no value.
fn changeable(constraint: &Constraint) -> Option<impl Fn(f64) -> &'static [Field]> {
    if constraint.measures(Field::Lo) || constraint.measures(Field::Hi) {
        return None;
    }
    let bounds = constraint.traits().bounds.filter(|_| pattern_of(constraint).has_relation())?;
    Some(move |change: f64| -> &'static [Field] {
        if bounds.is_equality() {
            &[Field::Lo, Field::Hi]
        } else if change > 0.0 {
            &[Field::Hi]
        } else {
            &[Field::Lo]
        }
    })
}
