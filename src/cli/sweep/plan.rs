//! A sweep as the user wants it: the script and its grid, and which of its rows are to be run.

use std::io;
use std::path::Path;

use crate::cli::args::SweepArguments;
use crate::cli::files;
use crate::cli::process_host::ProcessHost;
use crate::diag::{Diagnostic, Kind, Sources, format_count};
use crate::errors;
use crate::session::{Grid, Host, Refusal, Shard, Sweep, SweepScript, Variant, reason};

/// A grid of more variants has to be meant.
const MOST_VARIANTS: f64 = 1e8;

/// How variants went, together.
#[derive(Debug, Default)]
pub struct Counts {
    pub failed: u64,
    pub missed: u64,
    pub dead: u64,
}

impl Counts {
    fn of(variant: &Variant) -> Self {
        Self {
            failed: u64::from(variant.failure.is_some()),
            missed: u64::from(variant.n_missed > 0),
            dead: u64::from(variant.n_dead_points > 0),
        }
    }

    /// Adds others.
    pub fn join(&mut self, other: &Self) {
        self.failed += other.failed;
        self.missed += other.missed;
        self.dead += other.dead;
    }
}

/// A sweep, and what the user wants of it.
pub struct Plan<'a> {
    pub wish: &'a SweepArguments,
    pub sweep: Sweep,
    shard: Shard,
}

impl<'a> Plan<'a> {
    /// Reads the script and runs what shows its columns.
    pub fn begin(wish: &'a SweepArguments) -> Result<Self, Refusal> {
        let text = files::read(&wish.file).map_err(|e| {
            let message = format!("cannot read `{}`: {}", wish.file.display(), reason(&e));
            failure(Diagnostic::error(errors::CANNOT_READ, message).kind(Kind::Unreadable))
        })?;
        let grid = Grid { axes: wish.host.set.clone() };
        let n = grid.n_variants();
        if n > MOST_VARIANTS && !wish.host.force {
            let message = format!("{} variants are a great many", format_count(n));
            return Err(failure(
                Diagnostic::error(errors::OUT_OF_RANGE, message)
                    .help("larger steps make fewer; `--force` runs them all the same"),
            ));
        }
        let folder = wish.file.parent().map(Path::to_path_buf).unwrap_or_default();
        let limits = wish.host.limits.clone();
        let script = SweepScript::read(&wish.file.to_string_lossy(), &text, folder, limits)?;
        let sweep = Sweep::begin(script, grid, &mut new_host(wish))?;
        Ok(Self { wish, sweep, shard: wish.shard.unwrap_or(Shard::WHOLE) })
    }

    /// Whom a variant talks to.
    pub fn host(&self) -> ProcessHost {
        new_host(self.wish)
    }

    /// How many rows the table is to have.
    pub fn n_rows(&self) -> u64 {
        self.shard.n_rows(self.sweep.n_variants())
    }

    /// A row of the table, and how its variant went; none where the user stops it.
    pub fn row(&self, row: u64, host: &mut dyn Host) -> Option<(String, Counts)> {
        let variant = self.sweep.variant(self.shard.variant(row), host)?;
        let columns = self.sweep.columns();
        let text =
            if self.wish.host.json { columns.object(&variant) } else { columns.row(&variant) };
        Some((text, Counts::of(&variant)))
    }
}

fn new_host(wish: &SweepArguments) -> ProcessHost {
    ProcessHost::new(&wish.host, files::folder_of(&wish.file))
}

/// What is wrong, in no text.
pub fn failure(problem: Diagnostic) -> Refusal {
    (problem, Sources::new())
}

/// What is wrong where something cannot be written.
pub fn unwritable(name: &str, e: &io::Error) -> Diagnostic {
    Diagnostic::error(errors::CANNOT_WRITE, format!("cannot write `{name}`: {}", reason(e)))
        .kind(Kind::Unreadable)
}
