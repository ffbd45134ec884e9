//! What is said of each mistake that only a world can show, and that it changes nothing.
//!
//! `mistakes/*.link` are scripts that end in a mistake; beside each stands what is said of
//! it and the exit status. With `UPDATE_GOLDEN=1` these are written anew; read the difference
//! before you keep it.

use std::fs;
use std::path::{Path, PathBuf};

use crate::support::desk::{Seat, check_golden, status};
use linkwork::lang::parse;

#[test]
fn mistakes_are_told_and_change_nothing() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/it/golden/mistakes");
    let mut scripts: Vec<PathBuf> = fs::read_dir(&folder)
        .expect("the folder is there")
        .map(|entry| entry.expect("it can be listed").path())
        .filter(|path| path.extension().is_some_and(|ending| ending == "link"))
        .collect();
    scripts.sort();
    assert!(scripts.len() >= 60, "only {} mistakes are tried", scripts.len());
    scripts.iter().for_each(|script| check(script));
}

fn check(script: &Path) {
    let name = script.file_name().expect("a file has a name").to_string_lossy();
    let text = fs::read_to_string(script).expect("the script can be read");
    let mut seat = Seat::new("mistakes");
    let source = seat.session.add_source(&name, &text, Some(PathBuf::new()));
    let mut told = String::new();
    for statement in parse(source, &text) {
        let before = seat.world();
        let result = statement.and_then(|it| seat.session.execute(&it, &mut seat.notebook));
        assert!(told.is_empty(), "{name} goes on after its mistake");
        if let Err(problem) = result {
            assert_eq!(seat.world(), before, "{name} changes the world");
            told = format!("{}\nstatus {}\n", seat.drawn(&problem), status(&problem));
        }
    }
    assert!(!told.is_empty(), "{name} has no mistake");
    check_golden(&script.with_extension("stderr"), &told);
}
