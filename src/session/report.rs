//! What a command that let time pass tells at its end.

use super::execution::Execution;
use super::finding::Finding;
use super::summary::Summary;
use crate::constraint::{Carried, Constraint, ConstraintKind as _};
use crate::diag::{Diagnostic, listed};
use crate::solve::{Settings, Status, verdict};
use crate::study::freedoms;

/// Scenes up to so many constraints are analysed for the receipt of every run: it takes less
/// than a tenth of a millisecond.
const SMALL: usize = 48;
/// Larger ones only after a run of so many seconds.
const LONG: f64 = 0.5;
/// The largest that is ever analysed.
const LARGE: usize = 2000;

impl Execution<'_> {
    /// Tells the user what the command under way ran, if it ran anything.
    pub(super) fn report_run(&mut self) {
        let Some(mut summary) = self.run.take() else { return };
        self.judge_the_end(&mut summary);
        summary.position_error = self.estimate_position_error(&summary);
        self.tell_chosen(&summary);
        self.tell_turned_over(&summary);
        let time = self.state.world.clock().time();
        let is_taken = self.host.takes_findings();
        // Of variants and trials nobody reads it.
        let is_read = self.host.is_listening() || !is_taken;
        let line = if is_read {
            summary.line(self.state.preferences.receipt, time)
        } else {
            String::new()
        };
        if is_taken && summary.n_frames > 0 {
            self.host.find_out(&Finding::Ran(&summary, time, &line));
        }
        match (summary.broken(0), summary.missed_at) {
            (Some((message, label)), Some(span)) => {
                let mut warning = Diagnostic::warning(message).at(span, label);
                if let Some(culprits) = &summary.culprits {
                    warning = culprits.explain(warning);
                }
                self.warn(&warning.note(line));
            }
            _ if summary.n_frames > 0 && !is_taken => self.note(line),
            _ => {}
        }
        self.history.note_run(summary, &self.state.world);
    }

    /// Sees to it that a receipt says converged only of a pose that is, where looking costs
    /// little beside what ran.
    fn judge_the_end(&mut self, summary: &mut Summary) {
        let n = self.state.world.n_constraints();
        let is_cheap = n <= SMALL || summary.is_longer_than(LONG);
        if !is_cheap || summary.n_frames == 0 || summary.n_missed > 0 {
            return;
        }
        let settings = Settings { tolerance: summary.tolerance, ..self.state.preferences.solve };
        let verdict = verdict(&self.state.world, &settings);
        if !verdict.is_met() {
            summary.own_up(&verdict, self.state.world.clock().frame);
            summary.culprits = Some(self.state.culprits(summary.worst_status, &[]));
        }
    }

    /// Warns of a motion that began where its branches meet.
    fn tell_chosen(&mut self, summary: &Summary) {
        let (Some((frame, name)), Some(span)) = (&summary.chosen, summary.chosen_at) else {
            return;
        };
        let warning = Diagnostic::warning(format!("frame {frame} began where two branches meet"))
            .at(span, format!("nothing tells along which of them `{name}` is to go on"));
        self.warn(&warning.help("a start a little beside it is on one of them"));
    }

    /// Warns of frames that may have changed branch.
    fn tell_turned_over(&mut self, summary: &Summary) {
        let ([(frame, point), ..], Some(span)) = (&summary.turned_over[..], summary.turned_over_at)
        else {
            return;
        };
        let n = summary.n_turned_over;
        let message = match n {
            1 => format!("frame {frame} may have changed branch"),
            n => format!("{n} frames may have changed branch, the first is frame {frame}"),
        };
        let events = summary.turned_over.iter();
        let mut events: Vec<String> =
            events.map(|(frame, point)| format!("`{point}` in frame {frame}")).collect();
        if n > events.len() as u64 {
            events.push(format!("{} more", n - events.len() as u64));
        }
        let label = match n {
            1 => format!("`{point}` changed sides in a single jump"),
            _ => format!("changed sides in a single jump: {}", listed(&events, "and")),
        };
        let warning = Diagnostic::warning(message).at(span, label);
        self.warn(&warning.help("smaller frames (`set dt`) follow the motion"));
    }

    /// The residual over the smallest singular value at the end, or what was worked out on the way
    /// where the mechanism was next to a singular pose; where nothing is free.
    fn estimate_position_error(&self, summary: &Summary) -> Option<f64> {
        let n = self.state.world.n_constraints();
        let is_cheap = n <= SMALL || (n <= LARGE && summary.is_longer_than(LONG));
        let is_solved = summary.worst_status == Status::Converged && summary.n_frames > 0;
        if !is_cheap || !is_solved || n == 0 || !self.host.is_listening() {
            return None;
        }
        // Wheels in velocity form drift without any residual.
        let is_drifting = |c: &Constraint| c.traits().carried == Carried::ByFrame;
        if self.state.world.constraints().any(|(_, r)| r.is_on && is_drifting(&r.constraint)) {
            return None;
        }
        // The residual is relative to what hangs together; the scene is at least as large.
        freedoms(&self.state.world, &[])
            .position_error(summary.worst_residual * self.state.solver.size(&self.state.world))
            .map(|at_the_end| at_the_end.max(summary.error_on_the_way))
    }
}
