//! Frames that pass at once, where a command asks for nothing between them, and long ones that the
//! user may stop on their way.

use super::run::{Frames, Hands, LONG, Limits, Stop};
use crate::diag::Diagnostic;
use crate::interrupt::{self, Stopped};
use crate::session::execution::Execution;
use crate::session::preferences::AtDeadPoint;
use crate::session::quotas::Quota;
use crate::session::state::State;
use crate::solve::{Along, Budget, Report, Stretch};

/// Frames between which it is told how far a run is.
const MOST_AT_ONCE: u64 = 4000;

/// A frame with so many evaluations of constraints takes much longer than a copy of what it changes.
const LONG_FRAME: u64 = 100_000;

impl Execution<'_> {
    /// Whether frames of a command may pass at once: nothing that it does asks for anything between
    /// them but traces.
    pub(super) fn may_stretch(&self, limits: &Limits, hands: Hands) -> bool {
        let preferences = &self.state.preferences;
        hands.firm.is_empty()
            && hands.soft.is_empty()
            && limits.seconds.is_none()
            && self.state.recorders.is_empty()
            && preferences.expose_every.is_none()
            && preferences.dead_points == AtDeadPoint::Hold
            && preferences.solve.iterations <= LONG
    }

    /// Lets up to `n` frames pass at once, as far as that goes.
    ///
    /// # Errors
    /// Where a measure has no value.
    pub(super) fn stretch(
        &mut self,
        n: u64,
        limits: &Limits,
        known_error: f64,
    ) -> Result<Stretch, Diagnostic> {
        // No further than it came before it was stopped.
        let n = self.most_done.map_or(n, |most| n.min(most.saturating_sub(self.n_done)));
        let most = self.input.quotas.of(Quota::TraceSamples);
        let most_readings = self.input.quotas.of(Quota::MeasureSamples);
        let Self { state, host, deadline, .. } = &mut *self;
        let State { solver, world, preferences, .. } = &mut **state;
        // No more than traces may keep: the frame that exceeds that is told of by itself.
        let n_kept = world.traces().iter().map(|trace| trace.samples.len() as u64).sum();
        let n_left = most.saturating_sub(n_kept).checked_div(world.traces().len() as u64);
        let n_measures = world.measures().count() as u64;
        let n_readings = most_readings.saturating_sub(world.n_readings() as u64);
        let n_readings = n_readings.checked_div(n_measures).unwrap_or(n);
        let n = n.min(n_left.unwrap_or(n)).min(n_readings).min(MOST_AT_ONCE);
        let budget = Budget { tolerance: limits.tolerance, stop: None, known_error };
        let goes_on = || !host.is_interrupted() && !deadline.has_passed(&**host);
        let on = Along { n, extremes: preferences.measures, goes_on: &goes_on };
        let stretch = solver.stretch(world, &preferences.solve, &budget, &on);
        stretch.map_err(|why| self.in_frame(why))
    }

    /// Lets frame `k` pass, unless the user stops it on its way: everything is then as it was at its
    /// beginning. A frame that is not long is not stopped; whether it is, the one before tells.
    pub(super) fn frame_unless_stopped(
        &mut self,
        k: u64,
        frames: Frames,
        limits: &Limits,
        n_evaluations: Option<u64>,
    ) -> Result<Result<Report, Diagnostic>, Stopped> {
        interrupt::rest();
        let frame = |it: &mut Self| it.one_frame(k, frames, limits, Stop::Allowed);
        match n_evaluations {
            None => Ok(frame(self)),
            Some(n) if n < LONG_FRAME => Ok(interrupt::undisturbed(|| frame(self))),
            Some(_) => {
                let way = self.way_back(k, k);
                let report = interrupt::catch(|| frame(self));
                report.inspect_err(|_| self.go_back(way))
            }
        }
    }
}
