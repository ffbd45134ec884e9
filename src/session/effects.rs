//! What `effects` finds, and how it is told.

use crate::diag::{format_counted, format_digits};

/// The effects of a scene, the islands it falls into, and what a frame costs.
#[derive(Debug, Clone)]
pub struct Effects {
    /// Every effect there is, switched on or not.
    pub rows: Vec<EffectRow>,
    /// How many islands there are, and how many of them a frame visits.
    pub islands: (usize, usize),
    /// How many frames were timed, on a copy.
    pub n_frames: u64,
    /// Why none was, if so.
    pub why_none: &'static str,
    /// The wall time they took, looking at the clock left out, seconds.
    pub seconds: f64,
}

/// What one effect came to.
#[derive(Debug, Clone)]
pub struct EffectRow {
    /// Its name.
    pub name: &'static str,
    /// Whether the scene calls for it.
    pub is_on: bool,
    /// The statements that call for it, by name.
    pub because: Vec<String>,
    /// The memory kept for it, bytes.
    pub n_bytes: usize,
    /// The part of the time of those frames that it took, seconds.
    pub seconds: f64,
}

/// Names told of those that call for an effect.
const NAMES_TOLD: usize = 6;

/// Columns of the table, most names left out.
const WIDTH: usize = 68;

impl Effects {
    /// The effects as lines of text, as a table where that fits.
    pub fn lines(&self, n_columns: usize) -> Vec<String> {
        let mut lines = if n_columns < WIDTH { self.paragraphs() } else { self.table() };
        let (total, awake) = self.islands;
        lines.push(format!("islands: {total}, {awake} awake, {} asleep", total - awake.min(total)));
        lines.push(match self.n_frames {
            0 => format!("no frame is timed: {}", self.why_none),
            n => format!(
                "a frame takes {} us, over {} of a copy",
                self.per_frame(self.seconds),
                format_counted(n, "frame")
            ),
        });
        lines
    }

    fn table(&self) -> Vec<String> {
        let head = ("effect", "", "memory", "us a frame", "share");
        let head = format!(
            "{:<20}{:<5}{:>10}{:>12}{:>8}  because of",
            head.0, head.1, head.2, head.3, head.4
        );
        let row = |row: &EffectRow| {
            if !row.is_on {
                return format!("{:<20}off", row.name);
            }
            let (time, share) = self.cost(row).unwrap_or_else(|| ("-".to_owned(), "-".to_owned()));
            format!(
                "{:<20}{:<5}{:>10}{time:>12}{share:>8}  {}",
                row.name,
                "on",
                bytes(row.n_bytes),
                row.told_because()
            )
        };
        std::iter::once(head).chain(self.rows.iter().map(row)).collect()
    }

    /// What a table says, for pages that have no room for one.
    fn paragraphs(&self) -> Vec<String> {
        let on = |row: &EffectRow| {
            let cost = self.cost(row).map(|(time, share)| format!("{time} us a frame, {share}"));
            let memory = (row.n_bytes > 0).then(|| bytes(row.n_bytes));
            let what: Vec<String> = [cost, memory].into_iter().flatten().collect();
            let says = if what.is_empty() { "on".to_owned() } else { what.join("; ") };
            [format!("{}: {says}", row.name), format!("  because of {}", row.told_because())]
        };
        let off: Vec<&str> =
            self.rows.iter().filter(|row| !row.is_on).map(|row| row.name).collect();
        let mut lines: Vec<String> =
            self.rows.iter().filter(|row| row.is_on).flat_map(on).collect();
        if !off.is_empty() {
            lines.push(format!("off: {}", off.join(", ")));
        }
        lines
    }

    /// The time of an effect in a frame and its share of that, if frames were timed.
    fn cost(&self, row: &EffectRow) -> Option<(String, String)> {
        let share = 100.0 * row.seconds / self.seconds.max(f64::MIN_POSITIVE);
        let share = match share {
            share if share > 0.0 && share < 0.01 => "<0.01%".to_owned(),
            share => format!("{}%", format_digits(share, 3)),
        };
        (self.n_frames > 0).then(|| (self.per_frame(row.seconds), share))
    }

    /// Microseconds a frame.
    fn per_frame(&self, seconds: f64) -> String {
        format_digits(seconds / self.n_frames.max(1) as f64 * 1e6, 3)
    }
}

impl EffectRow {
    fn told_because(&self) -> String {
        match self.because.len() {
            n if n <= NAMES_TOLD => self.because.join(", "),
            n => format!("{} and {} more", self.because[..NAMES_TOLD].join(", "), n - NAMES_TOLD),
        }
    }
}

fn bytes(n: usize) -> String {
    match n {
        0 => "-".to_owned(),
        n if n < 10_000 => format!("{n} B"),
        n if n < 10_000_000 => format!("{} kB", n / 1000),
        n => format!("{} MB", n / 1_000_000),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_stay_apart_however_small_a_share() {
        let row = |seconds| EffectRow {
            name: "ghosts",
            is_on: true,
            because: vec!["expose".to_owned()],
            n_bytes: 480,
            seconds,
        };
        let rows = [1e-9, 1.23e-5, 0.1234, 1.0].map(row).to_vec();
        let effects = Effects { rows, islands: (1, 1), n_frames: 240, why_none: "", seconds: 1.0 };
        for line in &effects.lines(WIDTH)[1..5] {
            assert_eq!(line.split_whitespace().count(), 7, "{line}");
        }
    }

    #[test]
    fn a_narrow_page_gets_sentences() {
        let row = |name, is_on| EffectRow {
            name,
            is_on,
            because: if is_on { vec!["crank".to_owned()] } else { Vec::new() },
            n_bytes: 480,
            seconds: 0.25,
        };
        let rows = vec![row("clock", true), row("ghosts", false), row("traces", false)];
        let effects = Effects { rows, islands: (1, 1), n_frames: 1, why_none: "", seconds: 1.0 };
        let wanted = [
            "clock: 250000 us a frame, 25%; 480 B",
            "  because of crank",
            "off: ghosts, traces",
            "islands: 1, 1 awake, 0 asleep",
            "a frame takes 1000000 us, over 1 frame of a copy",
        ];
        assert_eq!(effects.lines(40), wanted);
    }
}
