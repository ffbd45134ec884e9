//! The laws of a session: a command is whole or nothing, `undo` and `redo` are exact, and what
//! is saved goes on to the same bits.

use super::random_session::{SCENE, statements};
use crate::support::compare::check_same;
use crate::support::talk::Talking;
use proptest::prelude::*;

/// Carries out a statement; whether it took effect. One that fails must have none.
fn tries(talking: &mut Talking, statement: &str) -> bool {
    let before = talking.script();
    let is_done = talking.execute(statement).is_ok();
    if !is_done {
        check_same(&talking.script(), &before, &format!("`{statement}` failed"));
    }
    is_done
}

fn undo_and_redo(statements: &[String]) {
    let mut talking = Talking::after(SCENE);
    let mut worlds = vec![talking.script()];
    for statement in statements {
        tries(&mut talking, statement);
        let world = talking.script();
        if worlds.last() != Some(&world) {
            worlds.push(world);
        }
    }
    // Commands that left no mark in the text are steps of their own: walk until it changes.
    let mut walk = |command: &str, wanted: &String| {
        for _ in 0..=statements.len() {
            if talking.script() == *wanted {
                return;
            }
            assert!(talking.execute(command).is_ok(), "`{command}` led nowhere");
        }
        check_same(&talking.script(), wanted, &format!("after `{command}`"));
    };
    worlds.iter().rev().for_each(|world| walk("undo", world));
    worlds.iter().for_each(|world| walk("redo", world));
}

/// Whether the clock has left 0.
fn has_begun(talking: &Talking) -> bool {
    talking.world().clock().frame > 0
}

/// Taken back to before the first frame, a session is as one in which none has passed, and goes
/// on as it went.
fn undone_to_the_start(statements: &[String]) {
    let mut talking = Talking::after(SCENE);
    let mut n_before = 0;
    while n_before < statements.len() && !has_begun(&talking) {
        talking.execute(&statements[n_before]).ok();
        n_before += 1;
    }
    if !has_begun(&talking) {
        return;
    }
    let (before, after) = statements.split_at(n_before - 1);
    let mut replay = Talking::after(SCENE);
    before.iter().for_each(|statement| _ = replay.execute(statement));
    after[1..].iter().for_each(|statement| _ = talking.execute(statement));
    let end = talking.script();
    let start = replay.script();
    for _ in after {
        if talking.script() != start {
            assert!(talking.execute("undo").is_ok(), "there was more to take back");
        }
    }
    check_same(&talking.script(), &start, "undone to the start");
    for statement in after {
        let is_done = tries(&mut replay, statement);
        assert_eq!(tries(&mut talking, statement), is_done, "`{statement}` knows what was undone");
        check_same(&talking.script(), &replay.script(), &format!("again after `{statement}`"));
    }
    check_same(&talking.script(), &end, "the same again");
}

fn saved_goes_on(before: &[String], after: &[String]) {
    let mut talking = Talking::after(SCENE);
    for statement in before {
        tries(&mut talking, statement);
    }
    let script = talking.script();
    let mut other = Talking::after(&script);
    check_same(&other.script(), &script, "a loaded world saves otherwise");
    for statement in after {
        let is_done = tries(&mut talking, statement);
        assert_eq!(tries(&mut other, statement), is_done, "`{statement}` knows what was loaded");
        check_same(&other.script(), &talking.script(), &format!("after `{statement}`"));
    }
}

/// As many cases as a test run has time for; `PROPTEST_CASES` asks for more.
fn config() -> ProptestConfig {
    let cases = std::env::var("PROPTEST_CASES").ok().and_then(|n| n.parse().ok()).unwrap_or(24);
    let failure_persistence = None;
    ProptestConfig {
        cases,
        failure_persistence,
        max_shrink_iters: 2_000,
        ..ProptestConfig::default()
    }
}

#[test]
fn what_was_at_rest_when_it_was_saved_is_not_solved_again() {
    let mut talking = Talking::after(
        "point A = (0.8, -1.77), B = (0.35, -2.2) frozen, C = (-1.94, 2.21) frozen
         point D = (-0.49, -0.97)
         hinge A on B C at 0.3
         length D A = 1.21
         length D B = 1.3
         length D C = 9
         step 2",
    );
    let mut other = Talking::after(&talking.script());
    for statement in ["solve", "step"] {
        talking.run(statement);
        other.run(statement);
        check_same(&other.script(), &talking.script(), &format!("after `{statement}`"));
    }
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn undo_takes_back_and_redo_brings_back_to_the_bit(statements in statements(16)) {
        undo_and_redo(&statements);
    }

    #[test]
    fn undone_to_before_the_first_frame_it_goes_the_same_way_again(statements in statements(16)) {
        undone_to_the_start(&statements);
    }

    #[test]
    fn what_is_saved_goes_on_to_the_same_bits(before in statements(12), after in statements(6)) {
        saved_goes_on(&before, &after);
    }

    #[test]
    fn looking_changes_nothing(statements in statements(10)) {
        let mut talking = Talking::after(SCENE);
        let mut looked_at = Talking::after(SCENE);
        for statement in &statements {
            let is_done = talking.execute(statement).is_ok();
            assert_eq!(tries(&mut looked_at, statement), is_done);
            looked_at.type_in("list; show B; print velocity(B), time; set; check; assert B = A");
        }
        check_same(&looked_at.script(), &talking.script(), "looked at");
    }
}
