//! A motion with other numbers: what a search for the best ones asks for.

use super::pace::Pace;
use super::passage::Passed;
use super::run::{Frames, Hands, Limits};
use crate::constraint::Point;
use crate::diag::{Diagnostic, Span};
use crate::interrupt::{self, Stopped};
use crate::session::execution::Execution;
use crate::session::preferences::Preferences;
use crate::session::quiet::Quiet;
use crate::session::quotas::Quota;
use crate::session::state::State;
use crate::session::undo::history::History;
use crate::solve::{Memory, Solver, Status};
use crate::world::{Edit, Formula, ParameterId, PointId, Rates, SampleList, Trace, Value, World};

/// A motion that is tried with different numbers, each time from the same pose.
pub(super) struct Trial {
    /// As it is before a trial, with measures that have no value yet.
    world: World,
    memory: Memory,
    preferences: Preferences,
    n_frames: u64,
    /// The statement that tries.
    span: Span,
}

/// A scene after a trial.
pub(super) struct Tried(State);

impl Execution<'_> {
    /// So many frames from how everything is now, with all that belongs to a run but what is kept for
    /// people to look at; the path of a point is kept where it is wanted.
    ///
    /// # Errors
    /// Where more would be kept of it than may be.
    pub(super) fn trial(
        &self,
        n_frames: u64,
        path_of: Option<PointId>,
        span: Span,
    ) -> Result<Trial, Diagnostic> {
        let n_values = n_frames.saturating_add(1);
        let n_measures = self.state.world.measures().count() as u64;
        let quotas = &self.input.quotas;
        quotas.check(Quota::Frames, n_frames, span)?;
        quotas.check(Quota::MeasureSamples, n_values.saturating_mul(n_measures), span)?;
        let mut world = self.state.world.clone();
        world.forget_readings();
        for k in (0..world.traces().len()).rev() {
            world.apply(Edit::Trace(k, None));
        }
        if let Some(point) = path_of {
            quotas.check(Quota::TraceSamples, n_values, span)?;
            let trace = Trace {
                point,
                label: None,
                every: 1,
                is_ended: false,
                samples: SampleList::default(),
            };
            world.apply(Edit::Trace(0, Some(Box::new(trace))));
        }
        let memory = self.state.solver.memory();
        let preferences = Preferences { expose_every: None, ..self.state.preferences.clone() };
        Ok(Trial { world, memory, preferences, n_frames, span })
    }

    /// Runs a trial with these numbers; none where something has no value, or a frame is not solved.
    pub(super) fn run_trial(
        &mut self,
        trial: &Trial,
        numbers: &[(ParameterId, f64)],
    ) -> Option<Tried> {
        let mut state = State {
            world: trial.world.clone(),
            preferences: trial.preferences.clone(),
            ..State::new()
        };
        state.solver.set_memory(trial.memory.clone());
        let mut history = History::default();
        let mut nobody = Quiet::new(self.host);
        let mut run = Execution::new(&mut state, self.input, &mut history, &mut nobody);
        run.deadline = self.deadline;
        run.run_with(trial, numbers)?;
        Some(Tried(state))
    }

    /// Lets the frames of a trial pass; none where not each is solved. It has no end but its own: where
    /// the user stops it, so is what tries.
    fn run_with(&mut self, trial: &Trial, numbers: &[(ParameterId, f64)]) -> Option<()> {
        for &(id, number) in numbers {
            let name = self.state.world.parameter(id)?.name.clone();
            self.set_parameter(id, name, Formula::constant(number)).ok()?;
        }
        self.begin_motion();
        if self.settle(&Limits::default()).ok()?.status != Status::Converged {
            return None;
        }
        let (n, limits, hands) = (trial.n_frames, Limits::default(), Hands::default());
        let mut passage = self.begin_frames(n, limits, trial.span).ok()?;
        self.state.world.sample_traces(false);
        let mut pace = Pace::new(self.may_stretch(&limits, hands));
        while passage.n_passed < n {
            if self.is_asked_to_stop() {
                interrupt::go_on(Stopped);
            }
            match self.pass_some(&mut passage, &mut pace, Frames { n, hands }).ok()? {
                Passed::On if passage.summary.n_missed == 0 => {}
                Passed::On | Passed::Over => return None,
                Passed::Stopped => interrupt::go_on(Stopped),
            }
        }
        Some(())
    }
}

impl Tried {
    /// The value of an expression at its end.
    pub(super) fn value(&mut self, formula: &Formula) -> Option<f64> {
        let State { world, solver, preferences, .. } = &mut self.0;
        let rates: Option<Rates> = if world.depends(formula).on_rates {
            Some(Solver::rates(solver, world, &preferences.solve).ok()?)
        } else {
            None
        };
        match world.evaluate(formula, rates.as_ref()).ok()? {
            Value::Number(n) => Some(n),
            Value::Vector(_) => None,
        }
    }

    /// Where the point was whose path was kept: at the start, and after each frame.
    pub(super) fn path(&self) -> Vec<Point> {
        let traces = self.0.world.traces().iter();
        traces.flat_map(|trace| trace.samples.iter()).map(|sample| sample.at).collect()
    }
}
