//! What the members of things are worth: `crank.angle`, `coupler.value`, `coupler.residual`.

use std::collections::{BTreeSet, VecDeque};

use super::environments::Here;
use super::{ConstraintId, Depends, Environment, Extent, Formula, Mention, Node, PointId, World};
use crate::constraint::{
    Carried, Constraint, ConstraintKind as _, Curve, Equal, Field, Real, length,
};
use crate::diag::Diagnostic;
use crate::terms::{Function, Member, Operator, Shape};

impl World {
    /// A member that a formula mentions, at any depth, and that follows from the constraints.
    pub fn following_member(&self, formula: &Formula) -> Option<(ConstraintId, Member)> {
        // Few do, and that is known without a walk.
        let may_be = self.depends(formula).on_constraints;
        if may_be { self.find_member(formula, Member::follows) } else { None }
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
            Member::Value => self.measured_by(id).evaluate(&Here::new(self, None))?.number(),
            Member::Residual if record.live().is_empty() => record.constraint.residual(x),
            Member::Residual => {
                let mut now = record.clone();
                now.drive(&Here::new(self, None))?;
                now.constraint.residual(x)
            }
        })
    }

    /// What a constraint measures now, that is stated by what it measures.
    pub fn measured_value(&self, id: ConstraintId) -> Option<f64> {
        self.has_member(id, Member::Value).then(|| self.member(id, Member::Value).ok()).flatten()
    }

    /// What a constraint measures, as a formula.
    pub(super) fn measured_by(&self, id: ConstraintId) -> Formula {
        let record = self.constraint(id).expect("a mentioned constraint lives");
        let depends = Depends { on_points: true, ..Depends::default() };
        let new = |node, shape| Formula::without_place(node, shape, depends);
        let call = |function, points: &[u32]| {
            let points = points.iter().map(|&p| new(Node::Point(PointId(p)), Shape::Vector));
            new(Node::Call(function, points.collect()), Shape::Number)
        };
        match record.constraint.stated() {
            Constraint::Length(c) => call(Function::Distance, &c.points),
            Constraint::Distance(c) => call(Function::DistanceToLine, &c.points),
            Constraint::Orientation(c) => call(Function::AngleBetween, &c.points),
            Constraint::Equal(Equal { points: [a, b, c, d], ratio, .. }) => {
                let [first, second] = [[*a, *b], [*c, *d]].map(|p| call(Function::Distance, &p));
                let driver = record.driver(Field::Ratio).cloned();
                let ratio = driver.unwrap_or_else(|| Formula::constant(*ratio));
                let second = new(Node::Binary(Operator::Multiply, second, ratio), Shape::Number);
                new(Node::Binary(Operator::Subtract, first, second), Shape::Number)
            }
            other => {
                let value = || Formula::constant(other.get(Field::Value).unwrap_or_default());
                record.driver(Field::Value).cloned().unwrap_or_else(value)
            }
        }
    }

    /// Whether a formula mentions a member of a constraint, at any depth.
    pub fn mentions_members(&self, formula: &Formula) -> bool {
        self.find_member(formula, |_| true).is_some()
    }

    /// A member of the kind that is looked for that a formula mentions, at any depth; of several the
    /// first by the fewest parameters on the way.
    fn find_member(
        &self,
        formula: &Formula,
        is_one: impl Fn(Member) -> bool,
    ) -> Option<(ConstraintId, Member)> {
        // Each parameter is looked at once: those that mention others twice would double.
        let mut seen = BTreeSet::new();
        let mut open = VecDeque::from([formula.clone()]);
        let mut found = None;
        while let Some(formula) = open.pop_front().filter(|_| found.is_none()) {
            formula.mentions(&mut |mention| match mention {
                Mention::Member(id, member) if is_one(member) => {
                    found = found.or(Some((id, member)));
                }
                Mention::Parameter(id) if seen.insert(id) => {
                    open.extend(self.parameter(id).map(|parameter| parameter.formula.clone()));
                }
                Mention::Member(..)
                | Mention::Parameter(_)
                | Mention::Point(_)
                | Mention::Measure(_) => {}
            });
        }
        found
    }

    /// How long and how deep a formula is with all that the members in it stand for; none where that
    /// is more than `most`.
    pub fn extent_within(&self, formula: &Formula, most: Extent) -> Option<Extent> {
        let Extent { mut n_terms, depth } = formula.extent();
        if n_terms > most.n_terms || depth > most.depth {
            return None;
        }
        let mut members = Vec::new();
        formula.mentions(&mut |mention| {
            if let Mention::Member(id, member) = mention {
                members.push((id, member));
            }
        });
        members.sort_unstable_by_key(|(id, member)| (*id, *member as u8));
        let mut deepest = 0;
        for mentions in members.chunk_by(|a, b| a == b) {
            let (id, member) = mentions[0];
            let behind = match member {
                Member::Radius => self.radius_driver(id).cloned(),
                Member::Value => Some(self.measured_by(id)),
                Member::Angle | Member::Residual => None,
            };
            let Some(behind) = behind else { continue };
            let n_left = (most.n_terms - n_terms) / mentions.len() as u32;
            let most = Extent { n_terms: n_left, depth: most.depth - depth };
            let extent = self.extent_within(&behind, most)?;
            n_terms += extent.n_terms * mentions.len() as u32;
            deepest = deepest.max(extent.depth);
        }
        Some(Extent { n_terms, depth: depth + deepest })
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
