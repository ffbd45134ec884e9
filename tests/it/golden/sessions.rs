//! Whole sessions, word for word.
//!
//! `sessions/*.txt` hold them: lines that begin with `> ` are typed, what follows is what
//! the session says. With `UPDATE_GOLDEN=1` the files are written anew; read the difference
//! before you keep it.

use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};

use crate::support::desk::{Seat, check_golden};
use linkwork::lang::is_incomplete;

#[test]
fn sessions_go_as_written() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/it/golden/sessions");
    let mut files: Vec<PathBuf> = fs::read_dir(&folder)
        .expect("the folder is there")
        .map(|entry| entry.expect("it can be listed").path())
        .filter(|path| path.extension().is_some_and(|ending| ending == "txt"))
        .collect();
    files.sort();
    assert!(!files.is_empty());
    files.iter().for_each(|file| check(file));
}

fn check(file: &Path) {
    let golden = fs::read_to_string(file).expect("the session can be read");
    let mut seat = Seat::new("sessions");
    let mut got = String::new();
    for typed in typed(&golden) {
        for line in typed.lines() {
            let line = if line.is_empty() { ">".to_owned() } else { format!("> {line}") };
            writeln!(got, "{line}").expect("writing to a string");
        }
        seat.talk(&typed);
        // How many iterations a run took is the solver's affair, not the session's.
        let is_receipt = |line: &&str| line.contains(" by ") && line.contains(" a frame, ");
        for line in seat.said().lines().filter(|line| !is_receipt(line)) {
            writeln!(got, "{line}").expect("writing to a string");
        }
    }
    check_golden(file, &got);
}

/// What is typed in a session: line by line, but for lines that hold a statement open.
fn typed(golden: &str) -> Vec<String> {
    let mut pieces: Vec<String> = Vec::new();
    for line in golden.lines() {
        let Some(text) = line.strip_prefix('>') else { continue };
        let text = text.strip_prefix(' ').unwrap_or(text);
        match pieces.last_mut().filter(|last| is_incomplete(last)) {
            Some(last) => write!(last, "\n{text}").expect("writing to a string"),
            None => pieces.push(text.to_owned()),
        }
    }
    pieces
}
