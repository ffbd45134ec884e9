//! Letting time pass: `step`, `run`, `drag`; and iterating while it stands still: `relax`, `solve`.

use std::cell::Cell;

use super::dead_point::WayBack;
use crate::diag::{
    Diagnostic, Kind, Span, format_count, format_counted, format_digits, format_number,
    format_rounded,
};
use crate::errors;
use crate::interrupt::{self, Stopped};
use crate::lang::ast::{Expr, Promise};
use crate::session::deadline::Deadline;
use crate::session::execution::{Execution, Flow};
use crate::session::host::NO_CLOCK;
use crate::session::quotas::Quota;
use crate::session::resolve::unbind::NOWHERE;
use crate::session::state::State;
use crate::solve::{Budget, Report, Settings, Solver, Status, Verdict, least_tolerance, verdict};
use crate::study::{Hand, move_by};
use crate::world::{PointId, World};

/// A promise, evaluated.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Limits {
    /// The tolerance that each frame is to reach.
    pub tolerance: Option<f64>,
    /// The wall time that no frame is to exceed.
    pub seconds: Option<f64>,
    /// The largest position error that is known of the run.
    pub known_error: f64,
}

/// The hands that are at work while frames pass.
#[derive(Clone, Copy, Default)]
pub(super) struct Hands<'a> {
    /// Those that hold their points.
    pub firm: &'a [Hand],
    /// Those that take their points as far as the constraints allow.
    pub soft: &'a [Hand],
}

/// So many frames, and the hands that are at work in them.
#[derive(Clone, Copy)]
pub(super) struct Frames<'a> {
    pub n: u64,
    pub hands: Hands<'a>,
}

/// What a user who wants to stop does to a frame on its way.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Stop {
    /// Ends one that may take long.
    Allowed,
    /// Nothing.
    Ignored,
}

/// Iterations of `relax` between two looks at whether the user wants to stop.
const RELAX_CHUNK: u64 = 256;
/// With more iterations than that a frame may take so long that its user wants to stop it.
pub(super) const LONG: u32 = 10_000;

