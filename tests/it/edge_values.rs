//! Numbers at the ends of what numbers hold: whatever is stated with them, in whatever pose, is
//! refused or survived by every command, and nothing that is said is no number.

use std::panic::{AssertUnwindSafe, catch_unwind};

use crate::support::talk::{Talking, is_read};

/// Each is said with every value in the place of `V`.
const STATEMENTS: [&str; 16] = [
    "it: hinge C on A B at V",
    "it: length B C = V",
    "it: length B C <= V",
    "it: coordinate B at (V, 1)",
    "it: distance C to A B = V",
    "it: orientation A B, A C = V",
    "it: motor A B radius V speed 1rev",
    "it: motor A B speed V",
    "it: cog A B, D C ratio V",
    "it: rack A B on C D radius V",
    "it: equal A B, C D = V",
    "it: hold V * A.x + B.y = 1",
    "it: hold B = (C.x * V, 1)",
    "circle it = A radius V; tangent C D to it",
    "let v = V; it: length B C = v * (1 + time)",
    "move B to (V, -V); it: equivalence A B, C D",
];

const VALUES: [&str; 10] =
    ["1e308", "-1e200", "1e154", "1e100", "1e16", "0", "-0", "1e-160", "-1e-300", "5e-324"];

const POSES: [&str; 4] = [
    "point A = (0, 0) frozen, B = (1, 0), C = (3, 2), D = (4, 0) frozen",
    "point A = (0, 0), B = (1, 0), C = (3, 2), D = (4, 0); freeze all",
    "point A = (0, 0), B = (0, 0), C = (0, 0), D = (0, 0)",
    "point A = (1e30, 0), B = (1e-30, 1), C = (0, -1e30), D = (5, 5) frozen; length A C",
];

const COMMANDS: [&str; 20] = [
    "step",
    "check",
    "solve",
    "step 3",
    "relax 5",
    "why it",
    "limits it",
    "show it",
    "list",
    "print it.value, it.residual, velocity(B), acceleration(C)",
    "effects",
    "svg \"a.svg\"",
    "pull B to (2, 2) over 2",
    "drag C to (2, 1) over 2",
    "drag B to (3, 1) over 0",
    "set method relaxation; step; set method auto",
    "change it = 1e200",
    "off it; step; on it; step",
    "trace C; step; sample \"x\" = A.x; sample \"x\" = A.x; plot \"t.svg\"; plot",
    "undo; redo",
];

/// Whether a text has a word for what is no number.
fn names_no_number(text: &str) -> bool {
    let mut words = text.split(|c: char| !c.is_alphanumeric());
    words.any(|word| ["inf", "NaN", "nan", "infinity"].contains(&word))
}

/// Says a statement in a pose, then each command, beginning with another one each time.
fn check(pose: &str, statement: &str, n_before: usize) {
    let mut script = pose.to_owned();
    let mut talking = Talking::after(pose);
    let rotated = COMMANDS.iter().cycle().skip(n_before).take(COMMANDS.len());
    for command in std::iter::once(&statement).chain(rotated) {
        script = format!("{script}\n{command}");
        let said = catch_unwind(AssertUnwindSafe(|| talking.type_in(command)));
        let said = said.unwrap_or_else(|_| panic!("a panic after\n{script}"));
        assert!(!names_no_number(&said), "{said}\nafter\n{script}");
    }
    let picture = talking.talk.files.values().find(|text| names_no_number(text));
    assert!(picture.is_none(), "{picture:?}\nafter\n{script}");
    assert!(!names_no_number(&talking.script()), "{}\nafter\n{script}", talking.script());
}

fn check_all_in(pose: &str) {
    let said = STATEMENTS.iter().flat_map(|statement| VALUES.map(|v| statement.replace('V', v)));
    said.enumerate().for_each(|(n, statement)| check(pose, &statement, n % COMMANDS.len()));
}

#[test]
fn what_is_said_are_statements() {
    for said in STATEMENTS.map(|it| it.replace('V', "1")).iter().map(|it| &**it).chain(COMMANDS) {
        assert!(is_read(said), "{said}");
    }
}

#[test]
fn numbers_at_the_ends_are_refused_or_survived_in_a_pose_that_moves() {
    check_all_in(POSES[0]);
}

#[test]
fn numbers_at_the_ends_are_refused_or_survived_where_all_is_frozen() {
    check_all_in(POSES[1]);
}

#[test]
fn numbers_at_the_ends_are_refused_or_survived_where_all_coincides() {
    check_all_in(POSES[2]);
}

#[test]
fn numbers_at_the_ends_are_refused_or_survived_among_huge_and_tiny_places() {
    check_all_in(POSES[3]);
}

#[test]
fn what_is_too_large_is_refused_where_it_stands() {
    let mut talking = Talking::after(POSES[0]);
    for (statement, place) in [
        ("length B C = 1e100", "1e100"),
        ("point E = (1e61, 0)", "(1e61, 0)"),
        ("move B to A - (0, 1e70)", "A - (0, 1e70)"),
        ("hinge B on A C at 10^99", "10^99"),
        ("hold 1e99 * C.x = 1", "1e99 * C.x"),
    ] {
        let problem = talking.execute(statement).expect_err(statement);
        assert_eq!(&*problem.message, "this is too large to work with", "{statement}");
        let span = problem.place().expect("a place");
        assert_eq!(talking.session.sources().slice(span).trim_end(), place);
    }
    talking.run("growing: length B C = 1e59 * (1 + 1e4 * time)");
    let problem = talking.execute("step").expect_err("it grows too large");
    assert_eq!(&*problem.message, "a value in `growing` is too large to work with");
}
