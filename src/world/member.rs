//! What the members of things are worth: `crank.angle`, `coupler.value`, `coupler.residual`.

use super::environments::Here;
use super::{ConstraintId, Formula, Mention, World};
use crate::constraint::geometry::wrap;
use crate::constraint::{Carried, Constraint, ConstraintKind as _, Field, Quantity};
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

    /// The angle of a motor with its phase, whole turns included, radians.
    pub(super) fn motor_angle(&self, id: ConstraintId) -> f64 {
        match self.constraint(id).map(|record| record.constraint.stated()) {
            Some(Constraint::Motor(motor)) => motor.total(),
            _ => unreachable!("only a motor has an angle"),
        }
    }
}
