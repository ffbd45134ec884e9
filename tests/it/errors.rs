//! Each kind of error is what its explanation says: the example goes wrong so, put right it runs.

use std::collections::BTreeSet;

use linkwork::errors::{Kind, all};

use crate::support::sources::sources;
use crate::support::talk::Talking;

#[test]
fn the_wrong_example_goes_wrong_so() {
    for Kind { code, wrong, .. } in all().filter(|kind| !kind.wrong.is_empty()) {
        let mut talking = Talking::default();
        let problem = talking.execute(wrong).expect_err(wrong);
        assert_eq!(problem.code, Some(*code), "{}", talking.drawn(&problem));
        let (_, last) = wrong.rsplit_once('\n').unwrap_or(("", wrong));
        let at = problem.place().expect("it has a place").start as usize;
        assert!(at >= wrong.len() - last.len(), "{code} goes wrong before its last line");
    }
}

#[test]
fn the_example_put_right_runs() {
    for kind in all() {
        Talking::default().run(kind.right);
    }
}

#[test]
fn codes_rise_and_names_are_used() {
    let codes: Vec<_> = all().map(|kind| kind.code).collect();
    assert!(codes.is_sorted_by(|a, b| a < b), "{codes:?}");
    let (tables, others): (Vec<_>, Vec<_>) =
        sources().into_iter().partition(|source| source.path.starts_with("errors/"));
    let names = tables.iter().flat_map(|source| source.text.lines().filter_map(declared));
    let names: BTreeSet<&str> = names.collect();
    assert_eq!(names.len(), codes.len());
    for name in names {
        let use_of_it = format!("errors::{name}");
        let is_used = others.iter().any(|source| source.text.contains(&use_of_it));
        assert!(is_used, "no error is a {name}");
    }
}

/// The name that a line of a table declares: `101 UNKNOWN_COMMAND {`.
fn declared(line: &str) -> Option<&str> {
    let mut words = line.split_whitespace();
    words.next()?.parse::<u16>().ok()?;
    words.next()
}

#[test]
fn help_explains_a_code() {
    let told = Talking::default().ask("help E0201").join("\n");
    for part in ["E0201: an unknown name.", "so it goes wrong:", "  length A B = 2", "put right:"] {
        assert!(told.contains(part), "{told}");
    }
}
