//! `measure` and `result`: values that are followed from frame to frame, and what a run is for.

use crate::constraint::Vec2;
use crate::diag::{Diagnostic, Span};
use crate::errors;
use crate::lang::ast::{Expr, Label, Name, ResultItem, Unit};
use crate::session::execution::Execution;
use crate::session::finding::Finding;
use crate::session::quotas::Quota;
use crate::session::results::line;
use crate::session::state::State;
use crate::session::undo::journal::Change;
use crate::solve::{Solver, verdict};
use crate::terms::Shape;
use crate::world::{Edit, Entity, Measure, MeasureId, Measuring, Tally, Value, World};

impl Execution<'_> {
    pub(crate) fn measure(
        &mut self,
        name: &Name,
        value: &Expr,
        unit: Unit,
        span: Span,
    ) -> Result<(), Diagnostic> {
        let term = self.resolve().live(value).map_err(|problem| {
            let is_unknown = problem.code == Some(errors::UNKNOWN_NAME);
            let says_nothing = is_unknown && problem.helps.is_empty();
            if says_nothing {
                problem.help("`list` shows what there is to measure")
            } else {
                problem
            }
        });
        let formula = term?.into_formula(value);
        if formula.shape() != Shape::Number {
            return Err(Diagnostic::error(errors::MIXED_SORTS, "a measure follows a number")
                .at(value.span, "this is a vector")
                .help("measure its parts, `v.x` and `v.y`, or its length, `norm(v)`"));
        }
        let text = self.resolve().declared(name)?;
        let (id, name) = match self.state.world.names().get(&text) {
            Some(Entity::Measure(id)) => {
                (id, self.state.world.measure(id).expect("it is named").name.clone())
            }
            _ => (self.state.world.next_measure(), self.resolve().declare(name)?),
        };
        let measure = Measure { name, formula, unit, tally: Tally::default() };
        self.edit(Edit::Measure(id, Some(Box::new(measure))));
        if self.state.is_restoring {
            return Ok(());
        }
        self.begin_counts();
        if self.state.is_solved() {
            self.state.take_first_reading(id)?;
        }
        self.check_readings(span)
    }

    /// Measures what has no value yet, where time is about to pass and the pose is solved.
    pub(super) fn begin_measures(&mut self) -> Result<(), Diagnostic> {
        if self.state.world.has_empty_measures() && self.state.is_solved() {
            self.state.take_readings(true, true)?;
        }
        Ok(())
    }

    /// Measures the pose of the frame that has just passed.
    pub(super) fn measure_frame(&mut self, is_met: bool) -> Result<(), Diagnostic> {
        if self.state.world.has_measures() {
            self.state.take_readings(false, is_met)?;
        }
        Ok(())
    }

    /// Refuses more values of measures than may be kept.
    pub(super) fn check_readings(&self, span: Span) -> Result<(), Diagnostic> {
        let n_readings = self.state.world.n_readings() as u64;
        self.input.quotas.check(Quota::MeasureSamples, n_readings, span)
    }

    pub(crate) fn say_results(&mut self, items: &[ResultItem]) -> Result<(), Diagnostic> {
        let mut results = self.state.results.clone();
        for ResultItem { label, value, unit } in items {
            let name = match label {
                Label::Name(name) => self.resolve().declared(name)?,
                Label::Text(text) => text.value.to_string(),
            };
            if name.is_empty() || name.contains(char::is_control) {
                return Err(Diagnostic::error(errors::NAME_TAKEN, "a result needs a name")
                    .at(label.span(), "a line of text, not empty")
                    .help("`result \"dead point\" = x`"));
            }
            let said = match self.resolve().value(value)? {
                Value::Number(n) => vec![(name, n)],
                Value::Vector(Vec2 { x, y }) => {
                    vec![(format!("{name}.x"), x), (format!("{name}.y"), y)]
                }
            };
            for (name, value) in said {
                let value = value / unit.scale();
                if self.host.takes_findings() {
                    self.host.find_out(&Finding::Result(&name, value));
                } else {
                    self.host.print(&line(&name, value));
                }
                results.set(name, value);
            }
        }
        self.change(Change::Results(Box::new(results)));
        Ok(())
    }
}

impl State {
    fn is_solved(&self) -> bool {
        verdict(&self.world, &self.preferences.solve).is_met()
    }

    /// Measures the pose of now, whatever the solver has taken in; looking changes nothing of it.
    fn take_first_reading(&mut self, id: MeasureId) -> Result<(), Diagnostic> {
        let extremes = self.preferences.measures;
        self.look(|solver, world, settings| {
            let mut rates = |world: &mut World| solver.rates(world, settings);
            let how = &mut Measuring { extremes, is_met: true, rates: &mut rates };
            world.take_reading(id, &mut None, how)
        })
    }

    /// Measures the pose of now, in which the solver has taken in all there is.
    fn take_readings(&mut self, only_empty: bool, is_met: bool) -> Result<(), Diagnostic> {
        let Self { world, solver, preferences, .. } = self;
        let settings = &preferences.solve;
        let mut rates = |world: &mut World| Solver::rates(solver, world, settings);
        let extremes = preferences.measures;
        let how = &mut Measuring { extremes, is_met, rates: &mut rates };
        world.take_readings(only_empty, how)
    }
}
