//! Points that are moved by hand: `drag` takes them along its path, `pull` as near as they can go.

use crate::support::talk::Talking;

/// Two bars, held at O, that reach 3.
const ARM: &str = "
    point O = (0, 0) frozen, B = (1, 1), A = (2, 0)
    upper: length O B = 1.5; lower: length B A = 1.5
    set dt 1/20
";

/// A crank of radius 1 drives a four-bar linkage.
const FOUR_BAR: &str = "
    point A = (0, 0) frozen, D = (4, 0) frozen, B = (1, 0), C = (3, 3)
    crank: length A B = 1; length B C = 3.5; length C D = 3
    set dt 1/50
    solve
";

#[test]
fn a_pulled_point_goes_where_it_can() {
    let mut talking = Talking::after(ARM);
    talking.run("pull A to (2, 1) over 10; assert A = (2, 1) within 1e-11; assert time = 0.5");
    talking
        .run("assert distance(O, B) = 1.5 within 1e-11; assert distance(A, B) = 1.5 within 1e-11");
    talking.run("pull A to (-1, -1.5) over 1; assert A = (-1, -1.5) within 1e-11");
}

#[test]
fn at_the_end_of_its_reach_a_pulled_point_stands_still_without_a_word() {
    let mut talking = Talking::after(ARM);
    talking.run("step");
    let said = talking.type_in("pull A to (8, 6) over 40; step 10");
    assert!(!said.contains("warning"), "{said}");
    talking.run("assert A = (2.4, 1.8) within 1e-10; assert B = (1.2, 0.9) within 1e-10");
    talking.run("assert upper.residual = 0 within 1e-11; assert lower.residual = 0 within 1e-11");
    // It is let go there, and comes back from there.
    talking.run("pull A to (1, 1); assert A = (1, 1) within 1e-10");
}

#[test]
fn the_nearest_point_of_a_circle_lies_on_the_way_to_its_centre() {
    for (x, y) in [(0.0, 5.0), (-100.0, -100.0), (0.3, 0.4), (-3.0, 0.001), (1e4, -1e4)] {
        let mut talking = Talking::after("point O = (0, 0) frozen, A = (2, 0); length O A = 2");
        talking.run(&format!("pull A to ({x}, {y}); let to = ({x}, {y})"));
        talking.run("assert A = 2 * to / norm(to) within 1e-10");
    }
}

#[test]
fn the_nearest_point_of_an_ellipse_lies_on_its_normal() {
    // A trammel: A runs on the ellipse x = 3 cos t, y = 2 sin t.
    let mut talking = Talking::after(
        "point O = (0, 0) frozen, R = (9, 0) frozen, T = (0, 9) frozen, P = (1, 0), Q = (0, 0.1), A = (2.9, 0.4)
         glider P on O R unbounded; glider Q on O T unbounded; length P Q = 1
         hinge A on Q P at 3; solve",
    );
    for (x, y) in [(5.0, 4.0), (-1.0, 3.0), (-0.7, 0.4), (2.0, -6.0)] {
        talking.run(&format!("pull A to ({x}, {y}) over 30"));
        talking.run(&format!(
            "assert (A.x / 3)^2 + (A.y / 2)^2 = 1 within 1e-10
             assert cross((A.x / 9, A.y / 4), ({x}, {y}) - A) = 0 within 1e-9"
        ));
    }
}

#[test]
fn a_point_of_a_linkage_comes_as_near_as_any_pose_allows() {
    let mut talking = Talking::after(FOUR_BAR);
    talking.run("pull C to (1, 6) over 25");
    let at = "distance(C, (1, 6))";
    let nearest: f64 = talking.ask(&format!("print {at}"))[0].parse().expect("a number");
    // The crank is turned by hand, a little and a lot.
    for by in ["0.001", "-0.001", "0.1", "-0.1", "1", "-1"] {
        talking.run(&format!("drag B to A + rotate(B - A, {by}) over 10"));
        talking.run(&format!("assert {at} > {nearest}; undo"));
    }
    talking.run("assert crank.residual = 0 within 1e-11");
}

#[test]
fn a_cord_gives_way_inwards_and_holds_outwards() {
    let mut talking = Talking::after("point O = (0, 0) frozen, A = (2, 0); cord: length O A <= 3");
    talking.run("pull A to (9, 0) over 10; assert A = (3, 0) within 1e-9");
    talking.run("pull A to (5, 5) over 10; assert A = polar(3, 45deg) within 1e-8");
    talking.run("pull A to (1, 1) over 10; assert A = (1, 1)");
    talking.run("change cord in 1..3; pull A to (-0.1, 0.2) over 10");
    talking
        .run("assert distance(O, A) = 1 within 1e-9; assert cross(A, (-0.1, 0.2)) = 0 within 1e-8");
}

#[test]
fn a_pulled_slider_stops_at_its_end() {
    let mut talking = Talking::after(
        "point L = (0, -2) frozen, R = (4, -2) frozen, P = (1, -2); glider P on L R",
    );
    talking.run("pull P to (3, 5); assert P = (3, -2) within 1e-12");
    talking.run("pull P to (8, 2) over 20; assert P = (4, -2) within 1e-12");
}

#[test]
fn what_is_pulled_stays_where_it_was_let_go() {
    let mut talking = Talking::after(ARM);
    talking.run("pull A to (0, 2) over 5; freeze B; thaw B; step 20; solve");
    talking.run("assert A = (0, 2) within 1e-11");
}

