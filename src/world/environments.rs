//! What formulas see of a world: values now, or values with their derivatives in time.

use std::collections::BTreeMap;

use super::{ConstraintId, Environment, MeasureId, ParameterId, PointId, Turning, Value, World};
use crate::constraint::{ConstraintKind as _, Field, Jet, Real, Vec2, Vector};
use crate::diag::{Diagnostic, Span};
use crate::errors;
use crate::terms::{Member, Statistic};

/// Velocities and accelerations of all points, by handle.
#[derive(Debug, Clone, Default)]
pub struct Rates {
    /// Rates of change, per time unit.
    pub velocity: Vec<Vector>,
    /// Second derivatives, per time unit squared.
    pub acceleration: Vec<Vector>,
}

/// A world as formulas see it, with rates where they were computed.
pub(super) struct Here<'a> {
    world: &'a World,
    rates: Option<&'a Rates>,
    /// What parameters that depend on rates came to; none without rates.
    values: Option<BTreeMap<ParameterId, Result<Value, Diagnostic>>>,
}

impl<'a> Here<'a> {
    /// The world as it stands, live parameters being up to date. Without `rates` what
    /// mentions a velocity has no value.
    pub fn new(world: &'a World, rates: Option<&'a Rates>) -> Self {
        let mut here = Self { world, rates, values: None };
        if rates.is_some() {
            for &id in world.dependencies.order() {
                let parameter = world.parameter(id).expect("a listed parameter lives");
                if parameter.depends.on_rates {
                    let value = parameter.formula.evaluate(&here);
                    here.values.get_or_insert_default().insert(id, value);
                }
            }
        }
        here
    }
}

impl Environment<f64> for Here<'_> {
    fn parameter(&self, id: ParameterId) -> Result<Value, Diagnostic> {
        let parameter = self.world.parameter(id).expect("a mentioned parameter lives");
        if let Some(value) = parameter.value {
            return Ok(value);
        }
        if let Some(value) = self.values.as_ref().and_then(|values| values.get(&id)) {
            return value.clone();
        }
        if parameter.depends.on_measures && !parameter.depends.on_rates {
            // It says what it waits for.
            return parameter.formula.evaluate(self);
        }
        Err(self.world.dependencies.failure(id).cloned().unwrap_or_else(|| {
            Diagnostic::error(
                errors::NOT_A_DRIVER,
                format!("`{}` follows from a velocity", parameter.name),
            )
            .at(parameter.formula.span(), "a velocity cannot be had here")
            .help("use it in `print`, `assert`, or a parameter that these use")
        }))
    }

    fn position(&self, id: PointId) -> Vec2<f64> {
        let p = self.world.points.at(id);
        Vec2 { x: p.x, y: p.y }
    }

    fn time(&self) -> f64 {
        self.world.clock.time()
    }

    fn expected_turn(&self, turning: Turning) -> f64 {
        self.world.expected_turn(turning)
    }

    fn member(&self, id: ConstraintId, member: Member) -> Result<f64, Diagnostic> {
        self.world.member(id, member)
    }

    fn statistic(&self, id: MeasureId, which: Statistic, span: Span) -> Result<f64, Diagnostic> {
        self.world.statistic(id, which, span)
    }

    fn rates(&self, id: PointId) -> Option<(Vec2<f64>, Vec2<f64>)> {
        let rates = self.rates?;
        let at = |rates: &[Vector]| rates.get(id.idx()).copied().unwrap_or_default();
        let (v, a) = (at(&rates.velocity), at(&rates.acceleration));
        Some((Vec2 { x: v.x, y: v.y }, Vec2 { x: a.x, y: a.y }))
    }
}

/// A world at an instant within a frame as formulas see it: time, and what time changes, as they
/// are then; the pose and what is measured on it as they are now.
pub(super) struct Within<'a> {
    world: &'a World,
    time: f64,
    values: BTreeMap<ParameterId, Value>,
}

impl<'a> Within<'a> {
    /// The world as it stands, live parameters being up to date, but for the time.
    pub fn new(world: &'a World) -> Self {
        Self { world, time: world.clock.time(), values: BTreeMap::new() }
    }

    /// Goes to an instant, with these parameters, each after those it mentions.
    ///
    /// # Errors
    /// Where one has no value then.
    pub fn go_to(&mut self, time: f64, parameters: &[ParameterId]) -> Result<(), Diagnostic> {
        self.time = time;
        self.values.clear();
        for &id in parameters {
            let parameter = self.world.parameter(id).expect("a listed parameter lives");
            let value = parameter.formula.evaluate(self)?;
            self.values.insert(id, value);
        }
        Ok(())
    }
}

