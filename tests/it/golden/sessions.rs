//! Whole sessions, word for word.
//!
//! `sessions/*.txt` hold them: lines that begin with `> ` are typed, what follows is what
//! the session says. With `UPDATE_GOLDEN=1` the files are written anew; read the difference
//! before you keep it.

use std::fmt::Write;
use std::fs;
use std::path::Path;

use crate::support::compare::{check_golden, golden, golden_files};
use crate::support::talk::Talking;
use linkwork::lang::is_incomplete;

#[test]
fn sessions_go_as_written() {
    let files = golden_files("sessions", "txt");
    assert!(!files.is_empty());
    files.iter().for_each(|file| check(file));
}

fn check(file: &Path) {
    let text = fs::read_to_string(file).expect("the session can be read");
    let mut talking = Talking::reading(golden("sessions"));
    let mut got = String::new();
    for typed in typed(&text) {
        for line in typed.lines() {
            let line = if line.is_empty() { ">".to_owned() } else { format!("> {line}") };
            writeln!(got, "{line}").expect("writing to a string");
        }
        let seen = talking.type_in(&typed);
        // How many iterations a run took is the solver's affair, not the session's.
        let is_receipt = |line: &&str| {
            line.contains(" by ") && line.contains(" a frame, ") || line.contains("note: t = ")
        };
        for line in seen.lines().filter(|line| !is_receipt(line)) {
            writeln!(got, "{line}").expect("writing to a string");
        }
    }
    check_golden(file, &got);
}

/// What is typed in a session: line by line, but for lines that hold a statement open.
fn typed(text: &str) -> Vec<String> {
    let mut pieces: Vec<String> = Vec::new();
    for line in text.lines() {
        let Some(line) = line.strip_prefix('>') else { continue };
        let line = line.strip_prefix(' ').unwrap_or(line);
        match pieces.last_mut().filter(|last| is_incomplete(last)) {
            Some(last) => write!(last, "\n{line}").expect("writing to a string"),
            None => pieces.push(line.to_owned()),
        }
    }
    pieces
}
