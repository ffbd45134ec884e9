//! `save`: a script that brings the same world back to the last bit.

use std::collections::BTreeSet;
use std::fmt::Write;

use super::restorable::{Restorable, VERSION, ordinals};
use super::setting_table::{SETTINGS, Setting};
use crate::constraint::{Constraint, ConstraintKind as _, Field};
use crate::diag::Diagnostic;
use crate::interrupt::tick;
use crate::lang::ast::{
    Binding, Building, Changing, Command, Drawing, Expose, Expr, Making, PointDecl, Text,
};
use crate::session::execution::Execution;
use crate::session::file_kind::{FileKind, SCRIPT_MARK};
use crate::session::resolve::unbind::{Unbind, ident, literal, named, quoted, text_of, vector};
use crate::session::state::State;
use crate::solve::CogForm;
use crate::terms::Shape;
use crate::world::{ConstraintId, Drivers, Mention, ParameterId, Record};

/// What the writing of a line takes, in ticks.
const LINE: usize = 1000;

impl Execution<'_> {
    pub(crate) fn save(&mut self, path: &Text) -> Result<(), Diagnostic> {
        let file = self.output_file(path, FileKind::Script)?;
        let text = self.state.to_script();
        self.queue_file(file, FileKind::Script, text.into_bytes(), path.span);
        Ok(())
    }

    /// Writes what was typed.
    pub(crate) fn save_history(&mut self, path: &Text) -> Result<(), Diagnostic> {
        let file = self.output_file(path, FileKind::Script)?;
        let mut text = format!("{SCRIPT_MARK} What was typed in it.\n");
        for statement in self.input.typed() {
            text.push_str(statement);
            text.push('\n');
        }
        self.queue_file(file, FileKind::Script, text.into_bytes(), path.span);
        Ok(())
    }
}

impl State {
    /// The script that makes this world, its settings and its state.
    pub fn to_script(&self) -> String {
        let mut script = format!("{SCRIPT_MARK} `load` it, or run it as a script.\n");
        restore(&mut script, Restorable::Version, None, numbers(&[VERSION]));
        self.save_settings(&mut script);
        for definition in self.definitions.values() {
            line(&mut script, Building::Define(definition.clone()));
        }
        self.save_points(&mut script);
        self.save_turn_counts(&mut script);
        restore(&mut script, Restorable::Past, None, numbers(&[1.0]));
        let late = Late::of(self);
        self.save_parameters(&late, &mut script);
        self.save_constraints(&late, &mut script);
        self.save_measures(&mut script);
        self.save_late_parameters(&late, &mut script);
        self.save_late_values(&late, &mut script);
        self.save_start_states(&mut script);
        restore(&mut script, Restorable::Past, None, numbers(&[0.0]));
        self.save_looks(&mut script);
        for (owner, values) in
            self.solver.memory().for_settings(&self.preferences.solve).to_numbers()
        {
            // What was remembered of things that are deleted since is lost on all others.
            let points = self.world.points();
            let Some(name) = owner.filter(|id| points.is_alive(*id)).map(|id| points.name(id))
            else {
                continue;
            };
            restore(&mut script, Restorable::Memory, Some(name), numbers(&values));
        }
        self.save_tastes(&mut script);
        script
    }

    fn save_settings(&self, script: &mut String) {
        for setting in SETTINGS.iter().filter(|setting| setting.is_of_scene) {
            // Writing to a string cannot fail.
            let _ = writeln!(script, "set {} {}", setting.name, (setting.text)(self));
        }
        let clock = self.world.clock();
        if clock.frame > 0 || clock.base_time != 0.0 {
            let values = [clock.frame as f64, clock.dt, clock.base_frame as f64, clock.base_time];
            restore(script, Restorable::Clock, None, numbers(&values));
        }
    }

    /// What the user likes otherwise than it is from the start. It comes last, when all is made: a
    /// solution after each edit would be another pose.
    fn save_tastes(&self, script: &mut String) {
        let as_it_was = Self::new();
        for Setting { name, text, .. } in SETTINGS.iter().filter(|setting| !setting.is_of_scene) {
            if text(self) != text(&as_it_was) {
                // Writing to a string cannot fail.
                let _ = writeln!(script, "set {name} {}", text(self));
            }
        }
    }

    fn save_points(&self, script: &mut String) {
        let points = self.world.points();
        for id in points.ids() {
            let at = points.at(id);
            let declaration = PointDecl {
                name: named(points.name(id)),
                at: vector(at.x, at.y),
                frozen: points.is_frozen(id),
            };
            line(script, Making::Point(vec![declaration]));
        }
        for id in points.ids() {
            if points.weight(id) != 1.0 {
                line(
                    script,
                    Changing::Set {
                        setting: ident("weight"),
                        value: literal(points.weight(id)),
                        targets: vec![named(points.name(id))],
                    },
                );
            }
            let (at, start) = (points.at(id), points.start(id));
            if self.world.clock().frame > 0 && at != start {
                let place = vec![vector(start.x, start.y)];
                restore(script, Restorable::Start, Some(points.name(id)), place);
            }
        }
    }

