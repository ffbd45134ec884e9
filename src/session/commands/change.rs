//! `change`: any trailing part of the statement that made a thing.

use super::constrain::{Measure, cog_ratio, not_negative};
use crate::constraint::{Constraint, ConstraintKind as _, Field, Glider, Period, Rack};
use crate::diag::Diagnostic;
use crate::lang::ast::{ChangePart, Name, Relation};
use crate::session::execution::Execution;
use crate::session::resolve::scope::Resolver;
use crate::world::{ConstraintId, Drivers, Edit, Entity, Record};

impl Execution<'_> {
    pub(crate) fn change_thing(
        &mut self,
        name: &Name,
        parts: &[ChangePart],
    ) -> Result<(), Diagnostic> {
        match self.resolve().entity(name)? {
            Entity::Constraint(id) => self.change_constraint(id, name, parts),
            Entity::Parameter(id) => match parts {
                [ChangePart::Relation(Relation::Equal(value))] => {
                    let formula = self.resolve().live(value)?.into_formula(value.span);
                    self.redefine(id, formula, value)
                }
                _ => Err(self.resolve().no_such_part(name, "a parameter takes `= value`")),
            },
            Entity::Point(id) => match parts {
                [ChangePart::Relation(Relation::Equal(at))] => {
                    let at = self.resolve().place(at)?;
                    self.edit(Edit::Move(id, at));
                    Ok(())
                }
                _ => Err(self.resolve().no_such_part(name, "a point takes `= (x, y)`")),
            },
        }
    }

    fn change_constraint(
        &mut self,
        id: ConstraintId,
        name: &Name,
        parts: &[ChangePart],
    ) -> Result<(), Diagnostic> {
        let mut record = self.state.world.constraint(id).expect("a named constraint lives").clone();
        // A line says whether a glider is bounded unless another part does.
        let (lines, others): (Vec<_>, Vec<_>) =
            parts.iter().partition(|part| matches!(part, ChangePart::On(_) | ChangePart::To(_)));
        for part in lines.into_iter().chain(others) {
            self.resolve().change_part(&mut record, name, part)?;
        }
        let is_on_another_line = parts.iter().any(|part| matches!(part, ChangePart::On(_)));
        if let Constraint::Rack(rack) = &record.constraint
            && is_on_another_line
            && self.state.world.clock().frame > 0
        {
            let points = self.state.world.points();
            let at_start = Rack::new(rack.points, points.start_column()).into();
            self.edit(self.state.world.begin_with(id, &at_start));
        }
        self.edit(Edit::Constraint(id, Some(Box::new(record))));
        Ok(())
    }
}

