//! `linkwork sweep`: a script run for every variant of a grid, on all cores, into one table.

use std::collections::BTreeMap;
use std::fs::{File, OpenOptions};
use std::io::{self, BufRead, BufReader, BufWriter, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::thread;
use std::time::Duration;

use super::args::SweepArguments;
use super::process_host::ProcessHost;
use super::progress::ProgressBar;
use super::run::{ExitStatus, Talk};
use super::{files, interrupt, output};
use crate::diag::{Diagnostic, Sources, format_count, nearest, suggest};
use crate::errors;
use crate::render::Options;
use crate::session::{
    Columns, Finding, Grid, Host, Shard, SweepScript, Swept, Variant, picture_sheet, reason,
};

/// A grid of more variants has to be meant.
const MOST_VARIANTS: f64 = 1e8;
/// Variants that are tried for one that comes to its end and shows the columns.
const MODELS: u64 = 1000;
/// Variants that a core takes at once.
const CHUNK: u64 = 8;
/// Chunks that may be done before one that is not: more would be kept in memory.
const MOST_AHEAD: u64 = 4096;
/// Pictures on a sheet.
const MOST_PICTURES: u64 = 100;

/// Runs a script for every variant.
pub fn sweep(wish: &SweepArguments) -> ExitStatus {
    let mut process = ProcessHost::new(&wish.host, files::folder_of(&wish.file));
    let mut talk = Talk::new(&mut process, &wish.host);
    let done = Sweep::begin(wish).and_then(|sweep| sweep.run(talk.host()));
    done.unwrap_or_else(|(problem, sources)| {
        talk.host().tell(&problem, &sources);
        ExitStatus::of(&problem)
    })
}

/// What is wrong, and the texts that its places are in.
type Failure = (Diagnostic, Sources);

fn failure(problem: Diagnostic) -> Failure {
    (problem, Sources::new())
}

struct Sweep<'a> {
    wish: &'a SweepArguments,
    script: SweepScript,
    grid: Grid,
    shard: Shard,
    columns: Columns,
}

