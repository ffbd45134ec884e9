//! What docs/guide.md tells its readers to type does what it says.

use std::io::Write;
use std::process::{Command, Stdio};

const GUIDE: &str = include_str!("../../docs/guide.md");

/// The scripts of a page: the blocks marked `link`, each with those marked `link continued` that
/// go on from it, and the line where it begins.
fn scripts(page: &str) -> Vec<(usize, String)> {
    let mut scripts: Vec<(usize, String)> = Vec::new();
    let mut is_open = false;
    for (k, line) in page.lines().enumerate() {
        match line {
            "```link" => scripts.push((k + 2, String::new())),
            _ if line.starts_with("```") => {}
            _ if is_open => {
                let (_, text) = scripts.last_mut().expect("a script goes on from one before");
                text.push_str(line);
                text.push('\n');
            }
            _ => {}
        }
        if line.starts_with("```") {
            is_open = !is_open && line.starts_with("```link");
        }
    }
    scripts
}

/// What the program says of a script that it does not carry out to its end.
fn complaint(text: &str) -> Option<String> {
    let out = tempfile::tempdir().expect("a temporary folder");
    let mut child = Command::new(env!("CARGO_BIN_EXE_linkwork"))
        .env("NO_COLOR", "1")
        .args(["run", "-", "--out"])
        .arg(out.path())
        .stdin(Stdio::piped())
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    child.stdin.take().expect("a pipe").write_all(text.as_bytes()).expect("the program reads");
    let output = child.wait_with_output().expect("the program ends");
    let told = String::from_utf8_lossy(&output.stderr).into_owned();
    let is_wrong = !output.status.success() || told.contains("warning");
    is_wrong.then_some(told)
}

#[test]
fn every_block_of_the_guide_runs() {
    let scripts = scripts(GUIDE);
    assert!(scripts.len() > 20, "only {} scripts found", scripts.len());
    let mut complaints = Vec::new();
    for (line, text) in &scripts {
        if !text.contains("assert ") {
            complaints.push(format!("docs/guide.md:{line}: nothing is asserted"));
        }
        complaints
            .extend(complaint(text).map(|told| format!("docs/guide.md:{line}:\n{text}\n{told}")));
    }
    assert!(complaints.is_empty(), "{}", complaints.join("\n\n"));
}

#[test]
fn the_guide_shows_what_the_program_prints() {
    trycmd::TestCases::new().case("docs/guide.md");
}

#[test]
fn blocks_are_found_and_tried() {
    let page = "a\n```link\nx\n```\n```text\ny\n```\n```link continued\nz\n```\n```link\nw\n```\n";
    assert_eq!(scripts(page), [(3, "x\nz\n".to_owned()), (12, "w\n".to_owned())]);
    assert_eq!(complaint("assert 1 = 1\n"), None);
    assert!(complaint("assert 1 = 2\n").is_some());
}
