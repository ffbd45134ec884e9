//! What a parameter drives: the values of constraints that follow it, and how fast.

use std::collections::{BTreeMap, BTreeSet};

use super::environments::Here;
use super::evaluate::given;
use super::{
    ConstraintId, Environment, Formula, MeasureId, Mention, ParameterId, PointId, Turning, Value,
    World,
};
use crate::constraint::{ConstraintKind as _, Field, Jet, Real, Vec2};
use crate::diag::{Diagnostic, Span};
use crate::terms::{Member, Statistic};

/// A parameter, and what follows it.
#[derive(Debug, Clone)]
pub struct Driving {
    /// The parameter.
    parameter: ParameterId,
    /// Those that follow it, each after those it mentions.
    parameters: Vec<ParameterId>,
    /// The values of constraints that follow it, constraint by constraint.
    values: Vec<(ConstraintId, Field, Formula)>,
}

impl Driving {
    /// The values of constraints that follow it, constraint by constraint.
    pub fn values(&self) -> impl Iterator<Item = (ConstraintId, Field)> {
        self.values.iter().map(|(id, field, _)| (*id, *field))
    }
}

impl World {
    /// What follows a parameter, of constraints that are switched on.
    pub fn driven_by(&self, parameter: ParameterId) -> Driving {
        let (parameters, constraints) = self.affected(self.dependencies.users(parameter));
        let all: BTreeSet<_> = parameters.iter().copied().chain([parameter]).collect();
        let mut values = Vec::new();
        for &id in &constraints {
            let record = self.constraint(id).expect("a listed constraint lives");
            for (field, formula) in record.live().iter().filter(|_| record.is_on) {
                let mut follows = false;
                formula.mentions(&mut |mention| {
                    follows |= match mention {
                        Mention::Parameter(id) => all.contains(&id),
                        Mention::Member(id, _) => constraints.binary_search(&id).is_ok(),
                        Mention::Point(_) | Mention::Measure(_) => false,
                    };
                });
                if follows {
                    values.push((id, *field, formula.clone()));
                }
            }
        }
        Driving { parameter, parameters, values }
    }

    /// The values that follow a parameter for any value of it, with their derivatives by it.
    ///
    /// # Errors
    /// Where an expression has no value then.
    pub fn driven_values(
        &self,
        driving: &Driving,
        to: f64,
    ) -> Result<Vec<(ConstraintId, Field, Jet)>, Diagnostic> {
        let mut with = WithParameter { world: self, values: BTreeMap::new() };
        with.values.insert(driving.parameter, Value::Number(Jet::new(to, 1.0, 0.0)));
        for &id in &driving.parameters {
            let parameter = self.parameter(id).expect("a listed parameter lives");
            if !parameter.depends.on_rates && !parameter.depends.on_constraints {
                let value = parameter.formula.evaluate(&with)?;
                with.values.insert(id, value);
            }
        }
        let values = driving
            .values
            .iter()
            .map(|(id, field, formula)| Ok((*id, *field, given(*field, formula.evaluate(&with)?))));
        values.collect()
    }
}

/// A world as formulas see it in which parameters have other values than they do, and nothing moves
/// but these.
struct WithParameter<'a> {
    world: &'a World,
    values: BTreeMap<ParameterId, Value<Jet>>,
}

impl Environment<Jet> for WithParameter<'_> {
    fn parameter(&self, id: ParameterId) -> Result<Value<Jet>, Diagnostic> {
        if let Some(value) = self.values.get(&id) {
            return Ok(*value);
        }
        Here::new(self.world, None).parameter(id).map(Value::constant)
    }

    fn position(&self, id: PointId) -> Vec2<Jet> {
        Vec2::constant(self.world.points().at(id).to_vector())
    }

    fn time(&self) -> Jet {
        Jet::constant(self.world.clock().time())
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
        let now = Jet::constant(self.world.member(id, member)?);
        let record = self.world.constraint(id).expect("a mentioned constraint lives");
        // A motor stands where its phase and its turn lead to.
        match (record.constraint.get(Field::Phase), record.driver(Field::Phase)) {
            (Some(phase), Some(formula)) if member == Member::Angle => {
                Ok(now + formula.evaluate(self)?.number() - Jet::constant(phase))
            }
            _ => Ok(now),
        }
    }

    fn statistic(&self, id: MeasureId, which: Statistic, span: Span) -> Result<Jet, Diagnostic> {
        self.world.statistic(id, which, span).map(Jet::constant)
    }

    fn rates(&self, _id: PointId) -> Option<(Vec2<Jet>, Vec2<Jet>)> {
        None
    }
}
