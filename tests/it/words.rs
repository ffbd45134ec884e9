//! The user's words: what the trade calls things, units as they were typed, and when an edit is
//! solved.

use std::io::Write;
use std::process::{Command, Stdio};

use linkwork::diag::{Diagnostic, Paint, Sources, Span, render_within};
use linkwork::errors;
use linkwork::lang::catalogue::{OUTSIDE, Outside, TRADE, trade_words};
use linkwork::session::Transcript;

use crate::support::talk::Talking;

#[test]
fn each_word_of_the_trade_is_explained_with_a_statement() {
    for trade in TRADE {
        for word in trade.words {
            let told = Talking::default().ask(&format!("help {word}")).join("\n");
            assert!(told.starts_with(word) && told.contains(trade.example), "{told}");
        }
    }
}

#[test]
fn each_word_of_the_trade_is_answered_by_a_statement() {
    for word in trade_words() {
        let problem = Talking::default().execute(&format!("{word} A B =")).expect_err(word);
        let statement = suggested(&problem.helps);
        let trade = TRADE.iter().find(|trade| trade.words.contains(&word)).expect("it is there");
        assert_eq!(statement, trade.example, "for {word}");
    }
}

#[test]
fn what_a_shell_is_to_be_told_is_said_at_a_prompt() {
    for Outside { word, example, .. } in OUTSIDE {
        for typed in [(*word).to_owned(), format!("{word} a.link"), format!("{word} r=1..5")] {
            let problem = Talking::default().execute(&typed).expect_err(word);
            assert_eq!(suggested(&problem.helps), *example, "for {typed}");
        }
        let told = Talking::default().ask(&format!("help {word}")).join("\n");
        assert!(told.starts_with(word) && told.contains(example), "{told}");
        assert!(Talking::default().execute(&format!("let {word} = 3; {word} + 0")).is_ok());
    }
}

/// The statement in backticks that a help ends with.
fn suggested(helps: &[String]) -> &str {
    let help = helps.first().map_or("", |help| help.trim_end_matches('`'));
    help.rsplit_once(": `").map_or("", |(_, statement)| statement)
}

#[test]
fn what_was_typed_is_in_the_statement_where_it_fits() {
    for (typed, wanted) in [
        ("rod A B 3.5", "length A B = 3.5"),
        ("rod A B", "length A B"),
        ("coupler: bar B C = 3", "coupler: length B C = 3"),
        ("rope A B 5", "length A B <= 5"),
        ("rope A B", "length A B <= 5"),
        ("fix A", "freeze A"),
        ("weld A B C", "rigid A B C"),
        ("gear O1 A, O2 B ratio 2", "cog O1 A, O2 B ratio 2"),
        ("slider P on A B", "glider P on A B"),
        ("remove coupler", "delete coupler"),
    ] {
        let problem = Talking::default().execute(typed).expect_err(typed);
        assert_eq!(suggested(&problem.helps), wanted, "for {typed}");
    }
}

/// What `list` and a saved file say after a statement.
#[track_caller]
fn check_shown(statement: &str, wanted: &str) {
    let mut talking =
        Talking::after("point O = (0, 0) frozen, A = (1, 0), B = (0, 1), C = (3, 3), D = (5, 0)");
    talking.run(statement);
    let told = talking.ask("list").join("\n");
    assert!(told.contains(wanted), "{told}");
    assert!(talking.script().contains(wanted), "{}", talking.script());
    talking.assert_goes_on_from_its_file("step 3");
}

