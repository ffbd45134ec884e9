//! The walls between the rooms hold: imports run one way, a foreign crate has one home, and no
//! file is two.

use std::collections::{BTreeMap, BTreeSet};
use std::process::Command;

use crate::support::sources::{Source, sources};

/// Each room with the rooms it may use.
const ROOMS: [(&str, &[&str]); 17] = [
    ("interrupt", &[]),
    ("diag", &[]),
    ("errors", &["diag"]),
    ("terms", &[]),
    ("lang", &["interrupt", "diag", "errors", "terms"]),
    ("constraint", &["interrupt", "terms"]),
    ("world", &["diag", "errors", "terms", "constraint"]),
    ("linalg", &["interrupt"]),
    ("optimise", &["linalg"]),
    ("mobility", &["constraint", "linalg"]),
    ("solve", &["interrupt", "diag", "constraint", "world", "linalg", "mobility"]),
    ("render", &["interrupt", "diag", "constraint", "linalg", "world"]),
    ("study", &["diag", "constraint", "world", "mobility", "solve", "render"]),
    (
        "session",
        &[
            "interrupt",
            "diag",
            "errors",
            "terms",
            "lang",
            "constraint",
            "world",
            "mobility",
            "solve",
            "render",
            "study",
            "optimise",
        ],
    ),
    ("live", &["diag", "lang", "constraint", "world", "render", "session"]),
    ("repl", &["lang", "session", "cli"]),
    ("cli", &["diag", "errors", "lang", "solve", "render", "session", "live", "repl"]),
];

/// Each foreign crate with the only places that may name it.
const HOMES: [(&str, &[&str]); 26] = [
    ("annotate_snippets", &["diag/render.rs"]),
    ("clap", &["cli/"]),
    ("clap_complete", &["cli/args.rs", "cli/manual.rs"]),
    ("clap_mangen", &["cli/manual.rs"]),
    ("ctrlc", &["cli/interrupt.rs"]),
    ("gif", &["render/raster/drawn.rs"]),
    ("getrandom", &["cli/view/token.rs"]),
    ("httparse", &["cli/view/request.rs"]),
    (
        "libm",
        &[
            "constraint/",
            "diag/",
            "linalg/",
            "mobility/",
            "optimise/",
            "render/",
            "solve/",
            "world/",
        ],
    ),
    ("nalgebra", &["linalg/", "mobility/"]),
    ("miniz_oxide", &["cli/graphics/png.rs"]),
    ("nix", &["cli/graphics/question.rs", "cli/interrupt.rs"]),
    ("pest", &["lang/lower/"]),
    ("pest_derive", &["lang/grammar.rs"]),
    ("resvg", &["render/raster/drawn.rs"]),
    ("rayon", &["solve/parallel/cores.rs"]),
    ("rustc_hash", &["world/name_index.rs"]),
    ("rustyline", &["repl/"]),
    ("lsp_server", &["cli/language_server/"]),
    ("serde_json", &["cli/language_server/", "live/", "session/json/"]),
    ("smallvec", &["mobility/system.rs", "session/resolve/scopes.rs", "solve/frame/motion.rs"]),
    ("svg", &["render/"]),
    ("tempfile", &["cli/files.rs"]),
    ("ttf_parser", &["render/pixels/letters.rs"]),
    ("terminal_size", &["cli/output.rs"]),
    ("tungstenite", &["cli/view/"]),
];

/// All that the library builds on without its features, where there is neither a thread nor a
/// file nor a clock. A crate more is a crate more for every user of the library.
const LIBRARY: [&str; 26] = [
    "annotate-snippets",
    "anstyle",
    "approx",
    "bytemuck",
    "itoa",
    "libm",
    "matrixmultiply",
    "memchr",
    "nalgebra",
    "num-complex",
    "num-integer",
    "num-rational",
    "num-traits",
    "pest",
    "rawpointer",
    "rustc-hash",
    "serde_core",
    "serde_json",
    "simba",
    "smallvec",
    "svg",
    "typenum",
    "ucd-trie",
    "unicode-width",
    "wide",
    "zmij",
];

/// What a page in a browser does not have.
const OUTSIDE: [&str; 6] = ["env", "fs", "net", "process", "thread", "time"];

/// Lines of a file that is still one thing, its tests left out.
const MOST_LINES: usize = 500;

#[test]
fn imports_run_one_way() {
    for Source { path, text } in sources() {
        let room = room_of(&path);
        let Some((_, may_use)) = ROOMS.iter().find(|(name, _)| *name == room) else { continue };
        for used in rooms_used(&text) {
            assert!(
                used == room || may_use.contains(&used.as_str()),
                "{path}: `{room}` must not use `{used}`"
            );
        }
    }
}

#[test]
fn the_page_shows_these_walls() {
    let page = include_str!("../../docs/architecture.md");
    let (_, table) = page.split_once("| room | may use | never |").expect("the table");
    let rows = table.lines().skip(2).take_while(|line| line.starts_with('|'));
    let shown: BTreeMap<&str, BTreeSet<&str>> = rows
        .map(|row| {
            let cells: Vec<&str> = row.split('|').map(str::trim).collect();
            (cells[1], cells[2].split(", ").filter(|room| !room.is_empty()).collect())
        })
        .collect();
    let held = ROOMS.map(|(room, may_use)| (room, may_use.iter().copied().collect()));
    assert_eq!(shown, BTreeMap::from(held));
}

