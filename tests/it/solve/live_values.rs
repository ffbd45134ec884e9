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
