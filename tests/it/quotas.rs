//! What is too much is an error that names its limit, and the limit is the user's.

use linkwork::session::Quota;

use crate::support::program::{folder, run, text};
use crate::support::talk::Talking;

/// A script that goes on for as long as it may, and the limit that ends it.
const ENDLESS: [(&str, &str); 17] = [
    ("source-bytes=1000", "include \"long.link\""),
    ("nesting=3", "define d(x) { use d(x) }\nuse d(1)"),
    ("seconds=0", "print 1"),
    ("statements=1000", "for i in 1..999 { let a = i; let b = i }"),
    ("frames=99", "step 100"),
    ("points=1000", "for i in 1..100000 { point p[i] = (i, 0) }"),
    ("constraints=1000", "point A = (0, 0), B = (1, 0)\nfor i in 1..100000 { length A B <= 2 }"),
    ("trace-samples=1000", "point A = (0, 0) frozen\ntrace A\nstep 100000"),
    ("measure-samples=1000", "point A = (0, 0) frozen\nmeasure x = A.x\nstep 100000"),
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
    ("terms=5", "point A = (0, 0) frozen, B = (1, 0)\nhold B.x + B.y + B.x = 2"),
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
fn what_exceeded_a_limit_is_in_the_way_of_nothing_else() {
    for (limit, script, right) in [
        ("points=2", "point C = (2, 2), D = (2, 3)", "delete B; point C = (2, 2); print C"),
        ("constraints=1", "length A B; length A B <= 3", "length A B; print B"),
        ("ghost-points=5", "expose every 1; step 3", "set dt 1; step; print B"),
        ("printed-bytes=3", "print \"long\"", "let r = 3; point C = (r, 0)"),
    ] {
        let typed =
            format!("point A = (0, 0), B = (1, 0)\nfor i in 1..1 {{ {script} }}\n{right}\n");
        let folder = folder(&[]);
        let out = run(folder.path(), &["--limit", limit], &typed);
        let said = text(&out.stderr);
        assert_eq!(said.matches("E0510").count(), 1, "of {limit}: {said}");
        assert_eq!(said.matches("error").count(), 1, "of {limit}: {said}");
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
        let wanted = match quota.usual() {
            u64::MAX => "none".to_owned(),
            n => n.to_string(),
        };
        assert_eq!(usual, Some(wanted), "of `{}`", quota.word());
    }
}

/// A crank, and ten commands before what a test does.
fn crank(begin: &str, limits: &[(Quota, u64)]) -> Talking {
    let mut talking = Talking::after("point A = (0, 0) frozen, B = (1, 0); motor A B speed 1rev");
    for &(quota, most) in limits {
        talking.session.limit(quota, most);
    }
    talking.run(begin);
    (0..10).for_each(|k| talking.run(&format!("let k{k} = {k}")));
    talking
}

/// How many commands can be taken back.
fn n_undoable(talking: &mut Talking) -> usize {
    (0..100).take_while(|_| talking.execute("undo").is_ok()).count()
}

#[test]
fn beyond_the_limits_of_undo_the_oldest_commands_are_forgotten() {
    let all = n_undoable(&mut crank("let k = 0", &[]));
    assert!(all > 10);
    let mut few = crank("let k = 0", &[(Quota::UndoCommands, 4)]);
    assert_eq!(n_undoable(&mut few), 4);
    few.run("assert k5 = 5; redo 4; assert k9 = 9");
    assert_eq!(n_undoable(&mut crank("let k = 0", &[(Quota::UndoCommands, 0)])), 0);

    let most = crank("let k = 0", &[]).session.undo_bytes() / 2;
    let mut half = crank("let k = 0", &[(Quota::UndoBytes, most as u64)]);
    let n_bytes = half.session.undo_bytes();
    assert!(n_bytes <= most && n_bytes > most / 2, "{n_bytes} of {most}");
    let n = n_undoable(&mut half);
    assert!((3..all - 3).contains(&n), "{n} of {all}");
    half.run("assert k0 = 0");
}

#[test]
fn the_bytes_of_undo_are_those_of_traces_ghosts_and_recordings_too() {
    let limits = [(Quota::UndoBytes, 8000)];
    for (begin, is_more) in [
        ("let k = 0", false),
        // A lap that repeats would be kept once.
        ("set dt 0.0123; trace B", true),
        ("expose every 1", true),
        ("record \"a.csv\"", true),
    ] {
        let mut talking = crank(begin, &limits);
        talking.run("step 1000");
        let before = talking.script();
        talking.run("undo");
        // What was undone holds what was made, and is all that is kept.
        let n_bytes = talking.session.undo_bytes();
        assert_eq!(n_bytes > 8000, is_more, "after `{begin}`: {n_bytes} bytes");
        assert_eq!(talking.execute("undo").is_err(), is_more, "after `{begin}`");
        if is_more {
            talking.run("redo");
            assert_eq!(talking.script(), before, "after `{begin}`");
        }
    }
}

#[test]
fn a_line_on_a_pipe_has_an_end() {
    let folder = folder(&[]);
    let typed = format!("print 1\nprint {}", "1 + ".repeat(1000));
    let out = run(folder.path(), &["--limit", "source-bytes=1000"], &typed);
    let said = text(&out.stderr);
    assert_eq!((out.status.code(), &*text(&out.stdout)), (Some(3), "1\n"), "{said}");
    assert!(said.contains("standard input") && said.contains("`source-bytes`"), "{said}");
}

#[test]
fn a_block_on_a_pipe_has_an_end() {
    let folder = folder(&[]);
    let typed = format!("print 1\nfor i in 1..2 {{\n{}", "print i\n".repeat(1000));
    let out = run(folder.path(), &["--limit", "source-bytes=1000"], &typed);
    let said = text(&out.stderr);
    assert_eq!((out.status.code(), &*text(&out.stdout)), (Some(3), "1\n"), "{said}");
    assert!(said.contains("standard input") && said.contains("`source-bytes`"), "{said}");
    let out = run(folder.path(), &[], &format!("{typed}}}\n"));
    assert_eq!((out.status.code(), text(&out.stdout).lines().count()), (Some(0), 2001));
}

#[test]
fn lines_on_a_pipe_are_what_they_are_however_they_come() {
    let folder = folder(&[]);
    let long = format!("print 1{}", " ".repeat(200_000));
    let typed = format!("print 1\n\n{long}\r\nprint 2\nprint 3");
    let out = run(folder.path(), &[], &typed);
    assert_eq!(text(&out.stderr), "");
    assert_eq!((out.status.code(), &*text(&out.stdout)), (Some(0), "1\n1\n2\n3\n"));
}
