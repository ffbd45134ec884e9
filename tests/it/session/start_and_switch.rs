//! `reset`, and switching off and on again, of what turns and rolls.

use crate::support::talk::Talking;

#[test]
fn reset_turns_back_a_motor_that_was_made_while_the_clock_ran() {
    let mut talking = Talking::after(
        "point O = (0, 0) frozen, P = (1, 0), Q = (5, 0) frozen, R = (6, 0)
         motor O P speed 1rev
         set dt 1/8
         step 2
         late: motor Q R radius 1 speed 1rev phase 0
         step 2
         assert R = (5, 1) within 1e-12",
    );
    talking.run("reset; solve; assert R = (6, 0) within 1e-12; assert P = (1, 0) within 1e-12");
    talking.run("step; assert R = (5, 0) + polar(1, 45deg) within 1e-12");
    talking.run("step 3; assert R = (4, 0) within 1e-12; assert P = (-1, 0) within 1e-12");
}

#[test]
fn reset_turns_back_a_motor_that_was_deleted_and_brought_back_while_the_clock_ran() {
    let mut talking = Talking::after(
        "point O = (0, 0) frozen, P = (1, 0)
         m: motor O P radius 1 speed 1rev
         set dt 1/8
         step 2
         delete m; step; undo 2
         step
         assert P = polar(1, 135deg) within 1e-12
         reset; solve
         assert P = (1, 0) within 1e-12",
    );
    talking.run("step; assert P = polar(1, 45deg) within 1e-12");
}

/// A wheel of radius 1 on the x axis, its rim point on the right of its centre.
const RACK: &str = "
    point P = (0, 0) frozen, Q = (100, 0) frozen, O = (1, 1), A = (2, 1)
    distance O to P Q = 1
    length O A = 1
    r: rack O A on P Q
";

#[test]
fn a_rack_that_is_switched_on_again_stays_where_it_is() {
    // Slides half a turn's length along without turning, then rolls a quarter of a turn.
    let mut talking = Talking::after(RACK);
    talking.run("off r; move O to (1 + pi, 1); move A to (2 + pi, 1)");
    talking.run("on r; step 2; solve");
    talking.run("assert O = (1 + pi, 1) within 1e-12; assert A = (2 + pi, 1) within 1e-12");
    talking.run("drag O to (1 + 1.5 * pi, 1) over 30");
    talking.run("assert A = (1 + 1.5 * pi, 0) within 1e-9");
}

#[test]
fn a_rack_that_was_off_for_frames_goes_on_from_its_pose() {
    let mut talking = Talking::after(RACK);
    talking.run("drag O to (1 + pi / 2, 1) over 20; assert A = (1 + pi / 2, 0) within 1e-9");
    // Turned back in place by the hand.
    talking.run("off r; freeze O; drag A to O + (1, 0) over 20; thaw O; on r; step 3");
    talking.run("assert O = (1 + pi / 2, 1) within 1e-9; assert A = O + (1, 0) within 1e-9");
    talking.run("drag O to (1, 1) over 20; assert A = (1, 2) within 1e-9");
}

#[test]
fn wheels_that_are_switched_on_again_stay_where_they_are() {
    for wheels in ["cog O A, C B ratio 2", "cog O A, C B ratio 2 inside"] {
        let mut talking = Talking::after(&format!(
            "point O = (0, 0) frozen, A = (1, 0), C = (3, 0) frozen, B = (1, 0)
             length C B = 2
             w: {wheels}
             step
             off w; drag A to (0, 1) over 9
             on w; step 3; solve
             assert A = (0, 1) within 1e-12; assert B = (1, 0) within 1e-12"
        ));
        // A quarter of a turn of the first is an eighth of the second.
        talking.run("drag A to (-1, 0) over 30");
        let sign = if wheels.ends_with("inside") { "" } else { "-" };
        talking.run(&format!("assert B = C + polar(2, 180deg + {sign}45deg) within 1e-9"));
    }
}

#[test]
fn wheels_that_are_made_while_the_clock_runs_mesh_at_the_start_as_the_points_stand_there() {
    const WHEELS: &str = "point O = (0, 0) frozen, G = (1, 0), Q = (3, 0) frozen, H = (2, 0)
         point P = (0, -1) frozen, R = (9, -1) frozen, S = (0, 0), T = (1, 0)
         distance S to P R = 1; length S T = 1; length Q H = 1
         motor O G speed 90deg
         coordinate S at (time, 0)";
    const MESH: &str = "cog O G, Q H ratio 2; rack S T on P R";
    for ratio in ["2", "2 + time"] {
        let mesh = MESH.replace("ratio 2", &format!("ratio {ratio}"));
        let mut late = Talking::after(WHEELS);
        late.run("step 50");
        late.run(&mesh);
        late.run("step 7; reset");
        for name in ["cog1", "rack1"] {
            let residual = late.session.residual(name).unwrap();
            assert!(residual.abs() < 1e-15, "{name}: {residual}");
        }
        let mut early = Talking::after(WHEELS);
        early.run(&mesh);
        let mut saved = Talking::after(&late.script());
        for talking in [&mut late, &mut early, &mut saved] {
            talking.run("step 30");
            assert_eq!(talking.session.last_run().unwrap().n_missed, 0);
        }
        for point in ["H", "T"] {
            let places = [&late, &early, &saved].map(|it| it.session.position(point).unwrap());
            assert!(places[0].distance(places[1]) < 1e-11, "{ratio}: {point} {places:?}");
            assert_eq!(places[0], places[2]);
        }
    }
}

#[test]
fn wheels_that_are_made_while_the_clock_runs_are_undone_with_what_reset_knows_of_them() {
    let mut talking = Talking::after(
        "point O = (0, 0) frozen, G = (1, 0), Q = (3, 0) frozen, H = (2, 0)
         motor O G speed 90deg; step 20; cog O G, Q H ratio 2; step 20",
    );
    let before = talking.script();
    talking.run("reset; undo");
    assert_eq!(talking.script(), before);
    talking.run("undo 2; redo 2");
    assert_eq!(talking.script(), before);
    talking.run("for i in 1..2 { step; cog O G, Q H ratio 2; step }; undo");
    assert_eq!(talking.script(), before);
    talking.run("point P = (0, -1), R = (9, -1); rack O G on P R; step");
    let before = talking.script();
    talking.run("change rack1 on R P; undo");
    assert_eq!(talking.script(), before);
}
