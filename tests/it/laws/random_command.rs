//! Any statement that a user may type on the scene of random sessions or on random points: those of
//! both generators, questions, blocks, and now and then a number at the ends of what numbers hold.

use super::{random_scene, random_session};
use crate::support::talk::is_read;
use proptest::prelude::*;

/// Numbers whose squares, sums or neighbours are not what they look like.
const EDGES: [&str; 14] = [
    "1e308",
    "-1e200",
    "1e154",
    "1e60",
    "1e30",
    "1e16",
    "9007199254740993",
    "0",
    "-0",
    "1e-9",
    "1e-154",
    "-1e-200",
    "5e-324",
    "(1 / 3)",
];

/// What is asked, and what has an end of its own.
const OTHERS: [&str; 46] = [
    "check",
    "effects",
    "list",
    "set",
    "freeze all",
    "thaw all",
    "solve",
    "step",
    "relax 3",
    "reset",
    "why coupler",
    "why c1",
    "why c2",
    "limits crank",
    "limits c0",
    "limits r",
    "limits act",
    "show B",
    "show coupler",
    "show c3",
    "print velocity(B), acceleration(C), crank.angle",
    "print c1.value, c2.residual, p1",
    "assert distance(B, C) = r within 1e-3",
    "svg \"a.svg\"",
    "for i in 1..1 { trace B; step 2; svg \"b.svg\"; untrace all }",
    "record \"c.csv\"",
    "record stop",
    "record \"d.svg\"",
    "list measures",
    "trace B as \"b\"",
    "untrace \"b\"",
    "record \"e.csv\" of time, d1.max, B - C, velocity(B).x in rev every 2",
    "plot d1, d2 against time log",
    "fit r in 2..4 to minimise B.x over 2",
    "d1",
    "result a = d1.max, \"b c\" = C in deg",
    "print d1.mean, d2.count, d2.at_min",
    "set measures sampled",
    "sample \"s\" = B.x",
    "plot \"p.svg\"",
    "accuracy",
    "undo",
    "undo 3",
    "redo",
    "for i in 1e16..1e16+4 {}",
    "for i in 1..20 { let q = i; move B to (q, 1 / i) }",
];

/// Where the numbers of a statement stand.
fn numbers(statement: &str) -> Vec<std::ops::Range<usize>> {
    let bytes = statement.as_bytes();
    let is_word = |b: u8| b.is_ascii_alphanumeric() || b == b'_' || b == b'.' || b == b'"';
    let mut found = Vec::new();
    let mut k = 0;
    while k < bytes.len() {
        let start = k;
        while k < bytes.len() && is_word(bytes[k]) {
            k += 1;
        }
        if bytes[start].is_ascii_digit() && statement[start..k].parse::<f64>().is_ok() {
            found.push(start..k);
        }
        k = k.max(start + 1);
    }
    found
}

/// A statement with one of its numbers replaced.
fn with_edge(statement: String, which: usize, edge: &str) -> String {
    let numbers = numbers(&statement);
    if numbers.is_empty() {
        return statement;
    }
    let place = numbers[which % numbers.len()].clone();
    format!("{}{edge}{}", &statement[..place.start], &statement[place.end..])
}

/// Any statement.
pub fn command() -> impl Strategy<Value = String> {
    let any = prop_oneof![
        6 => random_session::statement(),
        6 => random_scene::edit(),
        2 => prop::sample::select(OTHERS.to_vec()).prop_map(str::to_owned),
    ];
    let edge = prop::option::weighted(0.2, (0..4_usize, prop::sample::select(EDGES.to_vec())));
    (any, edge).prop_map(|(statement, edge)| match edge {
        Some((which, edge)) => with_edge(statement, which, edge),
        None => statement,
    })
}

/// What there is to begin with: the scene of random sessions, or random points.
pub fn beginning() -> impl Strategy<Value = Vec<String>> {
    prop_oneof![
        1 => Just(vec![random_session::SCENE.to_owned()]),
        3 => random_scene::scene(),
    ]
}

/// A beginning, and fewer than `most` statements after it.
pub fn session(most: usize) -> impl Strategy<Value = (Vec<String>, Vec<String>)> {
    (beginning(), prop::collection::vec(command(), 1..most))
}

#[test]
fn what_is_asked_is_a_statement() {
    for statement in OTHERS {
        assert!(is_read(statement), "{statement}");
    }
}

#[test]
fn a_number_is_replaced_where_it_stands() {
    assert_eq!(with_edge("length p1 p2 = 3.5".to_owned(), 0, "1e200"), "length p1 p2 = 1e200");
    assert_eq!(with_edge("move B to (1, -2)".to_owned(), 1, "0"), "move B to (1, -0)");
    assert_eq!(with_edge("motor A B speed 1rev".to_owned(), 2, "0"), "motor A B speed 1rev");
}
