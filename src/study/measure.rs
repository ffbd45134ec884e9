//! The study itself: reference, one look at every rung, then rounds of timings.

use super::host::StudyHost;
use super::reference::Reference;
use super::reference_run::{self, FoundReference};
use super::repeatable_motion::RepeatableMotion;
use super::report::{Cut, ErrorMeasure, RungResult, Study, Why};
use super::sample::{Subject, Track};
use super::setting_ladder::{Rung, Step};
use crate::diag::Diagnostic;

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

/// Repeats a motion with every rung of a ladder.
///
/// # Errors
/// A live expression that has no value in the reference run.
pub fn study(
    motion: &RepeatableMotion,
    ladder: &[Rung],
    host: &StudyHost,
) -> Result<Study, Diagnostic> {
    let begun = (host.now)();
    (host.progress)(0.0);
    let mut found = reference_run::of_motion(motion, host, REFERENCE_SHARE * host.seconds)?;
    let mut notes = std::mem::take(&mut found.notes);
    let start;
    let mut subject = Subject { motion, is_still: false, n_frames: found.n_frames };
    if found.is_still {
        notes.insert(
            0,
            "nothing moves in this scene: what is studied is one solve of the pose it \
             was given; to study a motion, give it a motor, or `drag` a point, and `step`"
                .to_owned(),
        );
        start = motion.at_the_start();
        subject = Subject { motion: &start, is_still: true, n_frames: 1 };
        found = reference_run::of_pose(&subject, host)?;
        notes.append(&mut found.notes);
    }
    let FoundReference { reference, .. } = found;
    let mut study = Study {
        rows: Vec::new(),
        cuts: Vec::new(),
        notes,
        measure: if reference.is_some() { ErrorMeasure::Position } else { ErrorMeasure::Residual },
        n_frames: subject.n_frames,
        is_still: subject.is_still,
        is_stopped: false,
        seconds: 0.0,
        floor: reference.as_ref().map_or(f64::EPSILON, |reference| reference.error),
    };
    if subject.n_frames > 0 {
        let tracks = look(&subject, ladder, reference.as_ref(), host, &mut study);
        time(&subject, host, begun, &tracks, &mut study)?;
    }
    if study.rows.iter().all(|row| row.residual == 0.0) && study.is_still {
        study
            .notes
            .push("the pose satisfies everything as it is: there is nothing to solve".into());
    }
    study.mark_efficient();
    study.is_stopped = (host.stop)();
    study.seconds = (host.now)() - begun;
    (host.progress)(1.0);
    Ok(study)
}

/// Runs every rung once and looks at every frame; gives what each row of the study did.
fn look(
    subject: &Subject,
    ladder: &[Rung],
    reference: Option<&Reference>,
    host: &StudyHost,
    study: &mut Study,
) -> Vec<Track> {
    let mut tracks = Vec::new();
    for (k, &rung) in ladder.iter().enumerate() {
        (host.progress)(LOOKED * k as f64 / ladder.len() as f64);
        let is_after = |cut: &Cut| {
            cut.why == Why::TooSlow
                && cut.rung.method == rung.method
                && matches!(rung.step, Step::Iterations(_))
        };
        let outcome = if (host.stop)() {
            Err(Why::Stopped)
        } else if study.cuts.iter().any(is_after) {
            Err(Why::TooSlow)
        } else {
            subject.look(rung, reference, host, RUNG_SHARE * host.seconds)
        };
        match outcome {
            Ok(outcome) => {
                tracks.push(outcome.track);
                study.rows.push(RungResult {
                    rung,
                    settings: rung.settings(&subject.motion.settings),
                    seconds_per_frame: outcome.seconds,
                    spread: 0.0,
                    n_rounds: 1,
                    residual: outcome.residual,
                    position_error: outcome.position_error,
                    n_failed: outcome.n_failed,
                    is_efficient: false,
                });
            }
            Err(why) => study.cuts.push(Cut { rung, why }),
        }
    }
    tracks
}

/// For each row the first of those of its method that did the same.
fn first_alike(rows: &[RungResult], tracks: &[Track]) -> Vec<usize> {
    let is_alike =
        |j: usize, k: usize| rows[j].rung.method == rows[k].rung.method && tracks[j] == tracks[k];
    (0..rows.len()).map(|k| (0..k).find(|&j| is_alike(j, k)).unwrap_or(k)).collect()
}

/// Times every rung, one after the other and round after round, so that what else the machine
/// does falls on all of them; a rung whose median is stable rests. Settings that lead a method the same way, as
/// tolerances do that one more step meets by far, are timed once for all of them.
fn time(
    subject: &Subject,
    host: &StudyHost,
    begun: f64,
    tracks: &[Track],
    study: &mut Study,
) -> Result<(), Diagnostic> {
    let mut samples: Vec<Vec<f64>> = vec![Vec::new(); study.rows.len()];
    let first = first_alike(&study.rows, tracks);
    let is_over = || (host.stop)() || (host.now)() - begun > host.seconds;
    'rounds: for _ in 0..MOST_ROUNDS {
        let mut is_stable = true;
        for (k, (row, samples)) in study.rows.iter().zip(&mut samples).enumerate() {
            if first[k] != k {
                continue;
            }
            if samples.len() >= LEAST_ROUNDS && median_and_spread(samples).1 <= STABLE {
                continue;
            }
            if is_over() {
                break 'rounds;
            }
            is_stable = false;
            samples.push(subject.time(row.rung, host)?);
            let by_time = ((host.now)() - begun) / host.seconds;
            (host.progress)((LOOKED + (1.0 - LOOKED) * by_time).min(1.0));
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
    for (k, j) in first.into_iter().enumerate() {
        let RungResult { n_rounds, seconds_per_frame, spread, .. } = study.rows[j];
        let row = &mut study.rows[k];
        (row.n_rounds, row.seconds_per_frame, row.spread) = (n_rounds, seconds_per_frame, spread);
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