    fn save_turn_counts(&self, script: &mut String) {
        let numbered = ordinals(&self.world);
        for (turning, count) in self.world.turn_counts() {
            let points = turning.points();
            let ordinal = |id| numbered.binary_search(id).unwrap_or_default() as f64;
            let mut values = vec![points.len() as f64];
            values.extend(points.iter().map(ordinal));
            values.extend(count.winding.to_numbers());
            values.extend(count.start.iter().flat_map(|start| start.to_numbers()));
            restore(script, Restorable::Turn, None, numbers(&values));
        }
    }

    fn save_constraints(&self, waiting: &Late, script: &mut String) {
        let now = self.preferences.solve.cog;
        let mut form = now;
        for (id, record) in self.world.constraints() {
            let wanted = match &record.constraint {
                Constraint::Cog(_) => CogForm::Holonomic,
                Constraint::CogVelocity(_) => CogForm::Velocity,
                _ => form,
            };
            if std::mem::replace(&mut form, wanted) != wanted {
                set_cog(script, wanted);
            }
            let late = self.late_fields(id, record);
            line(script, Unbind::of(&self.world).constraint_statement(&without(record, &late)));
            if let Some(rho) = record.rho() {
                let targets = vec![named(&record.name)];
                let value = literal(rho);
                line(script, Changing::Set { setting: ident("rho"), value, targets });
            }
            if !waiting.is_followed_by(record) {
                save_state(record, script);
            }
        }
        if form != now {
            set_cog(script, now);
        }
    }

    /// Makes the parameters, in the order in which they were made; what has to wait for others is a
    /// number until then.
    fn save_parameters(&self, late: &Late, script: &mut String) {
        for (id, parameter) in self.world.parameters() {
            if late.parameters.contains(&id) {
                let value = match parameter.formula.shape() {
                    Shape::Number => literal(1.0),
                    Shape::Vector => vector(1.0, 1.0),
                };
                let binding = Binding { name: named(&parameter.name), value };
                line(script, Making::Let(vec![binding]));
            } else {
                tick(LINE);
                script.push_str(&Unbind::of(&self.world).parameter_text(id));
                script.push('\n');
            }
        }
    }

    /// Begins the measures, and gives them what they have kept.
    fn save_measures(&self, script: &mut String) {
        for (_, measure) in self.world.measures() {
            line(script, Unbind::of(&self.world).measure_statement(measure));
        }
        for (_, measure) in self.world.measures() {
            let kept = measure.tally.to_numbers();
            if !kept.is_empty() {
                restore(script, Restorable::Measure, Some(&measure.name), numbers(&kept));
            }
        }
    }

    /// Makes parameters live that had to wait.
    fn save_late_parameters(&self, late: &Late, script: &mut String) {
        for &id in &late.in_order {
            tick(LINE);
            script.push_str(&Unbind::of(&self.world).parameter_text(id));
            script.push('\n');
        }
    }

    /// The values of a constraint that mention members of itself or of such as come after it, and
    /// those that stand in the same part of its statement.
    fn late_fields(&self, id: ConstraintId, record: &Record) -> Vec<Field> {
        let parts: [&[Field]; 6] = [
            &[Field::Lo, Field::Hi],
            &[Field::X, Field::Y],
            &[Field::Radius],
            &[Field::Speed],
            &[Field::Phase],
            &[Field::Ratio],
        ];
        let is_late = |field: &Field| {
            let mut is_late = false;
            if let Some(formula) = record.driver(*field) {
                formula.mentions(&mut |mention| {
                    is_late |= matches!(mention, Mention::Member(used, _) if used >= id);
                });
            }
            is_late
        };
        let late = parts.into_iter().filter(|part| part.iter().any(is_late)).flatten();
        late.copied().filter(|field| record.driver(*field).is_some()).collect()
    }

    /// Makes live what had to wait for the members it mentions.
    fn save_late_values(&self, waiting: &Late, script: &mut String) {
        for (id, record) in self.world.constraints() {
            if !waiting.is_followed_by(record) {
                continue;
            }
            let late = self.late_fields(id, record);
            let unbind = Unbind::of(&self.world);
            let parts = |record: &Record| match unbind.constraint_statement(record) {
                Command::Constrain(declaration) => declaration.constraint.parts,
                _ => unreachable!("a constraint is stated by its statement"),
            };
            let before = parts(&without(record, &late));
            let changed = parts(record).into_iter().filter(|part| !before.contains(part));
            for part in changed {
                line(script, Changing::Change { name: named(&record.name), parts: vec![part] });
            }
            save_state(record, script);
        }
    }

    fn save_start_states(&self, script: &mut String) {
        for (id, state) in self.world.start_states() {
            if let Some(record) = self.world.constraint(*id) {
                restore(script, Restorable::FirstState, Some(&record.name), numbers(state));
            }
        }
    }

