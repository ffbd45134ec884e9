//! Frames one after the other: until so many have passed, or until somebody says that it is enough.

use super::dead_point::{Next, WayBack};
use super::pace::Pace;
use super::run::{Frames, Hands, Limits, is_missed};
use crate::diag::{Diagnostic, Kind, Span, format_counted, format_number};
use crate::errors;
use crate::session::execution::{Execution, Flow};
use crate::session::summary::Summary;
use crate::solve::Status;
use crate::world::PointId;

/// Frames on their way: what is kept from one to the next.
pub(crate) struct Passage {
    /// The statement that lets them pass.
    span: Span,
    limits: Limits,
    pub summary: Summary,
    /// Of earlier statements of the command.
    n_before: u64,
    n_missed_before: u64,
    /// How many have passed.
    pub n_passed: u64,
    /// Whether nothing is kept of a frame but the pose.
    leaves_nothing: bool,
    way_back: Option<WayBack>,
    /// How the last one ended.
    last: Status,
    /// Of the frame before; what a command begins with it goes back to by itself.
    n_evaluations: Option<u64>,
}

/// How a frame went.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Passed {
    /// The next may follow.
    On,
    /// It was taken back, and no other is to follow.
    Over,
    /// The user stopped it on its way; it was taken back.
    Stopped,
}

