//! `change`: any trailing part of the statement that made a thing.

use super::constrain::{refusal_at, refuse_flaw};
use crate::constraint::{Bounds, Constraint, ConstraintKind as _, Field, Point, Refusal};
use crate::diag::Diagnostic;
use crate::errors;
use crate::lang::ast::{Name, Part, Relation, Role};
use crate::session::execution::Execution;
use crate::session::resolve::said::{Behind, Said, flag_of, pattern_of};
use crate::session::resolve::scope::Resolver;
use crate::world::{ConstraintId, Edit, Entity, Record};

impl Execution<'_> {
    pub(crate) fn change_thing(&mut self, name: &Name, parts: &[Part]) -> Result<(), Diagnostic> {
        match self.resolve().entity(name)? {
            Entity::Constraint(id) => self.change_constraint(id, name, parts),
            Entity::Parameter(id) => match parts {
                [Part::Relation(Relation::Equal(value))] => {
                    let formula = self.resolve().live(value)?.into_formula(value.span);
                    self.redefine(id, formula, value)
                }
                _ => Err(self.resolve().no_such_part(name, "a parameter takes `= value`")),
            },
            Entity::Measure(_) => {
                let begin = "`measure NAME = ...` begins a measure anew";
                Err(self.resolve().no_such_part(name, begin))
            }
            Entity::Point(id) => match parts {
                [Part::Relation(Relation::Equal(at))] => {
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
        parts: &[Part],
    ) -> Result<(), Diagnostic> {
        let mut record = self.state.world.constraint(id).expect("a named constraint lives").clone();
        let as_stated = record.constraint.at(self.state.world.points().column()).into_owned();
        record.constraint = as_stated;
        // What stands behind a line says something of that line.
        let (lines, others): (Vec<_>, Vec<_>) =
            parts.iter().partition(|part| matches!(part, Part::Line(..)));
        let mut is_made_anew = false;
        for part in lines.into_iter().chain(others) {
            is_made_anew |= self.resolve().change_part(&mut record, name, part)?;
        }
        if let Some(radius) = record.driver(Field::Radius)
            && self.state.world.curve(id).is_some()
        {
            self.refuse_cycle(Entity::Constraint(id), radius, radius.span())?;
        }
        self.state.world.bind(&mut record);
        // What has no value now is given the one that it had last.
        if !self.state.is_restoring {
            refuse_flaw(&record.constraint, parts, name.span)?;
            self.note_slips(record.constraint.stated(), parts, record.drivers());
        }
        self.edit(Edit::Constraint(id, Some(Box::new(record))));
        if is_made_anew {
            self.begin_at_start(id);
        }
        self.rebind_users_of(id)?;
        Ok(())
    }

    /// Has `reset` bring back what is made anew while the clock runs as if it had been made of the
    /// pose that is brought back too.
    pub(super) fn begin_at_start(&mut self, id: ConstraintId) {
        let world = &self.state.world;
        let Some(Record { constraint, .. }) = world.constraint(id) else { return };
        if world.clock().frame > 0
            && constraint.state().is_some()
            && !constraint.captured().is_empty()
            && let Ok(at_start) = declare_again(constraint, world.points().start_column(), |_| {})
        {
            self.edit(world.begin_with(id, &at_start));
        }
    }
}

impl Resolver<'_> {
    fn no_such_part(&self, name: &Name, takes: &str) -> Diagnostic {
        let what = self.text(name.span);
        Diagnostic::error(errors::NO_SUCH_PART, format!("`{what}` has no such part"))
            .at(name.span, takes)
    }

    /// Changes what a part says; whether the constraint was made anew for that, as it stands.
    fn change_part(
        &mut self,
        record: &mut Record,
        name: &Name,
        part: &Part,
    ) -> Result<bool, Diagnostic> {
        let pattern = pattern_of(&record.constraint);
        let slot = pattern.slot(part);
        if slot.is_none() {
            return Err(self.no_such_part(name, pattern.takes));
        }
        let mut behind = Behind::default();
        let mut values = Vec::new();
        let mut is_made_anew = true;
        match part {
            Part::Points(_) | Part::Measure(_) | Part::Defined(_) | Part::Point(..) => {}
            Part::Relation(relation) if record.constraint.get(Field::ValueY).is_some() => {
                let at = self.held_target(relation, &mut behind)?;
                values.extend([(Field::X, at.x), (Field::Y, at.y)]);
            }
            Part::Relation(relation) => {
                let Bounds { lo, hi } = self.bounds(relation, &mut behind)?;
                values.extend([(Field::Lo, lo), (Field::Hi, hi)]);
            }
            Part::Value(_, value) => {
                self.say_value(slot, value, &mut values, &mut behind)?;
            }
            Part::Values(_, teeth) => values.extend(self.teeth(teeth, &mut behind)?),
            Part::Line(_, line) => {
                let ends = self.ends(line)?;
                let x = self.state.world.points().column();
                let made = declare_again(&record.constraint, x, |said| {
                    // The line stands behind the points, if it is said.
                    said.groups.truncate(pattern.n_point_groups());
                    said.groups.push(ends.to_vec());
                    said.flags.clear();
                    // Another angle than that from another line would be a jump.
                    said.values.retain(|(field, _)| *field != Field::Phase);
                });
                let at = line.from.span.to(line.to.span);
                record.constraint = made.map_err(|refusal| refusal_at(&refusal, at))?;
            }
            Part::Flag(role) => match record.constraint.get(Field::Ratio) {
                // They mesh on from where they stand.
                Some(ratio) if *role == Role::Inside && !is_by_teeth(&record.constraint) => {
                    record.constraint.set(Field::Ratio, -ratio.abs());
                    is_made_anew = false;
                }
                _ => {
                    let x = self.state.world.points().column();
                    let made = declare_again(&record.constraint, x, |said| {
                        said.flags.push(flag_of(*role));
                    });
                    record.constraint = made.map_err(|refusal| refusal_at(&refusal, name.span))?;
                }
            },
        }
        let mut changed: Vec<Field> = values.iter().map(|(field, _)| *field).collect();
        if changed.iter().any(|field| record.constraint.get(*field).is_none()) {
            // What it does not have yet, its statement says in another way: as it stands now.
            let x = self.state.world.points().column();
            let made = declare_again(&record.constraint, x, |said| {
                said.values.retain(|(field, _)| !changed.contains(field));
                said.values.extend(values);
            });
            record.constraint = made.map_err(|refusal| refusal_at(&refusal, name.span))?;
        } else {
            is_made_anew &= values.is_empty();
            for (field, value) in values {
                record.constraint.set(field, value);
            }
        }
        if changed.iter().any(|field| field.is_of_gearing()) {
            // A ratio takes the place of numbers of teeth, and these that of a ratio.
            changed = Field::ALL.into_iter().filter(|field| field.is_of_gearing()).collect();
        }
        record.replace_drivers(&changed, behind.drivers);
        record.set_units(&changed, behind.units);
        Ok(is_made_anew)
    }
}

/// Whether it is geared by numbers of teeth.
fn is_by_teeth(constraint: &Constraint) -> bool {
    constraint.get(Field::FirstTeeth).is_some()
}

/// Makes a constraint anew, after a change of what was said of it.
fn declare_again(
    constraint: &Constraint,
    x: &[Point],
    change: impl FnOnce(&mut Said),
) -> Result<Constraint, Refusal> {
    let mut said = Said::of(constraint);
    change(&mut said);
    said.declare(constraint.kind(), constraint.traits().word, x)
}
