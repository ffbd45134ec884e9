//! What is too much: the bounds that keep odd input from hanging or exhausting the machine. All that
//! a user may set stand in one table.

use crate::diag::{Diagnostic, Span, format_count, format_number, suggest};
use crate::errors;

/// Something of which there is a most.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quota {
    /// Bytes of one text.
    SourceBytes,
    /// Levels of blocks.
    Nesting,
    /// Seconds of a command.
    Seconds,
    /// Statements of a command.
    Statements,
    /// Frames of a command.
    Frames,
    /// Points of a world.
    Points,
    /// Constraints of a world.
    Constraints,
    /// Samples of traces.
    TraceSamples,
    /// Values of measures.
    MeasureSamples,
    /// Points of ghosts.
    GhostPoints,
    /// Values that `sample` collected.
    PlotSamples,
    /// Frames of recordings.
    RecordedFrames,
    /// What recordings took.
    RecordedBytes,
    /// What was printed.
    PrintedBytes,
    /// Files that were written.
    Files,
    /// What was written to them.
    FileBytes,
    /// Terms of an expression.
    Terms,
    /// Commands kept for `undo`.
    UndoCommands,
    /// What these hold.
    UndoBytes,
}

/// A line of the table.
struct Row {
    quota: Quota,
    /// Its name on the command line.
    word: &'static str,
    /// What is counted.
    what: &'static str,
    /// How much of it is allowed unless the user says otherwise.
    usual: u64,
    /// How much a user may allow.
    highest: u64,
}

const fn row(quota: Quota, word: &'static str, what: &'static str, usual: u64) -> Row {
    Row { quota, word, what, usual, highest: u64::MAX }
}

/// All of them, in the order of [`Quota`]. The usual bounds keep a session below some four gigabytes
/// of memory; a slip of the pen is found in seconds.
const ROWS: [Row; 19] = [
    row(Quota::SourceBytes, "source-bytes", "bytes of a script", 64 << 20),
    // Each level takes some kilobytes of a stack that cannot grow.
    Row {
        highest: 64,
        ..row(Quota::Nesting, "nesting", "levels of `for`, `use` and `include`", 64)
    },
    // How long something takes is the machine's: a command that is long is no mistake for that.
    row(Quota::Seconds, "seconds", "seconds in one command", u64::MAX),
    row(Quota::Statements, "statements", "statements in one command", 20_000_000),
    // A billion frames of the smallest mechanism take minutes.
    row(Quota::Frames, "frames", "frames in one command", 1_000_000_000),
    row(Quota::Points, "points", "points", 4_000_000),
    row(Quota::Constraints, "constraints", "constraints", 4_000_000),
    row(Quota::TraceSamples, "trace-samples", "samples of traces", 40_000_000),
    row(Quota::MeasureSamples, "measure-samples", "values of measures", 40_000_000),
    row(Quota::GhostPoints, "ghost-points", "points of all ghosts together", 40_000_000),
    row(Quota::PlotSamples, "plot-samples", "values collected by `sample`", 40_000_000),
    row(Quota::RecordedFrames, "recorded-frames", "frames in recordings under way", 10_000_000),
    row(Quota::RecordedBytes, "recorded-bytes", "bytes kept of recordings under way", 16 << 30),
    row(Quota::PrintedBytes, "printed-bytes", "bytes printed", 4 << 30),
    row(Quota::Files, "files", "files written", 100_000),
    row(Quota::FileBytes, "file-bytes", "bytes written to files", 16 << 30),
    // Each is worked out many times a frame.
    Row {
        highest: u32::MAX as u64,
        ..row(Quota::Terms, "terms", "terms in one expression", 100_000)
    },
    // Beyond these nothing is refused: the oldest commands are forgotten.
    row(Quota::UndoCommands, "undo-commands", "commands kept for `undo`", 10_000),
    row(Quota::UndoBytes, "undo-bytes", "bytes kept for `undo`", 256 << 20),
];

/// How deep the terms of one expression may stand within each other, with all that the members in it
/// stand for: they are worked out by calls within calls.
pub const DEEPEST_EXPRESSION: u32 = 500;

/// An argument of a definition that has more terms becomes a parameter of the instance: what it is
/// handed on to mentions it, and does not hold it again.
pub const LONGEST_ARGUMENT: u32 = 64;

