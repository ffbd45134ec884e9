//! `limits`: how far a motor can turn.

use crate::constraint::geometry::wrap;
use crate::constraint::{ConstraintKind as _, Kind};
use crate::diag::{Diagnostic, format_degrees, listed};
use crate::lang::ast::Name;
use crate::mobility::{MotorRange, RangeEnd, Reach, range};
use crate::session::execution::Execution;
use crate::session::settled::Parts;
use crate::session::state::State;
use crate::world::{ConstraintId, Entity};

impl Execution<'_> {
    pub(crate) fn limits(&mut self, name: &Name) -> Result<(), Diagnostic> {
        let entity = self.resolve().entity(name)?;
        let motor = match entity {
            Entity::Constraint(id) => self.state.world.constraint(id).map(|record| (id, record)),
            _ => None,
        };
        let Some((id, record)) = motor.filter(|(_, r)| r.constraint.kind() == Kind::Motor) else {
            return Err(Diagnostic::error("`limits` asks how far a motor can turn")
                .at(name.span, format!("this is a {}", self.state.noun_of(entity)))
                .help("`list constraints` shows the motors"));
        };
        if !record.is_on {
            let text = format!("{} is switched off", record.name);
            self.host.print(&text);
            return Ok(());
        }
        let text = self.state.limits_of(id);
        self.host.print(&text);
        Ok(())
    }
}

impl State {
    fn noun_of(&self, entity: Entity) -> &'static str {
        match entity {
            Entity::Constraint(id) => {
                self.world.constraint(id).map_or("constraint", |r| r.constraint.traits().word)
            }
            other => other.noun(),
        }
    }

    /// How far a motor that is switched on can turn, the rest held as it is now.
    pub fn range(&self, motor: ConstraintId) -> Option<MotorRange> {
        let subject = self.settled();
        let place = subject.parts.place(motor)?;
        if subject.parts.constraints[place].kind() != Kind::Motor {
            return None;
        }
        let tolerance = subject.slack / subject.size();
        Some(subject.with(|scene| range(scene, place, tolerance)))
    }

    fn limits_of(&self, motor: ConstraintId) -> String {
        let name = self.world.name_of(Entity::Constraint(motor));
        let cannot = |why: String| format!("it cannot be told how far {name} turns: {why}");
        if let Some(measured) = self.measured() {
            return cannot(format!("{measured} is measured on the pose"));
        }
        let Some(MotorRange { now, reach, change_points }) = self.range(motor) else {
            return cannot("it is switched off".to_owned());
        };
        let end = |end: RangeEnd, which: &str| match end {
            RangeEnd::DeadPoint(angle) => {
                format!("{which} {}, a dead point", format_degrees(angle))
            }
            RangeEnd::Stop(angle, by) => {
                let by = Parts::of(&self.world).ids[by];
                let by = self.world.name_of(Entity::Constraint(by));
                format!("{which} {}, where {by} stops it", format_degrees(angle))
            }
            RangeEnd::Lost(angle) => {
                format!("{which} at least {}, where the motion was lost", format_degrees(angle))
            }
            RangeEnd::Endless(angle) => format!("{which} {} and on", format_degrees(angle)),
        };
        let text = match reach {
            Reach::Full(1) => format!("{name} turns fully"),
            Reach::Full(n) => format!("{name} turns fully; the pose comes again after {n} turns"),
            Reach::Between(lower, upper) => format!(
                "{name} turns {}, {}; it is at {}",
                end(lower, "from"),
                end(upper, "to"),
                format_degrees(now)
            ),
            Reach::Rigid => format!("{name} cannot turn: what it drives is rigid"),
            Reach::Unsatisfied => cannot("the constraints do not hold now".to_owned()),
            Reach::Open(1) => cannot("another freedom leaves the motion open".to_owned()),
            Reach::Open(n) => cannot(format!("{n} other freedoms leave the motion open")),
            Reach::Nonholonomic => {
                cannot("cog wheels in the velocity form depend on the way".to_owned())
            }
        };
        let mut angles: Vec<f64> = match reach {
            // All the way round, an angle is as good as a turn later.
            Reach::Full(_) => change_points.into_iter().map(wrap).collect(),
            _ => change_points,
        };
        angles.sort_by(f64::total_cmp);
        // They are known to some 1e-8.
        let rounded = |angle: f64| ((angle.to_degrees() * 1e6).round() / 1e6).to_radians();
        let mut angles: Vec<String> = angles.into_iter().map(rounded).map(format_degrees).collect();
        angles.dedup();
        match angles.len() {
            0 => text,
            1 => format!("{text}; change point at {}", angles[0]),
            _ => format!("{text}; change points at {}", listed(&angles, "and")),
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