impl Execution<'_> {
    pub(crate) fn promised(&mut self, promise: &Promise) -> Result<Limits, Diagnostic> {
        let mut positive = |expr: &Option<Expr>| -> Result<Option<f64>, Diagnostic> {
            let Some(expr) = expr else { return Ok(None) };
            let value = self.resolve().number(expr)?;
            if value > 0.0 {
                return Ok(Some(value));
            }
            Err(Diagnostic::error(errors::OUT_OF_RANGE, "expected a number above 0")
                .at(expr.span, format!("this is {}", format_number(value))))
        };
        let (tolerance, seconds) = (positive(&promise.within)?, positive(&promise.in_time)?);
        self.input.is_unrepeatable |= seconds.is_some();
        if let Some(time) = &promise.in_time
            && self.host.seconds().is_none()
        {
            return Err(Diagnostic::error(errors::NO_CLOCK, NO_CLOCK)
                .at(time.span, "no time can be promised"));
        }
        Ok(Limits { tolerance, seconds, known_error: 0.0 })
    }

    pub(crate) fn step(
        &mut self,
        frames: Option<&Expr>,
        promise: &Promise,
        span: Span,
    ) -> Result<Flow, Diagnostic> {
        let n = match frames {
            None => 1,
            Some(n) => {
                let most = self.input.quotas.of(Quota::Frames) as f64;
                self.resolve().count(n, 0.0, most, "frames")?
            }
        };
        let limits = self.promised_here(promise)?;
        self.history.begin_leg(self.state, n, self.depth > 0);
        let (flow, n_done) = self.frames(n, limits, span, Hands::default())?;
        self.history.last_motion.end_leg(self.state, n, n_done, Vec::new());
        Ok(flow)
    }

    pub(crate) fn run(
        &mut self,
        time: &Expr,
        promise: &Promise,
        span: Span,
    ) -> Result<Flow, Diagnostic> {
        let value = self.resolve().number(time)?;
        let n = (value / self.state.world.clock().dt).round();
        let most = self.input.quotas.of(Quota::Frames) as f64;
        if !(0.0..=most).contains(&n) {
            let what = if value < 0.0 { "time does not run backwards" } else { "too many frames" };
            return Err(Diagnostic::error(errors::OUT_OF_RANGE, what)
                .at(time.span, format!("{} frames of dt", format_count(n))));
        }
        let (n, limits) = (n as u64, self.promised_here(promise)?);
        self.history.begin_leg(self.state, n, self.depth > 0);
        let (flow, n_done) = self.frames(n, limits, span, Hands::default())?;
        self.history.last_motion.end_leg(self.state, n, n_done, Vec::new());
        Ok(flow)
    }

    /// What a frame left is to be within the tolerance that was promised, also where rounding
    /// would have it otherwise.
    pub(super) fn hold_to_promise(&self, report: &mut Report, limits: &Limits) {
        let Some(tolerance) = limits.tolerance else { return };
        if report.status == Status::Converged && report.residual > tolerance {
            let found = self.verdict_within(tolerance);
            if !found.is_met() {
                report.status = found.status.max(Status::Stalled);
                report.residual = report.residual.max(found.residual);
            }
        }
    }

    /// How the present pose stands by a tolerance.
    pub(super) fn verdict_within(&self, tolerance: f64) -> Verdict {
        verdict(&self.state.world, &Settings { tolerance, ..self.state.preferences.solve })
    }

    /// The limits of a command that lets the solver work. A tolerance below what rounding allows
    /// cannot be promised.
    fn promised_here(&mut self, promise: &Promise) -> Result<Limits, Diagnostic> {
        let limits = self.promised(promise)?;
        let (Some(tolerance), Some(within)) = (limits.tolerance, &promise.within) else {
            return Ok(limits);
        };
        let least = least_tolerance(&self.state.world);
        if tolerance >= least {
            return Ok(limits);
        }
        // A twentieth more, so that two digits never round below it.
        let least = format_digits(1.05 * least, 2);
        Err(Diagnostic::error(errors::NO_PROMISE, "this cannot be promised here")
            .at(within.span, format!("{} is below what rounding allows", format_number(tolerance)))
            .help(format!("the smallest tolerance that can be promised: `within {least}`")))
    }

    /// Lets frame `k` pass.
    pub(super) fn one_frame(
        &mut self,
        k: u64,
        frames: Frames,
        limits: &Limits,
        stop: Stop,
    ) -> Result<Report, Diagnostic> {
        // What was edited is part of no frame's time.
        self.sync();
        let Self { state, host, deadline, .. } = &mut *self;
        let State { solver, world, preferences, .. } = &mut **state;
        let may_be_long = stop == Stop::Allowed && preferences.solve.iterations > LONG;
        let promised = Deadline::after(limits.seconds, &**host);
        let is_cut = Cell::new(false);
        let is_over = || {
            if may_be_long && (host.is_interrupted() || deadline.has_passed(&**host)) {
                is_cut.set(true);
            }
            is_cut.get() || promised.has_passed(&**host)
        };
        let has_end = may_be_long || promised.exists();
        let stop = has_end.then_some(&is_over as &dyn Fn() -> bool);
        let Limits { tolerance, known_error, .. } = *limits;
        let budget = Budget { tolerance, stop, known_error };
        let share = k as f64 / frames.n as f64;
        let hand = |world: &mut World| move_by(frames.hands.firm, share, world);
        let report = solver.step(world, &preferences.solve, &budget, hand);
        let report = report.and_then(|mut report| {
            if !frames.hands.soft.is_empty() && report.status == Status::Converged {
                let soft = frames.hands.soft.iter();
                let pulled: Vec<_> = soft.map(|hand| (hand.point, hand.at(share))).collect();
                let after = solver.pull(world, &preferences.solve, &budget, &pulled)?;
                report.status = report.status.max(after.status);
                report.residual = report.residual.max(after.residual);
                report.counters.add(&after.counters);
            }
            Ok(report)
        });
        // How far it came within the frame depends on the machine.
        self.input.is_unrepeatable |= is_cut.get();
        report.map_err(|why| self.in_frame(why))
    }

    /// Goes a way back, and does the frames from there up to `k` again. Each took its time
    /// already, so none is cut short: what comes out is what was.
    pub(super) fn go_back_to(
        &mut self,
        k: u64,
        way: WayBack,
        frames: Frames,
        limits: &Limits,
    ) -> Result<(), Diagnostic> {
        let limits = Limits { seconds: None, ..*limits };
        let again = way.frame..k;
        self.go_back(way);
        for k in again {
            let report = self.one_frame(k, frames, &limits, Stop::Ignored)?;
            self.keep_frame(is_missed(&report), NOWHERE)?;
        }
        Ok(())
    }

    /// Adds to an error in which frame it came up.
    pub(super) fn in_frame(&self, why: Diagnostic) -> Diagnostic {
        let clock = self.state.world.clock();
        why.note(format!("at frame {}, time {}", clock.frame, format_number(clock.time())))
    }

    pub(crate) fn relax(&mut self, n: Option<&Expr>) -> Result<Flow, Diagnostic> {
        let n = n.map_or(Ok(1), |n| self.resolve().count(n, 0.0, 1e12, "iterations"))?;
        self.begin_motion();
        let mut left = n;
        let mut lowered: Option<f64> = None;
        let mut flow = Flow::On;
        while left > 0 {
            if self.is_to_stop() {
                self.input.n_done = Some(n - left);
                self.note_stop(format!(
                    "stopped after {} of {}",
                    n - left,
                    format_counted(n, "iteration")
                ));
                flow = Flow::Stopped;
                break;
            }
            self.state.world.refresh_driven()?;
            let chunk = left.min(RELAX_CHUNK);
            let report = self.state.solver.relax(
                &mut self.state.world,
                &self.state.preferences.solve,
                chunk,
            );
            if let Some(rho) = report.lowered_rho {
                lowered = Some(lowered.map_or(rho, |least| least.min(rho)));
            }
            left -= chunk;
            self.n_done += 1;
        }
        // From here on the method that is set counts again; that is part of this command.
        self.sync();
        if let Some(rho) = lowered {
            let given = format_number(self.state.preferences.solve.rho);
            self.note(format!(
                "rho {given} would diverge on this scene; {} was used",
                format_rounded(rho)
            ));
        }
        Ok(flow)
    }

    /// Solves while the clock stands still, as long as that gets on.
    pub(super) fn settle(&mut self, limits: &Limits) -> Result<Report, Diagnostic> {
        self.solve_still(limits, Solver::settle)
    }

    /// The same for a place on the way of a hand, of which the last is to be settled.
    pub(super) fn settle_on_the_way(&mut self) -> Result<Report, Diagnostic> {
        self.solve_still(&Limits::default(), Solver::lead)
    }

    /// Settles where a hand has led, unless everything holds there already; gives how that ended.
    pub(super) fn settle_at_the_end(&mut self, status: Status) -> Result<Status, Diagnostic> {
        if status == Status::Converged {
            return Ok(status);
        }
        // What is off is looked at again, although nothing has moved it since.
        let tolerance = Some(self.state.preferences.solve.tolerance);
        Ok(self.settle(&Limits { tolerance, ..Limits::default() })?.status)
    }

    fn solve_still(
        &mut self,
        limits: &Limits,
        solve: fn(&mut Solver, &mut World, &Settings, &Budget) -> Report,
    ) -> Result<Report, Diagnostic> {
        self.state.world.refresh_driven()?;
        let report = {
            let Self { state, host, deadline, .. } = &mut *self;
            let State { solver, world, preferences, .. } = &mut **state;
            let promised = Deadline::after(limits.seconds, &**host);
            let is_over = || {
                host.is_interrupted()
                    || deadline.has_passed(&**host)
                    || promised.has_passed(&**host)
            };
            let budget =
                Budget { tolerance: limits.tolerance, stop: Some(&is_over), ..Budget::default() };
            solve(solver, world, &preferences.solve, &budget)
        };
        // Whatever it came to, more might have come of it.
        if self.is_asked_to_stop() {
            interrupt::go_on(Stopped);
        }
        if report.status != Status::Converged
            && let Some(why) = self.state.world.failed_measure()
        {
            return Err(why);
        }
        Ok(report)
    }

    /// Says how the present pose stands, unless everything holds, and who is to blame.
    pub(super) fn tell_unless_solved(&mut self, status: Status, hands: &[Hand]) {
        let verdict = self.verdict_within(self.state.preferences.solve.tolerance);
        if verdict.is_met() || !self.host.is_listening() {
            return;
        }
        let held: Vec<PointId> = hands.iter().map(|hand| hand.point).collect();
        let found = self.state.culprits(verdict.ending(status), &held);
        let residual = format_rounded(verdict.residual);
        self.note(format!("{}: residual {residual}", found.status.phrase()));
        found.notes.iter().chain(&found.helps).for_each(|text| self.note(text.as_str()));
    }

    /// Solves what an edit left unsolved, where the user wants that after each.
    pub(crate) fn solve_after_edit(&mut self) -> Result<(), Diagnostic> {
        let tolerance = self.state.preferences.solve.tolerance;
        if self.verdict_within(tolerance).is_met() {
            return Ok(());
        }
        self.begin_motion();
        let report = self.settle(&Limits::default())?;
        let status = self.verdict_within(tolerance).ending(report.status);
        if status != Status::Converged && self.host.is_listening() {
            let found = self.state.culprits(status, &[]);
            self.note(found.status.phrase());
            found.notes.iter().chain(&found.helps).for_each(|text| self.note(text.as_str()));
        }
        Ok(())
    }

    pub(crate) fn solve(&mut self, promise: &Promise, span: Span) -> Result<(), Diagnostic> {
        let limits = self.promised_here(promise)?;
        self.begin_motion();
        let report = self.settle(&limits)?;
        let tolerance = limits.tolerance.unwrap_or(self.state.preferences.solve.tolerance);
        let verdict = self.verdict_within(tolerance);
        let mut status = verdict.ending(report.status);
        let mut culprits = None;
        if status != Status::Converged && (self.host.is_listening() || limits.tolerance.is_some()) {
            let found = self.state.culprits(status, &[]);
            status = found.status;
            culprits = Some(found);
        }
        let text = format!(
            "{}: residual {} after {}",
            status.phrase(),
            format_rounded(verdict.residual),
            format_counted(report.iterations, "iteration")
        );
        if limits.tolerance.is_some() && !verdict.is_met() {
            let problem =
                Diagnostic::error(errors::BROKEN_PROMISE, "the tolerance was not reached");
            let problem = problem.kind(Kind::Promise).at(span, text);
            return Err(culprits.iter().fold(problem, |problem, it| it.explain(problem)));
        }
        self.note(text);
        if let Some(found) = &culprits {
            found.notes.iter().chain(&found.helps).for_each(|text| self.note(text.as_str()));
        }
        Ok(())
    }
}

/// Whether a frame counts as missed.
pub(super) fn is_missed(report: &Report) -> bool {
    report.status != Status::Converged || report.is_interrupted
}