#[test]
fn a_number_is_shown_in_the_unit_it_was_typed_in() {
    check_shown("motor O A radius 1 speed 60rpm", "speed 60rpm");
    check_shown("motor O A radius 1 speed -1rev phase 90deg", "speed -1rev phase 90deg");
    check_shown("orientation O A, O B = 37.5deg", "= 37.5deg");
    check_shown("orientation O A, O B in -30deg..1rad", "in -30deg..1rad");
    check_shown("let w = 33rpm", "let w = 33rpm");
    check_shown("length A C = 3 + sin(90deg * time)", "= 3 + sin(90deg * time)");
    check_shown("hinge C on A D at 1/3", "at 0.333");
    check_shown("x: motor O A radius 1 speed 1rev\nchange x speed 20deg", "speed 20deg");
    check_shown("x: motor O A radius 1 speed 1rev\nchange x speed 2", "speed 2");
}

#[test]
fn a_value_that_no_such_number_gives_is_shown_without_unit() {
    // No number of degrees is 0.1 to the last bit for every 0.1: those that are not stay radians.
    for k in 1..400 {
        let mut talking = Talking::after("point O = (0, 0) frozen, A = (1, 0), B = (0, 1)");
        talking.run(&format!("let a = {}deg", f64::from(k) * 0.07));
        let value = talking.session.evaluate("a").expect("a value").number();
        let mut again = Talking::after(&talking.script());
        let back = again.session.evaluate("a").expect("a value").number();
        assert_eq!(value.to_bits(), back.to_bits(), "of {}", f64::from(k) * 0.07);
    }
}

#[test]
fn who_assigns_to_a_constraint_is_told_a_change_that_it_takes() {
    for (stated, typed, advised) in [
        ("it: length A B = 3", "it = 2", "write `change it = 2`"),
        ("it: orientation A B, A C", "it = 2deg", "write `change it = 2deg`"),
        ("it: hold A.x + B.y = 5", "it = 2", "write `change it = 2`"),
        ("it: hinge C on A B at 0.5", "it = 0.3", "write `change it at 0.3`"),
        ("it: coordinate D at (3, 3)", "it = (2, 2)", "write `change it at (2, 2)`"),
        ("circle it = A radius 2", "it = 3", "write `change it radius 3`"),
        ("it: rack A B on C D radius 1", "it = 2", "write `change it radius 2`"),
        ("it: cog A B, D C ratio 2", "it = 3", "write `change it ratio 3`"),
        ("it: motor A B speed 1rev", "it = 3", "a motor takes"),
        ("it: parallel A B, C D", "it = 3", "no part that can be changed"),
    ] {
        let mut talking = Talking::after("point A = (0, 0), B = (1, 0), C = (0.4, 1), D = (3, 3)");
        talking.run(stated);
        let source = talking.add("typed", typed, "");
        let problem = talking.execute_all(source).expect_err(typed);
        let help = problem.helps.concat();
        assert!(help.contains(advised), "after {stated}: {help}");
        if let Some((_, statement)) = help.split_once("write `") {
            talking.run(statement.trim_end_matches('`'));
        }
    }
}

#[test]
fn with_live_on_each_edit_is_solved() {
    let mut talking = Talking::after("point A = (0, 0) frozen, B = (1, 0)\nset live on");
    talking.run("rod: length A B = 3");
    assert_at(&talking, 3.0);
    talking.run("change rod = 2");
    assert_at(&talking, 2.0);
    // The edit and its solution are one step of undo.
    talking.run("undo");
    assert_at(&talking, 3.0);
    talking.run("set live off\nchange rod = 5");
    assert_at(&talking, 3.0);
}

/// Checks where B is along the x axis.
#[track_caller]
fn assert_at(talking: &Talking, x: f64) {
    let b = talking.session.position("B").expect("B is a point");
    assert!((b.x - x).abs() < 1e-11, "at {}", b.x);
}

#[test]
fn a_saved_session_stays_live_and_is_the_same() {
    let mut talking = Talking::after("point A = (0, 0) frozen, B = (1, 0)");
    talking.run("rod: length A B = 3\nset live on");
    assert_at(&talking, 1.0);
    talking.assert_goes_on_from_its_file("step");
    assert!(talking.script().ends_with("set live on\n"), "{}", talking.script());
}

