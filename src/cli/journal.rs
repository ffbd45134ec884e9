//! The journal of a session: each statement is on disk before the next is read, so that a session
//! which does not end in order can be brought back.

use std::fs::{self, File, OpenOptions};
use std::io::{self, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::process;
use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

use super::folders;
use crate::session::Kept;

/// Between two times that the disk is asked to have it all: a power cut loses no more.
const SYNC_PAUSE: Duration = Duration::from_secs(2);

/// Journals of sessions that did not end in order; older ones are removed.
const MOST_KEPT: usize = 10;

/// How a journal begins.
const FIRST_LINE: &str = "# The journal of a linkwork session.\n";

/// The line behind each text: what stands behind the last of them was being written.
const MARK: &str = "#\n";

/// What the name of one begins with that was told to the user.
const TOLD: &str = "told-";

/// The journal of the present session, locked for as long as it goes on.
#[derive(Debug)]
pub struct Journal {
    path: PathBuf,
    file: File,
    /// Where each text ends that was written since the last script of all there is, and where that does.
    ends: Vec<u64>,
    synced: Instant,
}

/// A session that did not end in order.
#[derive(Debug)]
pub struct Remains {
    /// Its journal, to be loaded.
    pub path: PathBuf,
    /// How many lines it has.
    pub n_lines: usize,
}

impl Journal {
    /// An empty journal in the user's folder.
    ///
    /// # Errors
    /// Where there is no such folder, or nothing can be written to it.
    pub fn begin() -> io::Result<Self> {
        let folder = folder().ok_or(io::ErrorKind::NotFound)?;
        fs::create_dir_all(&folder)?;
        let now = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default().as_secs();
        let path = folder.join(format!("{now}-{}.link", process::id()));
        let file = locked(&path)?;
        let mut journal = Self { path, file, ends: Vec::new(), synced: Instant::now() };
        journal.begin_with("")?;
        Ok(journal)
    }

    /// Writes down what brings the session back.
    ///
    /// # Errors
    /// Where it cannot be written.
    pub fn keep(&mut self, kept: Kept<'_>) -> io::Result<()> {
        match kept {
            Kept::Done(text) => self.append(text)?,
            Kept::First(n) => {
                self.ends.truncate(n as usize + 1);
                let end = self.ends.last().copied().unwrap_or_default();
                self.file.set_len(end)?;
                self.file.seek(SeekFrom::Start(end))?;
            }
            Kept::Whole(script) => {
                // Beside it first: a journal is whole whenever the session ends.
                let beside = self.path.with_extension("next");
                let file = locked(&beside)?;
                let before = std::mem::replace(&mut self.file, file);
                self.begin_with(script)?;
                fs::rename(&beside, &self.path)?;
                drop(before);
            }
        }
        if self.synced.elapsed() >= SYNC_PAUSE {
            self.file.sync_data()?;
            self.synced = Instant::now();
        }
        Ok(())
    }

    /// Begins an empty file.
    fn begin_with(&mut self, script: &str) -> io::Result<()> {
        let parts = [FIRST_LINE, script, MARK];
        self.ends = vec![parts.iter().map(|part| part.len() as u64).sum()];
        parts.iter().try_for_each(|part| self.file.write_all(part.as_bytes()))
    }

    fn append(&mut self, text: &str) -> io::Result<()> {
        let piece = format!("{text}\n{MARK}");
        let end = self.ends.last().copied().unwrap_or_default();
        self.ends.push(end + piece.len() as u64);
        self.file.write_all(piece.as_bytes())
    }

    /// The session ended in order: there is nothing to bring back.
    pub fn end(self) {
        // One that cannot be removed is offered at the next start, which does no harm.
        drop(fs::remove_file(&self.path));
    }
}

/// What the last session left that did not end in order, if there is one that was not told of yet.
pub fn remains() -> Option<Remains> {
    let folder = folder()?;
    let mut left: Vec<PathBuf> = scripts(&folder).filter(|path| is_left(path)).collect();
    left.sort_unstable();
    let mut found = None;
    for path in left {
        let Ok(n_lines) = mend(&path) else { continue };
        if n_lines == 0 {
            drop(fs::remove_file(&path));
            continue;
        }
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let told = folder.join(format!("{TOLD}{name}"));
        if fs::rename(&path, &told).is_ok() {
            found = Some(Remains { path: told, n_lines });
        }
    }
    forget_old(&folder);
    found
}

/// Cuts off what was being written when the session ended; gives how many lines there are.
fn mend(path: &Path) -> io::Result<usize> {
    let text = fs::read(path)?;
    let mark = format!("\n{MARK}");
    let last = text.windows(mark.len()).rposition(|bytes| bytes == mark.as_bytes());
    // An older linkwork wrote no marks.
    let end = last.map_or(text.len(), |at| at + mark.len());
    if end < text.len() {
        OpenOptions::new().write(true).open(path)?.set_len(end as u64)?;
    }
    let lines = text[..end].split(|&byte| byte == b'\n');
    Ok(lines.filter(|line| !line.is_empty() && line[0] != b'#').count())
}

/// Removes journals that were told of long ago.
fn forget_old(folder: &Path) {
    let mut told: Vec<PathBuf> = scripts(folder).filter(|path| is_told(path)).collect();
    told.sort_unstable();
    for path in told.iter().rev().skip(MOST_KEPT) {
        drop(fs::remove_file(path));
    }
}

fn scripts(folder: &Path) -> impl Iterator<Item = PathBuf> {
    let entries = fs::read_dir(folder).into_iter().flatten();
    let paths = entries.filter_map(|entry| Some(entry.ok()?.path()));
    paths.filter(|path| path.extension().is_some_and(|ending| ending == "link"))
}

fn is_told(path: &Path) -> bool {
    path.file_name().is_some_and(|name| name.to_string_lossy().starts_with(TOLD))
}

/// Whether the session of a journal is over: nobody holds it.
fn is_left(path: &Path) -> bool {
    !is_told(path) && File::open(path).is_ok_and(|file| file.try_lock().is_ok())
}

/// Where journals are.
pub fn folder() -> Option<PathBuf> {
    Some(folders::state()?.join("journal"))
}

/// A new file that only its user may read, and that others see is in use.
fn locked(path: &Path) -> io::Result<File> {
    let mut options = OpenOptions::new();
    options.write(true).create(true).truncate(true);
    #[cfg(unix)]
    std::os::unix::fs::OpenOptionsExt::mode(&mut options, 0o600);
    let file = options.open(path)?;
    file.lock()?;
    Ok(file)
}
