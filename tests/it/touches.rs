//! What a new thing touches is counted, by the files that name one that is there: a question
//! asked of each kind in a place of its own would be one more file. `docs/architecture.md` lists
//! them.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use linkwork::constraint::Kind;
use linkwork::lang::catalogue::{self, ConstraintWord, Section};
use linkwork::solve::Method;
use linkwork::terms::Function;

use crate::support::sources::{Source, sources};

const GRAMMAR: &str = "grammar/linkwork.pest";

/// What names each kind of constraint besides its own file; a script that shows it is the sixth.
const OF_A_KIND: [&str; 4] =
    ["constraint/kinds/mod.rs", GRAMMAR, "lang/catalogue/constraints.rs", "render/classify.rs"];

/// What names one kind to go a shorter way with it, or to say more of it. Without that it would
/// go the way of all others; what would be wrong then does not belong here.
const SHORTER_WAYS: &[(Kind, &[&str])] = &[
    // One on a circle is of another kind.
    (
        Kind::Glider,
        &[
            "constraint/kinds/touch.rs",
            "session/commands/constrain.rs",
            "session/commands/touch.rs",
            // A point on a line has a closed form.
            "solve/closed_form/compile.rs",
            "solve/frame/dyad.rs",
        ],
    ),
    // Where its point is needs no solving.
    (Kind::Coordinate, &["solve/closed_form/compile.rs", "solve/closed_form/schedule.rs"]),
    // A point on a line, and one on a wheel that rolls, has a closed form.
    (Kind::Aligned, &["solve/closed_form/compile.rs", "solve/closed_form/line.rs"]),
    (
        Kind::Rack,
        &[
            "solve/closed_form/compile.rs",
            "solve/closed_form/rolling.rs",
            "solve/closed_form/wheel.rs",
        ],
    ),
    // Points that are sums of others have a closed form.
    (Kind::Coincidence, &["solve/closed_form/sum.rs"]),
    (Kind::Equivalence, &["solve/closed_form/sum.rs"]),
    // What a cutter makes: rods, cranks, bodies, and holes for what is hinged on them.
    (
        Kind::Hinge,
        &[
            "render/export/members.rs",
            "session/commands/touch.rs",
            "solve/closed_form/body.rs",
            "solve/closed_form/cluster.rs",
            "solve/closed_form/sum.rs",
        ],
    ),
    (
        Kind::Rigid,
        // A body is placed as one.
        &["render/export/members.rs", "solve/closed_form/body.rs", "solve/closed_form/cluster.rs"],
    ),
    // What of a circle others name; SVG documents and drawing lists have circles of their own.
    (
        Kind::Curve,
        &[
            "live/drawn.rs",
            "render/document.rs",
            "render/pixels/markup.rs",
            "render/symbols/round.rs",
            "session/commands/touch.rs",
            "world/compile.rs",
            "world/member.rs",
        ],
    ),
    (
        Kind::Touch,
        &[
            "session/commands/constrain.rs",
            "session/commands/touch.rs",
            "session/resolve/unbind.rs",
        ],
    ),
    // What is likely a slip in a distance, an angle or a phase is noted.
    // What a constraint measures is said by a function that measures the same.
    (
        Kind::Distance,
        &[
            "lang/lower/errors/mistake.rs",
            "session/commands/slips.rs",
            "solve/closed_form/compile.rs",
            "world/member.rs",
        ],
    ),
    // Bars are found by the meeting of two circles, and swept in shares.
    (
        Kind::Equal,
        // The spokes of an arc are of one length.
        &[
            "constraint/kinds/curve.rs",
            "solve/closed_form/compile.rs",
            "solve/frame/dyad.rs",
            "world/member.rs",
        ],
    ),
    (
        Kind::Length,
        &[
            "lang/lower/errors/refusal.rs",
            "render/export/members.rs",
            "session/commands/diagnose.rs",
            "session/resolve/unbind.rs",
            "world/member.rs",
            "solve/closed_form/compile.rs",
            "solve/closed_form/length.rs",
            "solve/closed_form/run.rs",
            "solve/frame/branch.rs",
            "solve/frame/decomposition.rs",
            "solve/frame/dyad.rs",
            "solve/frame/motion.rs",
            "solve/method/sweep.rs",
        ],
    ),
    (
        Kind::Orientation,
        &[
            "solve/closed_form/compile.rs",
            "solve/closed_form/direction.rs",
            "session/commands/diagnose.rs",
            "session/commands/slips.rs",
            "session/resolve/unbind.rs",
            "world/member.rs",
        ],
    ),
    // A motor is what drives: its turn is an input, its end is what `limits` asks for.
    (
        Kind::Motor,
        &[
            "mobility/range.rs",
            "render/export/members.rs",
            "render/style.rs",
            "solve/closed_form/compile.rs",
            "solve/closed_form/run.rs",
            "session/commands/driver.rs",
            "session/commands/driver_range.rs",
            "session/resolve/unbind.rs",
            "solve/dead_point.rs",
            "solve/frame/dyad.rs",
            "solve/frame/interpolate.rs",
            "solve/island/inputs.rs",
            "solve/island/mod.rs",
            "session/commands/slips.rs",
            // A speed that is an expression is integrated over the frame.
            "world/motion.rs",
            // Its angle is a member.
            "world/member.rs",
        ],
    ),
    // `set cog` says in which of two forms wheels are made.
    (
        Kind::Cog,
        &[
            "solve/closed_form/compile.rs",
            "solve/closed_form/rolling.rs",
            "solve/closed_form/wheel.rs",
            "constraint/kinds/cog_velocity.rs",
            "session/commands/constrain.rs",
            "session/commands/save.rs",
            "session/commands/setting_table.rs",
        ],
    ),
    (Kind::CogVelocity, &["session/commands/constrain.rs", "session/commands/save.rs"]),
];

