//! The sources of the library, as texts.

use std::fs;
use std::path::{Path, PathBuf};

/// A file of source.
pub struct Source {
    /// Its path below `src`, with `/` between its parts.
    pub path: String,
    /// What is in it.
    pub text: String,
}

impl Source {
    /// Its code: without comments and without the tests at its end.
    pub fn code(&self) -> String {
        let text = self.text.split("#[cfg(test)]\nmod tests").next().unwrap_or_default();
        let lines = text.lines().filter(|line| !line.trim_start().starts_with("//"));
        lines.flat_map(|line| [line, "\n"]).collect()
    }
}

/// All of them, in order of their paths.
pub fn sources() -> Vec<Source> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut files = Vec::new();
    collect(&root, &mut files);
    files.sort();
    assert!(files.len() > 50, "the sources are found");
    let source = |path: PathBuf| {
        let text = fs::read_to_string(&path).expect("a source can be read");
        let path = path.strip_prefix(&root).expect("it lies below src");
        Source { path: path.to_string_lossy().replace('\\', "/"), text }
    };
    files.into_iter().map(source).collect()
}

/// The scripts below `scripts/`, in order of their paths.
pub fn scripts() -> Vec<PathBuf> {
    let mut files = Vec::new();
    collect_ending(&Path::new(env!("CARGO_MANIFEST_DIR")).join("scripts"), "link", &mut files);
    files.sort();
    assert!(files.len() > 100, "the scripts are found");
    files
}

fn collect(folder: &Path, files: &mut Vec<PathBuf>) {
    collect_ending(folder, "rs", files);
}

fn collect_ending(folder: &Path, wanted: &str, files: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("a folder can be listed") {
        let path = entry.expect("it can be listed").path();
        if path.is_dir() {
            collect_ending(&path, wanted, files);
        } else if path.extension().is_some_and(|ending| ending == wanted) {
            files.push(path);
        }
    }
}