#[test]
fn a_conversation_says_that_an_edit_left_the_pose_unsolved() {
    let mut talking = Talking::default();
    let mut transcript = Transcript::conversation("<prompt>");
    let mut told = |line: &str| {
        transcript.enter(line, &mut talking.session, &mut talking.talk);
        std::mem::take(&mut talking.talk.said)
    };
    assert_eq!(told("point A = (0, 0) frozen, B = (1, 0), C = (2, 0)"), "");
    let first = told("rod: length A B = 3");
    assert!(first.contains("not solved yet: rod is off by 2"), "{first}");
    assert!(first.contains("`solve` solves it; `set live on`"), "{first}");
    // Said once: whoever builds a mechanism knows.
    assert_eq!(told("length B C = 3"), "");
    told("solve");
    assert!(told("change rod = 2").contains("not solved yet"));
}

#[test]
fn a_newer_file_is_refused() {
    let saved = Talking::after("point A = (0, 0)").script();
    assert!(saved.contains("\nrestore version = 1\n"), "{saved}");
    let newer = saved.replace("restore version = 1", "restore version = 2");
    let mut talking = Talking::default();
    let problem = talking.execute(&newer).expect_err("it is newer");
    assert_eq!(problem.code, Some(errors::NEWER_FILE));
    assert_eq!(talking.session.position("A"), None);
}

#[test]
fn no_line_of_an_error_is_wider_than_the_terminal() {
    let text =
        "point A = (0, 0), B = (1, 0), C = (3, 3), D = (4, 0), Coupler = (1, 2), E = Q + (2, 2)";
    let mut sources = Sources::new();
    let id = sources.add("a.link", text);
    let at = text.find('Q').expect("it is there");
    for n_columns in [40, 60, 80] {
        let problem = Diagnostic::error(errors::UNKNOWN_NAME, "unknown name `Q`")
            .at(Span::new(id, at..at + 1), "");
        let drawn = render_within(&problem, &sources, Paint::Plain, n_columns);
        assert!(drawn.lines().all(|line| line.chars().count() <= n_columns), "{drawn}");
        let lines: Vec<&str> = drawn.lines().collect();
        let column = lines.iter().find_map(|line| line.find('^')).expect("a caret");
        let marked = lines.iter().find(|line| line.starts_with("1 |")).expect("the text");
        assert_eq!(marked.as_bytes()[column], b'Q', "{drawn}");
    }
}

#[test]
fn a_short_message_is_one_line_with_its_place() {
    let mut child = Command::new(env!("CARGO_BIN_EXE_linkwork"))
        .args(["run", "-", "--message-format", "short"])
        .stdin(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    let mut stdin = child.stdin.take().expect("a pipe");
    stdin.write_all(b"point A = (0, 0)\nlength A B = 3\n").expect("the program reads");
    drop(stdin);
    let out = child.wait_with_output().expect("the program ends");
    assert_eq!(
        String::from_utf8_lossy(&out.stderr),
        "<stdin>:2:10: error[E0201]: unknown name `B`: nothing has this name\n"
    );
    assert_eq!(out.status.code(), Some(2));
}

/// What the program prints.
fn printed(arguments: &[&str]) -> String {
    let out = Command::new(env!("CARGO_BIN_EXE_linkwork"))
        .args(arguments)
        .output()
        .expect("the program starts");
    assert!(out.status.success(), "{out:?}");
    String::from_utf8(out.stdout).expect("a text")
}

#[test]
fn shells_and_man_are_told_every_command() {
    let page = printed(&["man"]);
    assert!(page.contains(".TH linkwork 1") && page.contains("EXIT STATUS"), "{page}");
    for shell in ["bash", "elvish", "fish", "powershell", "zsh"] {
        let words = printed(&["completions", shell]);
        for command in ["accuracy", "check", "fmt", "watch", "lsp"] {
            assert!(words.contains(command), "{shell} is not told of {command}");
            assert!(page.contains(command), "the page does not name {command}");
        }
    }
}