/// The most files of the program, its grammar and its scripts that a new one touches.
const MOST_OF_A_CONSTRAINT: usize = 6;
const MOST_OF_A_COMMAND: usize = 4;
const MOST_OF_A_METHOD: usize = 3;
const MOST_OF_A_FUNCTION: usize = 2;

#[test]
fn a_constraint_touches_six_files() {
    for &kind in Kind::ALL {
        let own = format!("constraint/kinds/{}.rs", snake(&format!("{kind:?}")));
        let mut wanted = set(&OF_A_KIND);
        wanted.insert(own);
        assert!(wanted.len() < MOST_OF_A_CONSTRAINT, "a script shows it too");
        if kind == Kind::CogVelocity {
            // Stated as the other form is.
            wanted = &wanted - &set(&[GRAMMAR, "lang/catalogue/constraints.rs"]);
        }
        for (_, files) in SHORTER_WAYS.iter().filter(|(special, _)| *special == kind) {
            wanted.extend(set(files));
        }
        assert_eq!(naming(|source| names_kind(source, kind)), wanted, "of {kind:?}");
    }
}

#[test]
fn each_constraint_is_shown_by_a_script() {
    let texts: String = scripts().into_iter().collect();
    for word in ConstraintWord::ALL {
        let keyword = word.pattern().entry.keyword;
        assert!(has_word(&texts, keyword), "no script states `{keyword}`");
    }
}

#[test]
fn a_command_touches_four_files() {
    for entry in catalogue::commands().filter(|entry| entry.section != Section::Constraints) {
        let word = entry.keyword;
        let family = match entry.section {
            Section::Points => "making",
            Section::Changing => "changing",
            Section::Running => "running",
            Section::Looking => "looking",
            Section::Measuring => "measuring",
            Section::Pictures => "drawing",
            Section::Building => "building",
            Section::Constraints | Section::Topics => unreachable!("it is a command"),
        };
        let own = format!("lang/commands/{family}.rs");
        let variant = capitalised(if word == "exit" { "quit" } else { word });
        let path = format!("{}::{variant}", capitalised(family));
        let found = naming(|source| match &*source.path {
            GRAMMAR => has_word(&source.text, &format!("kw_{word}")),
            path if path == own => source.text.contains(&format!("keyword: \"{word}\"")),
            // What writes such a statement names it too.
            "session/commands/save.rs"
            | "session/commands/diagnose.rs"
            | "session/resolve/unbind.rs"
            | "session/ask.rs" => false,
            _ => has_word(&source.code(), &path),
        });
        assert_eq!(found, set(&[GRAMMAR, &own, "session/dispatch.rs"]), "of `{word}`");
        assert!(found.len() < MOST_OF_A_COMMAND, "what it does is a file more");
    }
}

