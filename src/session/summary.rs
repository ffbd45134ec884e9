//! The receipt of a command that let time pass: what it did, and what it has to confess.

use std::fmt::Write;

use super::culprits::Culprits;
use super::preferences::Receipt;
use crate::diag::{Span, format_counted, format_number, format_rounded, format_seconds};
use crate::solve::{Method, Report, Settings, Status, Stretch, Verdict};
use crate::world::{NameText, PointId, World};

/// Receipt of a command that let time pass.
#[derive(Debug, Clone)]
pub struct Summary {
    /// Frames that were solved.
    pub n_frames: u64,
    /// Frames that did not reach the tolerance.
    pub n_missed: u64,
    /// The first frame that missed, as the clock counts.
    pub first_missed: Option<u64>,
    /// Frames whose time was up before they were solved.
    pub n_late: u64,
    /// Iterations of all frames together.
    pub n_iterations: u64,
    /// The largest residual of a frame, relative to the scene's size.
    pub worst_residual: f64,
    /// How the worst frame ended.
    pub worst_status: Status,
    /// The least relaxation coefficient that was used instead of the user's.
    pub lowered_rho: Option<f64>,
    /// The tolerance that was asked for last.
    pub tolerance: f64,
    /// Frames after which something may be on another branch of its motion.
    pub n_turned_over: u64,
    /// The first few of them, as the clock counts, each with a point that changed sides.
    pub turned_over: Vec<(u64, NameText)>,
    /// The first frame that began in a pose where branches meet, and a point that goes along one.
    pub chosen: Option<(u64, NameText)>,
    /// Wall time of all frames together, seconds, where there is a clock.
    pub seconds: Option<f64>,
    /// How the frames were solved, with the number of frames each.
    pub ways: Vec<(Way, u64)>,
    /// How far points may be from where they belong, length units, where that can be said and
    /// somebody listens.
    pub position_error: Option<f64>,
    /// The same, as it was worked out frame by frame where the mechanism was next to a singular
    /// pose; 0 if it never was.
    pub(super) error_on_the_way: f64,
    /// Who is to blame, once a command ended in a frame that missed.
    pub(super) culprits: Option<Culprits>,
    /// The statement of the last frame.
    pub(super) ended_at: Option<Span>,
    /// The statement whose frame was the first to miss.
    pub(super) missed_at: Option<Span>,
    /// The statement whose frame was the first to turn over.
    pub(super) turned_over_at: Option<Span>,
    /// The statement whose frame that was.
    pub(super) chosen_at: Option<Span>,
}

/// How frames were solved, as far as the user chose it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Way {
    /// The method.
    pub method: Method,
    /// The relaxation coefficient.
    pub rho: f64,
    /// The most iterations.
    pub iterations: u32,
}

/// Frames that may have changed branch, each told by its number.
const MOST_TURNED_OVER: usize = 5;
/// Ways that are told before it becomes too many.
const MOST_WAYS: usize = 4;
impl Summary {
    /// No frames yet.
    pub(super) const fn new() -> Self {
        Self {
            n_frames: 0,
            n_missed: 0,
            first_missed: None,
            n_late: 0,
            n_iterations: 0,
            worst_residual: 0.0,
            worst_status: Status::Converged,
            lowered_rho: None,
            tolerance: 0.0,
            n_turned_over: 0,
            turned_over: Vec::new(),
            chosen: None,
            seconds: None,
            ways: Vec::new(),
            position_error: None,
            error_on_the_way: 0.0,
            culprits: None,
            ended_at: None,
            missed_at: None,
            turned_over_at: None,
            chosen_at: None,
        }
    }

    /// Frames solved with these settings follow.
    pub(super) fn begin(&mut self, settings: &Settings, tolerance: f64) {
        let &Settings { method, rho, iterations, .. } = settings;
        let way = Way { method, rho, iterations };
        self.tolerance = tolerance;
        if self.ways.last().is_none_or(|(last, _)| *last != way) {
            self.ways.push((way, 0));
        }
    }

    /// One frame more, after which the world is this. What is named may be gone when it is told of.
    pub(super) fn add(&mut self, report: &Report, world: &World, span: Span) {
        let frame = world.clock().frame;
        let name = |point: PointId| NameText::from(world.points().name(point));
        self.n_frames += 1;
        self.ended_at = Some(span);
        if let Some((_, n)) = self.ways.last_mut() {
            *n += 1;
        }
        self.n_iterations += report.iterations;
        self.worst_residual = self.worst_residual.max(report.residual);
        self.error_on_the_way = self.error_on_the_way.max(report.position_error);
        self.worst_status = self.worst_status.max(report.status);
        self.n_late += u64::from(report.is_interrupted);
        if report.status != Status::Converged || report.is_interrupted {
            self.n_missed += 1;
            self.first_missed.get_or_insert(frame);
            self.missed_at.get_or_insert(span);
        }
        if let Some(point) = report.turned_over {
            self.n_turned_over += 1;
            if self.turned_over.len() < MOST_TURNED_OVER {
                self.turned_over.push((frame, name(point)));
            }
            self.turned_over_at.get_or_insert(span);
        }
        if let (None, Some(point)) = (&self.chosen, report.chosen) {
            (self.chosen, self.chosen_at) = (Some((frame, name(point))), Some(span));
        }
        if let Some(rho) = report.lowered_rho {
            self.lowered_rho = Some(self.lowered_rho.map_or(rho, |least| least.min(rho)));
        }
    }