impl Resolver<'_> {
    fn no_such_part(&self, name: &Name, takes: &str) -> Diagnostic {
        let what = self.text(name.span);
        Diagnostic::error(format!("`{what}` has no such part")).at(name.span, takes)
    }

    fn change_part(
        &mut self,
        record: &mut Record,
        name: &Name,
        part: &ChangePart,
    ) -> Result<(), Diagnostic> {
        let mut drivers = Drivers::new();
        let changed: &[Field] = match (&mut record.constraint, part) {
            (Constraint::Length(c), ChangePart::Relation(relation)) => {
                c.bounds = self.bounds(relation, Measure::Length, &mut drivers)?;
                &[Field::Lo, Field::Hi]
            }
            (Constraint::Equal(c), ChangePart::Relation(relation)) => {
                c.bounds = self.bounds(relation, Measure::Signed, &mut drivers)?;
                &[Field::Lo, Field::Hi]
            }
            (Constraint::Distance(c), ChangePart::Relation(relation)) => {
                c.bounds = self.bounds(relation, Measure::Signed, &mut drivers)?;
                &[Field::Lo, Field::Hi]
            }
            (Constraint::Orientation(c), ChangePart::Relation(relation))
                if c.period == Period::Whole =>
            {
                c.bounds = self.bounds(relation, Measure::Angle, &mut drivers)?;
                &[Field::Lo, Field::Hi]
            }
            (c @ Constraint::Motor(_), ChangePart::Radius(e)) => {
                let value = self.drive(e, Field::Radius, &mut drivers)?;
                not_negative(value, "a radius", e.span)?;
                c.set(Field::Radius, value);
                &[Field::Radius]
            }
            (c @ Constraint::Motor(_), ChangePart::Speed(e)) => {
                c.set(Field::Speed, self.drive(e, Field::Speed, &mut drivers)?);
                &[Field::Speed]
            }
            (c @ Constraint::Motor(_), ChangePart::Phase(e)) => {
                c.set(Field::Phase, self.drive(e, Field::Phase, &mut drivers)?);
                &[Field::Phase]
            }
            (Constraint::Hinge(c), ChangePart::At(e) | ChangePart::Ratio(e)) => {
                c.ratio = self.drive(e, Field::Ratio, &mut drivers)?;
                &[Field::Ratio]
            }
            (Constraint::Coordinate(c), ChangePart::At(e)) => {
                c.target = self.target(e, &mut drivers)?;
                &[Field::X, Field::Y]
            }
            (c @ (Constraint::Cog(_) | Constraint::CogVelocity(_)), ChangePart::Ratio(e)) => {
                let value = self.drive(e, Field::Ratio, &mut drivers)?;
                c.set(Field::Ratio, cog_ratio(value, false, e.span)?);
                &[Field::Ratio]
            }
            (c @ (Constraint::Cog(_) | Constraint::CogVelocity(_)), ChangePart::Inside) => {
                let ratio = c.get(Field::Ratio).unwrap_or(1.0);
                c.set(Field::Ratio, -ratio.abs());
                &[]
            }
            (Constraint::Glider(c), ChangePart::Unbounded) => {
                c.bounded = false;
                &[]
            }
            (Constraint::Glider(c), ChangePart::On(line)) => {
                let [a, b] = self.pair(line)?;
                *c = Glider { points: [c.points[0], a, b], bounded: true };
                &[]
            }
            (Constraint::Hinge(c), ChangePart::On(line)) => {
                let [a, b] = self.pair(line)?;
                c.points = [c.points[0], a, b];
                &[]
            }
            (Constraint::Distance(c), ChangePart::To(line)) => {
                let [a, b] = self.pair(line)?;
                c.points = [c.points[0], a, b];
                &[]
            }
            (Constraint::Rack(c), ChangePart::On(line)) => {
                let [p, q] = self.pair(line)?;
                let [o, a, ..] = c.points;
                *c = Rack::new([o, a, p, q], self.state.world.points().column());
                &[]
            }
            (c, _) => {
                let takes = takes(c);
                return Err(self.no_such_part(name, takes));
            }
        };
        record.replace_drivers(changed, drivers);
        Ok(())
    }
}

/// What can be changed of a constraint, for a message.
fn takes(constraint: &Constraint) -> &'static str {
    match constraint {
        Constraint::Length(_) | Constraint::Equal(_) => {
            "this takes `= value`, `<= value`, `>= value` or `in a..b`"
        }
        Constraint::Distance(_) => {
            "a distance takes `= value`, `<= value`, `>= value`, `in a..b` and `to A B`"
        }
        Constraint::Orientation(c) if c.period == Period::Whole => {
            "an orientation takes `= angle`, `<= angle`, `>= angle` or `in a..b`"
        }
        Constraint::Motor(_) => "a motor takes `radius`, `speed` and `phase`",
        Constraint::Hinge(_) => "a hinge takes `on A B` and `at ratio`",
        Constraint::Coordinate(_) => "a coordinate takes `at (x, y)`",
        Constraint::Cog(_) | Constraint::CogVelocity(_) => "cogs take `ratio r` and `inside`",
        Constraint::Glider(_) => "a glider takes `on A B` and `unbounded`",
        Constraint::Rack(_) => "a rack takes `on P Q`",
        _ => "this constraint has no part that can be changed",
    }
}
