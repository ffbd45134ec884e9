//! Small scripts each with its right value, those that the program gets wrong listed by name.
//!
//! What no `assert` can say stands in comments: `# to be said: TEXT`, `# not to be said: TEXT`,
//! `# position error: as printed` (the receipt's, against the largest number printed, to ten times)
//! and `# refused: STATEMENT` (after the script; what the refusal says counts as said).

use std::fs;
use std::path::{Path, PathBuf};

use crate::program::{Program, position_error};

/// Those known to be wrong. One that comes right fails the test until it is taken out.
const STILL_WRONG: [&str; 0] = [];

/// How much a receipt may be off, either way.
const TIMES: f64 = 10.0;

fn scripts(folder: &str) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/truth").join(folder);
    let entries = fs::read_dir(folder).expect("the folder is there");
    let mut scripts: Vec<_> = entries.map(|entry| entry.expect("an entry").path()).collect();
    scripts.sort();
    scripts
}

/// What is wrong with what the program makes of a script; none if nothing.
fn complaint(text: &str) -> Option<String> {
    let wanted = |key: &'static str| {
        text.lines().filter_map(move |line| line.strip_prefix(key)).map(str::trim)
    };
    let mut program = match Program::after("") {
        Ok(program) => program,
        Err(problem) => return Some(problem),
    };
    let said = match program.run(text) {
        Ok(said) => said,
        Err(problem) => return Some(problem),
    };
    let mut all = format!("{}\n{}", said.printed.join("\n"), said.told);
    for statement in wanted("# refused:") {
        match program.run(statement) {
            Ok(_) => return Some(format!("`{statement}` is not refused")),
            Err(problem) => all.push_str(&problem),
        }
    }
    if let Some(text) = wanted("# to be said:").find(|text| !all.contains(text)) {
        return Some(format!("`{text}` is not said, but\n{all}"));
    }
    if let Some(text) = wanted("# not to be said:").find(|text| all.contains(text)) {
        return Some(format!("`{text}` is said:\n{all}"));
    }
    let printed = said.printed.iter().filter_map(|line| line.parse::<f64>().ok());
    let right = printed.fold(0.0, f64::max);
    let is_near = |told: f64| told >= right / TIMES && told <= right * TIMES;
    let is_wrong = wanted("# position error:").next().is_some()
        && !position_error(&said.told).is_some_and(is_near);
    is_wrong.then(|| format!("the position error is {right}, and the receipt says\n{}", said.told))
}

/// Runs the scripts of a folder beside this file: those on the list are wrong, and no others.
pub fn hold(folder: &str, still_wrong: &[&str]) {
    let mut surprises = Vec::new();
    let mut names = Vec::new();
    for path in scripts(folder) {
        let name = path.file_stem().expect("a name").to_string_lossy().into_owned();
        let text = fs::read_to_string(&path).expect("the script is text");
        assert!(text.starts_with("# "), "{name} does not open with what it is about");
        let complaint = complaint(&text);
        match (still_wrong.contains(&name.as_str()), complaint) {
            (true, None) => surprises.push(format!("{name} is right now: take it off the list")),
            (false, Some(why)) => surprises.push(format!("{name}: {why}")),
            _ => {}
        }
        names.push(name);
    }
    for name in still_wrong.iter().filter(|name| !names.iter().any(|known| known == *name)) {
        surprises.push(format!("{name} is on the list, but there is no such script"));
    }
    assert!(surprises.is_empty(), "{}", surprises.join("\n"));
}

#[test]
fn what_is_known_to_be_wrong_is_all_that_is_wrong() {
    hold("findings", &STILL_WRONG);
}

/// A test that cannot fail says nothing: each kind of comment is seen to be kept and broken.
#[test]
fn what_is_asked_of_a_script_is_looked_at() {
    let right = "# to be said: 3\n# not to be said: 4\n# refused: print x\nprint 1 + 2";
    assert_eq!(complaint(right), None);
    let wrong = [
        "# to be said: 4\nprint 1 + 2",
        "# not to be said: 3\nprint 1 + 2",
        "# refused: print 1\nprint 1 + 2",
        "# position error: as printed\nprint 1 + 2",
        "assert 1 + 2 = 4",
        "print x",
    ];
    for text in wrong {
        assert!(complaint(text).is_some(), "{text}");
    }
}
