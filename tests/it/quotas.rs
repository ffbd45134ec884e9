//! What is too much is an error that names its limit, and the limit is the user's.

use linkwork::session::Quota;

use crate::support::program::{folder, run, text};

/// A script that goes on for as long as it may, and the limit that ends it.
const ENDLESS: [(&str, &str); 14] = [
    ("source-bytes=1000", "include \"long.link\""),
    ("nesting=3", "define d(x) { use d(x) }\nuse d(1)"),
    ("statements=1000", "for i in 1..999 { let a = i; let b = i }"),
    ("frames=99", "step 100"),
    ("points=1000", "for i in 1..100000 { point p[i] = (i, 0) }"),
    ("constraints=1000", "point A = (0, 0), B = (1, 0)\nfor i in 1..100000 { length A B <= 2 }"),
    ("trace-samples=1000", "point A = (0, 0) frozen\ntrace A\nstep 100000"),
    ("ghost-points=1000", "point A = (0, 0) frozen, B = (1, 0)\nexpose every 1\nstep 100000"),
    ("plot-samples=1000", "for i in 1..100000 { sample \"a\" = i }"),
    ("recorded-frames=1000", "point A = (0, 0)\nrecord \"t.csv\"\nstep 100000"),
    ("recorded-bytes=1000", "point A = (0, 0)\nrecord \"t.svg\"\nstep 1000"),
    ("printed-bytes=1000", "for i in 1..100000 { print i }"),
    (
        "files=3",
        "for i in 1..4 { sample \"a\" = i }\nsvg \"1.svg\"; svg \"2.svg\"; svg \"3.svg\"; svg \"4.svg\"",
    ),
    ("file-bytes=100", "point A = (0, 0)\nsvg \"a.svg\""),
];

#[test]
fn what_exceeds_a_limit_is_an_error_that_names_it() {
    let long = "# so it goes on\n".repeat(100);
    for (limit, script) in ENDLESS {
        let (word, most) = limit.split_once('=').expect("a limit");
        let folder = folder(&[("a.link", script), ("long.link", &long)]);
        let limited = |most: &str| {
            let limit = format!("{word}={most}");
            run(folder.path(), &["run", "a.link", "--force", "--limit", &limit], "")
        };
        let out = limited(most);
        let said = text(&out.stderr);
        let status = if word == "source-bytes" { 3 } else { 2 };
        assert_eq!(out.status.code(), Some(status), "of {limit}: {said}");
        let is_named = match word {
            "nesting" => said.contains("3 levels"),
            "frames" => said.contains("99"),
            _ => said.contains(word),
        };
        assert!(is_named && said.contains("a.link:"), "of {limit}: {said}");
        if word != "nesting" {
            let out = limited("none");
            assert_eq!(out.status.code(), Some(0), "of {limit}: {}", text(&out.stderr));
        }
    }
}

#[test]
fn a_command_that_exceeds_a_limit_leaves_nothing() {
    let typed = "point A = (0, 0) frozen; trace A\nstep 5\nstep 100\nprint time\nlist points\n\
        for i in 1..100 { point p[i] = (i, 0) }\nlist points\n";
    let folder = folder(&[]);
    let args = ["--limit", "trace-samples=50", "--limit", "points=50"];
    let out = run(folder.path(), &args, typed);
    assert_eq!(out.status.code(), Some(2));
    let answer = text(&out.stdout);
    let lines: Vec<&str> = answer.lines().collect();
    assert_eq!(lines.len(), 3, "{answer}");
    assert!(lines[0].starts_with("0.0833") && lines[1] == lines[2], "{answer}");
}

#[test]
fn a_limit_that_is_none_is_told() {
    let folder = folder(&[]);
    for (limit, says) in [
        ("pints=3", "points"),
        ("points=many", "`many` is no whole number"),
        ("points", "NAME=NUMBER"),
        ("nesting=65", "64"),
    ] {
        let out = run(folder.path(), &["--limit", limit], "");
        assert_eq!(out.status.code(), Some(2), "of {limit}");
        assert!(text(&out.stderr).contains(says), "of {limit}: {}", text(&out.stderr));
    }
}

#[test]
fn the_documentation_lists_all_limits() {
    let page = include_str!("../../docs/language.md");
    for quota in Quota::ALL {
        let line = page.lines().find(|line| line.starts_with(&format!("| `{}` |", quota.word())));
        let usual = line.and_then(|line| line.split('|').nth(3)).map(|cell| cell.replace(' ', ""));
        assert_eq!(usual, Some(quota.usual().to_string()), "of `{}`", quota.word());
    }
}
