//! What can drive a mechanism: a motor, the value of a constraint, a parameter; and why not where not.

use crate::constraint::{Activity, Carried, Constraint, ConstraintKind as _, Field, Jet, Quantity};
use crate::diag::{format_decimals, format_degrees};
use crate::lang::catalogue::Slot;
use crate::mobility::{ConstraintSystem, Driven, Driver};
use crate::session::resolve::said::pattern_of;
use crate::session::settled::Settled;
use crate::session::state::State;
use crate::terms::Shape;
use crate::world::{ConstraintId, Driving, Entity, ParameterId, Record, World};

/// What drives.
#[derive(Debug, Clone)]
pub(super) enum Source {
    /// Values of a constraint, all alike; whether they are an angle.
    Values(ConstraintId, &'static [Field], bool),
    /// A parameter, by what follows it.
    Parameter(ParameterId, Driving),
}

/// Why something drives nothing.
#[derive(Debug)]
pub(super) struct NoDriver {
    /// What is wrong.
    pub message: String,
    /// What stands at its name.
    pub label: String,
    /// What to do instead.
    pub help: Option<String>,
}

impl NoDriver {
    fn new(message: String, label: impl Into<String>) -> Self {
        Self { message, label: label.into(), help: None }
    }

    fn help(self, help: impl Into<String>) -> Self {
        Self { help: Some(help.into()), ..self }
    }
}

impl State {
    /// What of an entity could drive the mechanism.
    pub(super) fn driver(&self, entity: Entity) -> Result<Source, NoDriver> {
        match entity {
            Entity::Point(_) | Entity::Measure(_) => {
                let message = "`limits` asks how far something that drives can go".to_owned();
                let help =
                    "name a motor, a constraint with a value, or a parameter that one follows";
                let label = format!("this is a {}", entity.noun());
                Err(NoDriver::new(message, label).help(help))
            }
            Entity::Constraint(id) => {
                let record = self.world.constraint(id).expect("a named constraint lives");
                let (fields, is_angle) = driving_values(&self.world, id, record)?;
                Ok(Source::Values(id, fields, is_angle))
            }
            Entity::Parameter(id) => {
                let driving = driving_parameter(&self.world, id)?;
                Ok(Source::Parameter(id, driving))
            }
        }
    }
}

/// The values of a constraint that drive, and whether they are an angle.
fn driving_values(
    world: &World,
    id: ConstraintId,
    record: &Record,
) -> Result<(&'static [Field], bool), NoDriver> {
    let (name, traits) = (&record.name, record.constraint.traits());
    if traits.carried == Carried::ByClock {
        return Ok((&[Field::Phase], true));
    }
    if traits.is_wheel {
        let message = format!("`{name}` says how far one wheel turns for another");
        return Err(NoDriver::new(message, "no pose follows from a ratio of wheels")
            .help("ask of a motor that turns one of them"));
    }
    let is_measured = |field| record.driver(field).is_some_and(|f| world.depends(f).on_points);
    let fields: &[Field] = if record.constraint.get(Field::Ratio).is_some() {
        &[Field::Ratio]
    } else if traits.bounds.is_some() {
        &[Field::Lo, Field::Hi]
    } else if record.constraint.get(Field::Radius).is_some() {
        let message = format!("the radius of `{name}` drives through a parameter only");
        return Err(NoDriver::new(message, format!("this is a {}", traits.word))
            .help("name the radius by a parameter, as in `let r = 2`, and ask of that"));
    } else if record.constraint.get(Field::X).is_some() {
        let message = format!("`{name}` asks for a vector, and what drives is a number");
        return Err(NoDriver::new(message, format!("this is a {}", traits.word))
            .help("name a coordinate of it by a parameter, and ask of that"));
    } else {
        let message = format!("`{name}` has no value that could drive");
        let known = pattern_of(&record.constraint).slots.contains(&Slot::Measure);
        let what = if known { "expression" } else { traits.word };
        return Err(NoDriver::new(message, format!("this is a {what}"))
            .help("name a motor, a constraint with a value, or a parameter that one follows"));
    };
    if fields.iter().any(|field| is_measured(*field)) {
        let message = format!("the value of `{name}` follows the pose");
        return Err(NoDriver::new(message, "it is measured, so nothing sets it")
            .help("name a factor or a summand of it by a parameter, and ask of that"));
    }
    if fields == [Field::Lo, Field::Hi] && traits.activity == Activity::Outside {
        let now = world.measured_value(id).unwrap_or_default();
        let is_angle = traits.quantity == Quantity::Angle;
        let value =
            if is_angle { format_degrees(now).replace(' ', "") } else { format_decimals(now, 9) };
        let message = format!("`{name}` allows a range, and what drives is one value");
        return Err(NoDriver::new(message, "it drives nothing")
            .help(format!("`change {name} = {value}` makes it a value, the present one")));
    }
    Ok((fields, fields[0] == Field::Lo && traits.quantity == Quantity::Angle))
}

/// What follows a parameter.
fn driving_parameter(world: &World, id: ParameterId) -> Result<Driving, NoDriver> {
    let parameter = world.parameter(id).expect("a named parameter lives");
    let name = &parameter.name;
    let depends = parameter.depends;
    if depends.on_points || depends.on_rates || depends.on_constraints {
        let message = format!("`{name}` follows the pose");
        return Err(NoDriver::new(message, "it is measured, so nothing sets it")
            .help("ask of a parameter that is a number"));
    }
    if parameter.value.is_some_and(|value| value.shape() == Shape::Vector) {
        let message = format!("`{name}` is a vector, and what drives is a number");
        return Err(NoDriver::new(message, "two numbers")
            .help("name a coordinate of it by a parameter, and ask of that"));
    }
    let driving = world.driven_by(id);
    for (constraint, field) in driving.values() {
        let record = world.constraint(constraint).expect("a listed constraint lives");
        let what = match field {
            Field::Speed => "the speed of",
            _ if record.constraint.traits().is_wheel => "how the wheels turn of",
            _ => continue,
        };
        let message = format!("`{name}` says {what} `{}`", record.name);
        return Err(
            NoDriver::new(message, "no pose follows from it").help("ask of a motor that turns")
        );
    }
    if driving.values().next().is_none() {
        let message = format!("no constraint that is switched on follows `{name}`");
        return Err(NoDriver::new(message, "it drives nothing")
            .help(format!("state a value by it, as in `length A B = {name}`")));
    }
    Ok(driving)
}

impl Source {
    /// The driver that it is of a scene at rest, if all that it drives is there.
    pub fn of<'a>(
        &'a self,
        subject: &'a Settled,
        scene: &ConstraintSystem<'a>,
    ) -> Option<Driver<'a>> {
        match self {
            Self::Values(id, fields, is_angle) => {
                let place = subject.parts.place(*id)?;
                let constraint = scene.constraints[place];
                let now = match constraint.stated() {
                    Constraint::Motor(motor) => motor.angle(),
                    _ => constraint.get(fields[0])?,
                };
                Some(Driver::of_values(constraint, place, fields, now, *is_angle))
            }
            Self::Parameter(id, driving) => {
                let now = subject.world.parameter(*id)?.value?.number();
                let values = move |by: f64| {
                    let all = subject.world.driven_values(driving, now + by).ok()?;
                    let driven = |(id, field, value): (ConstraintId, Field, Jet)| {
                        Some(Driven { constraint: subject.parts.place(id)?, field, value })
                    };
                    all.into_iter().map(driven).collect::<Option<Vec<_>>>()
                };
                let start = values(0.0)?;
                let turns = |driven: &&Driven| {
                    let traits = scene.constraints[driven.constraint].traits();
                    let is_end = matches!(driven.field, Field::Lo | Field::Hi);
                    let is_angle = is_end && traits.quantity == Quantity::Angle;
                    driven.value.d.abs() == 1.0 && (driven.field == Field::Phase || is_angle)
                };
                let is_angle = start.iter().all(|driven| turns(&driven));
                let places = start.iter().map(|driven| driven.constraint).collect();
                Some(Driver::new(places, now, is_angle, values))
            }
        }
    }
}
