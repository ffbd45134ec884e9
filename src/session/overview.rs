//! All there is to a session at one moment, as plain data: for a front end that shows it beside the
//! mechanism.

use super::Session;
use super::commands::setting_table::SETTINGS;
use super::resolve::unbind::Unbind;
use super::settled::miss;
use super::summary::Summary;
use crate::constraint::{ConstraintKind as _, Field};
use crate::diag::{Diagnostic, format_number};
use crate::solve::{present, verdict};
use crate::terms::Unit;
use crate::world::{ConstraintId, Entity, Value};

/// A constraint, and what states it.
#[derive(Debug, Clone, PartialEq)]
pub struct ConstraintView {
    /// Its handle.
    pub id: ConstraintId,
    /// Its name.
    pub name: String,
    /// The word that its statement has.
    pub kind: &'static str,
    /// Its statement.
    pub text: String,
    /// Whether it is switched on.
    pub is_on: bool,
    /// Its points, by handle.
    pub points: Vec<u32>,
    /// Of a motor, how fast it turns, radians a time unit, and how that is typed.
    pub speed: Option<(f64, String)>,
}

/// A parameter.
#[derive(Debug, Clone)]
pub struct ParameterView {
    /// Its name.
    pub name: String,
    /// What stands behind its `=`.
    pub text: String,
    /// What it is now, where that is known without looking at velocities.
    pub value: Option<Value>,
    /// Whether it is an expression of other things.
    pub is_live: bool,
    /// Whether something follows it: what a loop or a position took was its value then.
    pub is_used: bool,
}

/// A constraint that is off.
#[derive(Debug, Clone, PartialEq)]
pub struct Offence {
    /// Its handle.
    pub id: ConstraintId,
    /// Its name.
    pub name: String,
    /// By how much, as the solver takes it: relative to what hangs together.
    pub residual: f64,
    /// By how much, in its own unit, as users are told.
    pub miss: String,
}

/// How the pose stands.
#[derive(Debug, Clone, PartialEq)]
pub struct Standing {
    /// The largest residual, as the tolerance means it.
    pub residual: f64,
    /// What is off, the worst first.
    pub off: Vec<Offence>,
}

impl Session {
    /// Every constraint, in the order of creation.
    pub fn constraint_views(&self) -> impl Iterator<Item = ConstraintView> {
        let world = self.world();
        let unbind = Unbind::of(world);
        world.constraints().map(move |(id, record)| {
            let constraint = &record.constraint;
            let speed = constraint.get(Field::Speed).map(|speed| {
                let text = match record.driver(Field::Speed) {
                    Some(formula) => unbind.unbind(formula).to_string(),
                    None if record.unit(Field::Speed) == Unit::None => {
                        // As the trade says it.
                        format!("{}rev", format_number(speed / Unit::Rev.scale()))
                    }
                    None => format!(
                        "{}{}",
                        format_number(speed / record.unit(Field::Speed).scale()),
                        record.unit(Field::Speed).suffix()
                    ),
                };
                (speed, text)
            });
            ConstraintView {
                id,
                name: record.name.to_string(),
                kind: constraint.traits().word,
                text: unbind.constraint_text(record),
                is_on: record.is_on,
                points: constraint.points().to_vec(),
                speed,
            }
        })
    }

    /// Every parameter, such that each comes after those that it mentions.
    pub fn parameter_views(&self) -> impl Iterator<Item = ParameterView> {
        let world = self.world();
        let unbind = Unbind::of(world);
        self.state.parameters_in_order().into_iter().filter_map(move |id| {
            let parameter = world.parameter(id)?;
            Some(ParameterView {
                name: world.name_of(Entity::Parameter(id)).to_owned(),
                text: unbind.unbind(&parameter.formula).to_string(),
                value: parameter.value,
                is_live: !parameter.depends.is_constant(),
                is_used: !world.users(&[Entity::Parameter(id)]).is_empty(),
            })
        })
    }

    /// The settings, each with its value as it is typed and the words that it may be.
    pub fn setting_views(
        &self,
    ) -> impl Iterator<Item = (&'static str, String, Vec<&'static str>, &'static str)> {
        SETTINGS.iter().map(|setting| {
            (setting.name, (setting.text)(&self.state), (setting.words)(), setting.what)
        })
    }

    /// How the pose stands now.
    pub fn standing(&self) -> Standing {
        let world = self.world();
        let found = verdict(world, &self.state.preferences.solve);
        let mut off: Vec<_> = found.judged.iter().filter(|judged| !judged.is_met()).collect();
        off.sort_by(|a, b| b.residual().total_cmp(&a.residual()).then(a.id.cmp(&b.id)));
        let now = if off.is_empty() { None } else { Some(present(world).0) };
        let off = off.into_iter().filter_map(|judged| {
            let now = now.as_deref()?;
            let record = now.constraint(judged.id)?;
            Some(Offence {
                id: judged.id,
                name: record.name.to_string(),
                residual: judged.residual(),
                miss: miss(now, &record.constraint),
            })
        });
        Standing { residual: found.residual, off: off.collect() }
    }

    /// What a command that let time pass came to, in a line.
    pub fn receipt(&self, summary: &Summary) -> String {
        summary.line(self.state.preferences.receipt, self.world().clock().time())
    }

    /// A session with the same world, the same limits, and no past.
    ///
    /// # Errors
    /// Where the world is larger than the limits.
    pub fn copy(&self) -> Result<Self, Diagnostic> {
        let mut copy = Self::new();
        copy.input.quotas = self.input.quotas.clone();
        copy.run(&self.to_script())?;
        Ok(copy)
    }

    /// What `undo` would take back and `redo` would do again, as it was typed.
    pub fn undo_and_redo(&self) -> [Option<&str>; 2] {
        self.history.journal.next_labels()
    }
}
