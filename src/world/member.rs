//! What the members of things are worth: `crank.angle`, `coupler.value`, `coupler.residual`.

use super::environments::Here;
use super::{ConstraintId, Depends, Environment, Formula, Mention, PointId, World};
use crate::constraint::geometry::wrap;
use crate::constraint::{
    Carried, Constraint, ConstraintKind as _, Curve, Field, Quantity, Real, length,
};
use crate::diag::Diagnostic;
use crate::terms::Member;

impl World {
    /// The first member that a formula mentions, at any depth, and that follows from the
    /// constraints.
    pub fn following_member(&self, formula: &Formula) -> Option<(ConstraintId, Member)> {
        let mut found = None;
        if self.depends(formula).on_constraints {
            formula.mentions(&mut |mention| {
                found = found.or(match mention {
                    Mention::Member(id, member) => member.follows().then_some((id, member)),
                    Mention::Parameter(id) => {
                        self.parameter(id).and_then(|p| self.following_member(&p.formula))
                    }
                    Mention::Point(_) => None,
                });
            });
        }
        found
    }

    /// Whether a constraint has a member.
    pub fn has_member(&self, id: ConstraintId, member: Member) -> bool {
        let traits = self.constraint(id).map(|record| record.constraint.traits());
        traits.is_some_and(|traits| match member {
            Member::Angle => traits.carried == Carried::ByClock,
            Member::Value => traits.bounds.is_some(),
            Member::Residual => true,
            Member::Radius => self.curve(id).is_some(),
        })
    }

    /// The value of a member that a constraint has, now.
    ///
    /// # Errors
    /// Where a live value of the constraint has none now.
    pub(super) fn member(&self, id: ConstraintId, member: Member) -> Result<f64, Diagnostic> {
        let record = self.constraint(id).expect("a mentioned constraint lives");
        let x = self.points.column();
        Ok(match member {
            Member::Angle => self.motor_angle(id),
            Member::Radius => self.radius(id, &Here::new(self, None))?,
            Member::Value => {
                // What it measures is what is left of it where 0 is asked for.
                let mut at_zero = record.constraint.at(x).into_owned();
                at_zero.set(Field::Lo, 0.0);
                at_zero.set(Field::Hi, 0.0);
                let value = at_zero.residual(x);
                let is_angle = at_zero.traits().quantity == Quantity::Angle;
                if is_angle { wrap(value) } else { value }
            }
            Member::Residual if record.live().is_empty() => record.constraint.residual(x),
            Member::Residual => {
                let mut now = record.clone();
                now.drive(&Here::new(self, None))?;
                now.constraint.residual(x)
            }
        })
    }

    /// The circle or arc that a constraint is, if it is one.
    pub fn curve(&self, id: ConstraintId) -> Option<&Curve> {
        match self.constraint(id)?.constraint.stated() {
            Constraint::Curve(curve) => Some(curve),
            _ => None,
        }
    }

    /// The radius of a circle or an arc, over any kind of number.
    ///
    /// # Errors
    /// Where its expression has no value now.
    pub(super) fn radius<T: Real>(
        &self,
        id: ConstraintId,
        env: &impl Environment<T>,
    ) -> Result<T, Diagnostic> {
        let curve = self.curve(id).expect("only a circle or an arc has a radius");
        let at = |p: u32| env.position(PointId(p));
        Ok(match *curve {
            Curve::Circle { radius, .. } => match self.radius_driver(id) {
                Some(formula) => formula.evaluate(env)?.number(),
                None => T::constant(radius),
            },
            Curve::Through { points: [o, p] } | Curve::Arc { points: [o, p, _] } => {
                length(at(p) - at(o))
            }
        })
    }

    /// The radius of a circle or an arc in the present pose; 0 where its expression has no value.
    pub fn radius_now(&self, id: ConstraintId) -> f64 {
        self.radius(id, &Here::new(self, None)).unwrap_or_default()
    }

    /// The expression behind the radius of a circle, if there is one.
    pub(super) fn radius_driver(&self, id: ConstraintId) -> Option<&Formula> {
        self.constraint(id)?.driver(Field::Radius)
    }

    /// What can change the radius of a circle or an arc.
    pub(super) fn radius_depends(&self, id: ConstraintId) -> Depends {
        let measured = Depends { on_points: true, ..Depends::default() };
        match self.curve(id) {
            Some(Curve::Circle { .. }) => {
                self.radius_driver(id).map_or_else(Depends::default, |f| self.depends(f))
            }
            _ => measured,
        }
    }

    /// The angle of a motor with its phase, whole turns included, radians.
    pub(super) fn motor_angle(&self, id: ConstraintId) -> f64 {
        match self.constraint(id).map(|record| record.constraint.stated()) {
            Some(Constraint::Motor(motor)) => motor.total(),
            _ => unreachable!("only a motor has an angle"),
        }
    }
}