#[test]
fn a_method_touches_three_files() {
    for method in Method::ALL {
        // What is tried by default, and the only one that the user gives a coefficient.
        if matches!(method, Method::Auto | Method::Relaxation) {
            continue;
        }
        let (path, word) = (format!("Method::{method:?}"), format!("\"{}\"", method.word()));
        let found = naming(|source| {
            let code = source.code();
            has_word(&code, &path) || code.contains(&word)
        });
        let wanted = set(&["solve/settings.rs", "solve/method/mod.rs"]);
        assert_eq!(found, wanted, "of {method:?}");
        assert!(found.len() < MOST_OF_A_METHOD, "its own file is one more");
    }
}

#[test]
fn a_function_touches_two_files() {
    for function in Function::ALL {
        let path = format!("Function::{function:?}");
        let names = |source: &Source| match &*source.path {
            "terms/function.rs" => true,
            // What is of vectors falls apart into numbers there, and what a tangent measures is said
            // in terms of the language.
            "world/compile.rs" | "world/member.rs" | "session/commands/touch.rs" => false,
            _ => has_word(&source.code(), &path),
        };
        let found = naming(names);
        assert_eq!(found.len(), MOST_OF_A_FUNCTION, "{function:?}: {found:?}");
    }
}

fn set(files: &[&str]) -> BTreeSet<String> {
    files.iter().map(|&file| file.to_owned()).collect()
}

fn capitalised(word: &str) -> String {
    let (first, rest) = word.split_at(1);
    first.to_uppercase() + rest
}

fn snake(name: &str) -> String {
    let mut snake = String::new();
    for c in name.chars() {
        if c.is_uppercase() && !snake.is_empty() {
            snake.push('_');
        }
        snake.extend(c.to_lowercase());
    }
    snake
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The sources and the grammar that something is true of.
fn naming(is_named: impl Fn(&Source) -> bool) -> BTreeSet<String> {
    let text = fs::read_to_string(root().join(GRAMMAR)).expect("the grammar can be read");
    let all = sources().into_iter().chain([Source { path: GRAMMAR.to_owned(), text }]);
    let all = all.filter(|source| !source.path.ends_with("tests.rs"));
    all.filter(is_named).map(|source| source.path).collect()
}

/// The texts of all scripts.
fn scripts() -> Vec<String> {
    let list = |folder: &Path| fs::read_dir(folder).expect("a folder can be listed");
    let folders =
        list(&root().join("scripts")).map(|entry| entry.expect("it can be listed").path());
    let files = folders.filter(|path| path.is_dir()).flat_map(|folder| list(&folder));
    let paths = files.map(|entry| entry.expect("it can be listed").path());
    let scripts = paths.filter(|path| path.extension().is_some_and(|ending| ending == "link"));
    scripts.map(|path| fs::read_to_string(path).expect("a script can be read")).collect()
}

/// Whether a source names a kind of constraint: its type, its variant, or its word.
fn names_kind(source: &Source, kind: Kind) -> bool {
    // Words that people bring are answered by any kind.
    if source.path == "lang/catalogue/trade.rs" {
        return false;
    }
    // What else is called so.
    let others = [
        "Quantity::Length",
        "feature = \"parallel\"",
        "Hold => \"hold\"",
        "Rigid => \"rigid\"",
        "\"holds\", \"hold\"",
    ];
    let code = others.iter().fold(source.code(), |code, other| code.replace(other, ""));
    let name = format!("{kind:?}");
    let words = ConstraintWord::ALL.iter().map(|word| word.pattern().entry.keyword);
    let mut words = words.filter(|word| Kind::stated_by(word) == Some(kind));
    if source.path == GRAMMAR {
        return words.any(|word| has_word(&code, &format!("kw_{word}")));
    }
    if source.path == "lang/catalogue/constraints.rs" {
        return words.any(|word| has_word(&code, word));
    }
    let is_table = source.path.starts_with("constraint/kinds/");
    let imports = code.split("use crate::constraint::").skip(1);
    let mut imports = imports.filter_map(|rest| rest.split(';').next());
    has_word(&code, &format!("Constraint::{name}"))
        || has_word(&code, &format!("Kind::{name}"))
        || is_table && has_word(&code, &name)
        || imports.any(|import| has_word(import, &name))
        || words.any(|word| code.contains(&format!("\"{word}\"")))
}

/// Whether a text has a word that is not part of another.
fn has_word(text: &str, word: &str) -> bool {
    let is_part = |c: Option<char>| c.is_some_and(|c| c.is_alphanumeric() || c == '_');
    text.match_indices(word).any(|(at, _)| {
        !is_part(text[..at].chars().next_back()) && !is_part(text[at + word.len()..].chars().next())
    })
}
