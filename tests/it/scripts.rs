//! Every script under scripts/ runs to its end with all its asserts, and draws what it says.

use std::collections::VecDeque;
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::sync::Mutex;
use std::thread;

const FOLDERS: [&str; 6] = ["paper", "study", "gallery", "hard", "bench", "constraints"];

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("scripts")
}

/// The scripts below a folder, in the order of their names.
fn scripts(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display())) {
        let path = entry.expect("an entry of the folder").path();
        if path.is_dir() {
            found.extend(scripts(&path));
        } else if path.extension().is_some_and(|ext| ext == "link") {
            found.push(path);
        }
    }
    found.sort();
    found
}

fn linkwork() -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_linkwork"));
    command.env("NO_COLOR", "1");
    command
}

/// Runs a script whose pictures go to `out`.
fn run(script: &Path, out: &Path) -> Output {
    linkwork().arg("run").arg(script).arg("--out").arg(out).output().expect("the program starts")
}

/// Runs a script typed here.
fn run_text(text: &str) -> Output {
    let mut child = linkwork()
        .args(["run", "-"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    child.stdin.take().expect("a pipe").write_all(text.as_bytes()).expect("the program reads");
    child.wait_with_output().expect("the program ends")
}

fn lossy(bytes: &[u8]) -> std::borrow::Cow<'_, str> {
    String::from_utf8_lossy(bytes)
}

/// The pictures a script says it draws.
fn pictures(text: &str) -> impl Iterator<Item = &str> {
    text.lines().filter_map(|line| {
        let path = line.strip_prefix("svg \"").or_else(|| line.strip_prefix("plot \""))?;
        path.split('"').next()
    })
}

/// What is wrong with a script, if anything.
fn complaint(script: &Path) -> Option<String> {
    let text = fs::read_to_string(script).expect("the script is text");
    if !text.starts_with("# ") || text.lines().all(|line| line.starts_with('#') || line.is_empty())
    {
        return Some("a script opens with a comment and then does something".to_owned());
    }
    let out = tempfile::tempdir().expect("a temporary folder");
    let output = run(script, out.path());
    if !output.status.success() {
        return Some(format!("{}\n{}", output.status, lossy(&output.stderr)));
    }
    pictures(&text).find_map(|name| match fs::read_to_string(out.path().join(name)) {
        Ok(svg) if svg.contains("<svg") && svg.trim_end().ends_with("</svg>") => None,
        Ok(_) => Some(format!("{name} is not a whole picture")),
        Err(e) => Some(format!("{name}: {e}")),
    })
}

#[test]
fn every_script_holds() {
    let all: Vec<PathBuf> = FOLDERS.iter().flat_map(|name| scripts(&root().join(name))).collect();
    assert!(all.len() > 90, "only {} scripts found", all.len());
    let queue = Mutex::new(VecDeque::from(all));
    let next = || queue.lock().expect("no worker panics with the queue").pop_front();
    let complaints = Mutex::new(Vec::new());
    thread::scope(|scope| {
        for _ in 0..thread::available_parallelism().map_or(2, usize::from) {
            scope.spawn(|| {
                while let Some(script) = next() {
                    if let Some(text) = complaint(&script) {
                        let name = script.strip_prefix(root()).unwrap_or(&script).display();
                        complaints
                            .lock()
                            .expect("no worker panics")
                            .push(format!("{name}: {text}"));
                    }
                }
            });
        }
    });
    let mut complaints = complaints.into_inner().expect("no worker panicked");
    complaints.sort();
    assert!(complaints.is_empty(), "{} failed\n\n{}", complaints.len(), complaints.join("\n"));
}

#[test]
fn every_mechanism_is_drawn() {
    for folder in ["paper", "gallery"] {
        for script in scripts(&root().join(folder)) {
            let text = fs::read_to_string(&script).expect("the script is text");
            let name = script.file_stem().expect("a name").to_string_lossy();
            let only_defines = text.contains("definitions");
            let own = format!("{name}.svg");
            assert!(
                only_defines || pictures(&text).any(|picture| picture == own),
                "{} draws no {own}",
                script.display()
            );
        }
    }
}

#[test]
fn a_rod_between_frozen_points_that_does_not_fit_is_reported() {
    let out = tempfile::tempdir().expect("a temporary folder");
    let output = run(&root().join("hard/19-all-frozen.link"), out.path());
    let stderr = lossy(&output.stderr);
    assert!(stderr.contains("unsatisfiable"), "{stderr}");
    assert!(stderr.contains("frozen points only"), "{stderr}");
}

#[test]
fn a_drag_to_nowhere_is_refused() {
    let world = "point A = (0, 0) frozen, B = (1, 0)\nlength A B = 1\n";
    for nowhere in ["(1/0, 0)", "(sqrt(-1), 0)", "(0, 1e308 * 1e308)"] {
        let output = run_text(&format!("{world}drag A to {nowhere} over 5\n"));
        assert_eq!(output.status.code(), Some(2), "{nowhere}: {}", lossy(&output.stderr));
        assert!(lossy(&output.stderr).contains("error[E0301]:"), "{}", lossy(&output.stderr));
    }
}

#[test]
fn an_inconsistent_triangle_is_a_best_fit_and_says_so() {
    let out = tempfile::tempdir().expect("a temporary folder");
    let output = run(&root().join("bench/w6-triangle.link"), out.path());
    assert!(output.status.success());
    assert!(lossy(&output.stderr).contains("best fit"), "{}", lossy(&output.stderr));
}
