//! Values that are measured on the pose: what they are measured on may begin to move, or stop.

use crate::support::talk::Talking;

/// A rod as long as a frozen point is high, three more. The point belongs a tenth higher.
const MEASURED: &str = "
    point A = (0, 0) frozen, B = (4, 0), F = (0, 1) frozen
    length A B = 3 + F.y
    coordinate F at (0, 1.1)
";

#[test]
fn a_measured_point_that_is_thawed_takes_its_value_along() {
    for run in ["step", "solve", "drag B to (5, 0) over 3; step", "run 1"] {
        let mut talking = Talking::after(MEASURED);
        talking.run(&format!("solve; thaw F; {run}"));
        talking.run("assert F.y = 1.1 within 1e-9; assert distance(A, B) = 4.1 within 1e-9");
    }
}

#[test]
fn one_that_is_thawed_by_undo_does_so_too() {
    let mut talking = Talking::after(MEASURED);
    talking.run("thaw F; move F to (0, 1); step; freeze F; move F to (0, 2); step");
    talking.run("assert distance(A, B) = 5 within 1e-9");
    talking.run("undo 3; step; assert F.y = 1.1 within 1e-9");
    talking.run("assert distance(A, B) = 4.1 within 1e-9");
}

#[test]
fn one_that_is_thawed_takes_along_what_mentions_it_through_parameters() {
    let mut talking = Talking::after(
        "point A = (0, 0) frozen, B = (4, 0), F = (0, 1) frozen
         let height = F.y, reach = 3 + height
         length A B = reach
         coordinate F at (0, 1.1)
         solve; thaw F; step",
    );
    talking.run("assert F.y = 1.1 within 1e-9; assert distance(A, B) = 4.1 within 1e-9");
    assert_eq!(talking.ask("print round(1e9 * reach) / 1e9"), ["4.1"]);
}

#[test]
fn one_that_is_frozen_keeps_its_place_and_its_value() {
    let mut talking = Talking::after(MEASURED);
    talking.run("thaw F; step; assert distance(A, B) = 4.1 within 1e-9");
    talking.run("move F to (0, 2); freeze F; step 2; assert F = (0, 2)");
    talking.run("assert distance(A, B) = 5 within 1e-9");
}

#[test]
fn a_rod_that_feeds_on_the_height_of_its_own_end_settles() {
    // y = 3 + y / 2 where the rod stands upright.
    for run in ["step", "solve"] {
        let mut talking = Talking::after(
            "point A = (0, 0) frozen, B = (0, 4), C = (0, 9) frozen
             glider B on A C
             length A B = 3 + B.y / 2",
        );
        talking.run(&format!("{run}; assert B = (0, 6) within 1e-9"));
    }
}

#[test]
fn an_equation_between_vectors_is_held_and_changed() {
    let mut talking = Talking::after(
        "point A = (0, 0) frozen, B = (4, 0), P = (1, 1)
         m: hold P = midpoint(A, B)
         hold B = (4, 2)
         solve",
    );
    talking.run("assert P = (2, 1) within 1e-12; change m = A + (1, B.y); solve");
    talking.run("assert P = (1, 2) within 1e-12; off m; move P to (5, 5); solve");
    talking.run("assert P = (5, 5) within 1e-12; on m; solve; assert P = (1, 2) within 1e-12");
    assert_eq!(talking.ask("list constraints")[0], "m: hold P = A + (1, B.y)  # residual 0");
}

#[test]
fn linear_equations_are_met_at_once_however_far() {
    let mut talking = Talking::after(
        "point A = (0, 0), B = (1, 0), C = (2, 0)
         hold A.x + B.x = 1e6; hold A.x - B.x = 2; hold B + C = (7, 1e5); hold C.y = 3",
    );
    talking.execute("solve").expect("it is solved");
    let told = talking.talk.told().concat();
    assert!(told.contains("after 2 iterations"), "{told}");
    talking.run("assert B.x = 499999 within 1e-9; assert C.x = -499992 within 1e-9");
}

#[test]
fn a_velocity_goes_through_what_is_measured() {
    // A rope over two pulleys: B rises half as fast as A goes down, and is slower the more the
    // faster A is.
    let mut talking = Talking::after(
        "point U = (0, 0) frozen, V = (6, 0) frozen, A = (0, -3), B = (6, -3)
         rope: hold distance(U, A) + 2 * distance(V, B) = 9
         hold A = (0, -3 - time^2); hold B.x = 6
         set dt 1/10; step 5",
    );
    talking
        .run("assert velocity(A) = (0, -1) within 1e-9; assert velocity(B) = (0, 0.5) within 1e-9");
    talking.run("assert acceleration(B) = (0, 1) within 1e-9");
}