impl Environment<f64> for Within<'_> {
    fn parameter(&self, id: ParameterId) -> Result<Value, Diagnostic> {
        match self.values.get(&id) {
            Some(value) => Ok(*value),
            None => Here::new(self.world, None).parameter(id),
        }
    }

    fn position(&self, id: PointId) -> Vec2<f64> {
        Here::new(self.world, None).position(id)
    }

    fn time(&self) -> f64 {
        self.time
    }

    fn expected_turn(&self, turning: Turning) -> f64 {
        self.world.expected_turn(turning)
    }

    fn member(&self, id: ConstraintId, member: Member) -> Result<f64, Diagnostic> {
        self.world.member(id, member)
    }

    fn statistic(&self, id: MeasureId, which: Statistic, span: Span) -> Result<f64, Diagnostic> {
        self.world.statistic(id, which, span)
    }

    fn rates(&self, _id: PointId) -> Option<(Vec2<f64>, Vec2<f64>)> {
        None
    }
}

/// A world in motion as formulas see it: everything with its derivatives in time.
pub(super) struct Moving<'a> {
    world: &'a World,
    rates: &'a Rates,
    values: BTreeMap<ParameterId, Result<Value<Jet>, Diagnostic>>,
    /// The angles of motors; to first order where they are not listed.
    angles: BTreeMap<ConstraintId, Jet>,
}

impl<'a> Moving<'a> {
    /// The world as it stands, live parameters being up to date, with the rates of its points.
    pub fn new(world: &'a World, rates: &'a Rates) -> Self {
        let first_order = Self::with_angles(world, rates, BTreeMap::new());
        if !world.dependencies.has_members() {
            return first_order;
        }
        // A speed changes with what the angles do to first order, its own motor's included.
        let used = world.dependencies.with_member_users().into_iter();
        let motors = used.filter(|id| world.has_member(*id, Member::Angle));
        let angles = motors.map(|id| (id, first_order.angle(id)));
        Self::with_angles(world, rates, angles.collect())
    }

    fn with_angles(
        world: &'a World,
        rates: &'a Rates,
        angles: BTreeMap<ConstraintId, Jet>,
    ) -> Self {
        let mut moving = Self { world, rates, values: BTreeMap::new(), angles };
        for &id in world.dependencies.order() {
            let parameter = world.parameter(id).expect("a listed parameter lives");
            if !parameter.depends.on_rates && !parameter.depends.on_constraints {
                let value = parameter.formula.evaluate(&moving);
                moving.values.insert(id, value);
            }
        }
        moving
    }

    /// The angle of a motor with two derivatives, of a world that has one.
    fn angle(&self, id: ConstraintId) -> Jet {
        let record = self.world.constraint(id).expect("a mentioned constraint lives");
        let rate = |field| {
            let now = Jet::constant(record.constraint.get(field).unwrap_or_default());
            let value = record.driver(field).map(|formula| formula.evaluate(self));
            // One that has no value now has said so where it drives.
            value.and_then(Result::ok).map_or(now, Value::number)
        };
        let (speed, phase) = (rate(Field::Speed), rate(Field::Phase));
        let turning = if record.is_on { speed } else { Jet::default() };
        let total = self.world.motor_angle(id);
        Jet::new(total, turning.v + phase.d, turning.d + phase.dd)
    }
}

impl Environment<Jet> for Moving<'_> {
    fn parameter(&self, id: ParameterId) -> Result<Value<Jet>, Diagnostic> {
        if let Some(value) = self.values.get(&id) {
            return value.clone();
        }
        Here::new(self.world, None).parameter(id).map(Value::constant)
    }

    fn position(&self, id: PointId) -> Vec2<Jet> {
        let p = self.world.points.at(id);
        let at = |rates: &[Vector]| rates.get(id.idx()).copied().unwrap_or_default();
        let (v, a) = (at(&self.rates.velocity), at(&self.rates.acceleration));
        Vec2 { x: Jet::new(p.x, v.x, a.x), y: Jet::new(p.y, v.y, a.y) }
    }

    fn time(&self) -> Jet {
        Jet::new(self.world.clock.time(), 1.0, 0.0)
    }

    fn expected_turn(&self, turning: Turning) -> f64 {
        self.world.expected_turn(turning)
    }

    fn member(&self, id: ConstraintId, member: Member) -> Result<Jet, Diagnostic> {
        match member {
            Member::Radius => return self.world.radius(id, self),
            Member::Value => return Ok(self.world.measured_by(id).evaluate(self)?.number()),
            Member::Angle | Member::Residual => {}
        }
        debug_assert_eq!(member, Member::Angle, "the others drive nothing");
        Ok(self.angles.get(&id).copied().unwrap_or_else(|| {
            let record = self.world.constraint(id).expect("a mentioned constraint lives");
            let speed = record.constraint.get(Field::Speed).filter(|_| record.is_on);
            Jet::new(self.world.motor_angle(id), speed.unwrap_or_default(), 0.0)
        }))
    }

    fn statistic(&self, id: MeasureId, which: Statistic, span: Span) -> Result<Jet, Diagnostic> {
        self.world.statistic(id, which, span).map(Jet::constant)
    }

    fn rates(&self, _id: PointId) -> Option<(Vec2<Jet>, Vec2<Jet>)> {
        None
    }
}
