//! Every constraint has a picture in the reference, and that is what its script draws.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::support::compare::check_golden;
use linkwork::lang::catalogue::ConstraintWord;

fn words() -> impl Iterator<Item = &'static str> {
    ConstraintWord::ALL.iter().map(|word| word.pattern().entry.keyword)
}

fn at(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(path)
}

/// The picture that the script of a constraint draws now.
fn drawn(word: &str) -> String {
    let out = tempfile::tempdir().expect("a temporary folder");
    let script = at("scripts/constraints").join(format!("{word}.link"));
    let output = Command::new(env!("CARGO_BIN_EXE_linkwork"))
        .arg("run")
        .arg(&script)
        .arg("--out")
        .arg(out.path())
        .output()
        .expect("the program starts");
    let told = String::from_utf8_lossy(&output.stderr);
    let says_more = told.lines().any(|line| !line.starts_with("note: wrote "));
    assert!(output.status.success() && !says_more, "{}: {told}", script.display());
    fs::read_to_string(out.path().join(format!("{word}.svg"))).expect("it draws its picture")
}

/// With `UPDATE_GOLDEN=1` they are drawn anew; look at those that differ before you keep them.
#[test]
fn pictures_of_constraints_are_what_their_scripts_draw() {
    for word in words() {
        check_golden(&at("docs/pictures/constraints").join(format!("{word}.svg")), &drawn(word));
    }
}

#[test]
fn no_picture_is_of_what_there_is_no_more() {
    for (folder, ending) in [("docs/pictures/constraints", "svg"), ("scripts/constraints", "link")]
    {
        for entry in fs::read_dir(at(folder)).expect("the folder is there") {
            let name = entry.expect("it can be listed").file_name();
            let name = name.to_str().expect("a name");
            let is_known = words().any(|word| format!("{word}.{ending}") == name);
            assert!(is_known, "{folder}/{name} is of no constraint");
        }
    }
}

#[test]
fn the_reference_shows_every_constraint() {
    let reference = include_str!("../../docs/language.md");
    for word in words() {
        let picture = format!("![{word}](pictures/constraints/{word}.svg)");
        assert!(reference.contains(&picture), "docs/language.md does not show {picture}");
        let script = fs::read_to_string(at("scripts/constraints").join(format!("{word}.link")))
            .expect("it has a script");
        let states = |line: &str| line.split([' ', ';']).any(|part| part == word);
        assert!(script.lines().any(|line| !line.starts_with('#') && states(line)), "{word}");
    }
}
