//! Functions of numbers and their derivatives, and values in units.

use crate::support::talk::Talking;

#[test]
fn a_clamped_value_stays_within_its_range() {
    Talking::default().run(
        "assert clamp(3, 0, 2) = 2; assert clamp(-3, 0, 2) = 0; assert clamp(1.5, 0, 2) = 1.5
         assert clamp(2, 2, 2) = 2; assert clamp(0, 0, 2) = 0",
    );
}

#[test]
fn a_triangle_is_0_at_even_and_1_at_odd_numbers() {
    Talking::default().run(
        "for k in -6..6 { assert triangle(k) = mod(k, 2) }
         for k in -60..60 { assert triangle(k / 10) = abs(k / 10 - 2 * round(k / 20)) within 1e-15 }
         assert triangle(0.25) = 0.25; assert triangle(1.75) = 0.25; assert triangle(-0.75) = 0.75
         assert triangle(1e15 + 1) = 1; assert triangle(1e300) = 0",
    );
}

#[test]
fn a_point_that_a_triangle_drives_goes_there_and_back() {
    let mut talking = Talking::after(
        "point P = (0, 0); coordinate P at (3 * triangle(2 * time), 0); set dt 1/16; step 4",
    );
    talking
        .run("assert P = (1.5, 0); assert velocity(P) = (6, 0); assert acceleration(P) = (0, 0)");
    talking.run("step 8; assert P = (1.5, 0); assert velocity(P) = (-6, 0)");
    // At a corner the motion to come counts.
    talking.run("step 4; assert P = (0, 0); assert velocity(P) = (6, 0)");
    talking.run("step 8; assert P = (3, 0); assert velocity(P) = (-6, 0)");
}

#[test]
fn a_point_that_a_clamp_holds_stands_still_at_the_ends() {
    let mut talking = Talking::after(
        "point P = (0, 0); coordinate P at (clamp(time ^ 2, 0.25, 1), 0); set dt 1/8; step 3",
    );
    talking.run("assert P = (0.25, 0); assert velocity(P) = (0, 0)");
    talking.run("step 3; assert P = (0.5625, 0) within 1e-15; assert velocity(P) = (1.5, 0)");
    talking.run("assert acceleration(P) = (2, 0)");
    talking.run("step 6; assert P = (1, 0); assert velocity(P) = (0, 0)");
}

#[test]
fn a_printed_item_may_be_in_a_unit() {
    let mut talking = Talking::after("point A = (0, 0), B = (0, 1)");
    let printed =
        talking.ask("print angle(A, B) in deg, 30rpm in rpm, 2rev in rad, \"s\", 5ms in s");
    assert_eq!(printed, ["90 30 12.566370614359172 s 0.005"]);
    assert_eq!(
        talking.ask("print 90deg in rev, 1rev in deg, 0.25 in ms, B"),
        ["0.25 360 250 (0, 1)"]
    );
    // A point may be called like the word.
    assert_eq!(talking.ask("point in = (2, 0); print in.x in s, in"), ["2 (2, 0)"]);
}
