//! `linkwork sweep`: a script run for every variant of a grid, on all cores, into one table.

mod in_order;
mod plan;
mod table;

use std::io;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::thread;

use super::args::SweepArguments;
use super::process_host::ProcessHost;
use super::progress::ProgressBar;
use super::run::{ExitStatus, Talk};
use super::{files, output};
use crate::diag::{Diagnostic, Sources};
use crate::render::Options;
use crate::session::{Finding, Host, Refusal, Swept, picture_sheet};
use in_order::in_order;
use plan::{Counts, Plan, failure, unwritable};
use table::Table;

/// Rows that a core takes at once.
const CHUNK: u64 = 8;
/// Pictures on a sheet.
const MOST_PICTURES: u64 = 100;

/// Runs a script for every variant.
pub fn sweep(wish: &SweepArguments) -> ExitStatus {
    let mut process = ProcessHost::new(&wish.host, files::folder_of(&wish.file));
    let mut talk = Talk::new(&mut process, &wish.host);
    let done = Plan::begin(wish).and_then(|plan| plan.run(talk.host()));
    done.unwrap_or_else(|(problem, sources)| {
        talk.host().tell(&problem, &sources);
        ExitStatus::of(&problem)
    })
}

impl Plan<'_> {
    fn run(&self, host: &mut dyn Host) -> Result<ExitStatus, Refusal> {
        // What was said comes before rows that go the same way.
        output::flush();
        let mut table = Table::open(self)?;
        let n_before = table.n_rows;
        let (counts, is_whole) = match self.fill(&mut table) {
            // Who reads the table has read enough; what is to be written besides still is.
            Err(e) if !table.is_file && e.kind() == io::ErrorKind::BrokenPipe => {
                if self.wish.pictures {
                    self.write_pictures(host)?;
                }
                return Ok(ExitStatus::Fine);
            }
            filled => filled.map_err(|e| failure(unwritable(&table.name, &e)))?,
        };
        if is_whole && self.wish.pictures {
            self.write_pictures(host)?;
        }
        let swept = Swept {
            table: table.name.clone(),
            columns: self.sweep.columns().names().map(str::to_owned).collect(),
            n_rows: table.n_rows,
            n_wanted: self.n_rows(),
            n_run: table.n_rows - n_before,
            n_failed: counts.failed,
            n_missed: counts.missed,
            n_dead: counts.dead,
        };
        if host.takes_findings() {
            host.find_out(&Finding::Swept(&swept));
        } else {
            tell(&in_words(&swept, table.is_file), host);
        }
        Ok(if is_whole { ExitStatus::Fine } else { ExitStatus::Interrupted })
    }

    /// Runs the rows that are missing, and writes them in their order as they come; whether all came.
    fn fill(&self, table: &mut Table) -> io::Result<(Counts, bool)> {
        let n_threads = self.wish.jobs.map_or_else(cores, u64::from).max(1);
        if n_threads > 1 {
            // Each variant has one core.
            crate::solve::limit_cores(1);
        }
        let (from, to) = (table.n_rows, self.n_rows());
        let rows = |number: u64| {
            let first = from + number * CHUNK;
            first..to.min(first + CHUNK)
        };
        let bar = ProgressBar::default();
        let is_shown = !self.wish.host.quiet && !self.wish.host.json;
        let show = |share: f64| {
            if is_shown {
                bar.show(share);
            }
        };
        show(0.0);
        let mut counts = Counts::default();
        let is_whole = in_order(
            (to - from).div_ceil(CHUNK),
            n_threads,
            || self.host(),
            |host, number| self.chunk(rows(number), host),
            |chunks| {
                for Chunk { text, n_rows, counts: more } in chunks {
                    table.add(&text, n_rows)?;
                    counts.join(&more);
                }
                table.flush()?;
                show((table.n_rows - from) as f64 / (to - from) as f64);
                Ok(())
            },
        );
        show(1.0);
        let is_whole = is_whole?;
        table.flush()?;
        Ok((counts, is_whole))
    }

    /// The rows of a chunk; none where the user stops it.
    fn chunk(&self, rows: Range<u64>, host: &mut dyn Host) -> Option<Chunk> {
        let mut chunk = Chunk { n_rows: rows.end - rows.start, ..Chunk::default() };
        for row in rows {
            let (text, counts) = self.row(row, host)?;
            chunk.text.push_str(&text);
            chunk.counts.join(&counts);
        }
        Some(chunk)
    }

    /// Writes the poses that variants end in, side by side.
    fn write_pictures(&self, told: &mut dyn Host) -> Result<(), Refusal> {
        let n = self.sweep.n_variants();
        let n_shown = n.min(MOST_PICTURES);
        let look = Options { without_names: true, ..Options::default() };
        let mut host = self.host();
        let mut pictures = Vec::new();
        for k in 0..n_shown {
            let number = k * n / n_shown;
            let Some(picture) = self.sweep.picture(number, &look, &mut host) else { break };
            pictures.push((number, picture));
        }
        let name = match self.wish.table_name() {
            "-" => PathBuf::from("sweep.svg"),
            table => Path::new(table).with_extension("svg"),
        };
        let sheet = picture_sheet(self.sweep.grid(), &pictures);
        let place = host.resolve(&name);
        let written = place.and_then(|place| {
            replaceable(&mut host, &place)?;
            host.write(&place, sheet.as_bytes())
        });
        written.map_err(|e| failure(unwritable(&name.display().to_string(), &e)))?;
        if told.takes_findings() {
            told.find_out(&Finding::Wrote(&name));
        } else {
            tell(&format!("{n_shown} pictures in {}", name.display()), told);
        }
        Ok(())
    }
}

fn tell(text: &str, host: &mut dyn Host) {
    host.tell(&Diagnostic::note_only(text), &Sources::new());
}

/// What a sweep came to.
fn in_words(swept: &Swept, is_file: bool) -> String {
    let Swept { table, n_rows, n_wanted, n_run, .. } = swept;
    if n_rows < n_wanted {
        let stopped = format!("stopped after {n_rows} of {n_wanted} rows");
        return if is_file { format!("{stopped}; `--resume` goes on with them") } else { stopped };
    }
    let mut told = Vec::new();
    told.push(match n_rows {
        1 => format!("1 row in {table}"),
        _ => format!("{n_rows} rows in {table}"),
    });
    if n_run < n_rows {
        told.push(format!("{n_run} of them run now"));
    }
    let counted = [
        (swept.n_failed, "ended in an error"),
        (swept.n_missed, "missed the tolerance"),
        (swept.n_dead, "met dead points"),
    ];
    let counted = counted.into_iter().filter(|(n, _)| *n > 0);
    let counted: Vec<String> = counted.map(|(n, what)| format!("{n} {what}")).collect();
    let told = told.join(", ");
    if counted.is_empty() { told } else { format!("{told}: {}", counted.join(", ")) }
}

/// Refuses to replace a picture that this program did not draw.
fn replaceable(host: &mut ProcessHost, place: &Path) -> io::Result<()> {
    match host.opening(place)? {
        Some(opening) if !opening.starts_with(crate::render::FIRST_WORDS.as_bytes()) => Err(
            io::Error::other("it is there, and linkwork did not write it; `--force` replaces it"),
        ),
        _ => Ok(()),
    }
}

fn cores() -> u64 {
    thread::available_parallelism().map_or(1, |n| n.get() as u64)
}

/// Rows that were run one after the other.
#[derive(Debug, Default)]
struct Chunk {
    n_rows: u64,
    text: String,
    counts: Counts,
}
