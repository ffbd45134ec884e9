//! `restore`: state that no other statement can bring back; `save` writes it.

use std::path::PathBuf;

use super::restorable::{Restorable, VERSION, ordinals};
use crate::constraint::{ConstraintKind as _, Point, Winding};
use crate::diag::{Diagnostic, Span, format_number};
use crate::errors;
use crate::lang::ast::{Expr, Ident, Name, Text};
use crate::session::execution::Execution;
use crate::session::undo::journal::Change;
use crate::session::undo::told::FileRead;
use crate::world::{
    Clock, Edit, Entity, Ghost, Measure, Record, Sample, SampleList, Tally, Trace, TurnCount,
    Turning, Value,
};

/// Why something cannot be restored.
enum Unfit {
    /// The values are not what `save` would write for it.
    Values,
    /// A later program wrote it.
    Newer(f64),
    /// What is named is not there, or not of its kind.
    Name(Diagnostic),
}

/// Refuses what a later program wrote: what it means by it is not known here.
fn check_version(values: &[Value]) -> Restored {
    match numbers(values)?[..] {
        [version] if version > VERSION => Err(Unfit::Newer(version)),
        [_] => Ok(()),
        _ => Err(Unfit::Values),
    }
}

impl From<Diagnostic> for Unfit {
    fn from(problem: Diagnostic) -> Self {
        Self::Name(problem)
    }
}

type Restored = Result<(), Unfit>;

