//! `limits`: how far a driver can go.

use super::driver::Source;
use crate::constraint::Kind;
use crate::constraint::geometry::wrap;
use crate::diag::{Diagnostic, format_decimals, format_degrees, listed};
use crate::errors;
use crate::lang::ast::Name;
use crate::mobility::{DriverRange, RangeEnd, Reach, range};
use crate::session::execution::Execution;
use crate::session::finding::{Finding, Limits};
use crate::session::settled::Parts;
use crate::session::state::State;
use crate::world::Entity;

impl Execution<'_> {
    pub(crate) fn limits(&mut self, name: &Name) -> Result<(), Diagnostic> {
        let entity = self.resolve().entity(name)?;
        let source = self.state.driver(entity).map_err(|why| {
            let problem = Diagnostic::error(errors::NO_RANGE, why.message).at(name.span, why.label);
            why.help.into_iter().fold(problem, Diagnostic::help)
        })?;
        let is_off = matches!(&source, Source::Values(id, ..)
            if !self.state.world.constraint(*id).is_some_and(|r| r.is_on));
        let is_sought = !is_off && self.state.measured().is_none();
        let found = if is_sought { self.state.range_of(&source) } else { None };
        let text = if is_off {
            format!("{} is switched off", self.state.world.name_of(entity))
        } else {
            self.state.limits_of(entity, found.clone())
        };
        if self.host.takes_findings() {
            let found = self.state.limits_found(entity, found, text);
            self.host.find_out(&Finding::Limits(&found));
        } else {
            self.host.print(&text);
        }
        Ok(())
    }
}

/// How the values of a driver are said.
struct Manner {
    /// What it does: a motor turns.
    verb: &'static str,
    is_angle: bool,
    /// Places behind the point of a number.
    n_decimals: usize,
}

impl Manner {
    fn value(&self, value: f64) -> String {
        if self.is_angle { format_degrees(value) } else { format_decimals(value, self.n_decimals) }
    }

    /// A value that is known up to a millionth of what it was, rounded.
    fn rough(&self, value: f64) -> String {
        if self.is_angle {
            format_degrees(((value.to_degrees() * 1e6).round() / 1e6).to_radians())
        } else {
            format_decimals(value, self.n_decimals.saturating_sub(3))
        }
    }
}

impl State {
    /// How far something that drives can go, the rest held as it is now; none if it drives nothing
    /// now.
    pub fn range(&self, entity: Entity) -> Option<DriverRange> {
        let source = self.driver(entity).ok()?;
        self.range_of(&source).map(|(range, _)| range)
    }

    /// The range of a driver, and whether it is an angle.
    fn range_of(&self, source: &Source) -> Option<(DriverRange, bool)> {
        let subject = self.settled();
        let tolerance = subject.slack / subject.size();
        subject.with(|scene| {
            let driver = source.of(&subject, scene)?;
            Some((range(scene, &driver, tolerance), driver.is_angle))
        })
    }

    /// The range of a driver as data, and what is said of it.
    fn limits_found(
        &self,
        entity: Entity,
        found: Option<(DriverRange, bool)>,
        text: String,
    ) -> Limits {
        let (range, is_angle) = found.unzip();
        let ids = Parts::of(&self.world).ids;
        let stop = |end: RangeEnd| match end {
            RangeEnd::Stop(_, by) => {
                Some(self.world.name_of(Entity::Constraint(ids[by])).to_owned())
            }
            _ => None,
        };
        let stops = match range.as_ref().map(|range| range.reach) {
            Some(Reach::Between(lower, upper)) => [stop(lower), stop(upper)],
            _ => [None, None],
        };
        let driver = self.world.name_of(entity).to_owned();
        Limits { driver, is_angle: is_angle.unwrap_or(false), range, stops, text }
    }

