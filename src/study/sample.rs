//! One run of one rung: what it comes to, and how long it takes.

use std::hash::{DefaultHasher, Hash, Hasher};

use super::host::StudyHost;
use super::reference::Reference;
use super::repeatable_motion::{RepeatableMotion, Replay};
use super::report::Why;
use super::setting_ladder::{Rung, Step};
use crate::diag::Diagnostic;
use crate::solve::{Budget, Report, Settings, Solver, Status};
use crate::world::World;

/// A pose this many sizes away from the reference has left the scene.
const BLOWN: f64 = 1e3;
/// A solve of a pose is repeated until this much time is measured: enough for the clock.
const LEAST_SECONDS: f64 = 2e-4;
/// No clock tells anything shorter, and a logarithm needs something.
const LEAST_TIME: f64 = 1e-9;
/// And no more often than this.
const MOST_SOLVES: usize = 100;

/// What is done again and again: a motion, or one solve of a pose.
pub(super) struct Subject<'a> {
    pub motion: &'a RepeatableMotion,
    pub is_still: bool,
    pub n_frames: u64,
}

/// What a run came to.
pub(super) struct RunOutcome {
    /// Seconds a frame, the median.
    pub seconds: f64,
    /// The largest residual of a frame.
    pub residual: f64,
    /// The largest error of a frame, if there is a reference.
    pub position_error: Option<f64>,
    /// Frames that missed the tolerance.
    pub n_failed: u64,
    /// What it did, frame by frame.
    pub track: Track,
}

/// A digest of where a run led and of the work that it took, frame by frame: runs of one method with the same
/// one did the same operations.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) struct Track(u64);

impl Track {
    /// Takes in a frame.
    fn take(&mut self, world: &World, report: &Report) {
        let mut hasher = DefaultHasher::new();
        (self.0, report.iterations, report.counters).hash(&mut hasher);
        for at in world.points().column() {
            (at.x.to_bits(), at.y.to_bits()).hash(&mut hasher);
        }
        self.0 = hasher.finish();
    }
}

impl Subject<'_> {
    /// Runs a rung and looks at every frame; gives why it was cut short, if it was.
    pub fn look(
        &self,
        rung: Rung,
        reference: Option<&Reference>,
        host: &StudyHost,
        seconds: f64,
    ) -> Result<RunOutcome, Why> {
        let settings = rung.settings(&self.motion.settings);
        let begun = (host.now)();
        let is_over = || (host.stop)() || (host.now)() - begun > seconds;
        let budget = Budget { tolerance: None, stop: Some(&is_over), ..Budget::default() };
        let mut outcome = RunOutcome {
            seconds: 0.0,
            residual: 0.0,
            position_error: reference.map(|_| 0.0),
            n_failed: 0,
            track: Track::default(),
        };
        let take = |outcome: &mut RunOutcome, world: &World, report: &Report, k: usize| {
            outcome.residual = outcome.residual.max(report.residual);
            outcome.n_failed += u64::from(report.status != Status::Converged);
            outcome.track.take(world, report);
            let error = reference.map(|reference| reference.error_of(world, k));
            if let (Some(worst), Some(error)) = (&mut outcome.position_error, error) {
                *worst = worst.max(error);
            }
            // A number that is none is not below the limit either.
            let is_sane = |value: f64| value <= BLOWN;
            is_sane(report.residual) && error.is_none_or(is_sane)
        };
        let no_value = |problem: Diagnostic| Why::NoValue(problem.message.to_string());
        if self.is_still {
            let (world, report, seconds) =
                self.solve(&settings, rung.step, &budget, host).map_err(no_value)?;
            outcome.seconds = seconds;
            if is_over() {
                return Err(host.why_over());
            }
            return if take(&mut outcome, &world, &report, 0) {
                Ok(outcome)
            } else {
                Err(Why::Blown)
            };
        }
        let mut replay = Replay::new(self.motion, 1);
        let mut times = Vec::with_capacity(self.n_frames as usize);
        for k in 0..self.n_frames {
            let before = (host.now)();
            let report = replay.frame(&settings, &budget).map_err(no_value)?;
            times.push((host.now)() - before);
            if is_over() {
                return Err(host.why_over());
            }
            if !take(&mut outcome, &replay.world, &report, k as usize) {
                return Err(Why::Blown);
            }
        }
        outcome.seconds = median(&mut times);
        Ok(outcome)
    }

    /// Runs a rung by the clock alone; gives the median of the times of its frames, seconds. A
    /// mean would tell of what else the machine was doing: that falls on few frames, but hard.
    pub fn time(&self, rung: Rung, host: &StudyHost) -> Result<f64, Diagnostic> {
        let settings = rung.settings(&self.motion.settings);
        let overhead = overhead(host);
        let mut times;
        if self.is_still {
            times = Vec::with_capacity(MOST_SOLVES);
            let mut sum = 0.0;
            while sum < LEAST_SECONDS && times.len() < MOST_SOLVES {
                let seconds = self.solve(&settings, rung.step, &Budget::default(), host)?.2;
                times.push(seconds);
                sum += seconds;
            }
        } else {
            times = Vec::with_capacity(self.n_frames as usize);
            let mut replay = Replay::new(self.motion, 1);
            let mut before = (host.now)();
            for _ in 0..self.n_frames {
                replay.frame(&settings, &Budget::default())?;
                let now = (host.now)();
                times.push(now - before);
                before = now;
            }
        }
        Ok((median(&mut times) - overhead).max(LEAST_TIME))
    }

    /// Solves the pose by a method until it is solved, or stuck.
    pub fn solve_pose(
        &self,
        settings: &Settings,
        host: &StudyHost,
    ) -> Result<(World, Report), Diagnostic> {
        let budget = Budget { tolerance: None, stop: Some(host.stop), ..Budget::default() };
        let (world, report, _) =
            self.solve(settings, Step::Tolerance(settings.tolerance), &budget, host)?;
        Ok((world, report))
    }

    fn solve(
        &self,
        settings: &Settings,
        step: Step,
        budget: &Budget,
        host: &StudyHost,
    ) -> Result<(World, Report, f64), Diagnostic> {
        let mut world = self.motion.world().clone();
        world.refresh_driven()?;
        let mut solver = Solver::new();
        // The scene is taken in before the clock runs: a mechanism is built once and solved often.
        let at_once = || true;
        let nothing = Budget { tolerance: None, stop: Some(&at_once), ..Budget::default() };
        solver.settle(&mut world, settings, &nothing);
        let before = (host.now)();
        let report = match step {
            Step::Iterations(n) => solver.relax(&mut world, settings, n.into()),
            Step::Tolerance(_) => solver.settle(&mut world, settings, budget),
        };
        let seconds = (host.now)() - before;
        let is_met = report.status == Status::Converged;
        match if is_met { None } else { world.failed_measure() } {
            Some(why) => Err(why),
            None => Ok((world, report, seconds)),
        }
    }
}

/// What looking at the clock takes, seconds.
fn overhead(host: &StudyHost) -> f64 {
    let mut before = (host.now)();
    let mut times = [0.0; 31];
    for time in &mut times {
        let now = (host.now)();
        *time = now - before;
        before = now;
    }
    median(&mut times)
}

/// The median of some numbers, of which there is at least one.
fn median(values: &mut [f64]) -> f64 {
    let middle = values.len() / 2;
    *values.select_nth_unstable_by(middle, f64::total_cmp).1
}