impl Execution<'_> {
    pub(crate) fn restore(
        &mut self,
        what: &Ident,
        name: Option<&Name>,
        values: &[Expr],
        span: Span,
    ) -> Result<(), Diagnostic> {
        let values =
            values.iter().map(|e| self.resolve().value(e)).collect::<Result<Vec<_>, _>>()?;
        let restored = match Restorable::named(&what.text) {
            Some(what) => self.bring_back(what, name, &values),
            None => Err(Unfit::Values),
        };
        restored.map_err(|unfit| match unfit {
            Unfit::Name(problem) => problem,
            Unfit::Newer(version) => {
                let version = format_number(version);
                Diagnostic::error(errors::NEWER_FILE, "a newer linkwork wrote this file")
                    .at(span, format!("it is of version {version}"))
                    .note(format!("this linkwork reads files up to version {VERSION}"))
                    .help("install a newer one; `linkwork --version` says which this is")
            }
            Unfit::Values => {
                Diagnostic::error(errors::NOT_RESTORED, "this does not restore anything")
                    .at(span, "written by `save` only")
            }
        })
    }

    /// What is read next in place of a file.
    pub(crate) fn restore_file(&mut self, path: &Text, text: &Text) {
        let (path, text) = (PathBuf::from(&*path.value), text.value.clone());
        self.input.next_files.push_back(FileRead { path, text });
    }

    fn bring_back(&mut self, what: Restorable, name: Option<&Name>, values: &[Value]) -> Restored {
        match (what, name) {
            (Restorable::Clock, None) => self.restore_clock(values),
            (Restorable::Start, Some(name)) => self.restore_start(name, values),
            (Restorable::State, Some(name)) => {
                let state = numbers(values)?;
                self.restore_record(name, |record| record.constraint.set_state(&state))
            }
            (Restorable::FirstState, Some(name)) => {
                let id = self.resolve().constraint(name)?;
                self.edit(Edit::StartState(id, Some(numbers(values)?.into())));
                Ok(())
            }
            (Restorable::Captured, Some(name)) => {
                let captured = numbers(values)?;
                self.restore_record(name, |record| record.constraint.set_captured(&captured))
            }
            (Restorable::Values, Some(name)) => self.restore_values(name, values),
            (Restorable::Trace, Some(name)) => self.restore_trace(name, values),
            (Restorable::Missed, Some(name)) => self.restore_missed(name, values),
            (Restorable::Ended, Some(name)) if values.is_empty() => {
                self.restore_trace_by(name, |trace| trace.is_ended = true)
            }
            (Restorable::Measure, Some(name)) => self.restore_measure(name, values),
            (Restorable::Ghost, None) => self.restore_ghost(values),
            (Restorable::Turn, None) => self.restore_turn(values),
            (Restorable::Memory, owner) => self.restore_memory(owner, values),
            (Restorable::Version, None) => check_version(values),
            (Restorable::Past, None) => self.restore_past(values),
            (Restorable::Stop, None) => self.restore_stop(values),
            // These have an owner or none, and this is the other way; or they have no values.
            (
                Restorable::Ended
                | Restorable::Clock
                | Restorable::Ghost
                | Restorable::Turn
                | Restorable::Version
                | Restorable::Past
                | Restorable::Stop,
                Some(_),
            )
            | (
                Restorable::Start
                | Restorable::State
                | Restorable::FirstState
                | Restorable::Captured
                | Restorable::Values
                | Restorable::Trace
                | Restorable::Missed
                | Restorable::Ended
                | Restorable::Measure,
                None,
            ) => Err(Unfit::Values),
        }
    }

    fn restore_clock(&mut self, values: &[Value]) -> Restored {
        let &[frame, dt, base_frame, base_time] = &numbers(values)?[..] else {
            return Err(Unfit::Values);
        };
        let is_count = |n: f64| (0.0..=9e15).contains(&n) && n.fract() == 0.0;
        if !is_count(frame) || !is_count(base_frame) || base_frame > frame || dt <= 0.0 {
            return Err(Unfit::Values);
        }
        let (frame, base_frame) = (frame as u64, base_frame as u64);
        self.edit(Edit::Clock(Box::new(Clock { frame, dt, base_frame, base_time })));
        Ok(())
    }

    fn restore_start(&mut self, name: &Name, values: &[Value]) -> Restored {
        let id = self.resolve().point(name)?;
        let &[Value::Vector(v)] = values else { return Err(Unfit::Values) };
        self.edit(Edit::Start(id, Point::new(v.x, v.y)));
        Ok(())
    }

    fn restore_values(&mut self, name: &Name, values: &[Value]) -> Restored {
        let values = numbers(values)?;
        self.restore_record(name, |record| {
            for (k, value) in values.iter().take(record.live().len()).enumerate() {
                record.constraint.set(record.live()[k].0, *value);
            }
        })
    }

    fn restore_ghost(&mut self, values: &[Value]) -> Restored {
        let numbered = ordinals(&self.state.world);
        let mut ghost = Ghost { at: Vec::new() };
        for pair in values.chunks(2) {
            let [Value::Number(k), Value::Vector(v)] = *pair else { return Err(Unfit::Values) };
            let id = *numbered.get(k as usize).ok_or(Unfit::Values)?;
            ghost.at.push((id, Point::new(v.x, v.y)));
        }
        self.edit(Edit::Ghost(Some(Box::new(ghost))));
        Ok(())
    }

    fn restore_measure(&mut self, name: &Name, values: &[Value]) -> Restored {
        let Entity::Measure(id) = self.resolve().entity(name)? else { return Err(Unfit::Values) };
        let tally = Tally::from_numbers(&numbers(values)?).ok_or(Unfit::Values)?;
        let measure = self.state.world.measure(id).expect("it is named").clone();
        self.edit(Edit::Measure(id, Some(Box::new(Measure { tally, ..measure }))));
        Ok(())
    }

    fn restore_turn(&mut self, values: &[Value]) -> Restored {
        let values = numbers(values)?;
        let numbered = ordinals(&self.state.world);
        let (n, values) = values.split_first().ok_or(Unfit::Values)?;
        let (points, windings) = values.split_at_checked(*n as usize).ok_or(Unfit::Values)?;
        let points = points.iter().map(|&k| numbered.get(k as usize).copied().ok_or(Unfit::Values));
        let turning = Turning::of(&points.collect::<Result<Vec<_>, _>>()?).ok_or(Unfit::Values)?;
        let (winding, start) = match *windings {
            [turns, angle] => ([turns, angle], None),
            [turns, angle, first_turns, first_angle] => {
                ([turns, angle], Some([first_turns, first_angle]))
            }
            _ => return Err(Unfit::Values),
        };
        let count = TurnCount {
            winding: Winding::from_numbers(winding),
            start: start.map(Winding::from_numbers),
        };
        self.edit(Edit::TurnCount(Box::new((turning, Some(count)))));
        Ok(())
    }

    fn restore_memory(&mut self, owner: Option<&Name>, values: &[Value]) -> Restored {
        let id = owner.map(|name| self.resolve().point(name)).transpose()?;
        let values = numbers(values)?;
        if self.history.restore_memory(self.state, id, &values) {
            Ok(())
        } else {
            Err(Unfit::Values)
        }
    }

    fn restore_past(&mut self, values: &[Value]) -> Restored {
        let is_restoring = match numbers(values)?[..] {
            [1.0] => true,
            [0.0] => false,
            _ => return Err(Unfit::Values),
        };
        self.change(Change::Restoring(is_restoring));
        Ok(())
    }

    /// The next statement was stopped when it had come so far.
    fn restore_stop(&mut self, values: &[Value]) -> Restored {
        match numbers(values)?[..] {
            [n] if n >= 0.0 && n.fract() == 0.0 => {
                self.input.next_stop = Some(n as u64);
                Ok(())
            }
            _ => Err(Unfit::Values),
        }
    }

    fn restore_record(&mut self, name: &Name, change: impl FnOnce(&mut Record)) -> Restored {
        let id = self.resolve().constraint(name)?;
        let mut record = self.state.world.constraint(id).expect("a named constraint lives").clone();
        change(&mut record);
        self.edit(Edit::Constraint(id, Some(Box::new(record))));
        Ok(())
    }

    fn restore_trace(&mut self, name: &Name, values: &[Value]) -> Restored {
        let samples = values.iter().map(|value| match value {
            Value::Vector(v) => Ok(Sample { at: Point::new(v.x, v.y), missed: false }),
            Value::Number(_) => Err(Unfit::Values),
        });
        let samples = samples.collect::<Result<SampleList, _>>()?;
        self.restore_trace_by(name, |trace| trace.samples = samples)
    }

    fn restore_missed(&mut self, name: &Name, values: &[Value]) -> Restored {
        let missed = numbers(values)?;
        self.restore_trace_by(name, |trace| {
            let mut samples: Vec<Sample> = trace.samples.iter().copied().collect();
            for k in missed {
                if let Some(sample) = samples.get_mut(k as usize) {
                    sample.missed = true;
                }
            }
            trace.samples = samples.into_iter().collect();
        })
    }

    /// Changes the trace of a point that was made last.
    fn restore_trace_by(&mut self, name: &Name, change: impl FnOnce(&mut Trace)) -> Restored {
        let point = self.resolve().point(name)?;
        let traces = self.state.world.traces();
        let Some(k) = traces.iter().rposition(|t| t.point == point) else {
            return Err(Diagnostic::error(errors::NOT_TRACED, "this point is not traced")
                .at(name.span, "")
                .into());
        };
        let mut trace = traces[k].clone();
        change(&mut trace);
        self.edit(Edit::Trace(k, None));
        self.edit(Edit::Trace(k, Some(Box::new(trace))));
        Ok(())
    }
}

/// The numbers, if all values are.
fn numbers(values: &[Value]) -> Result<Vec<f64>, Unfit> {
    let number = |value: &Value| match value {
        Value::Number(n) => Ok(*n),
        Value::Vector(_) => Err(Unfit::Values),
    };
    values.iter().map(number).collect()
}