    fn limits_of(&self, entity: Entity, found: Option<(DriverRange, bool)>) -> String {
        let name = self.world.name_of(entity);
        let is_motor = match entity {
            Entity::Constraint(id) => {
                self.world.constraint(id).is_some_and(|r| r.constraint.kind() == Kind::Motor)
            }
            _ => false,
        };
        let verb = if is_motor { "turns" } else { "goes" };
        let cannot = |why: String| format!("it cannot be told how far {name} {verb}: {why}");
        if let Some(measured) = self.measured() {
            return cannot(format!("{measured} is measured on the pose"));
        }
        let Some((DriverRange { now, reach, change_points }, is_angle)) = found else {
            return cannot("it drives nothing now".to_owned());
        };
        let manner = Manner { verb, is_angle, n_decimals: n_decimals(now, &reach) };
        let text = match reach {
            Reach::Full(n) => {
                let way = if is_motor { "turns fully" } else { "goes all the way round" };
                let text = format!("{name} {way}");
                if n == 1 { text } else { format!("{text}; the pose comes again after {n} turns") }
            }
            Reach::Between(lower, upper) => format!(
                "{name} {verb} {}, {}; it is at {}",
                self.tell_end(&manner, lower, "from"),
                self.tell_end(&manner, upper, "to"),
                manner.value(now)
            ),
            Reach::Rigid if is_motor => format!("{name} cannot turn: what it drives is rigid"),
            Reach::Rigid => format!("{name} cannot change: what it drives is rigid"),
            Reach::Unsatisfied => cannot("the constraints do not hold now".to_owned()),
            Reach::Open(1) => cannot("another freedom leaves the motion open".to_owned()),
            Reach::Open(n) => cannot(format!("{n} other freedoms leave the motion open")),
            Reach::Nonholonomic => {
                cannot("cog wheels in the velocity form depend on the way".to_owned())
            }
        };
        let mut crossings: Vec<f64> = match reach {
            // All the way round, an angle is as good as a turn later.
            Reach::Full(_) => change_points.into_iter().map(wrap).collect(),
            _ => change_points,
        };
        crossings.sort_by(f64::total_cmp);
        let mut crossings: Vec<String> =
            crossings.into_iter().map(|value| manner.rough(value)).collect();
        crossings.dedup();
        match crossings.len() {
            0 => text,
            1 => format!("{text}; change point at {}", crossings[0]),
            _ => format!("{text}; change points at {}", listed(&crossings, "and")),
        }
    }

    fn tell_end(&self, manner: &Manner, end: RangeEnd, which: &str) -> String {
        let value = manner.value(end.value());
        match end {
            RangeEnd::DeadPoint(_) => format!("{which} {value}, a dead point"),
            RangeEnd::Stop(_, by) => {
                let by = Parts::of(&self.world).ids[by];
                let by = self.world.name_of(Entity::Constraint(by));
                format!("{which} {value}, where {by} stops it")
            }
            RangeEnd::NoValue(_, Some(flaw)) => {
                format!("{which} {value}, beyond which there would be {}", flaw.noun())
            }
            RangeEnd::NoValue(_, None) => {
                format!("{which} {value}, beyond which something has no value")
            }
            RangeEnd::Lost(_) => format!("{which} at least {value}, where the motion was lost"),
            RangeEnd::Endless(_) if manner.verb == "turns" => format!("{which} {value} and on"),
            RangeEnd::Endless(far) => {
                let bound = if which == "to" { "at least" } else { "at most" };
                let value = manner.value(if manner.is_angle { far } else { rounded_in(far) });
                format!("{which} {bound} {value}, where the search ends")
            }
        }
    }

    /// A constraint whose value is an expression over points that move, if there is one.
    fn measured(&self) -> Option<&str> {
        let measured = self.world.constraints().find(|(_, record)| {
            let mut formulas = record.live().iter().map(|(_, formula)| formula);
            record.is_on && formulas.any(|formula| self.world.follows_motion(formula))
        });
        measured.map(|(_, record)| &*record.name)
    }
}

/// How many places behind the point say ten digits of what a value goes through.
fn n_decimals(now: f64, reach: &Reach) -> usize {
    let mut width = match reach {
        Reach::Between(lower, upper) => (upper.value() - lower.value()).abs(),
        _ => now.abs(),
    };
    let mut n_decimals = 9;
    while width >= 10.0 && n_decimals > 0 {
        width *= 0.1;
        n_decimals -= 1;
    }
    while width < 1.0 && width > 0.0 && n_decimals < 15 {
        width *= 10.0;
        n_decimals += 1;
    }
    n_decimals
}

/// The nearest number towards 0 of two digits.
fn rounded_in(value: f64) -> f64 {
    let mut unit = 1.0;
    while (value / unit).abs() >= 100.0 {
        unit *= 10.0;
    }
    while value != 0.0 && (value / unit).abs() < 10.0 {
        unit *= 0.1;
    }
    (value / unit).trunc() * unit
}