#[test]
fn a_value_that_is_out_of_range_on_the_way_is_no_mistake() {
    // The root has no value beyond x = 4, where a long first step leads.
    let mut talking = Talking::after(
        "point O = (0, 0) frozen, P = (3.9, 0)
         hold sqrt(4 - P.x) = 1; hold P.y = 0; solve",
    );
    talking.run("assert P = (3, 0) within 1e-9");
    let told = talking.execute("move P to (9, 0); solve").expect_err("a root of -5");
    assert!(told.to_string().contains("`sqrt` has no value at -5"), "{told}");
}

#[test]
fn what_measures_no_point_cannot_be_held() {
    for statement in ["hold 3 = 3", "hold time = 4", "hold velocity(P).x = 1", "hold P < (1, 2)"] {
        let mut talking = Talking::after("point P = (3, 0)");
        assert!(talking.execute(statement).is_err(), "{statement}");
    }
}

#[test]
fn a_count_of_turns_is_held_beyond_half_a_turn() {
    // A wheel that may turn by a turn and a half, and is pushed on by another that turns two.
    let mut talking = Talking::after(
        "point O = (0, 0) frozen, A = (1, 0), Q = (3, 0) frozen, B = (4, 0)
         length O A = 1
         motor Q B radius 1 speed 1rev
         stop: hold turn(O, A) <= 1.5rev
         follow: hold turn(O, A) = turn(Q, B) / 2
         set dt 1/36; step 36",
    );
    talking.run("assert turn(O, A) = 0.5rev within 1e-9; assert A = (-1, 0) within 1e-9");
    talking.run("step 36; assert turn(O, A) = 1rev within 1e-9; assert A = (1, 0) within 1e-9");
}

#[test]
fn what_a_constraint_measures_is_a_measure_like_others() {
    // A rod, another twice as long, and a third that is as long as what is held.
    let mut talking = Talking::after(
        "point O = (0, 0) frozen, A = (1, 0), B = (4, 0), C = (0, 3)
         a: length O A in 1..3
         b: length A B = 2 * a.value
         sum: hold distance(O, A) + distance(A, B) = 6
         length O C = sum.value
         hold A.y = 0; hold B.y = 0
         solve",
    );
    talking.run("assert A = (2, 0) within 1e-9; assert B = (6, 0) within 1e-9");
    talking.run("assert distance(O, C) = 6 within 1e-9; change sum = 9; solve");
    talking.run("assert A = (3, 0) within 1e-9; assert distance(O, C) = 9 within 1e-9");
}

#[test]
fn an_equation_that_holds_whatever_the_pose_is_named_redundant() {
    let mut talking = Talking::after(
        "point A = (0, 0) frozen, B = (4, 0), C = (1, 1)
         h: hold B.x - B.x = 0
         same: hold distance(B, C) = distance(C, B)
         hold B.x + C.x = 5",
    );
    let told = talking.ask("check");
    assert_eq!(
        told[..3],
        [
            "degrees of freedom: 3",
            "redundant: h, which holds whatever the pose",
            "redundant: same, which holds whatever the pose"
        ]
    );
}

#[test]
fn no_number_is_said_of_what_has_no_value() {
    let mut talking = Talking::after("point B = (4, 0)\nh: hold sqrt(B.x) = 2\nmove B to (-3, 0)");
    let told = [talking.ask("check"), talking.ask("show h"), talking.ask("why h")].concat();
    assert!(!told.concat().contains("inf"), "{told:?}");
}

#[test]
fn an_equation_over_five_points_that_move_is_followed() {
    let mut talking = Talking::after(
        "point O = (0, 0) frozen
         point A = (2, 0), B = (2, 0), C = (2, 0), D = (2, 0), E = (2, 0)
         hold A.y = 0; hold B.y = 0; hold C.y = 0; hold D.y = 0; hold E.y = 0
         hold A.x * B.x + B.x * C.x + C.x * D.x + D.x * E.x + E.x * A.x = 5 * (2 + time) ^ 2
         hold A.x ^ 2 + B.x ^ 2 = 2 * C.x ^ 2; hold B.x ^ 2 + C.x ^ 2 = 2 * D.x ^ 2
         hold C.x ^ 2 + D.x ^ 2 = 2 * E.x ^ 2; hold D.x ^ 2 + E.x ^ 2 = 2 * A.x ^ 2
         set dt 1/4; step 8",
    );
    // All squares are equal, and five times each is what is asked for.
    for point in ["A", "B", "C", "D", "E"] {
        talking.run(&format!("assert {point} = (4, 0) within 1e-9"));
    }
}