    fn save_looks(&self, script: &mut String) {
        let points = self.world.points();
        for trace in self.world.traces() {
            let name = points.name(trace.point);
            let every = (trace.every > 1).then(|| literal(trace.every as f64));
            let label = trace.label.as_deref().map(quoted);
            line(script, Drawing::Trace { names: vec![named(name)], label, every });
            if !trace.samples.is_empty() {
                let places = trace.samples.iter().map(|s| vector(s.at.x, s.at.y)).collect();
                restore(script, Restorable::Trace, Some(name), places);
            }
            let missed = trace.samples.iter().enumerate().filter(|(_, sample)| sample.missed);
            let missed: Vec<f64> = missed.map(|(k, _)| k as f64).collect();
            if !missed.is_empty() {
                restore(script, Restorable::Missed, Some(name), numbers(&missed));
            }
            if trace.is_ended {
                restore(script, Restorable::Ended, Some(name), Vec::new());
            }
        }
        let numbered = ordinals(&self.world);
        for ghost in self.world.ghosts() {
            let places = ghost.at.iter().filter_map(|(id, at)| {
                let k = numbered.binary_search(id).ok()?;
                Some([literal(k as f64), vector(at.x, at.y)])
            });
            restore(script, Restorable::Ghost, None, places.flatten().collect());
        }
        for (series, values) in &self.series {
            let series = quoted(series);
            line(script, Drawing::Sample { series, values: numbers(values) });
        }
        if let Some(every) = self.preferences.expose_every {
            line(script, Drawing::Expose(Expose::Every(literal(every as f64))));
        }
    }
}

/// What has to wait for others, or for constraints, that come after it.
#[derive(Debug, Default)]
struct Late {
    /// Parameters that can be made live only then.
    parameters: BTreeSet<ParameterId>,
    /// These, each after those that it mentions.
    in_order: Vec<ParameterId>,
    /// These, and all parameters that mention them at any depth.
    following: BTreeSet<ParameterId>,
}

impl Late {
    fn of(state: &State) -> Self {
        let mut late = Self::default();
        // Those that mention members, at any depth.
        let mut with_members = BTreeSet::new();
        for id in state.parameters_in_order() {
            let parameter = state.world.parameter(id).expect("a listed parameter lives");
            let (mut has_members, mut is_late, mut is_following) = (false, false, false);
            parameter.formula.mentions(&mut |mention| match mention {
                Mention::Member(..) => has_members = true,
                Mention::Parameter(used) => {
                    has_members |= with_members.contains(&used);
                    is_late |= used > id;
                    is_following |= late.following.contains(&used);
                }
                Mention::Measure(_) => is_late = true,
                Mention::Point(_) => {}
            });
            if has_members {
                with_members.insert(id);
            }
            if is_late || has_members {
                late.parameters.insert(id);
                late.in_order.push(id);
            }
            if is_late || has_members || is_following {
                late.following.insert(id);
            }
        }
        late
    }

    /// Whether some value of a constraint is made live by what comes after it.
    fn is_followed_by(&self, record: &Record) -> bool {
        let mut is_followed = false;
        for (_, formula) in record.drivers() {
            formula.mentions(&mut |mention| match mention {
                Mention::Member(..) => is_followed = true,
                Mention::Parameter(used) => is_followed |= self.following.contains(&used),
                Mention::Point(_) | Mention::Measure(_) => {}
            });
        }
        is_followed
    }
}

/// A constraint with the numbers of now in the place of the expressions behind these values.
fn without(record: &Record, fields: &[Field]) -> Record {
    let mut plain = record.clone();
    plain.replace_drivers(fields, Drivers::new());
    plain
}

/// The state of a constraint, once its values are live.
fn save_state(record: &Record, script: &mut String) {
    let name = Some(&*record.name);
    // The values come first: a new ratio makes wheels mesh anew.
    if !record.live().is_empty() {
        let value = |field| record.constraint.get(field).unwrap_or_default();
        let values: Vec<f64> = record.live().iter().map(|d| value(d.0)).collect();
        restore(script, Restorable::Values, name, numbers(&values));
    }
    let captured = record.constraint.captured();
    if !captured.is_empty() {
        restore(script, Restorable::Captured, name, numbers(&captured));
    }
    if let Some(state) = record.constraint.state() {
        restore(script, Restorable::State, name, numbers(&state));
    }
    if !record.is_on {
        line(script, Changing::Off(vec![named(&record.name)]));
    }
}

#[allow(clippy::needless_pass_by_value, reason = "the callers make it for this")]
fn line(script: &mut String, command: impl Into<Command>) {
    tick(LINE);
    script.push_str(&text_of(&command.into()));
    script.push('\n');
}

fn set_cog(script: &mut String, form: CogForm) {
    // Writing to a string cannot fail.
    let _ = writeln!(script, "set cog {}", form.word());
}

fn numbers(values: &[f64]) -> Vec<Expr> {
    values.iter().map(|&value| literal(value)).collect()
}

fn restore(script: &mut String, what: Restorable, name: Option<&str>, values: Vec<Expr>) {
    line(script, Building::Restore { what: ident(what.word()), name: name.map(named), values });
}
