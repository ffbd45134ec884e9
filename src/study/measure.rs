//! The study itself: reference, one look at every rung, then rounds of timings.

use super::course::Course;
use super::reference::{self, Found, Reference};
use super::report::{Cut, Measure, Row, Study, Why};
use super::sample::Subject;
use super::setting_ladder::{Rung, Step};
use crate::diag::Diagnostic;

/// What a study needs of the world outside.
pub struct Outside<'a> {
    /// Seconds since some fixed moment.
    pub now: &'a dyn Fn() -> f64,
    /// Whether to come to an end with what there is.
    pub stop: &'a dyn Fn() -> bool,
    /// Told how much is done, from 0 to 1.
    pub progress: &'a dyn Fn(f64),
    /// How long it may take, roughly, seconds.
    pub seconds: f64,
}

impl Outside<'_> {
    /// Why a run that is over is over.
    pub(super) fn why_over(&self) -> Why {
        if (self.stop)() { Why::Stopped } else { Why::TooSlow }
    }
}

/// Rounds of timings a rung gets at least, unless time runs out.
const LEAST_ROUNDS: usize = 5;
/// And at most.
const MOST_ROUNDS: usize = 25;
/// A median is stable if the middle half of the rounds is within this of it.
const STABLE: f64 = 0.03;
/// Shares of the time for the reference and for one rung's first run.
const REFERENCE_SHARE: f64 = 0.2;
const RUNG_SHARE: f64 = 0.04;
/// The share of the progress told when all rungs have been looked at.
const LOOKED: f64 = 0.4;

/// Repeats a course with every rung of a ladder.
///
/// # Errors
/// A live expression that has no value in the reference run.
pub fn study(course: &Course, ladder: &[Rung], outside: &Outside) -> Result<Study, Diagnostic> {
    let begun = (outside.now)();
    (outside.progress)(0.0);
    let mut found = reference::of_motion(course, outside, REFERENCE_SHARE * outside.seconds)?;
    let mut notes = std::mem::take(&mut found.notes);
    let start;
    let mut subject = Subject { course, is_still: false, n_frames: found.n_frames };
    if found.is_still {
        notes.insert(
            0,
            "nothing moves in this scene: what is studied is one solve of the pose it \
                         was given"
                .to_owned(),
        );
        start = course.at_the_start();
        subject = Subject { course: &start, is_still: true, n_frames: 1 };
        found = reference::of_pose(&subject, outside)?;
        notes.append(&mut found.notes);
    }
    let Found { reference, .. } = found;
    let mut study = Study {
        rows: Vec::new(),
        cuts: Vec::new(),
        notes,
        measure: if reference.is_some() { Measure::Position } else { Measure::Residual },
        n_frames: subject.n_frames,
        is_still: subject.is_still,
        is_stopped: false,
        seconds: 0.0,
        floor: reference.as_ref().map_or(f64::EPSILON, |reference| reference.error),
    };
    if subject.n_frames > 0 {
        look(&subject, ladder, reference.as_ref(), outside, &mut study);
        time(&subject, outside, begun, &mut study)?;
    }
    if study.rows.iter().all(|row| row.residual == 0.0) && study.is_still {
        study
            .notes
            .push("the pose satisfies everything as it is: there is nothing to solve".into());
    }
    study.mark_efficient();
    study.is_stopped = (outside.stop)();
    study.seconds = (outside.now)() - begun;
    (outside.progress)(1.0);
    Ok(study)
}

/// Runs every rung once and looks at every frame.
fn look(
    subject: &Subject,
    ladder: &[Rung],
    reference: Option<&Reference>,
    outside: &Outside,
    study: &mut Study,
) {
    for (k, &rung) in ladder.iter().enumerate() {
        (outside.progress)(LOOKED * k as f64 / ladder.len() as f64);
        let is_after = |cut: &Cut| {
            cut.why == Why::TooSlow
                && cut.rung.method == rung.method
                && matches!(rung.step, Step::Iterations(_))
        };
        let outcome = if (outside.stop)() {
            Err(Why::Stopped)
        } else if study.cuts.iter().any(is_after) {
            Err(Why::TooSlow)
        } else {
            subject.look(rung, reference, outside, RUNG_SHARE * outside.seconds)
        };
        match outcome {
            Ok(outcome) => study.rows.push(Row {
                rung,
                settings: rung.settings(&subject.course.settings),
                seconds_per_frame: outcome.seconds,
                spread: 0.0,
                n_rounds: 1,
                residual: outcome.residual,
                position_error: outcome.position_error,
                n_failed: outcome.n_failed,
                is_efficient: false,
            }),
            Err(why) => study.cuts.push(Cut { rung, why }),
        }
    }
}

/// Times every rung, one after the other and round after round, so that what else the machine
/// does falls on all of them; a rung whose median is stable rests.
fn time(
    subject: &Subject,
    outside: &Outside,
    begun: f64,
    study: &mut Study,
) -> Result<(), Diagnostic> {
    let mut samples: Vec<Vec<f64>> = vec![Vec::new(); study.rows.len()];
    let is_over = || (outside.stop)() || (outside.now)() - begun > outside.seconds;
    'rounds: for _ in 0..MOST_ROUNDS {
        let mut is_stable = true;
        for (row, samples) in study.rows.iter().zip(&mut samples) {
            if samples.len() >= LEAST_ROUNDS && median_and_spread(samples).1 <= STABLE {
                continue;
            }
            if is_over() {
                break 'rounds;
            }
            is_stable = false;
            samples.push(subject.time(row.rung, outside)?);
            let by_time = ((outside.now)() - begun) / outside.seconds;
            (outside.progress)((LOOKED + (1.0 - LOOKED) * by_time).min(1.0));
        }
        if is_stable {
            break;
        }
    }
    for (row, mut samples) in study.rows.iter_mut().zip(samples) {
        if !samples.is_empty() {
            row.n_rounds = samples.len();
            (row.seconds_per_frame, row.spread) = median_and_spread(&mut samples);
        }
    }
    Ok(())
}

/// The median, and half of what the middle half spans, relative to it.
fn median_and_spread(samples: &mut [f64]) -> (f64, f64) {
    samples.sort_by(f64::total_cmp);
    let at = |share: f64| samples[(share * (samples.len() - 1) as f64).round() as usize];
    let median = at(0.5);
    (median, if median > 0.0 { 0.5 * (at(0.75) - at(0.25)) / median } else { 0.0 })
}
