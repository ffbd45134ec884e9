//! One frame from beginning to end: time passes, points are driven, everything is solved.

use super::{Budget, Report, Settings, Solver, Status};
use crate::diag::Diagnostic;
use crate::world::World;

/// How often a pose is solved anew for values that are measured on it, before it counts as
/// not settled. Each round shrinks the difference where the measure is a mild function.
const MEASURE_ROUNDS: u32 = 60;

impl Solver {
    /// Lets one frame pass: the clock ticks, live values are evaluated, the pose is solved,
    /// and solved again until values that are measured on it agree with it. Points that a hand
    /// drags along in this frame are moved after [`Solver::sync`] and before this.
    ///
    /// # Errors
    /// A live expression that has no value at this time or in this pose.
    pub fn pass(
        &mut self,
        world: &mut World,
        settings: &Settings,
        budget: &Budget,
    ) -> Result<Report, Diagnostic> {
        if self.is_behind() {
            self.sync(world, settings);
        }
        world.advance()?;
        let mut report = self.frame(world, settings, budget);
        if world.is_mutual() {
            self.agree(world, settings, budget, &mut report)?;
        }
        Ok(report)
    }

    /// Solves until values that are measured on the pose agree with it.
    ///
    /// # Errors
    /// A live expression that has no value in this pose.
    pub fn agree(
        &mut self,
        world: &mut World,
        settings: &Settings,
        budget: &Budget,
        report: &mut Report,
    ) -> Result<(), Diagnostic> {
        let tolerance = budget.tolerance.unwrap_or(settings.tolerance);
        for _ in 0..MEASURE_ROUNDS {
            let change = world.refresh_measured()?;
            if change <= tolerance * self.size() {
                return Ok(());
            }
            let again = self.settle(world, settings, budget);
            report.iterations += again.iterations;
            report.residual = again.residual;
            report.status = again.status;
        }
        report.status = report.status.max(Status::Stalled);
        Ok(())
    }
}
