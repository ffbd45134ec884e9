//! Angles with their whole turns, against the motors and wheels that make them.

use crate::support::talk::Talking;

/// A motor from 90 degrees on, ten frames a time unit.
const CRANK: &str = "
    point O = (0, 0) frozen, P = (0, 2), Q = (5, 0) frozen
    crank: motor O P radius 2 speed 3 phase 90deg
    set dt 1/10
";

#[test]
fn a_turn_goes_on_where_an_angle_comes_back() {
    let mut talking = Talking::after(CRANK);
    talking.run("assert turn(O, P) = 90deg within 1e-15; let w = turn(O, P)");
    for k in 1..60 {
        talking.run(&format!("step; assert w = 90deg + {k} * 0.3 within 1e-13"));
    }
    talking.run("assert mod(w - angle(O, P) + 1, 1rev) = 1 within 1e-13; assert w = crank.angle within 1e-13");
    talking.run("change crank speed -3; step 120; assert w = 90deg - 60 * 0.3 - 0.3 within 1e-12");
}

#[test]
fn a_motor_counts_its_turns_however_large_the_step() {
    let mut talking = Talking::after(CRANK);
    talking.run(
        "let w = turn(O, P), v = turn(O, Q, O, P), u = turn(O, P, O, Q)
         change crank speed 27.3rev; step 10
         assert w = 90deg + 27.3rev within 1e-12; assert v = w within 1e-12; assert u = -w within 1e-12
         change crank speed -1000.1rev; step 10; assert w = 90deg - 972.8rev within 1e-11
         assert velocity(P) = 2000.2rev * rotate(P, -90deg) / 2 within 1e-8",
    );
}

#[test]
fn a_count_of_what_a_motor_turns_begins_with_the_turns_of_the_motor() {
    let mut talking = Talking::after(CRANK);
    talking.run("change crank speed 2.25rev; step 10");
    // What is said first is what is said from then on.
    talking.run("assert turn(O, P) = 90deg + 2.25rev within 1e-13");
    talking.run(
        "assert turn(O, P) = 90deg + 2.25rev within 1e-13; assert turn(P, O) = 0 within 1e-13",
    );
    talking.run("assert turn(O, Q, O, P) = 90deg + 2.25rev within 1e-13; reset");
    talking.run("assert turn(O, P) = 90deg within 1e-15; assert turn(P, O) = -90deg within 1e-15");
}

#[test]
fn a_wheel_in_mesh_turns_by_the_ratio() {
    let mut talking = Talking::after(
        "point O = (0, 0) frozen, P = (1, 0), Q = (4, 0) frozen, R = (1, 0)
         crank: motor O P radius 1 speed 1rev phase 0; cog O P, Q R ratio 3
         let w = turn(Q, R), r = turn(O, P, Q, R); set dt 1/36",
    );
    talking.run("assert w = 180deg; step 360; assert w = 180deg - 10/3 * 1rev within 1e-11");
    talking.run("assert r = 180deg - 40/3 * 1rev within 1e-11");
}

#[test]
fn a_hand_winds_up_and_down() {
    let mut talking = Talking::after(
        "point O = (0, 0) frozen, A = (1, 0), B = (2, 0) frozen; let w = turn(O, A)",
    );
    let round = "drag A to (0, 1) over 4; drag A to (-1, 0) over 4; drag A to (0, -1) over 4; drag A to (1, 0) over 4";
    talking.run(&format!("{round}; assert w = 1rev; {round}; assert w = 2rev"));
    talking.run("undo; assert w = 630deg within 1e-14; redo; assert w = 2rev");
    // At once, the short way.
    talking.run("move A to (-1, 0.1); assert w = 2rev + atan2(0.1, -1) within 1e-14");
    talking.run("step; move A to (-1, -0.1); assert w = 3rev + atan2(-0.1, -1) within 1e-14");
}

#[test]
fn a_motor_that_was_off_goes_on_from_what_was_counted() {
    let mut talking = Talking::after(CRANK);
    talking.run("let w = turn(O, P); change crank speed 1rev; step 10; off crank");
    for place in ["(-2, 0)", "(0, -2)", "(2, 0)", "(0, 2)", "(-2, 0)"] {
        talking.run(&format!("drag P to {place} over 3"));
    }
    talking.run("assert w = 2.5rev within 1e-13; on crank; step 10");
    talking.run("assert w = 3.5rev within 1e-13; change crank speed 7.5rev; step 10");
    talking.run("assert w = 11rev within 1e-12");
}

#[test]
fn counts_come_back_with_what_they_count() {
    let mut talking = Talking::after(CRANK);
    talking.run(
        "point A = (1, 1); motor O A radius 1.5 speed 2.5rev phase 0; step 10; print turn(O, A)",
    );
    talking.run("step 10; assert turn(O, A) = 5rev within 1e-12");
    let before = talking.script();
    talking.run("delete A cascade; undo");
    assert_eq!(talking.script(), before);
    talking.run("assert turn(O, A) = 5rev within 1e-12; delete A cascade; point A = (0, 3)");
    talking.run("assert turn(O, A) = 90deg");
}

#[test]
fn reset_undo_and_files_keep_counts() {
    let mut talking = Talking::after(CRANK);
    talking.run("change crank speed 3.7rev; let w = turn(O, P); step 10");
    talking.run("print turn(Q, P), turn(P, Q, P, O); step 7");
    let wanted = talking.ask("print w, turn(Q, P), turn(P, Q, P, O), turn(O, P)");
    talking.assert_goes_on_from_its_file("step 13; reset; step 5");
    talking.run("undo 3");
    assert_eq!(talking.ask("print w, turn(Q, P), turn(P, Q, P, O), turn(O, P)"), wanted);
    talking.run("reset; assert w = 90deg within 1e-14");
    talking.run(
        "undo; redo; assert w = 90deg within 1e-14; step; assert w = 90deg + 0.37rev within 1e-13",
    );
}

#[test]
fn looking_at_a_value_from_outside_counts_nothing() {
    let mut talking = Talking::after(CRANK);
    let before = talking.script();
    let value = talking.session.evaluate("turn(O, P)").expect("a value");
    assert!(format!("{value:?}").contains("1.57079632679"), "{value:?}");
    assert_eq!(talking.script(), before);
}

#[test]
fn a_rope_winds_onto_a_drum() {
    // Each turn of the drum takes up a circumference of rope.
    let mut talking = Talking::after(
        "point O = (0, 0) frozen, P = (1, 0), T = (9, 0) frozen, W = (9, -30), V = (9, -60) frozen
         crank: motor O P radius 1 speed 1rev phase 0; rope: length T W = 30 - 0.5 * turn(O, P)
         glider W on T V; set dt 1/24; step 96",
    );
    talking.run("assert W = (9, -30 + 4 * pi) within 1e-9; step 24; assert W = (9, -30 + 5 * pi) within 1e-9");
    talking.run("assert velocity(W).y = pi within 1e-6");
}