impl Quota {
    /// All of them.
    pub const ALL: [Self; 19] = {
        let mut all = [Self::SourceBytes; 19];
        let mut k = 0;
        while k < all.len() {
            all[k] = ROWS[k].quota;
            k += 1;
        }
        all
    };

    /// Its name on the command line.
    pub const fn word(self) -> &'static str {
        ROWS[self as usize].word
    }

    /// How much of it is allowed unless the user says otherwise.
    pub const fn usual(self) -> u64 {
        ROWS[self as usize].usual
    }
}

/// How much is allowed.
#[derive(Debug, Clone)]
pub struct Quotas {
    most: [u64; 19],
}

impl Default for Quotas {
    fn default() -> Self {
        Self { most: Quota::ALL.map(Quota::usual) }
    }
}

impl Quotas {
    /// The most of something.
    pub const fn of(&self, quota: Quota) -> u64 {
        self.most[quota as usize]
    }

    /// The most seconds of one command, where there are.
    pub fn seconds(&self) -> Option<f64> {
        let most = self.of(Quota::Seconds);
        (most < u64::MAX).then_some(most as f64)
    }

    /// The most terms of one expression.
    pub fn n_terms(&self) -> u32 {
        self.of(Quota::Terms).try_into().unwrap_or(u32::MAX)
    }

    /// Sets the most of something.
    pub const fn set(&mut self, quota: Quota, most: u64) {
        let highest = ROWS[quota as usize].highest;
        self.most[quota as usize] = if most < highest { most } else { highest };
    }

    /// Refuses so much of something where that is more than is allowed.
    ///
    /// # Errors
    /// What it is too much of, and how to allow more.
    pub fn check(&self, quota: Quota, n: u64, span: Span) -> Result<(), Diagnostic> {
        if n <= self.of(quota) {
            return Ok(());
        }
        let Row { word, what, highest, .. } = ROWS[quota as usize];
        let most = format_count(self.of(quota) as f64);
        let problem =
            Diagnostic::error(errors::TOO_MUCH, format!("the limit `{word}` is exceeded"))
                .at(span, format!("no more than {most} {what}"));
        Err(if self.of(quota) < highest {
            problem.help(format!("`--limit {word}=N` on the command line allows N"))
        } else {
            problem
        })
    }
}

/// A limit as the command line gives it: `points=1e5`, or `points=none` for no limit.
///
/// # Errors
/// Where there is no such limit, or that is no number for it.
pub fn parse_limit(text: &str) -> Result<(Quota, u64), Diagnostic> {
    let (word, number) = text
        .split_once('=')
        .ok_or_else(|| Diagnostic::error(errors::TOO_MUCH, "expected `NAME=NUMBER`"))?;
    let words = ROWS.iter().map(|row| row.word);
    let Some(row) = ROWS.iter().find(|row| row.word == word) else {
        let all: Vec<&str> = words.clone().collect();
        let problem = Diagnostic::error(
            errors::TOO_MUCH,
            format!("no limit `{word}`, but {}", all.join(", ")),
        );
        return Err(suggest(problem, word, words));
    };
    let most = match number.parse::<f64>() {
        _ if number == "none" => row.highest,
        // Beyond 2^64 it is no limit at all.
        Ok(n) if n >= 0.0 && n.fract() == 0.0 => n as u64,
        _ => {
            return Err(Diagnostic::error(
                errors::TOO_MUCH,
                format!("`{number}` is no whole number"),
            ));
        }
    };
    if most > row.highest {
        let highest = format_number(row.highest as f64);
        return Err(Diagnostic::error(
            errors::TOO_MUCH,
            format!("`{word}` cannot be more than {highest}"),
        ));
    }
    Ok((row.quota, most))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_is_in_order() {
        for (k, quota) in Quota::ALL.into_iter().enumerate() {
            assert_eq!(quota as usize, k, "{}", quota.word());
        }
    }

    #[test]
    fn limits_are_read() {
        assert_eq!(parse_limit("points=1e3").unwrap(), (Quota::Points, 1000));
        assert_eq!(parse_limit("files=0").unwrap(), (Quota::Files, 0));
        assert_eq!(parse_limit("frames=none").unwrap(), (Quota::Frames, u64::MAX));
        assert_eq!(parse_limit("nesting=none").unwrap(), (Quota::Nesting, 64));
        for wrong in ["points", "points=", "points=1.5", "points=-1", "pints=3", "nesting=65"] {
            assert!(parse_limit(wrong).is_err(), "{wrong}");
        }
    }
}
