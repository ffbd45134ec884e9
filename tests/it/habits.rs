//! What the pages for contributors tell people to type is there.

use std::fs;
use std::path::Path;

fn root(path: &str) -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(path)
}

fn text(path: &str) -> String {
    fs::read_to_string(root(path)).expect("the page can be read")
}

/// The words of a text that look like paths of this repository.
fn paths(text: &str) -> impl Iterator<Item = &str> {
    let words = text.split(|c: char| c.is_whitespace() || "`()[],;:".contains(c));
    let words = words.map(|word| word.trim_end_matches('.'));
    let roots = ["src/", "tests/", "benches/", "docs/", "grammar/", "fuzz/", ".ci/", "scripts/"];
    words.filter(move |word| roots.iter().any(|root| word.starts_with(root)))
}

#[test]
fn what_contributors_are_pointed_to_exists() {
    for page in ["CONTRIBUTING.md", "justfile", "docs/architecture.md", "README.md"] {
        let text = text(page);
        for path in paths(&text).filter(|path| !path.contains('*')) {
            assert!(root(path).exists(), "{page} names {path}");
        }
    }
}

#[test]
fn benches_and_features_have_the_names_that_are_told() {
    let manifest = text("Cargo.toml");
    let told = [text("CONTRIBUTING.md"), text("justfile")].concat();
    for (_, rest) in told.match_indices("--bench ").map(|(at, it)| (at, &told[at + it.len()..])) {
        let name: String = rest.chars().take_while(|c| c.is_alphanumeric()).collect();
        assert!(manifest.contains(&format!("name = \"{name}\"")), "no bench `{name}`");
    }
}

/// Each recipe of the justfile runs a command of ours or of the toolchain.
#[test]
fn recipes_run_what_is_there() {
    for line in text("justfile").lines().filter(|line| line.starts_with("    ")) {
        let program = line.split_whitespace().find(|word| !word.contains('='));
        assert!(program.is_some_and(|it| ["cargo", "python3", ".ci/run"].contains(&it)), "{line}");
    }
}
