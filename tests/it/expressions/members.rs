//! Members of things: the angle of a motor, what a constraint measures, by how much it is missed.

use crate::support::talk::Talking;

const CRANK: &str = "
    point O = (0, 0) frozen, P = (0, 2), Q = (5, 0)
    crank: motor O P radius 2 speed 3 phase 90deg
    set dt 1/10
";

#[test]
fn the_angle_of_a_motor_has_its_phase_and_goes_on_past_a_turn() {
    let mut talking = Talking::after(CRANK);
    talking.run("assert crank.angle = 90deg");
    talking.run("step 50; assert crank.angle = 90deg + 15 within 1e-13");
    talking.run("change crank speed -3; step 100; assert crank.angle = 90deg - 15 within 1e-13");
    talking.run(
        "reset; assert crank.angle = 90deg; undo; assert crank.angle = 90deg - 15 within 1e-13",
    );
}

#[test]
fn a_value_follows_the_angle_of_the_same_frame() {
    let mut talking = Talking::after(CRANK);
    talking.run(
        "point S = (1, 0); let lead = 2 / 1rev * crank.angle
         coordinate S at (lead, 0); step 7
         assert S.x = 2 / 1rev * (90deg + 2.1) within 1e-14
         assert velocity(S) = (6 / 1rev, 0) within 1e-14; assert acceleration(S) = (0, 0) within 1e-14",
    );
}

#[test]
fn an_angle_has_the_derivatives_of_its_motor() {
    // Angle t^3, so that its square has the derivatives 6 t^5 and 30 t^4.
    let mut talking = Talking::after(
        "point O = (0, 0) frozen, P = (1, 0), S = (1, 0)
         let w = 3 * time ^ 2; crank: motor O P radius 1 speed w phase 0
         coordinate S at (crank.angle ^ 2, 0); set dt 1/20; step 20",
    );
    talking.run("assert S.x = 1 within 1e-13; assert velocity(S).x = 6 within 1e-12");
    talking.run("assert acceleration(S).x = 30 within 1e-11");
}

#[test]
fn the_speed_of_a_motor_may_follow_its_own_angle() {
    // w = 1 + a/2: from the angle a on the rate is w, and its rate w/2.
    let mut talking = Talking::after(
        "point O = (0, 0) frozen, P = (1, 0); crank: motor O P radius 1 speed 1 phase 0
         change crank speed 1 + crank.angle / 2; set dt 1/10000; step 10000",
    );
    talking.run("assert omega(O, P) = 1 + crank.angle / 2 within 1e-13");
    talking.run("assert alpha(O, P) = omega(O, P) / 2 within 1e-11");
    // a = 2 (e^(t/2) - 1); each frame takes the speed of its beginning.
    talking.run("assert crank.angle = 2 * (exp(0.5) - 1) within 1e-4");
}

#[test]
fn a_constraint_has_the_value_that_it_measures() {
    let mut talking = Talking::after(
        "point A = (0, 0) frozen, B = (3, 4) frozen, C = (6, 0) frozen, D = (0, 1) frozen
         cord: length A B <= 9; rod: length A B = 5.5; bend: orientation A B, A D = 10deg
         off_line: distance B to A C = 3; alike: equal A B, A C; skew: parallel A C, A B
         assert cord.value = 5; assert cord.residual = 0
         assert rod.value = 5; assert rod.residual = -0.5
         assert bend.value = atan2(3, 4) within 1e-15
         assert bend.residual = atan2(3, 4) - 10deg within 1e-15
         assert off_line.value = 4; assert off_line.residual = 1
         assert alike.value = -1; assert alike.residual = -1
         assert skew.value = atan2(4, 3) within 1e-15
         off rod; assert rod.value = 5",
    );
    talking.run("hold: hinge D on A C at 0; assert hold.residual = 1");
}

#[test]
fn a_residual_is_that_of_the_values_of_now() {
    let mut talking = Talking::after(
        "point A = (0, 0) frozen, B = (3, 0) frozen, C = (7, 0) frozen
         rod: length A B = distance(B, C) / 2; let missed = rod.residual
         assert missed = 1; move C to (11, 0); assert missed = -1; assert rod.residual = -1
         change rod = 2.5; assert missed = 0.5; let l = 4; change rod = l; assert missed = -1
         let l = 1; assert missed = 2; undo; assert missed = -1",
    );
    assert!(talking.ask("show rod")[0].ends_with("residual -1"));
    let told = talking.type_in("delete rod");
    assert!(told.contains("used by `missed`"), "{told}");
    talking.run("delete rod cascade");
    assert!(talking.ask("list parameters")[0].starts_with("let l"));
}

#[test]
fn a_declared_name_comes_before_a_member_of_an_instance() {
    // An instance may have the names that things have members of.
    Talking::default().run(
        "define arm(A) { point angle = A + (1, 0); let value = 7 }
         point A = (0, 0) frozen; use arm(A) as crank
         assert crank.angle = (1, 0); assert crank.angle.x = 1; assert crank.value = 7",
    );
}

#[test]
fn what_mentions_members_is_saved_after_what_has_them() {
    let mut talking = Talking::after(CRANK);
    talking.run(
        "point S = (1, 0), U = (0, 7)
         slide: coordinate S at (0.1, 0); rod: length Q S in 1..9; stay: length S U <= 8
         second: motor Q U speed 1; let half = crank.angle / 2, m = rod.value
         change slide at (half, time); change rod in time..half + 7; change second speed half
         let r = rod.residual
         step 3",
    );
    talking.assert_goes_on_from_its_file("step 40");
    talking.run("off second; off slide; step 2");
    talking.assert_goes_on_from_its_file("on second; step 40");
}
