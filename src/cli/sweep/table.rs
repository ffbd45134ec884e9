//! The table of a sweep on its way: begun, or gone on with.

use std::fs::{File, OpenOptions};
use std::io::{self, BufRead, BufReader, BufWriter, Read, Seek, SeekFrom, Write};
use std::path::Path;

use super::plan::{Plan, failure, unwritable};
use crate::cli::files;
use crate::diag::{Diagnostic, Kind};
use crate::errors;
use crate::session::{Host as _, Refusal};

/// A row of so many bytes is none of a sweep.
const LONGEST_ROW: u64 = 1 << 24;

/// What a table is called that goes to standard output.
const STANDARD_OUTPUT: &str = "standard output";

/// The table on its way.
pub struct Table {
    /// What it is called.
    pub name: String,
    /// Whether it lies in a file, and can be gone on with.
    pub is_file: bool,
    /// How many rows it has.
    pub n_rows: u64,
    out: BufWriter<Box<dyn Write>>,
}

/// What is there of a table: whole rows, and perhaps the beginning of one.
struct Rest {
    n_bytes: u64,
    n_rows: u64,
    /// The last whole row.
    last: Vec<u8>,
    /// What stands behind it.
    begun: Vec<u8>,
}

impl Rest {
    /// What stands in a table after this heading; none where another stands there.
    fn read(place: &Path, heading: &[u8]) -> io::Result<Option<Self>> {
        let mut reader = BufReader::new(File::open(place)?);
        let mut found = Vec::new();
        reader.by_ref().take(heading.len() as u64).read_to_end(&mut found)?;
        if !heading.starts_with(&found) {
            return Ok(None);
        }
        let mut rest =
            Self { n_bytes: found.len() as u64, n_rows: 0, last: Vec::new(), begun: Vec::new() };
        if found.len() < heading.len() {
            rest.n_bytes = 0;
            return Ok(Some(rest));
        }
        loop {
            rest.begun.clear();
            reader.by_ref().take(LONGEST_ROW).read_until(b'\n', &mut rest.begun)?;
            if rest.begun.len() as u64 == LONGEST_ROW {
                return Ok(None);
            }
            if rest.begun.last() != Some(&b'\n') {
                return Ok(Some(rest));
            }
            rest.n_bytes += rest.begun.len() as u64;
            rest.n_rows += 1;
            std::mem::swap(&mut rest.last, &mut rest.begun);
        }
    }

    /// Whether a sweep wrote it: the last whole row says what its variant was, and nothing stands behind
    /// it but the beginning of the next.
    fn is_of(&self, plan: &Plan) -> Result<bool, Refusal> {
        let mut host = plan.host();
        let mut row = |k: u64| {
            if k >= plan.n_rows() {
                return Ok(String::new());
            }
            plan.row(k, &mut host).map(|(row, _)| row).ok_or_else(|| {
                let message = "stopped before the table was gone on with";
                failure(Diagnostic::error(errors::INTERRUPTED, message).kind(Kind::Interrupted))
            })
        };
        Ok((self.n_rows == 0 || row(self.n_rows - 1)?.as_bytes() == self.last)
            && (self.begun.is_empty() || row(self.n_rows)?.as_bytes().starts_with(&self.begun)))
    }
}

impl Table {
    /// Begins a table, or goes on with the one that is there.
    pub fn open(plan: &Plan) -> Result<Self, Refusal> {
        let wish = plan.wish;
        let heading = if wish.host.json { String::new() } else { plan.sweep.columns().heading() };
        if wish.table_name() == "-" {
            return Self::on_standard_output(plan, &heading);
        }
        let name = wish.table_name().to_owned();
        let place = plan.host().resolve(Path::new(&name)).map_err(|e| {
            failure(unwritable(&name, &e).help("`--allow-any-path` lets it lie anywhere"))
        })?;
        let is_there = files::opening(&place).map_err(|e| failure(unwritable(&name, &e)))?;
        let is_there = is_there.is_some_and(|opening| !opening.is_empty());
        if is_there && wish.resume {
            return Self::resume(plan, name, &place, &heading);
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
        Ok(Self::of(name, file, 0))
    }

    fn of(name: String, file: File, n_rows: u64) -> Self {
        Self { name, is_file: true, n_rows, out: BufWriter::new(Box::new(file)) }
    }

    fn on_standard_output(plan: &Plan, heading: &str) -> Result<Self, Refusal> {
        if plan.wish.resume {
            let message = "`--resume` goes on with a table in a file";
            let problem = Diagnostic::error(errors::FOREIGN_FILE, message);
            return Err(failure(problem.help("`--to sweep.csv` names one, `--to -` does not")));
        }
        let mut out = BufWriter::new(Box::new(io::stdout()) as Box<dyn Write>);
        let name = STANDARD_OUTPUT.to_owned();
        let begun = out.write_all(heading.as_bytes());
        begun.map_err(|e| failure(unwritable(&name, &e)))?;
        Ok(Self { name, is_file: false, n_rows: 0, out })
    }

    /// Goes on behind the last whole row of a table of the same sweep. Nothing is cut off but the
    /// beginning of the row that comes next.
    fn resume(plan: &Plan, name: String, place: &Path, heading: &str) -> Result<Self, Refusal> {
        let failed = |e: io::Error| failure(unwritable(&name, &e));
        let other = || {
            let message = format!("`{name}` is of another sweep");
            let problem = Diagnostic::error(errors::FOREIGN_FILE, message);
            let begun_with =
                "the script, `--set` and `--shard` have to be those that it was begun with";
            let instead = "`--to` names another, `--force` without `--resume` replaces it";
            failure(problem.help(begun_with).help(instead))
        };
        let rest = Rest::read(place, heading.as_bytes()).map_err(failed)?.ok_or_else(other)?;
        if !rest.is_of(plan)? {
            return Err(other());
        }
        let mut file = OpenOptions::new().write(true).open(place).map_err(failed)?;
        file.set_len(rest.n_bytes).map_err(failed)?;
        file.seek(SeekFrom::End(0)).map_err(failed)?;
        if rest.n_bytes == 0 {
            file.write_all(heading.as_bytes()).map_err(failed)?;
        }
        Ok(Self::of(name, file, rest.n_rows))
    }

    /// Adds rows.
    pub fn add(&mut self, text: &str, n_rows: u64) -> io::Result<()> {
        self.out.write_all(text.as_bytes())?;
        self.n_rows += n_rows;
        Ok(())
    }

    /// Has what was added where it can be read, and is not lost to who kills the program.
    pub fn flush(&mut self) -> io::Result<()> {
        self.out.flush()
    }
}
