//! Letting time pass: `step`, `run`, `drag`; and iterating while it stands still: `relax`, `solve`.

use super::dead_point::Next;
use super::perform::format_count;
use super::{Diagnostic, Flow, Session};
use crate::constraint::{Point, Vector};
use crate::diag::{Kind, Span, format_number};
use crate::lang::ast::{DragTarget, Expr, Promise};
use crate::solve::{Budget, Report, Status};
use crate::world::{Edit, PointId};

/// Receipt of a command that let time pass.
#[derive(Debug, Clone)]
pub struct Summary {
    /// Frames that were solved.
    pub n_frames: u64,
    /// Frames that did not reach the tolerance.
    pub n_missed: u64,
    /// The first frame that missed, as the clock counts.
    pub first_missed: Option<u64>,
    /// Iterations of all frames together.
    pub n_iterations: u64,
    /// The largest residual of a frame, relative to the scene's size.
    pub worst_residual: f64,
    /// How the worst frame ended.
    pub worst_status: Status,
    /// The least relaxation coefficient that was used instead of the user's.
    pub lowered_rho: Option<f64>,
    /// The tolerance that was asked for.
    pub tolerance: f64,
    /// Frames after which something may be on another branch of its motion.
    pub n_turned_over: u64,
    /// The first of them, as the clock counts, and a point that changed sides.
    pub first_turned_over: Option<(u64, PointId)>,
    /// Wall time of all frames together, seconds.
    pub seconds: f64,
}

impl Summary {
    const fn new(tolerance: f64) -> Self {
        Self {
            n_frames: 0,
            n_missed: 0,
            first_missed: None,
            n_iterations: 0,
            worst_residual: 0.0,
            worst_status: Status::Converged,
            lowered_rho: None,
            tolerance,
            n_turned_over: 0,
            first_turned_over: None,
            seconds: 0.0,
        }
    }

    fn add(&mut self, report: &Report, frame: u64) {
        self.n_frames += 1;
        self.n_iterations += report.iterations;
        self.worst_residual = self.worst_residual.max(report.residual);
        self.worst_status = self.worst_status.max(report.status);
        if report.status != Status::Converged {
            self.n_missed += 1;
            self.first_missed.get_or_insert(frame);
        }
        if let Some(point) = report.turned_over {
            self.n_turned_over += 1;
            self.first_turned_over.get_or_insert((frame, point));
        }
        if let Some(rho) = report.lowered_rho {
            self.lowered_rho = Some(self.lowered_rho.map_or(rho, |least| least.min(rho)));
        }
    }
}

/// A promise, evaluated.
#[derive(Debug, Clone, Copy, Default)]
struct Limits {
    tolerance: Option<f64>,
    seconds: Option<f64>,
}

/// Iterations of `relax` between two looks at whether the user wants to stop.
const RELAX_CHUNK: u64 = 256;

impl Session {
    fn promised(&mut self, promise: &Promise) -> Result<Limits, Diagnostic> {
        let mut positive = |expr: &Option<Expr>| -> Result<Option<f64>, Diagnostic> {
            let Some(expr) = expr else { return Ok(None) };
            let value = self.number(expr)?;
            if value > 0.0 {
                return Ok(Some(value));
            }
            Err(Diagnostic::error("expected a number above 0")
                .at(expr.span, format!("this is {}", format_number(value))))
        };
        Ok(Limits { tolerance: positive(&promise.within)?, seconds: positive(&promise.in_time)? })
    }

    pub(super) fn step(
        &mut self,
        frames: Option<&Expr>,
        promise: &Promise,
        span: Span,
    ) -> Result<Flow, Diagnostic> {
        let n = match frames {
            None => 1,
            Some(n) => self.count(n, 0.0, super::limits::MOST_FRAMES, "frames")?,
        };
        let limits = self.promised(promise)?;
        self.frames(n, limits, span, |_, _| {})
    }

    pub(super) fn run(
        &mut self,
        time: &Expr,
        promise: &Promise,
        span: Span,
    ) -> Result<Flow, Diagnostic> {
        let value = self.number(time)?;
        let n = (value / self.world.clock().dt).round();
        if !(0.0..=super::limits::MOST_FRAMES).contains(&n) {
            let what = if value < 0.0 { "time does not run backwards" } else { "too many frames" };
            return Err(
                Diagnostic::error(what).at(time.span, format!("{} frames of dt", format_count(n)))
            );
        }
        let limits = self.promised(promise)?;
        self.frames(n as u64, limits, span, |_, _| {})
    }

