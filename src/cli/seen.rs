//! The files that a run read: whether one of them was saved since.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

/// The files that a run read, and when they were written before that.
#[derive(Debug, Default)]
pub struct Seen {
    files: BTreeMap<PathBuf, Stamp>,
}

/// When a file was written and how long it is; none while it is missing.
type Stamp = Option<(SystemTime, u64)>;

fn stamp(file: &Path) -> Stamp {
    let about = std::fs::metadata(file).ok()?;
    Some((about.modified().ok()?, about.len()))
}

impl Seen {
    /// Notes how a file is before it is read: a change that comes while it is read is one.
    pub fn note(&mut self, file: &Path) {
        self.files.entry(file.to_path_buf()).or_insert_with(|| stamp(file));
    }

    /// How many there are.
    pub fn n_files(&self) -> usize {
        self.files.len()
    }

    /// Whether one is another than it was.
    pub fn has_changed(&self) -> bool {
        self.files.iter().any(|(file, seen)| stamp(file) != *seen)
    }
}