#[test]
fn motors_keep_their_turn_while_something_is_pulled() {
    let mut talking = Talking::after(
        "point O = (0, 0) frozen, P = (1, 0), B = (2, 1), A = (3, 0)
         crank: motor O P radius 1 speed 1rev phase 0; length P B = 1.5; length B A = 1.5
         set dt 1/40; pull A to (2, 2) over 30",
    );
    talking.run("assert P = polar(1, 270deg) within 1e-12; assert A = polar(1, 270deg) + 3 * ((2, 2) - P) / norm((2, 2) - P) within 1e-9");
    talking.run("assert omega(O, P) = 1rev within 1e-12");
}

#[test]
fn a_gear_is_wound_up_by_its_rim() {
    let mut talking = Talking::after(
        "point O = (0, 0) frozen, P = (1, 0), Q = (4, 0) frozen, R = (3, 0)
         length O P = 1; length Q R = 1; mesh: cog O P, Q R ratio 1; let w = turn(Q, R); print turn(O, P)",
    );
    talking.run("for k in 1..10 { pull P through (0, 2), (-2, 0), (0, -2), (2, 0) over 32 }");
    talking.run("assert turn(O, P) = 10rev within 1e-9; assert w = 180deg - 10rev within 1e-9");
    talking.run("assert mesh.residual = 0 within 1e-10");
}

#[test]
fn two_hands_share_what_they_cannot_have() {
    let mut talking = Talking::after("point A = (0, 0), B = (1, 0); length A B = 1");
    talking.run("pull A to (-2, 3), B to (4, 3) over 20");
    talking.run("assert A = (0.5, 3) within 1e-10; assert B = (1.5, 3) within 1e-10");
}

#[test]
fn a_point_that_nothing_holds_comes_along() {
    Talking::default()
        .run("point A = (0, 0); pull A through (1, 1), (2, 0) over 2; assert A = (2, 0)");
}

#[test]
fn a_pull_is_one_step_of_undo() {
    let mut talking = Talking::after(ARM);
    talking.run("step 3");
    let before = talking.script();
    talking.run("pull A through (1, 1), (0, 2) over 12");
    let after = talking.script();
    talking.run("undo");
    assert_eq!(talking.script(), before);
    talking.run("redo");
    assert_eq!(talking.script(), after);
    talking.assert_goes_on_from_its_file("pull A to (1, 1) over 7; step 5");
    talking.run("reset; assert A = (2, 0)");
}

#[test]
fn over_0_the_clock_stands_still() {
    let mut talking = Talking::after(ARM);
    talking.run("step 2; pull A through (2, 1), (0, 2) over 0; assert time = 0.1");
    talking.run("assert A = (0, 2) within 1e-10; undo; redo; assert A = (0, 2) within 1e-10");
    talking.run("drag A through (0, -2), (2, 1) over 0; assert time = 0.1; assert A = (2, 1)");
    talking.run("assert upper.residual = 0 within 1e-10; assert lower.residual = 0 within 1e-10");
    // Held or not, it is as free as before.
    talking.run("pull A to (1, 1) over 0; assert A = (1, 1) within 1e-10; undo 2; assert A = (0, 2) within 1e-10");
    let said = talking.type_in("drag A to (0, 7) over 0");
    assert!(said.contains("upper") && said.contains("contradict"), "{said}");
    talking.run("assert A = (0, 7); assert time = 0.1; undo; assert A = (0, 2) within 1e-10");
}

#[test]
fn a_drag_follows_its_path_by_length() {
    let mut talking = Talking::after("point A = (0, 0) frozen, B = (5, 0); trace A, B");
    talking.run("drag A through (1, 0), (1, 2), (2, 2), B to (6, 0) over 8");
    let places = |trace: usize| -> Vec<(f64, f64)> {
        talking.world().traces()[trace].samples.iter().map(|s| (s.at.x, s.at.y)).collect()
    };
    let corner = [(0.5, 0.0), (1.0, 0.0), (1.0, 0.5), (1.0, 1.0), (1.0, 1.5), (1.0, 2.0)];
    assert_eq!(places(0), [&corner[..], &[(1.5, 2.0), (2.0, 2.0)]].concat());
    assert_eq!(places(1), (1..=8).map(|k| (5.0 + f64::from(k) / 8.0, 0.0)).collect::<Vec<_>>());
    talking.run("reset; assert A = (0, 0); assert B = (5, 0); undo; undo; assert A = (0, 0)");
    // Without a number of frames each piece takes one.
    talking.run("drag A through (1, 0), (1, 2), (2, 2); assert time = 3/60; assert A = (2, 2)");
}

#[test]
fn a_pull_leads_out_of_a_straight_stay() {
    // The stay is straight where the lid is open: its joint has to go aside before the lid moves.
    let mut talking = Talking::after(
        "point H = (0, 0) frozen, F = (1.5, -1) frozen, L = (4, 0), M = (2, 0), K = (2.9, -1.3)
         length H L = 4; hinge M on H L at 1/2; length F K = 1.7; length K M = 1.6; solve",
    );
    talking.run("pull L through (3, 3), (-3, 5) over 40; assert distance(K, F, M) = 0 within 1e-6");
    talking.run("pull L to (4, 1) over 20; assert angle(H, L) = atan2(1, 4) within 1e-9");
    talking.run("pull L to (-4, 3) over 0; assert distance(F, M) = 3.3 within 1e-9");
    talking.run("pull L to (4, 1) over 0; assert angle(H, L) = atan2(1, 4) within 1e-9");
}