    pub(super) fn drag(
        &mut self,
        targets: &[DragTarget],
        over: Option<&Expr>,
        span: Span,
    ) -> Result<Flow, Diagnostic> {
        let n = match over {
            None => 1,
            Some(n) => self.count(n, 1.0, super::limits::MOST_FRAMES, "frames")?,
        };
        let mut paths: Vec<(PointId, Point, Vector)> = Vec::new();
        for target in targets {
            let id = self.point(&target.point)?;
            if paths.iter().any(|(other, ..)| *other == id) {
                return Err(Diagnostic::error("one point cannot be dragged to two places")
                    .at(target.point.span, "dragged twice"));
            }
            let (from, to) = (self.world.points().at(id), self.place(&target.to)?);
            paths.push((id, from, to - from));
        }
        // A free point is held by the hand that drags it, and let go after.
        let free: Vec<PointId> =
            paths.iter().map(|p| p.0).filter(|&id| !self.world.points().is_frozen(id)).collect();
        self.begin_motion();
        for &id in &free {
            self.edit(Edit::Freeze(id, true));
        }
        let is_at_start = self.world.clock().frame == 0;
        let flow = self.frames(n, Limits::default(), span, |session, k| {
            for &(id, from, way) in &paths {
                let at = if k == n { from + way } else { from + way * (k as f64 / n as f64) };
                session.world.apply(Edit::Move(id, at));
            }
        })?;
        for &id in &free {
            self.edit(Edit::Freeze(id, false));
        }
        // The hand moved before the clock left 0: `reset` puts the point back under it.
        if is_at_start && self.world.clock().frame > 0 {
            for &(id, from, _) in &paths {
                self.edit(Edit::Start(id, from));
            }
        }
        Ok(flow)
    }

    /// Lets `n` frames pass. Before each, `hand` may move points; it is given the frame's
    /// number, from 1.
    fn frames(
        &mut self,
        n: u64,
        limits: Limits,
        span: Span,
        hand: impl Fn(&mut Self, u64),
    ) -> Result<Flow, Diagnostic> {
        self.begin_motion();
        let tolerance = limits.tolerance.unwrap_or(self.preferences.solve.tolerance);
        let mut summary = Summary::new(tolerance);
        let mut flow = Flow::On;
        let begun = self.host.seconds();
        let leaves_nothing = self.world.traces().is_empty()
            && self.recorders.is_empty()
            && self.preferences.expose_every.is_none();
        let mut lookout = self.lookout();
        for k in 1..=n {
            if self.host.is_interrupted() {
                flow = Flow::Stopped;
                self.note(format!("stopped after {} of {n} frames", k - 1));
                break;
            }
            self.look_out(&mut lookout);
            self.attend();
            hand(self, k);
            let mut report = self.pass(&limits).map_err(|why| self.in_frame(why))?;
            if report.status != Status::Converged {
                match self.met(&lookout, k, n) {
                    Next::On => {}
                    Next::Again => {
                        self.attend();
                        hand(self, k);
                        report = self.pass(&limits).map_err(|why| self.in_frame(why))?;
                    }
                    Next::Stop => break,
                }
            }
            summary.add(&report, self.world.clock().frame);
            if !leaves_nothing {
                self.keep_frame(report.status != Status::Converged);
            }
        }
        summary.seconds = self.host.seconds() - begun;
        let broken = self.tell_summary(&summary, &limits, span);
        self.last_run = Some(summary);
        broken.map_or(Ok(flow), Err)
    }

    /// Adds to an error in which frame it came up.
    fn in_frame(&self, why: Diagnostic) -> Diagnostic {
        let clock = self.world.clock();
        why.note(format!("at frame {}, time {}", clock.frame, format_number(clock.time())))
    }

    fn pass(&mut self, limits: &Limits) -> Result<Report, Diagnostic> {
        let Self { solver, world, preferences, host, .. } = self;
        match limits.seconds {
            None => {
                let budget = Budget { tolerance: limits.tolerance, stop: None };
                solver.pass(world, &preferences.solve, &budget)
            }
            Some(seconds) => {
                let deadline = host.seconds() + seconds;
                let is_late = || host.seconds() >= deadline;
                let budget = Budget { tolerance: limits.tolerance, stop: Some(&is_late) };
                solver.pass(world, &preferences.solve, &budget)
            }
        }
    }

