//! What holds of a world, evaluated anew: nothing is asked that the session or the solver keeps
//! from one command to the next.

use linkwork::constraint::{Constraint, ConstraintKind as _, Field, Point, Vec2};
use linkwork::diag::{Diagnostic, Span};
use linkwork::terms::{Member, Statistic};
use linkwork::world::{
    ConstraintId, Environment, MeasureId, ParameterId, PointId, Turning, Value, World,
};

/// A world as its formulas see it: each parameter is what its own formula gives now.
struct Fresh<'a>(&'a World);

impl Environment<f64> for Fresh<'_> {
    fn parameter(&self, id: ParameterId) -> Result<Value, Diagnostic> {
        self.0.parameter(id).expect("a mentioned parameter lives").formula.evaluate(self)
    }

    fn position(&self, id: PointId) -> Vec2<f64> {
        let Point { x, y } = self.0.points().at(id);
        Vec2 { x, y }
    }

    fn time(&self) -> f64 {
        self.0.clock().time()
    }

    fn expected_turn(&self, turning: Turning) -> f64 {
        self.0.turn_count(turning).total()
    }

    fn member(&self, id: ConstraintId, member: Member) -> Result<f64, Diagnostic> {
        let x = self.0.points().column();
        let record = self.0.constraint(id).expect("a mentioned constraint lives");
        if let (Member::Radius, Constraint::Curve(curve)) = (member, record.constraint.stated()) {
            let driver = record.driver(Field::Radius);
            let radius = driver.map(|formula| formula.evaluate(self).map(Value::number));
            return radius.unwrap_or(Ok(curve.radius_at(x)));
        }
        if member == Member::Value {
            let mut at_zero = record.constraint.at(x).into_owned();
            at_zero.set(Field::Lo, 0.0);
            at_zero.set(Field::Hi, 0.0);
            return Ok(at_zero.residual(x));
        }
        match self.0.constraint(id).map(|record| &record.constraint) {
            Some(Constraint::Motor(motor)) if member == Member::Angle => Ok(motor.total()),
            other => unreachable!("{member:?} of {other:?} drives nothing"),
        }
    }

    fn statistic(&self, id: MeasureId, which: Statistic, _: Span) -> Result<f64, Diagnostic> {
        unreachable!("{which:?} of {id:?} drives nothing")
    }

    fn rates(&self, _id: PointId) -> Option<(Vec2<f64>, Vec2<f64>)> {
        None
    }
}

/// What is wrong with a world that is said to be solved to a tolerance, relative to its size:
/// values that are not what their expressions give, and constraints that do not hold.
pub fn flaws(world: &World, tolerance: f64) -> Vec<String> {
    let most = tolerance * size(world);
    let (x, w) = (world.points().column(), world.points().inverse_masses());
    let mut flaws = Vec::new();
    for (_, record) in world.constraints().filter(|(_, record)| record.is_on) {
        // What is measured at the beginning of a frame is none of its end.
        let live = record.live().iter().filter(|(field, formula)| {
            !(matches!(field, Field::Input(_)) && formula.depends().on_points)
        });
        for (field, formula) in live {
            let wanted = match (field, formula.evaluate(&Fresh(world))) {
                (Field::X, Ok(Value::Vector(v))) => v.x,
                (Field::Y, Ok(Value::Vector(v))) => v.y,
                (_, Ok(value)) => value.number(),
                (_, Err(why)) => {
                    flaws.push(format!("{}: {field:?} has no value: {}", record.name, why.message));
                    continue;
                }
            };
            let is = record.constraint.get(*field).expect("what is driven is there");
            if (is - wanted).abs() > most {
                flaws.push(format!("{}: {field:?} is {is}, not {wanted}", record.name));
            }
        }
        let violation = record.constraint.violation(x, &w);
        if violation > most {
            flaws.push(format!("{}: off by {violation:e}, not {most:e}", record.name));
        }
    }
    flaws
}

/// The largest distance to satisfaction of a constraint that is on.
pub fn violation(world: &World) -> f64 {
    let (x, w) = (world.points().column(), world.points().inverse_masses());
    let on = world.constraints().filter(|(_, record)| record.is_on);
    on.map(|(_, record)| record.constraint.violation(x, &w)).fold(0.0, f64::max)
}

/// How far a world extends, and no less than the lengths that are asked for in it.
fn size(world: &World) -> f64 {
    let points = world.points();
    let extent = |of: fn(Point) -> f64| {
        let values = points.ids().map(|p| of(points.at(p)));
        let ends = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), value| {
            (f64::min(lo, value), f64::max(hi, value))
        });
        ends.1 - ends.0
    };
    let asked = world.constraints().map(|(_, record)| match &record.constraint {
        Constraint::Length(c) if c.bounds.hi.is_finite() => c.bounds.hi,
        c @ Constraint::Motor(_) => c.get(Field::Radius).unwrap_or(0.0),
        _ => 0.0,
    });
    asked.fold(extent(|p| p.x).max(extent(|p| p.y)), f64::max)
}
