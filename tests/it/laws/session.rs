//! The laws of a session: a command is whole or nothing, `undo` and `redo` are exact, and what
//! is saved goes on to the same bits.

use super::random_session::{SCENE, statements};
use crate::support::compare::check_same;
use crate::support::draws::draws;
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

/// Names are for people: a world whose things are called otherwise goes on to the same bits, and is the same
/// once they are called again as they were.
fn names_do_not_matter(statements: &[String]) {
    let mut plain = Talking::after(SCENE);
    for statement in statements {
        tries(&mut plain, statement);
    }
    let mut renamed = Talking::after(SCENE);
    statements.iter().for_each(|statement| _ = renamed.execute(statement));
    let names: Vec<String> =
        plain.world().names().iter().map(|(name, _)| name.to_owned()).collect();
    for (k, name) in names.iter().enumerate() {
        renamed.run(&format!("rename {name} to other[{k}]"));
    }
    let script = renamed.script();
    check_same(&Talking::after(&script).script(), &script, "loaded with other names");
    for statement in ["step 3", "solve", "relax 2", "reset", "step"] {
        let is_done = plain.execute(statement).is_ok();
        assert_eq!(renamed.execute(statement).is_ok(), is_done, "`{statement}` knows names");
    }
    for (k, name) in names.iter().enumerate() {
        renamed.run(&format!("rename other[{k}] to {name}"));
    }
    check_same(&renamed.script(), &plain.script(), "with the same names again");
}

/// Statements that all fail, some of them after they let time pass or moved points.
fn failing() -> impl Strategy<Value = String> {
    prop::sample::select(vec![
        "for i in 1..3 { step; print nowhere }",
        "for i in 1..2 { step 3; move B to (i, 2); step; length B nowhere }",
        "for i in 1..2 { reset; step; trace B; step; print nowhere }",
        "for i in 1..2 { solve; relax 3; drag C to (3, 2); print nowhere }",
        "for i in 1..2 { pull C to (3, 2) over 2; off coupler; step; print nowhere }",
        "for i in 1..2 { set tolerance 1e-6; set method newton; step; print nowhere }",
        "for i in 1..2 { point N[i] = (i, 9); length N[i] B; step; delete N[i] cascade; print nowhere }",
        "for i in 1..2 { drag F to (6, 2); freeze B; step; thaw B; step; let r = 3.4; print nowhere }",
        "for i in 1..2 { expose; clear; print nowhere }",
        "print nowhere",
    ])
    .prop_map(str::to_owned)
}

/// What leads nowhere leaves nothing: with statements that fail, and with commands that are taken
/// back and done again at once, a session goes the same way to the bit.
fn leaves_no_trace(statements: &[String], failing: &[String]) {
    let mut plain = Talking::after(SCENE);
    let mut busy = Talking::after(SCENE);
    for (k, statement) in statements.iter().enumerate() {
        let wrong = &failing[k % failing.len()];
        assert!(busy.execute(wrong).is_err(), "`{wrong}` is wrong");
        let before = busy.script();
        let is_done = plain.execute(statement).is_ok();
        assert_eq!(busy.execute(statement).is_ok(), is_done, "`{statement}` after `{wrong}`");
        let changed = busy.script() != before;
        check_same(&busy.script(), &plain.script(), &format!("`{statement}` after `{wrong}`"));
        if changed {
            for command in ["undo", "redo", "undo 2", "redo 2"] {
                // Where there is but one command, one is taken back.
                assert!(busy.execute(command).is_ok(), "`{command}` after `{statement}`");
            }
            check_same(&busy.script(), &plain.script(), &format!("`{statement}` done again"));
        }
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
    #![proptest_config(ProptestConfig { max_shrink_iters: 2_000, ..draws(24) })]

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
    fn a_world_goes_the_same_way_whatever_its_things_are_called(statements in statements(12)) {
        names_do_not_matter(&statements);
    }

    #[test]
    fn what_fails_and_what_is_undone_and_redone_leaves_no_trace(
        statements in statements(12),
        failing in prop::collection::vec(failing(), 1..6),
    ) {
        leaves_no_trace(&statements, &failing);
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