    /// Says what a run has to confess; gives the error where it broke a promise.
    fn tell_summary(
        &mut self,
        summary: &Summary,
        limits: &Limits,
        span: Span,
    ) -> Option<Diagnostic> {
        if let Some(rho) = summary.lowered_rho {
            let given = format_number(self.preferences.solve.rho);
            self.note(format!(
                "rho {given} would diverge on this scene; {} was used",
                format_rounded(rho)
            ));
        }
        if let Some((frame, point)) = summary.first_turned_over {
            let name = self.world.points().name(point);
            let message = match summary.n_turned_over {
                1 => format!("frame {frame} may have changed branch"),
                n => format!("{n} frames may have changed branch, the first is frame {frame}"),
            };
            let label = format!("`{name}` changed sides in a single jump");
            let warning = Diagnostic::warning(message).at(span, label);
            self.warn(&warning.help("smaller frames (`set dt`) follow the motion"));
        }
        if summary.n_missed == 0 {
            return None;
        }
        let frames = if summary.n_frames == 1 { "frame" } else { "frames" };
        let message = format!(
            "{} of {} {frames} did not reach the tolerance {}",
            summary.n_missed,
            summary.n_frames,
            format_number(summary.tolerance)
        );
        let first = summary.first_missed.unwrap_or_default();
        let label = format!(
            "largest residual {}, first at frame {first}: {}",
            format_rounded(summary.worst_residual),
            summary.worst_status.phrase()
        );
        if limits.tolerance.is_some() {
            return Some(Diagnostic::error(message).kind(Kind::Promise).at(span, label));
        }
        self.warn(&Diagnostic::warning(message).at(span, label));
        None
    }

    pub(super) fn relax(&mut self, n: Option<&Expr>) -> Result<Flow, Diagnostic> {
        let n = n.map_or(Ok(1), |n| self.count(n, 0.0, 1e12, "iterations"))?;
        self.begin_motion();
        let mut left = n;
        let mut lowered: Option<f64> = None;
        let mut flow = Flow::On;
        while left > 0 {
            if self.host.is_interrupted() {
                self.note(format!("stopped after {} of {n} iterations", n - left));
                flow = Flow::Stopped;
                break;
            }
            if self.world.is_measured() {
                self.world.refresh_measured()?;
            }
            let chunk = left.min(RELAX_CHUNK);
            let report = self.solver.relax(&mut self.world, &self.preferences.solve, chunk);
            if let Some(rho) = report.lowered_rho {
                lowered = Some(lowered.map_or(rho, |least| least.min(rho)));
            }
            left -= chunk;
        }
        if let Some(rho) = lowered {
            let given = format_number(self.preferences.solve.rho);
            self.note(format!(
                "rho {given} would diverge on this scene; {} was used",
                format_rounded(rho)
            ));
        }
        Ok(flow)
    }

    pub(super) fn solve(&mut self, promise: &Promise, span: Span) -> Result<(), Diagnostic> {
        let limits = self.promised(promise)?;
        self.begin_motion();
        let is_measured = self.world.is_measured();
        if is_measured {
            self.world.refresh_measured()?;
        }
        let mut report = {
            let Self { solver, world, preferences, host, .. } = self;
            let deadline = limits.seconds.map(|s| host.seconds() + s);
            let is_over = || {
                host.is_interrupted() || deadline.is_some_and(|deadline| host.seconds() >= deadline)
            };
            let budget = Budget { tolerance: limits.tolerance, stop: Some(&is_over) };
            solver.settle(world, &preferences.solve, &budget)
        };
        if is_measured {
            let Self { solver, world, preferences, .. } = self;
            let budget = Budget { tolerance: limits.tolerance, stop: None };
            solver.agree(world, &preferences.solve, &budget, &mut report)?;
        }
        let text = format!(
            "{}: residual {} after {} iterations",
            report.status.phrase(),
            format_rounded(report.residual),
            report.iterations
        );
        if limits.tolerance.is_some() && report.status != Status::Converged {
            return Err(Diagnostic::error("the tolerance was not reached")
                .kind(Kind::Promise)
                .at(span, text));
        }
        self.note(text);
        Ok(())
    }
}

/// A number for talk: three digits say enough.
pub(super) fn format_rounded(value: f64) -> String {
    format_digits(value, 3)
}

/// A number rounded to so many digits.
pub(super) fn format_digits(value: f64, n_digits: usize) -> String {
    let text = format!("{value:.*e}", n_digits - 1);
    format_number(text.parse().unwrap_or(value))
}
