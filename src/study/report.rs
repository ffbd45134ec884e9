//! What a study found.

use super::setting_ladder::Rung;
use crate::diag::{format_counted, format_digits};
use crate::solve::Settings;

/// What came of a study.
#[derive(Debug, Clone)]
pub struct Study {
    /// A row for each rung that was run whole, in the order of the ladder.
    pub rows: Vec<RungResult>,
    /// The rungs that were not.
    pub cuts: Vec<Cut>,
    /// What is shown and what is not, in words.
    pub notes: Vec<String>,
    /// What the errors of the rows are.
    pub measure: ErrorMeasure,
    /// Frames of the motion; 1 for a pose.
    pub n_frames: u64,
    /// Whether a pose was solved, there being no motion.
    pub is_still: bool,
    /// Whether the user stopped it.
    pub is_stopped: bool,
    /// How long it took, seconds.
    pub seconds: f64,
    /// Errors below this are rounding, and equal.
    pub floor: f64,
}

/// By what error rows are compared.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ErrorMeasure {
    /// The position error: there is a reference.
    Position,
    /// The largest residual, for want of a reference.
    Residual,
}

impl ErrorMeasure {
    /// What it is called.
    pub const fn words(self) -> &'static str {
        match self {
            Self::Position => "position error",
            Self::Residual => "residual",
        }
    }
}

/// What one setting costs and gives.
#[derive(Debug, Clone)]
pub struct RungResult {
    /// The method and its setting.
    pub rung: Rung,
    /// All settings it was run with.
    pub settings: Settings,
    /// The median over the rounds of the median time of a frame, seconds.
    pub seconds_per_frame: f64,
    /// Half of what the middle half of the rounds spans, relative to the median.
    pub spread: f64,
    /// How often it was timed.
    pub n_rounds: usize,
    /// The largest residual of a frame, relative to the size.
    pub residual: f64,
    /// The largest distance of a point from its reference, relative to the size.
    pub position_error: Option<f64>,
    /// Frames that missed the tolerance.
    pub n_failed: u64,
    /// No other is both faster and more accurate.
    pub is_efficient: bool,
}

impl RungResult {
    /// The error by which it is compared.
    pub fn error(&self, measure: ErrorMeasure) -> f64 {
        match measure {
            ErrorMeasure::Position => self.position_error.unwrap_or(f64::INFINITY),
            ErrorMeasure::Residual => self.residual,
        }
    }
}

/// A rung that was not run to its end.
#[derive(Debug, Clone, PartialEq)]
pub struct Cut {
    /// Which.
    pub rung: Rung,
    /// Why.
    pub why: Why,
}

/// Why a rung was not run to its end.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Why {
    /// It takes too long, or a smaller setting of the same method did.
    TooSlow,
    /// Points left for infinity.
    Blown,
    /// An expression has no value in the poses it led to.
    NoValue(String),
    /// The user stopped the study before.
    Stopped,
}

impl Why {
    /// In words, behind a list of settings.
    pub fn phrase(&self) -> String {
        match self {
            Self::TooSlow => "too slow".to_owned(),
            Self::Blown => "points left for infinity".to_owned(),
            Self::NoValue(message) => format!("led to a pose where {message}"),
            Self::Stopped => "not reached before the study was stopped".to_owned(),
        }
    }
}

impl Study {
    /// Marks the rows that none is better than.
    pub(super) fn mark_efficient(&mut self) {
        let (measure, floor) = (self.measure, self.floor);
        let place = |row: &RungResult| (row.seconds_per_frame, row.error(measure).max(floor));
        let places: Vec<(f64, f64)> = self.rows.iter().map(place).collect();
        for (k, row) in self.rows.iter_mut().enumerate() {
            row.is_efficient = !is_beaten(&places, k);
        }
    }

    /// The efficient rows, the fastest first.
    pub fn frontier(&self) -> Vec<&RungResult> {
        let mut rows: Vec<&RungResult> = self.rows.iter().filter(|row| row.is_efficient).collect();
        rows.sort_by(|a, b| a.seconds_per_frame.total_cmp(&b.seconds_per_frame));
        rows
    }

    /// What was cut, in words: a line for each method and reason.
    pub fn cut_notes(&self) -> Vec<String> {
        let is_together = |a: &Cut, b: &Cut| a.rung.method == b.rung.method && a.why == b.why;
        let groups = self.cuts.chunk_by(is_together);
        let line = |group: &[Cut]| {
            let settings: Vec<String> = group.iter().map(|cut| cut.rung.setting()).collect();
            let (method, why) = (group[0].rung.method.word(), group[0].why.phrase());
            format!("left out: {method} {}: {why}", settings.join(", "))
        };
        groups.map(line).collect()
    }

    /// What was done, in a line.
    pub fn summary(&self) -> String {
        let what = if self.is_still {
            "one solve of the starting pose".to_owned()
        } else {
            format_counted(self.n_frames, "frame")
        };
        let n_rounds = self.rows.iter().map(|row| row.n_rounds);
        let (least, most) = (n_rounds.clone().min(), n_rounds.max());
        let mut spreads: Vec<f64> = self.rows.iter().map(|row| row.spread).collect();
        spreads.sort_by(f64::total_cmp);
        let spread = spreads.get(spreads.len() / 2).copied().unwrap_or(0.0);
        let good = format!("times good to about {} %", format_digits(100.0 * spread, 2));
        let times = match (least, most) {
            (Some(1), Some(1)) => "each timed once".to_owned(),
            (Some(a), Some(b)) if a == b => format!("{a} rounds, {good}"),
            (Some(a), Some(b)) => format!("{a} to {b} rounds, {good}"),
            _ => "none timed".to_owned(),
        };
        format!(
            "{what}, {} settings, {times}, {} s in all",
            self.rows.len(),
            format_digits(self.seconds, 2)
        )
    }
}

/// Whether another place is no worse in both and better in one; of equal places the first
/// stays.
fn is_beaten(places: &[(f64, f64)], k: usize) -> bool {
    let (x, y) = places[k];
    places
        .iter()
        .enumerate()
        .any(|(other, &(u, v))| other != k && u <= x && v <= y && (u < x || v < y || other < k))
}

#[cfg(test)]
mod tests {
    use super::is_beaten;

    #[test]
    fn a_place_is_beaten_by_one_that_is_better() {
        let check = |places: &[(f64, f64)], wanted: &[bool]| {
            let found: Vec<bool> = (0..places.len()).map(|k| is_beaten(places, k)).collect();
            assert_eq!(found, wanted, "of {places:?}");
        };
        check(&[(1.0, 1.0)], &[false]);
        check(&[(1.0, 2.0), (2.0, 1.0)], &[false, false]);
        check(&[(1.0, 1.0), (2.0, 2.0)], &[false, true]);
        check(&[(1.0, 1.0), (1.0, 2.0), (2.0, 1.0)], &[false, true, true]);
        check(&[(1.0, 1.0), (1.0, 1.0)], &[false, true]);
    }
}
