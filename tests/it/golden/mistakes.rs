//! What is said of each mistake that only a world can show, and that it changes nothing.
//!
//! `mistakes/*.link` are scripts that end in a mistake; beside each stands what is said of
//! it and the exit status. With `UPDATE_GOLDEN=1` these are written anew; read the difference
//! before you keep it.

use std::fs;
use std::path::{Path, PathBuf};

use crate::support::compare::{check_golden, golden, golden_files};
use crate::support::talk::Talking;
use linkwork::diag::{Diagnostic, Kind};
use linkwork::lang::parse;

#[test]
fn mistakes_are_told_and_change_nothing() {
    let scripts = golden_files("mistakes", "link");
    assert!(scripts.len() >= 60, "only {} mistakes are tried", scripts.len());
    scripts.iter().for_each(|script| check(script));
}

fn check(script: &Path) {
    let name = script.file_name().expect("a file has a name").to_string_lossy();
    let text = fs::read_to_string(script).expect("the script can be read");
    let mut talking = Talking::reading(golden("mistakes"));
    let source = talking.add(&name, &text, PathBuf::new());
    let mut told = String::new();
    for statement in parse(source, &text) {
        let before = talking.script();
        let statement = statement.map_err(|problem| talking.session.advise(problem));
        let result = statement.and_then(|statement| talking.execute_one(&statement));
        assert!(told.is_empty(), "{name} goes on after its mistake");
        if let Err(problem) = result {
            assert_eq!(talking.script(), before, "{name} changes the world");
            told = format!("{}\nstatus {}\n", talking.drawn(&problem), status(&problem));
        }
    }
    assert!(!told.is_empty(), "{name} has no mistake");
    check_golden(&script.with_extension("stderr"), &told);
}

/// The exit status that a batch ends with.
fn status(problem: &Diagnostic) -> u8 {
    match problem.kind {
        Kind::Promise => 1,
        Kind::Mistake => 2,
        Kind::Unreadable => 3,
        Kind::Interrupted => 130,
    }
}