impl Execution<'_> {
    /// Lets `n` frames pass, in which hands go their ways; gives how many did.
    pub(super) fn frames(
        &mut self,
        n: u64,
        limits: Limits,
        span: Span,
        hands: Hands,
    ) -> Result<(Flow, u64), Diagnostic> {
        let mut passage = self.begin_frames(n, limits, span)?;
        let begun = self.host.seconds();
        let mut flow = Flow::On;
        let is_told = n > 1 && self.begin_work();
        let mut pace = Pace::new(self.may_stretch(&limits, hands));
        while passage.n_passed < n {
            if is_told {
                self.host.progress(passage.n_passed as f64 / n as f64);
            }
            let passed = if self.is_to_stop() {
                Passed::Stopped
            } else {
                self.pass_some(&mut passage, &mut pace, Frames { n, hands })?
            };
            match passed {
                Passed::On => continue,
                Passed::Over => break,
                Passed::Stopped => flow = Flow::Stopped,
            }
            self.input.n_done = Some(passage.n_passed);
            self.note_stop(format!(
                "stopped after {} of {}",
                passage.n_passed,
                format_counted(n, "frame")
            ));
            break;
        }
        if is_told {
            self.end_work();
        }
        passage.summary.add_time(begun, self.host.seconds());
        Ok((flow, self.end_frames(passage, hands)?))
    }

    /// Up to `n` frames are about to pass.
    pub(super) fn begin_frames(
        &mut self,
        n: u64,
        limits: Limits,
        span: Span,
    ) -> Result<Passage, Diagnostic> {
        let clock = self.state.world.clock();
        if !(clock.time() + n as f64 * clock.dt).is_finite() {
            return Err(Diagnostic::error(errors::OUT_OF_RANGE, "the clock does not go that far")
                .at(span, format!("time would be beyond {}", format_number(f64::MAX))));
        }
        self.begin_motion();
        let settings = self.state.preferences.solve;
        let mut summary = self.run.take().unwrap_or(Summary::new());
        summary.begin(&settings, limits.tolerance.unwrap_or(settings.tolerance));
        self.begin_measures()?;
        Ok(Passage {
            span,
            limits,
            n_before: summary.n_frames,
            n_missed_before: summary.n_missed,
            n_passed: 0,
            leaves_nothing: self.state.world.traces().is_empty()
                && !self.state.world.has_measures()
                && self.state.recorders.is_empty()
                && self.state.preferences.expose_every.is_none(),
            way_back: None,
            last: Status::Converged,
            n_evaluations: (summary.n_frames > 0).then_some(0),
            summary,
        })
    }

    /// Lets as many frames pass as pass at once, or the next one.
    pub(super) fn pass_some(
        &mut self,
        passage: &mut Passage,
        pace: &mut Pace,
        frames: Frames,
    ) -> Result<Passed, Diagnostic> {
        if pace.is_due() && frames.n - passage.n_passed > 1 {
            let n_at_once = self.pass_at_once(passage, frames.n)?;
            pace.note(n_at_once);
            if n_at_once > 0 {
                return Ok(Passed::On);
            }
        }
        self.pass_one(passage, frames)
    }

    /// Lets frames pass at once up to the `n`th, as far as that goes; gives how many did.
    fn pass_at_once(&mut self, passage: &mut Passage, n: u64) -> Result<u64, Diagnostic> {
        let known_error = passage.summary.error_on_the_way;
        let stretch = self.stretch(n - passage.n_passed, &passage.limits, known_error)?;
        if stretch.n_frames > 0 {
            passage.n_passed += stretch.n_frames;
            self.n_done += stretch.n_frames;
            passage.summary.add_stretch(&stretch, passage.span);
            passage.last = Status::Converged;
        }
        Ok(stretch.n_frames)
    }

    /// Lets one frame pass, the next of those that `frames` tells of.
    pub(super) fn pass_one(
        &mut self,
        passage: &mut Passage,
        frames: Frames,
    ) -> Result<Passed, Diagnostic> {
        let k = passage.n_passed + 1;
        // Frames that the time decides about are not the same when done again.
        self.keep_way_back(&mut passage.way_back, k, passage.limits.seconds.is_some());
        let limits = Limits { known_error: passage.summary.error_on_the_way, ..passage.limits };
        let Ok(report) = self.frame_unless_stopped(k, frames, &limits, passage.n_evaluations)
        else {
            return Ok(Passed::Stopped);
        };
        let mut report = report?;
        passage.n_evaluations = Some(report.counters.evaluations);
        if report.status != Status::Converged {
            let next = self.met(passage.way_back.is_some(), k, frames.n);
            if next != Next::On
                && let Some(way) = passage.way_back.take()
            {
                self.go_back_to(k, way, frames, &limits)?;
            }
            match next {
                Next::On => {}
                Next::Again(motors) => {
                    motors.into_iter().for_each(|id| self.reverse(id));
                    report = self.one_frame(k, frames, &limits, super::run::Stop::Allowed)?;
                }
                Next::Stop => return Ok(Passed::Over),
            }
        }
        self.hold_to_promise(&mut report, &limits);
        passage.n_passed = k;
        self.n_done += 1;
        passage.last = report.status;
        passage.summary.add(&report, &self.state.world, passage.span);
        if !passage.leaves_nothing {
            self.keep_frame(is_missed(&report), passage.span)?;
        }
        Ok(Passed::On)
    }

    /// No more frames are to pass; gives how many did.
    pub(super) fn end_frames(&mut self, passage: Passage, hands: Hands) -> Result<u64, Diagnostic> {
        let Passage { span, limits, mut summary, n_before, n_missed_before, mut last, .. } =
            passage;
        if let Some(tolerance) = limits.tolerance
            && last == Status::Converged
            && summary.n_frames > n_before
        {
            // What sleeps had no frame that could have missed.
            let found = self.verdict_within(tolerance);
            if !found.is_met() {
                last = found.status.max(Status::Stalled);
                summary.own_up(&found, self.state.world.clock().frame);
            }
        }
        let is_asked = self.host.is_listening() || limits.tolerance.is_some();
        if last != Status::Converged && summary.culprits.is_none() && is_asked {
            let held: Vec<PointId> = hands.firm.iter().map(|hand| hand.point).collect();
            summary.culprits = Some(self.state.culprits(last, &held));
        }
        let broken = summary.broken(n_missed_before).filter(|_| limits.tolerance.is_some());
        let n_done = summary.n_frames - n_before;
        let result = match broken {
            None => Ok(n_done),
            Some((message, label)) => {
                let problem = Diagnostic::error(errors::BROKEN_PROMISE, message)
                    .kind(Kind::Promise)
                    .at(span, label);
                Err(summary.culprits.iter().fold(problem, |problem, it| it.explain(problem)))
            }
        };
        self.run = Some(summary);
        result
    }
}

impl Passage {
    /// The statement that let these frames pass was written after they had.
    pub fn write_at(&mut self, span: Span) {
        let Self { span: own, summary, .. } = self;
        *own = span;
        for place in [&mut summary.ended_at, &mut summary.missed_at, &mut summary.turned_over_at] {
            *place = place.map(|_| span);
        }
    }
}
