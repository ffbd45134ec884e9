//! Frames that pass at once, where a command asks for nothing between them.

use super::run::{Hands, LONG, Limits};
use crate::session::execution::Execution;
use crate::session::preferences::AtDeadPoint;
use crate::session::quotas::Quota;
use crate::session::state::State;
use crate::solve::{Budget, Stretch};

/// Frames between which it is told how far a run is.
const MOST_AT_ONCE: u64 = 1000;

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
    pub(super) fn stretch(&mut self, n: u64, limits: &Limits, known_error: f64) -> Stretch {
        let most = self.input.quotas.of(Quota::TraceSamples);
        let Self { state, host, .. } = &mut *self;
        let State { solver, world, preferences, .. } = &mut **state;
        // No more than traces may keep: the frame that exceeds that is told of by itself.
        let n_kept = world.traces().iter().map(|trace| trace.samples.len() as u64).sum();
        let n_left = most.saturating_sub(n_kept).checked_div(world.traces().len() as u64);
        let n = n.min(n_left.unwrap_or(n)).min(MOST_AT_ONCE);
        let budget = Budget { tolerance: limits.tolerance, stop: None, known_error };
        let goes_on = || !host.is_interrupted();
        solver.stretch(world, &preferences.solve, &budget, n, &goes_on)
    }
}