impl<'a> Sweep<'a> {
    fn begin(wish: &'a SweepArguments) -> Result<Self, Failure> {
        let text = files::read(&wish.file).map_err(|e| {
            let message = format!("cannot read `{}`: {}", wish.file.display(), reason(&e));
            failure(
                Diagnostic::error(errors::CANNOT_READ, message).kind(crate::diag::Kind::Unreadable),
            )
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
        let sweep = Self {
            wish,
            script,
            shard: wish.shard.unwrap_or(Shard::WHOLE),
            columns: Columns::new(&grid, None),
            grid,
        };
        sweep.check_names()?;
        Ok(Self { columns: sweep.find_columns(), ..sweep })
    }

    fn host(&self) -> ProcessHost {
        ProcessHost::new(&self.wish.host, files::folder_of(&self.wish.file))
    }

    /// Refuses parameters that no script declares, and those that are said twice.
    fn check_names(&self) -> Result<(), Failure> {
        let names: Vec<&str> = self.grid.axes.iter().map(|axis| axis.name.as_str()).collect();
        for (k, name) in names.iter().enumerate() {
            if names[..k].contains(name) {
                let message = format!("`--set {name}=...` is given twice");
                return Err(failure(Diagnostic::error(errors::TWICE, message)));
            }
        }
        let (unused, known) = self.script.unused(&self.grid, &mut self.host());
        let Some(name) = unused.first() else { return Ok(()) };
        let problem =
            Diagnostic::error(errors::UNKNOWN_NAME, format!("no `let` declares `{name}`"));
        if nearest(name, known.iter().map(String::as_str)).is_some() {
            return Err(failure(suggest(problem, name, known.iter().map(String::as_str))));
        }
        Err(failure(match &known[..] {
            [] => problem.help(format!("`let {name} = 1` in the script declares it")),
            known => problem.help(format!("the script declares {}", known.join(", "))),
        }))
    }

    /// The columns of the first variant that comes to its end: the same whoever asks.
    fn find_columns(&self) -> Columns {
        let mut host = self.host();
        let mut first = None;
        for number in 0..MODELS.min(self.grid.n_variants() as u64) {
            let Some(variant) = self.script.run(&self.grid, number, &mut host) else { break };
            if variant.failure.is_none() {
                return Columns::new(&self.grid, Some(&variant));
            }
            first.get_or_insert(variant);
        }
        Columns::new(&self.grid, first.as_ref())
    }

    fn run(&self, host: &mut dyn Host) -> Result<ExitStatus, Failure> {
        let n_wanted = self.shard.n_rows(self.grid.n_variants() as u64);
        // What was said comes before rows that go the same way.
        output::flush();
        let mut table = Table::open(self)?;
        let begun_at = table.n_rows.min(n_wanted);
        let (counts, is_whole) = self.fill(&mut table, begun_at, n_wanted);
        let counts = counts.map_err(|e| failure(unwritable(&table.name, &e)))?;
        if is_whole && self.wish.pictures {
            self.write_pictures(host)?;
        }
        let swept = Swept {
            table: table.name.clone(),
            columns: self.columns.names().map(str::to_owned).collect(),
            n_rows: table.n_rows,
            n_wanted,
            n_failed: counts.failed,
            n_missed: counts.missed,
            n_dead: counts.dead,
        };
        if host.takes_findings() {
            host.find_out(&Finding::Swept(&swept));
        } else {
            tell(&in_words(&swept), host);
        }
        Ok(if is_whole { ExitStatus::Fine } else { ExitStatus::Interrupted })
    }

    /// Runs the rows from one on, and writes them in their order as they come; whether all came.
    fn fill(&self, table: &mut Table, from: u64, to: u64) -> (io::Result<Counts>, bool) {
        let n_workers = self.wish.jobs.map_or_else(cores, u64::from).max(1);
        if n_workers > 1 {
            // Each variant has one core.
            crate::solve::limit_cores(1);
        }
        let n_chunks = (to - from).div_ceil(CHUNK);
        let (next, written) = (AtomicU64::new(0), AtomicU64::new(0));
        let (sender, done) = sync_channel(64);
        let work = |sender: SyncSender<Chunk>| {
            let mut host = self.host();
            loop {
                let number = next.fetch_add(1, Ordering::Relaxed);
                if number >= n_chunks {
                    return;
                }
                while number > written.load(Ordering::Relaxed) + MOST_AHEAD
                    && !interrupt::is_asked()
                {
                    thread::sleep(Duration::from_millis(1));
                }
                let first = from + number * CHUNK;
                let Some(chunk) = self.chunk(number, first..to.min(first + CHUNK), &mut host)
                else {
                    return;
                };
                if sender.send(chunk).is_err() {
                    return;
                }
            }
        };
        thread::scope(|scope| {
            for _ in 0..n_workers.min(n_chunks) {
                let sender = sender.clone();
                scope.spawn(|| work(sender));
            }
            drop(sender);
            let counts = self.collect(&done, table, &written, n_chunks);
            drop(done);
            let is_whole = written.load(Ordering::Relaxed) == n_chunks;
            (counts, is_whole)
        })
    }

    /// The rows of a chunk; none where the user stops it.
    fn chunk(&self, number: u64, rows: std::ops::Range<u64>, host: &mut dyn Host) -> Option<Chunk> {
        let mut chunk = Chunk { number, n_rows: rows.end - rows.start, ..Chunk::default() };
        for row in rows {
            let variant = self.script.run(&self.grid, self.shard.variant(row), host)?;
            chunk.counts.add(&variant);
            chunk.text.push_str(&if self.wish.host.json {
                self.columns.object(&variant)
            } else {
                self.columns.row(&variant)
            });
        }
        Some(chunk)
    }

    /// Writes chunks in their order.
    fn collect(
        &self,
        done: &Receiver<Chunk>,
        table: &mut Table,
        written: &AtomicU64,
        n_chunks: u64,
    ) -> io::Result<Counts> {
        let bar = ProgressBar::default();
        let is_shown = !self.wish.host.quiet && !self.wish.host.json;
        let show = |share: f64| {
            if is_shown {
                bar.show(share);
            }
        };
        show(0.0);
        let mut counts = Counts::default();
        let mut waiting: BTreeMap<u64, Chunk> = BTreeMap::new();
        let mut n_written = 0;
        for chunk in done {
            waiting.insert(chunk.number, chunk);
            while let Some(chunk) = waiting.remove(&n_written) {
                table.add(&chunk)?;
                counts.join(&chunk.counts);
                n_written += 1;
                written.store(n_written, Ordering::Relaxed);
            }
            if waiting.is_empty() {
                // What is there can be read, and is not lost to who kills the program.
                table.flush()?;
            }
            if n_written < n_chunks {
                show(n_written as f64 / n_chunks as f64);
            }
        }
        show(1.0);
        table.flush()?;
        Ok(counts)
    }

    /// Writes the poses that variants end in, side by side.
    fn write_pictures(&self, told: &mut dyn Host) -> Result<(), Failure> {
        let n = self.grid.n_variants() as u64;
        let n_shown = n.min(MOST_PICTURES);
        let look = Options { without_names: true, ..Options::default() };
        let mut host = self.host();
        let mut pictures = Vec::new();
        for k in 0..n_shown {
            let number = k * n / n_shown;
            let Some(picture) = self.script.picture(&self.grid, number, &look, &mut host) else {
                break;
            };
            pictures.push((number, picture));
        }
        let name = match self.wish.table_name() {
            "-" => PathBuf::from("sweep.svg"),
            table => Path::new(table).with_extension("svg"),
        };
        let sheet = picture_sheet(&self.grid, &pictures);
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
fn in_words(swept: &Swept) -> String {
    let Swept { table, n_rows, n_wanted, .. } = swept;
    if n_rows < n_wanted {
        return format!("stopped after {n_rows} of {n_wanted} rows; `--resume` goes on with them");
    }
    let rows = if *n_rows == 1 { "1 row".to_owned() } else { format!("{n_rows} rows") };
    let told = [
        (swept.n_failed, "ended in an error"),
        (swept.n_missed, "missed the tolerance"),
        (swept.n_dead, "met dead points"),
    ];
    let told = told.into_iter().filter(|(n, _)| *n > 0);
    let told: Vec<String> = told.map(|(n, what)| format!(", {n} {what}")).collect();
    format!("{rows} in {table}{}", told.concat())
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
    number: u64,
    n_rows: u64,
    text: String,
    counts: Counts,
}

/// How variants went, together.
#[derive(Debug, Default)]
struct Counts {
    failed: u64,
    missed: u64,
    dead: u64,
}

impl Counts {
    fn add(&mut self, variant: &Variant) {
        self.failed += u64::from(variant.failure.is_some());
        self.missed += u64::from(variant.n_missed > 0);
        self.dead += u64::from(variant.n_dead_points > 0);
    }

    fn join(&mut self, other: &Self) {
        self.failed += other.failed;
        self.missed += other.missed;
        self.dead += other.dead;
    }
}

/// The table on its way.
struct Table {
    name: String,
    out: BufWriter<Box<dyn Write>>,
    n_rows: u64,
}

impl Table {
    /// Begins a table, or goes on with the one that is there.
    fn open(sweep: &Sweep) -> Result<Self, Failure> {
        let wish = sweep.wish;
        let heading = if wish.host.json { String::new() } else { sweep.columns.heading() };
        if wish.table_name() == "-" {
            let mut out = BufWriter::new(Box::new(io::stdout()) as Box<dyn Write>);
            let begun = out.write_all(heading.as_bytes());
            begun.map_err(|e| failure(unwritable("standard output", &e)))?;
            return Ok(Self { name: "standard output".to_owned(), out, n_rows: 0 });
        }
        let name = wish.table_name().to_owned();
        let place = sweep.host().resolve(Path::new(&name)).map_err(|e| {
            failure(unwritable(&name, &e).help("`--allow-any-path` lets it lie anywhere"))
        })?;
        let is_there = files::opening(&place).map_err(|e| failure(unwritable(&name, &e)))?;
        let is_there = is_there.is_some_and(|opening| !opening.is_empty());
        if is_there && wish.resume {
            return Self::resume(sweep, &name, &place, &heading);
        }
        if is_there && !wish.host.force {
            return Err(failure(
                Diagnostic::error(errors::FOREIGN_FILE, format!("`{name}` is there")).help(
                    "`--resume` goes on with it, `--force` replaces it, `--to` names another",
                ),
            ));
        }
        let begin = || -> io::Result<File> {
            std::fs::create_dir_all(files::folder_of(&place))?;
            let mut file = File::create(&place)?;
            file.write_all(heading.as_bytes())?;
            Ok(file)
        };
        let file = begin().map_err(|e| failure(unwritable(&name, &e)))?;
        Ok(Self { name, out: BufWriter::new(Box::new(file)), n_rows: 0 })
    }

    /// Goes on behind the last whole row of a table of the same sweep.
    fn resume(sweep: &Sweep, name: &str, place: &Path, heading: &str) -> Result<Self, Failure> {
        let failed = |e: io::Error| failure(unwritable(name, &e));
        let other = || {
            failure(
                Diagnostic::error(errors::FOREIGN_FILE, format!("`{name}` is of another sweep"))
                    .help(
                        "the script, `--set` and `--shard` have to be those that it was begun with",
                    ),
            )
        };
        let mut reader = BufReader::new(File::open(place).map_err(failed)?);
        let mut line = Vec::new();
        let (mut n_bytes, mut n_rows) = (0, 0);
        if !heading.is_empty() {
            n_bytes += reader.read_until(b'\n', &mut line).map_err(failed)? as u64;
            if line != heading.as_bytes() && !heading.as_bytes().starts_with(&line) {
                return Err(other());
            }
        }
        let mut last = Vec::new();
        loop {
            line.clear();
            let n = reader.read_until(b'\n', &mut line).map_err(failed)? as u64;
            if n == 0 || line.last() != Some(&b'\n') {
                break;
            }
            (n_bytes, n_rows) = (n_bytes + n, n_rows + 1);
            std::mem::swap(&mut last, &mut line);
        }
        let mut file = OpenOptions::new().write(true).open(place).map_err(failed)?;
        if n_rows == 0 {
            n_bytes = 0;
        } else {
            // The last whole row says what its variant was.
            let variant = sweep.shard.variant(n_rows - 1);
            let model = sweep.script.run(&sweep.grid, variant, &mut sweep.host());
            let row = model.map(|variant| {
                if sweep.wish.host.json {
                    sweep.columns.object(&variant)
                } else {
                    sweep.columns.row(&variant)
                }
            });
            let is_past = variant >= sweep.grid.n_variants() as u64;
            if is_past || row.is_some_and(|row| row.as_bytes() != last) {
                return Err(other());
            }
        }
        file.set_len(n_bytes).map_err(failed)?;
        file.seek(SeekFrom::End(0)).map_err(failed)?;
        if n_rows == 0 {
            file.write_all(heading.as_bytes()).map_err(failed)?;
        }
        Ok(Self { name: name.to_owned(), out: BufWriter::new(Box::new(file)), n_rows })
    }

    fn add(&mut self, chunk: &Chunk) -> io::Result<()> {
        self.out.write_all(chunk.text.as_bytes())?;
        self.n_rows += chunk.n_rows;
        Ok(())
    }

    fn flush(&mut self) -> io::Result<()> {
        self.out.flush()
    }
}

fn unwritable(name: &str, e: &io::Error) -> Diagnostic {
    Diagnostic::error(errors::CANNOT_WRITE, format!("cannot write `{name}`: {}", reason(e)))
        .kind(crate::diag::Kind::Unreadable)
}