#[test]
fn a_foreign_crate_has_one_home() {
    for Source { path, text } in sources() {
        for (name, homes) in HOMES {
            let is_at_home = homes.iter().any(|home| path.starts_with(home));
            let is_named = code(&text).any(|line| names_crate(line, name));
            assert!(is_at_home || !is_named, "{path} names `{name}`, which lives in {homes:?}");
        }
    }
}

#[test]
fn the_library_needs_no_system() {
    for source in sources() {
        // What takes the feature `pictures` draws on a thread of its own.
        let has_features = source.path == "render/raster/drawn.rs";
        if has_features || ["cli", "main", "repl"].contains(&room_of(&source.path).as_str()) {
            continue;
        }
        for module in OUTSIDE {
            assert!(!names_std(&source.code(), module), "{} names std::{module}", source.path);
        }
    }
    assert!(names_std("use std::fs;", "fs") && names_std("use std::{\n    io, fs::File};", "fs"));
    assert!(!names_std("use std::{fmt, io};", "fs") && !names_std("std::fmt::x", "fs"));
}

#[test]
fn the_library_builds_on_these_crates_alone() {
    let target = ["--target", "wasm32-unknown-unknown", "--offline", "--locked"];
    let tree = Command::new(env!("CARGO"))
        .args(["tree", "--no-default-features", "--edges", "normal,no-proc-macro"])
        .args(["--prefix", "none"])
        .args(target)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .expect("cargo runs");
    let names = String::from_utf8(tree.stdout).expect("names are text");
    let names = names.lines().filter_map(|line| line.split(' ').next());
    let names: BTreeSet<&str> = names.filter(|name| *name != "linkwork").collect();
    let why = String::from_utf8_lossy(&tree.stderr).into_owned();
    assert_eq!(names, BTreeSet::from(LIBRARY), "{why}");
}

#[test]
fn the_environment_is_read_in_one_place() {
    // There a variable that is empty is none.
    for source in sources() {
        let reads = ["env::var", "env::vars"].iter().any(|it| source.code().contains(it));
        assert!(!reads || source.path == "cli/environment.rs", "{} reads variables", source.path);
    }
}

#[test]
fn no_file_is_two() {
    for Source { path, text } in sources() {
        let n_lines = text.split("#[cfg(test)]").next().map_or(0, |code| code.lines().count());
        assert!(n_lines <= MOST_LINES, "{path} has {n_lines} lines: split it");
    }
}

#[test]
fn every_file_says_what_it_is_for() {
    for Source { path, text } in sources() {
        assert!(text.starts_with("//! "), "{path} does not open with what it is for");
    }
}

#[test]
fn the_check_sees_what_it_should() {
    let used = rooms_used(
        "use crate::world::World;\nlet x = crate::solve::Solver::new();\n// crate::cli\n",
    );
    assert_eq!(used, BTreeSet::from(["solve".to_owned(), "world".to_owned()]));
    let used = rooms_used("use crate::{diag::Span, lang::ast};\n");
    assert_eq!(used, BTreeSet::from(["diag".to_owned(), "lang".to_owned()]));
    assert!(names_crate("use rustyline::Editor;", "rustyline"));
    assert!(!names_crate("let myclap::x", "clap"));
}

fn room_of(path: &str) -> String {
    path.split('/').next().unwrap_or_default().trim_end_matches(".rs").to_owned()
}

/// The lines that are code.
fn code(text: &str) -> impl Iterator<Item = &str> {
    text.lines().filter(|line| !line.trim_start().starts_with("//"))
}

/// The rooms that a source names: `crate::room` and `crate::{room, ...}`.
fn rooms_used(text: &str) -> BTreeSet<String> {
    let mut used = BTreeSet::new();
    let text: String = code(text).flat_map(|line| [line, "\n"]).collect();
    for (_, rest) in
        text.match_indices("crate::").map(|(at, found)| (at, &text[at + found.len()..]))
    {
        let list = match rest.strip_prefix('{') {
            Some(rest) => rest.split_once("};").map_or(rest, |(list, _)| list),
            None => rest.split(|c: char| !is_word(c)).next().unwrap_or_default(),
        };
        let mut depth = 0;
        for part in list.split_inclusive(['{', '}', ',']) {
            let word: String = part.trim().chars().take_while(|&c| is_word(c)).collect();
            let is_room = ROOMS.iter().any(|(name, _)| *name == word);
            if depth == 0 && is_room {
                used.insert(word);
            }
            depth += i32::from(part.ends_with('{')) - i32::from(part.ends_with('}'));
        }
    }
    used
}

fn is_word(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

/// Whether a line of code names a crate by a path.
fn names_crate(line: &str, name: &str) -> bool {
    line.match_indices(&format!("{name}::"))
        .any(|(at, _)| !line[..at].ends_with(|c: char| is_word(c) || c == ':'))
}

/// Whether code names a module of the standard library: `std::name` or `std::{name, ...}`.
fn names_std(code: &str, module: &str) -> bool {
    code.match_indices("std::").any(|(at, found)| {
        let rest = &code[at + found.len()..];
        let list = match rest.strip_prefix('{') {
            Some(list) => list.split_once("};").map_or(list, |(list, _)| list),
            None => rest.split(|c: char| !is_word(c)).next().unwrap_or_default(),
        };
        list.split(|c: char| !is_word(c)).any(|word| word == module)
    })
}
