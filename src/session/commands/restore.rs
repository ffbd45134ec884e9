//! `restore`: state that no other statement can bring back; `save` writes it.

use super::save::{ordinals, what};
use crate::constraint::{ConstraintKind as _, Point};
use crate::diag::{Diagnostic, Span};
use crate::lang::ast::{Expr, Ident, Name};
use crate::session::execution::Execution;
use crate::world::{Clock, ConstraintId, Edit, Ghost, Record, Sample, Value};

impl Execution<'_> {
    pub(crate) fn restore(
        &mut self,
        kind: &Ident,
        name: Option<&Name>,
        values: &[Expr],
        span: Span,
    ) -> Result<(), Diagnostic> {
        let values =
            values.iter().map(|e| self.resolve().value(e)).collect::<Result<Vec<_>, _>>()?;
        let bad = || {
            Diagnostic::error("this does not restore anything").at(span, "written by `save` only")
        };
        match (&*kind.text, name) {
            (what::CLOCK, None) => {
                let &[frame, dt, base_frame, base_time] = &numbers(&values).ok_or_else(bad)?[..]
                else {
                    return Err(bad());
                };
                let is_count = |n: f64| (0.0..=9e15).contains(&n) && n.fract() == 0.0;
                if !is_count(frame) || !is_count(base_frame) || base_frame > frame || dt <= 0.0 {
                    return Err(bad());
                }
                let (frame, base_frame) = (frame as u64, base_frame as u64);
                self.edit(Edit::Clock(Box::new(Clock { frame, dt, base_frame, base_time })));
            }
            (what::START, Some(name)) => {
                let id = self.resolve().point(name)?;
                let [Value::Vector(v)] = values[..] else { return Err(bad()) };
                self.edit(Edit::Start(id, Point::new(v.x, v.y)));
            }
            (what::STATE, Some(name)) => {
                let state = numbers(&values).ok_or_else(bad)?;
                self.restore_record(name, |record| record.constraint.set_state(&state))?;
            }
            (what::CAPTURED, Some(name)) => {
                let captured = numbers(&values).ok_or_else(bad)?;
                self.restore_record(name, |record| record.constraint.set_captured(&captured))?;
            }
            (what::VALUES, Some(name)) => {
                let values = numbers(&values).ok_or_else(bad)?;
                self.restore_record(name, |record| {
                    for (k, value) in values.iter().take(record.drivers().len()).enumerate() {
                        record.constraint.set(record.drivers()[k].0, *value);
                    }
                })?;
            }
            (what::FIRST_STATE, Some(name)) => {
                let id = self.resolve().constraint(name)?;
                let state = numbers(&values).ok_or_else(bad)?;
                self.edit(Edit::StartState(id, Some(state.into())));
            }
            (what::TRACE, Some(name)) => self.restore_trace(name, &values).ok_or_else(bad)??,
            (what::MISSED, Some(name)) => {
                let missed = numbers(&values).ok_or_else(bad)?;
                self.restore_missed(name, &missed)?;
            }
            (what::GHOST, None) => {
                let numbered = ordinals(&self.state.world);
                let mut ghost = Ghost { at: Vec::new() };
                for pair in values.chunks(2) {
                    let [Value::Number(k), Value::Vector(v)] = *pair else { return Err(bad()) };
                    let id = *numbered.get(k as usize).ok_or_else(bad)?;
                    ghost.at.push((id, Point::new(v.x, v.y)));
                }
                self.edit(Edit::Ghost(Some(Box::new(ghost))));
            }
            (what::MEMORY, owner) => {
                let id = owner.map(|name| self.resolve().point(name)).transpose()?;
                let values = numbers(&values).ok_or_else(bad)?;
                let mut memory = self.state.solver.memory();
                if !memory.restore(id, &values) {
                    return Err(bad());
                }
                self.set_memory(memory);
            }
            _ => return Err(bad()),
        }
        Ok(())
    }

    fn restore_record(
        &mut self,
        name: &Name,
        change: impl FnOnce(&mut Record),
    ) -> Result<(), Diagnostic> {
        let id: ConstraintId = self.resolve().constraint(name)?;
        let mut record = self.state.world.constraint(id).expect("a named constraint lives").clone();
        change(&mut record);
        self.edit(Edit::Constraint(id, Some(Box::new(record))));
        Ok(())
    }

    /// None where the values are not places.
    fn restore_trace(&mut self, name: &Name, values: &[Value]) -> Option<Result<(), Diagnostic>> {
        let samples = values
            .iter()
            .map(|value| match value {
                Value::Vector(v) => Some(Sample { at: Point::new(v.x, v.y), missed: false }),
                Value::Number(_) => None,
            })
            .collect::<Option<Vec<_>>>()?;
        Some(self.restore_samples(name, |kept| *kept = samples))
    }

    fn restore_missed(&mut self, name: &Name, missed: &[f64]) -> Result<(), Diagnostic> {
        self.restore_samples(name, |samples| {
            for k in missed {
                if let Some(sample) = samples.get_mut(*k as usize) {
                    sample.missed = true;
                }
            }
        })
    }

    fn restore_samples(
        &mut self,
        name: &Name,
        change: impl FnOnce(&mut Vec<Sample>),
    ) -> Result<(), Diagnostic> {
        let point = self.resolve().point(name)?;
        let traces = self.state.world.traces();
        let Some(k) = traces.iter().position(|t| t.point == point) else {
            return Err(Diagnostic::error("this point is not traced").at(name.span, ""));
        };
        let mut trace = traces[k].clone();
        change(&mut trace.samples);
        self.edit(Edit::Trace(k, None));
        self.edit(Edit::Trace(k, Some(Box::new(trace))));
        Ok(())
    }
}

/// The numbers, if all values are.
fn numbers(values: &[Value]) -> Option<Vec<f64>> {
    values
        .iter()
        .map(|value| match value {
            Value::Number(n) => Some(*n),
            Value::Vector(_) => None,
        })
        .collect()
}