    /// Frames more that passed at once.
    pub(super) fn add_stretch(&mut self, stretch: &Stretch, span: Span) {
        self.n_frames += stretch.n_frames;
        self.ended_at = Some(span);
        if let Some((_, n)) = self.ways.last_mut() {
            *n += stretch.n_frames;
        }
        self.n_iterations += stretch.iterations;
        self.worst_residual = self.worst_residual.max(stretch.residual);
        self.error_on_the_way = self.error_on_the_way.max(stretch.position_error);
    }

    /// The last frame missed after all, by what was found of its pose.
    pub(super) fn own_up(&mut self, verdict: &Verdict, frame: u64) {
        self.worst_residual = self.worst_residual.max(verdict.residual);
        self.worst_status = self.worst_status.max(verdict.status).max(Status::Stalled);
        self.n_missed += 1;
        self.first_missed.get_or_insert(frame);
        self.missed_at = self.missed_at.or(self.ended_at);
    }

    /// So much more wall time went by: what the clock said before, and says now.
    pub(super) fn add_time(&mut self, before: Option<f64>, now: Option<f64>) {
        if let (Some(before), Some(now)) = (before, now) {
            *self.seconds.get_or_insert(0.0) += now - before;
        }
    }

    /// Whether at least so many seconds of wall time went by.
    pub(super) fn is_longer_than(&self, seconds: f64) -> bool {
        self.seconds.is_some_and(|all| all >= seconds)
    }

    /// The receipt, in one line; the clock shows `time`.
    pub(super) fn line(&self, receipt: Receipt, time: f64) -> String {
        let mut text = match receipt {
            Receipt::Short => self.short(time),
            Receipt::Long => self.long(),
        };
        // Writing to a string cannot fail.
        if self.n_missed > 0 {
            let _ = write!(text, ", {} missed {}", self.n_missed, format_number(self.tolerance));
        }
        if self.n_late > 0 {
            let _ = write!(text, ", {} of them for want of time", self.n_late);
        }
        if let Some(rho) = self.lowered_rho {
            let rho = format_rounded(rho);
            let _ = write!(text, ", rho lowered to {rho} where it would diverge");
        }
        text
    }

    fn short(&self, time: f64) -> String {
        let mut text = format!("t = {} s, {}", format_rounded(time), frames(self.n_frames));
        if self.n_missed > 0 {
            return text;
        }
        // Writing to a string cannot fail.
        let _ = write!(text, ", exact to {}", format_number(self.tolerance));
        // What is near to the tolerance goes without saying.
        if let Some(error) = self.position_error.filter(|error| *error > 100.0 * self.tolerance) {
            let _ = write!(text, ", positions to about {}", format_rounded(error));
        }
        text
    }

    fn long(&self) -> String {
        let n = self.n_frames.max(1) as f64;
        let mut text = format!(
            "{} by {}: {} iterations{} a frame, largest residual {}",
            frames(self.n_frames),
            self.ways_text(),
            format_rounded(self.n_iterations as f64 / n),
            self.seconds.map_or_else(String::new, |it| format!(" and {}", format_seconds(it / n))),
            format_rounded(self.worst_residual)
        );
        // Writing to a string cannot fail.
        if let Some(error) = self.position_error.filter(|error| *error > 0.0) {
            let _ = write!(text, ", position error about {}", format_rounded(error));
        }
        text
    }

    /// How the worst frame ended, as far as that was tested.
    fn ended(&self) -> Status {
        match &self.culprits {
            Some(culprits) if self.worst_status == Status::BestFit => culprits.status,
            _ => self.worst_status,
        }
    }

    fn ways_text(&self) -> String {
        if let [(way, _)] = &self.ways[..] {
            return way.to_string();
        }
        let told = self.ways.iter().filter(|(_, n)| *n > 0);
        let mut text: Vec<String> =
            told.take(MOST_WAYS).map(|(way, n)| format!("{way} ({n})")).collect();
        if self.ways.len() > MOST_WAYS {
            text.push(format!("{} more", self.ways.len() - MOST_WAYS));
        }
        text.join(", then ")
    }

    /// What is wrong with the frames after the first `n_before` that missed; none if nothing.
    pub(super) fn broken(&self, n_before: u64) -> Option<(String, String)> {
        if self.n_missed <= n_before {
            return None;
        }
        let message = format!(
            "{} of {} did not reach the tolerance {}",
            self.n_missed,
            frames(self.n_frames),
            format_number(self.tolerance)
        );
        let label = format!(
            "largest residual {}, first at frame {}: {}",
            format_rounded(self.worst_residual),
            self.first_missed.unwrap_or_default(),
            self.ended().phrase()
        );
        Some((message, label))
    }
}

fn frames(n: u64) -> String {
    format_counted(n, "frame")
}

impl std::fmt::Display for Way {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        f.write_str(self.method.word())?;
        match self.method {
            Method::Auto => Ok(()),
            method if method.is_relaxed() => {
                write!(f, " (rho {}, iterations {})", format_number(self.rho), self.iterations)
            }
            _ => write!(f, " (iterations {})", self.iterations),
        }
    }
}
