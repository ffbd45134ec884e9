//! Comparisons of long texts: with files kept for that, and with each other.

use std::fmt::Write;
use std::path::{Path, PathBuf};

/// A folder of texts below `golden/`.
pub fn golden(folder: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/it/golden").join(folder)
}

/// The files of a folder below `golden/` whose names end so, in their order.
pub fn golden_files(folder: &str, ending: &str) -> Vec<PathBuf> {
    let mut files: Vec<PathBuf> = std::fs::read_dir(golden(folder))
        .expect("the folder is there")
        .map(|entry| entry.expect("it can be listed").path())
        .filter(|path| path.extension().is_some_and(|found| found == ending))
        .collect();
    files.sort();
    files
}

/// Compares `got` with the file, or writes the file if `UPDATE_GOLDEN` says so.
pub fn check_golden(path: &Path, got: &str) {
    if std::env::var_os("UPDATE_GOLDEN").is_some() {
        std::fs::write(path, got).expect("the file can be written");
        return;
    }
    let wanted = std::fs::read_to_string(path).unwrap_or_default();
    assert_eq!(got, wanted, "in {}", path.display());
}

/// Compares two texts; on a difference shows the first lines that differ, not all of both.
pub fn check_same(got: &str, wanted: &str, when: &str) {
    if got == wanted {
        return;
    }
    let mut differing = String::new();
    let (mut a, mut b) = (got.lines(), wanted.lines());
    loop {
        match (a.next(), b.next()) {
            (None, None) => break,
            (a, b) if a == b => {}
            (a, b) if differing.len() < 2_000 => {
                writeln!(differing, "  is     {}\n  wanted {}", a.unwrap_or("-"), b.unwrap_or("-"))
                    .expect("writing to a string");
            }
            _ => break,
        }
    }
    panic!("{when}:\n{differing}");
}
