//! How the frames of scripts are found: `cargo bench --bench steps` for all of this repository but those
//! that are scenes of benchmarks for scale, `cargo bench --bench steps -- FILE ...` for others.

#![allow(clippy::disallowed_methods)]

use std::fs;
use std::path::{Path, PathBuf};

use linkwork::Session;
use linkwork::session::Nowhere;
use linkwork::solve::FrameCounts;

/// How many frames were found in one way.
type Count = fn(&FrameCounts) -> u64;

/// A script with how its frames were found; those up to a mistake if it has one.
fn run(file: &Path) -> FrameCounts {
    let text = fs::read_to_string(file).unwrap_or_default();
    let mut session = Session::new();
    let folder = file.parent().map(Path::to_path_buf);
    let source = session.add_source(&file.to_string_lossy(), &text, folder);
    // A script that reads files or asks goes as far as it does without.
    let _ = session.execute_all(source, &mut Nowhere);
    session.frame_counts()
}

/// All scripts below a folder.
fn scripts(folder: &Path, all: &mut Vec<PathBuf>) {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.path()).collect();
    paths.sort();
    for path in paths {
        if path.is_dir() {
            scripts(&path, all);
        } else if path.extension().is_some_and(|extension| extension == "link") {
            all.push(path);
        }
    }
}

fn main() {
    let is_name = |a: &String| !a.starts_with('-');
    let mut files: Vec<PathBuf> =
        std::env::args().skip(1).filter(is_name).map(Into::into).collect();
    if files.is_empty() {
        scripts(&Path::new(env!("CARGO_MANIFEST_DIR")).join("scripts"), &mut files);
        files.retain(|file| !file.to_string_lossy().contains("w5"));
    }
    let ways: [(&str, Count); 6] = [
        ("found by closed steps", |counts| counts.closed),
        ("of these side by side", |counts| counts.abreast),
        ("the first frame, or the first after an edit", |counts| counts.first),
        ("a value that a step holds was changed", |counts| counts.changed),
        ("some points have no closed form", |counts| counts.open),
        ("next to a singular pose, or not proved", |counts| counts.unproved),
    ];
    let counts: Vec<FrameCounts> = files.iter().map(|file| run(file)).collect();
    println!("| | frames | scripts |\n| --- | --- | --- |");
    for (name, of) in ways {
        let frames: u64 = counts.iter().map(of).sum();
        let n_scripts = counts.iter().filter(|counts| of(counts) > 0).count();
        println!("| {name} | {frames} | {n_scripts} |");
    }
    for (file, counts) in files.iter().zip(&counts) {
        if counts.closed + counts.first < counts.total() {
            eprintln!("{}: {counts:?}", file.display());
        }
    }
}
