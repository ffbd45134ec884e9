//! A constraint put in the place of another while everything is at rest is seen to.

use crate::support::talk::Talking;

/// What stood still under the one constraint is solved anew under the other.
fn check(script: &str, replacement: &str, truth: &str) {
    let mut talking = Talking::after(script);
    talking.run("step 10");
    talking.run(replacement);
    talking.run(&format!("step within 1e-9\nassert {truth} within 1e-9"));
}

#[test]
fn end_stops_act_where_there_were_none() {
    check(
        "point A = (0, 0) frozen, B = (1, 0) frozen, P = (3, 0); line: glider P on A B unbounded",
        "delete line; glider P on A B",
        "P = B",
    );
}

#[test]
fn an_angle_with_a_sense_turns_what_was_perpendicular() {
    check(
        "point M = (0, 0) frozen, B = (1, 0) frozen, Q = (1, -1); length B Q = 1
         square: perpendicular M B, B Q; turn: orientation M B, B Q = 90deg; off turn",
        "off square; on turn",
        "angle(M, B, B, Q) = 90deg",
    );
}

#[test]
fn wheels_by_velocities_go_on_from_where_they_are_switched_on() {
    let mut talking = Talking::after(
        "set cog velocity; set dt 1/360
         point O = (0, 0) frozen, A = (1, 0), Q = (3, 0) frozen, B = (1, 0)
         motor O A radius 1 speed 1rev; length Q B = 2
         mesh: cog O A, Q B ratio 2; step 10; off mesh; step 90; let before = angle(Q, B)",
    );
    let before = talking.ask("print before");
    talking.run(&format!("on mesh; step; assert angle(Q, B) in {0} - 1deg..{0}", before[0]));
}
