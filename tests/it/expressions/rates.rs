//! What follows from velocities, against the formulas of kinematics.

use crate::support::talk::Talking;

/// A crank of radius 1 that drives a four-bar linkage.
const FOUR_BAR: &str = "
    point A = (0, 0) frozen, D = (4, 0) frozen, B = (1, 0), C = (3, 3)
    crank: motor A B radius 1 speed 2; length B C = 3.5; length C D = 3
    set dt 1/50
    step 17
";

#[test]
fn a_crank_turns_with_its_motor() {
    let mut talking = Talking::after(FOUR_BAR);
    talking.run("assert omega(A, B) = 2 within 1e-13; assert alpha(A, B) = 0 within 1e-12");
    talking.run("assert omega(B, A) = 2 within 1e-13; assert omega(A, D) = 0");
}

#[test]
fn a_motor_that_speeds_up_has_an_angular_acceleration() {
    let mut talking = Talking::after(
        "point A = (0, 0) frozen, B = (2, 0); motor A B radius 2 speed 3 * time ^ 2
         set dt 1/20; step 10",
    );
    talking.run("assert omega(A, B) = 0.75 within 1e-13; assert alpha(A, B) = 3 within 1e-12");
}

#[test]
fn coupler_and_rocker_turn_as_the_loop_of_vectors_says() {
    let mut talking = Talking::after(FOUR_BAR);
    // a w2 sin(t2 - t3) = c w4 sin(t4 - t3) and b w3 sin(t3 - t4) = a w2 sin(t4 - t2), of
    // AB + BC = AD + DC differentiated.
    talking.run(
        "let t2 = angle(A, B), t3 = angle(B, C), t4 = angle(D, C)
         assert 3 * omega(D, C) * sin(t4 - t3) = 2 * sin(t2 - t3) within 1e-12
         assert 3.5 * omega(B, C) * sin(t3 - t4) = 2 * sin(t4 - t2) within 1e-12",
    );
}

#[test]
fn an_angular_acceleration_is_the_change_of_the_angular_velocity() {
    let mut talking = Talking::after(FOUR_BAR);
    let [before, at, after] = [-1, 0, 1].map(|k: i32| {
        talking.run("reset; set dt 1/50; step 17; set dt 1/10000");
        talking.run(&format!("step {}", 100 + k));
        let printed = talking.ask("print omega(D, C); print alpha(D, C)");
        [0, 1].map(|k| printed[k].parse::<f64>().expect("a number"))
    });
    assert!(((after[0] - before[0]) * 5000.0 - at[1]).abs() < 1e-6, "{before:?} {at:?} {after:?}");
}

#[test]
fn a_bar_that_stretches_turns_by_its_angle_alone() {
    // On the line x = 1 at y = t: angle atan(t), rate 1/(1 + t^2), then -2 t/(1 + t^2)^2.
    let mut talking = Talking::after(
        "point A = (0, 0) frozen, B = (1, 0); coordinate B at (1, time); set dt 1/10; step 5",
    );
    talking.run("assert omega(A, B) = 0.8 within 1e-14; assert alpha(A, B) = -0.64 within 1e-13");
}

#[test]
fn the_instant_centre_of_a_coupler_is_where_the_cranks_meet() {
    let mut talking = Talking::after(FOUR_BAR);
    talking.run(
        "let u = B - A, v = C - D
         let meet = A + u * cross(D - A, v) / cross(u, v)
         assert ic(B, C, A, D) = meet within 1e-11
         assert ic(A, D, B, C) = meet within 1e-11",
    );
    // Kennedy: neighbours turn about their joint, and the centre of the cranks lies on AD and BC.
    talking.run("assert ic(A, B, B, C) = B within 1e-12; assert ic(B, C, C, D) = C within 1e-12");
    talking.run("assert ic(A, B, C, D).y = 0 within 1e-11");
    talking.run("assert distance(ic(A, B, C, D), B, C) = 0 within 1e-11");
}

#[test]
fn the_path_of_a_crank_is_a_circle() {
    let mut talking = Talking::after(FOUR_BAR);
    talking
        .run("assert curvature(B) = 1 within 1e-12; assert abs(curvature(C)) = 1/3 within 1e-12");
    talking.run("change crank speed -2; assert curvature(B) = -1 within 1e-12");
}

#[test]
fn an_ellipse_has_the_curvature_that_it_has() {
    // x = 3 cos t, y = 2 sin t: 6 / (9 sin^2 + 4 cos^2)^(3/2).
    let mut talking = Talking::after(
        "point P = (3, 0); coordinate P at (3 * cos(time), 2 * sin(time)); set dt 1/10; step 7",
    );
    talking.run(
        "assert curvature(P) = 6 / (9 * sin(time)^2 + 4 * cos(time)^2)^1.5 within 1e-14
         let k = curvature(P); step 3; assert k = curvature(P)",
    );
}
