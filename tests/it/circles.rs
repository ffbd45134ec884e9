//! No file leads back to itself by its imports: each room can be read from the bottom up.

use std::collections::{BTreeMap, BTreeSet};

use crate::support::sources::{Source, sources};

/// The rooms in which no files may lead to each other.
const ROOMS: [&str; 13] = [
    "cli",
    "constraint",
    "diag",
    "linalg",
    "live",
    "mobility",
    "render",
    "repl",
    "session",
    "solve",
    "study",
    "terms",
    "world",
];

#[test]
fn no_room_runs_in_a_circle() {
    let tree = Tree::new(sources());
    let edges = tree.edges();
    for room in ROOMS {
        let circles = circles(&edges, room);
        assert!(circles.is_empty(), "files of `{room}` lead back to themselves: {circles:#?}");
    }
}

#[test]
fn a_circle_is_seen() {
    let file = |path: &str, text: &str| Source { path: path.into(), text: text.into() };
    let tree = Tree::new(vec![
        file("a/mod.rs", "mod b;\nmod c;\npub use b::B;\n"),
        file("a/b.rs", "use super::c::{self, C};\n"),
        file("a/c.rs", "use crate::a::{\n    B,\n};\n"),
        file(
            "a/d.rs",
            "// crate::a::b\nfn f() { super::c::g() }\n#[cfg(test)]\nmod tests { use super::super::b; }\n",
        ),
    ]);
    let edges = tree.edges();
    let file = |path: &str| path.to_owned();
    assert_eq!(circles(&edges, "a"), [vec![file("a/b.rs"), file("a/c.rs")]]);
    assert_eq!(edges["a/d.rs"], BTreeSet::from([file("a/c.rs")]));
    assert!(edges["a/mod.rs"].is_empty(), "what a folder only passes on is no import of its own");
}

/// The path of a module, without the crate.
type Module = Vec<String>;

/// All sources, by the module each of them is.
struct Tree {
    files: BTreeMap<Module, Source>,
    /// What a module passes on: where its items come from.
    passed_on: BTreeMap<Module, BTreeMap<String, Module>>,
    /// The modules of which a module passes on all.
    passed_whole: BTreeMap<Module, Vec<Module>>,
}

impl Tree {
    fn new(sources: Vec<Source>) -> Self {
        let files = sources.into_iter().map(|source| (module_of(&source.path), source)).collect();
        let mut tree = Self { files, passed_on: BTreeMap::new(), passed_whole: BTreeMap::new() };
        for (module, source) in &tree.files {
            let mut items = BTreeMap::new();
            let mut wholes = Vec::new();
            for import in imports(&source.code()).iter().filter(|import| import.is_public) {
                for path in &import.paths {
                    match (tree.absolute(path, module), path.last()) {
                        (Some(mut from), Some(item)) if item == "*" => {
                            from.pop();
                            wholes.push(from);
                        }
                        (Some(from), Some(item)) => drop(items.insert(item.clone(), from)),
                        _ => {}
                    }
                }
            }
            tree.passed_on.insert(module.clone(), items);
            tree.passed_whole.insert(module.clone(), wholes);
        }
        tree
    }

    /// For each file the files whose items it names.
    fn edges(&self) -> BTreeMap<String, BTreeSet<String>> {
        let edges = self.files.iter().map(|(module, source)| {
            let code = source.code();
            let is_folder = source.path.ends_with("mod.rs");
            let mut named: Vec<Vec<String>> = Vec::new();
            for import in imports(&code) {
                // What a folder passes on is its face, not what it is made of.
                if !(is_folder && import.is_public) {
                    named.extend(import.paths);
                }
            }
            named.extend(paths_in_code(&code));
            let files = named.iter().filter_map(|path| self.absolute(path, module));
            let files = files.filter_map(|path| self.file_of(&path, 0));
            let others = files.filter(|path| *path != source.path);
            (source.path.clone(), others.collect())
        });
        edges.collect()
    }

    /// A path without `super`, `self` and `crate`; none if it leaves the crate.
    fn absolute(&self, path: &[String], from: &Module) -> Option<Module> {
        let mut here = from.clone();
        let mut rest = path;
        match path.first()?.as_str() {
            "crate" => {
                here.clear();
                rest = &path[1..];
            }
            "self" => rest = &path[1..],
            "super" => {
                while rest.first().is_some_and(|word| word == "super") {
                    here.pop();
                    rest = &rest[1..];
                }
            }
            child => {
                here.push(child.to_owned());
                if !self.files.contains_key(&here) {
                    return None;
                }
                rest = &path[1..];
            }
        }
        here.extend(rest.iter().cloned());
        Some(here)
    }

    /// Where an item comes from that a module passes on.
    fn origin(&self, module: &[String], item: &str) -> Option<&Module> {
        let passed_on = |module: &[String]| self.passed_on.get(module)?.get(item);
        let wholes = || self.passed_whole.get(module).into_iter().flatten();
        passed_on(module).or_else(|| wholes().find_map(|whole| passed_on(whole)))
    }

    /// The file that defines what a path names: the longest module of it, and from there on what
    /// that one passes on.
    fn file_of(&self, path: &[String], depth: usize) -> Option<String> {
        let n = (0..=path.len()).rev().find(|&n| self.files.contains_key(&path[..n]))?;
        if let Some(item) = path.get(n)
            && let Some(from) = self.origin(&path[..n], item)
            && depth < 8
        {
            let path: Vec<String> = from.iter().chain(&path[n + 1..]).cloned().collect();
            return self.file_of(&path, depth + 1);
        }
        Some(self.files[&path[..n]].path.clone())
    }
}

fn module_of(path: &str) -> Module {
    let mut words: Module = path.trim_end_matches(".rs").split('/').map(str::to_owned).collect();
    if words.last().is_some_and(|last| last == "mod" || last == "lib") {
        words.pop();
    }
    words
}

/// A `use`, taken apart.
struct Import {
    is_public: bool,
    paths: Vec<Vec<String>>,
}

/// The imports of a text.
fn imports(code: &str) -> Vec<Import> {
    let mut imports = Vec::new();
    let mut rest = code;
    while let Some(at) = rest.find("use ") {
        let line = rest[..at].rsplit('\n').next().unwrap_or_default().trim();
        let is_public = line.starts_with("pub");
        let is_import = line.is_empty() || is_public && !line.contains(['{', '"', ';']);
        rest = &rest[at + 4..];
        if !is_import {
            continue;
        }
        let (tree, after) = rest.split_once(';').unwrap_or((rest, ""));
        let mut paths = Vec::new();
        flatten(&[], tree, &mut paths);
        imports.push(Import { is_public, paths });
        rest = after;
    }
    imports
}

/// The leaves of a tree like `a::{b, c::{self, d}}`.
fn flatten(stem: &[String], tree: &str, paths: &mut Vec<Vec<String>>) {
    let words = |text: &str| -> Vec<String> {
        let words = text.split("::").map(|word| word.trim().to_owned());
        words.filter(|word| !word.is_empty()).collect()
    };
    let tree = tree.trim();
    if let Some((before, inside)) = tree.split_once('{') {
        let stem = [stem, &words(before)].concat();
        let inside = inside.trim_end().strip_suffix('}').unwrap_or(inside);
        let mut depth = 0;
        let parts = inside.split(|c: char| {
            depth += i32::from(c == '{') - i32::from(c == '}');
            c == ',' && depth == 0
        });
        parts.for_each(|part| flatten(&stem, part, paths));
        return;
    }
    let path = tree.split(" as ").next().unwrap_or_default();
    let mut path = [stem, &words(path)].concat();
    if path.last().is_some_and(|last| last == "self") {
        path.pop();
    }
    if !path.is_empty() {
        paths.push(path);
    }
}

/// The paths that begin with `crate`, `super` or `self` outside of imports.
fn paths_in_code(code: &str) -> Vec<Vec<String>> {
    let is_word = |c: char| c.is_alphanumeric() || c == '_' || c == ':';
    // What ends in `::` is the stem of an import.
    let words = code.split(|c: char| !is_word(c)).filter(|word| !word.ends_with("::"));
    let stems = ["crate::", "super::", "self::"];
    let paths = words.filter(|word| stems.iter().any(|stem| word.starts_with(stem)));
    let path = |text: &str| -> Vec<String> {
        text.split("::").filter(|word| !word.is_empty()).map(str::to_owned).collect()
    };
    paths.map(path).filter(|path| path.len() > 1).collect()
}

/// The sets of files of a room that lead to each other, each in order.
fn circles(edges: &BTreeMap<String, BTreeSet<String>>, room: &str) -> Vec<Vec<String>> {
    let files: Vec<&String> =
        edges.keys().filter(|path| path.split('/').next() == Some(room)).collect();
    let reach: BTreeMap<&String, BTreeSet<&String>> = files
        .iter()
        .map(|&start| {
            let mut seen = BTreeSet::new();
            let mut left = vec![start];
            while let Some(file) = left.pop() {
                for next in edges.get(file).into_iter().flatten() {
                    if next.split('/').next() == Some(room) && seen.insert(next) {
                        left.push(next);
                    }
                }
            }
            (start, seen)
        })
        .collect();
    let mut circles: Vec<Vec<String>> = Vec::new();
    for file in files.iter().filter(|file| reach[**file].contains(**file)) {
        if circles.iter().flatten().any(|known| known == *file) {
            continue;
        }
        let both = files
            .iter()
            .filter(|other| reach[*file].contains(**other) && reach[**other].contains(*file));
        circles.push(both.map(|path| (*path).clone()).collect());
    }
    circles
}
