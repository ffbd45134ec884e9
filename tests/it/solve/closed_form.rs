//! Frames by closed form: what they give does not depend on how many pass at once, and they are
//! left where a motion has to be followed.

use std::fs;
use std::path::Path;

use crate::support::talk::Talking;
use linkwork::world::World;

/// Mechanisms each of whose frames, or most of them, have a closed form.
const SCRIPTS: [&str; 6] = [
    "w1-four-bar",
    "w2-jansen",
    "w3-peaucellier",
    "w4-crankshaft",
    "w7-parallelogram",
    "w8-three-cranks",
];

/// A scene up to its first frame.
fn scene(name: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("scripts/bench/{name}.link"));
    fs::read_to_string(path).unwrap().replace("step frames", "")
}

/// The bits of all coordinates, and the frame.
fn bits(world: &World) -> (u64, Vec<[u64; 2]>) {
    let all = world.points().ids().map(|id| world.points().at(id));
    (world.clock().frame, all.map(|p| [p.x.to_bits(), p.y.to_bits()]).collect())
}

/// Lets frames of a scene pass at once, one by one, and with a file in between: the same to the
/// bit, and so is what the solver remembers.
#[track_caller]
fn check_same(name: &str, scene: &str, n: u32) {
    let at_once = Talking::after(&format!("{scene}\nstep {n}"));
    let one_by_one = Talking::after(&format!("{scene}\nfor i in 1..{n} {{ step }}"));
    assert_eq!(one_by_one.script(), at_once.script(), "{name}, frame by frame");
    let before = Talking::after(&format!("{scene}\nstep {}", n / 3));
    let continued = Talking::after(&format!("{}\nstep {}", before.script(), n - n / 3));
    assert_eq!(bits(continued.world()), bits(at_once.world()), "{name}, saved and continued");
}

#[test]
fn frames_at_once_are_frames_one_by_one() {
    for name in SCRIPTS {
        for per_turn in [360, 36, 12] {
            let scene = format!("{}\nset dt 1/{per_turn}", scene(name));
            check_same(&format!("{name}, {per_turn} a turn"), &scene, 100);
        }
    }
}

#[test]
fn what_sleeps_and_what_is_traced_makes_no_difference() {
    let still = "point S = (0, 9) frozen, T = (1, 9); length S T = 1; trace B; trace C every 3";
    let both = format!("{}\n{still}", scene("w1-four-bar"));
    let alone = bits(Talking::after(&format!("{}\nstep 100", scene("w1-four-bar"))).world());
    let with = Talking::after(&format!("{both}\nstep 100"));
    assert_eq!(bits(with.world()).1[..4], alone.1[..]);
    check_same("traced", &both, 100);
    let counts: Vec<usize> = with.world().traces().iter().map(|t| t.samples.len()).collect();
    assert_eq!(counts, [100, 33]);
}

#[test]
fn what_is_measured_makes_no_difference() {
    let measures = "trace B; measure swing = angle(A, B); measure rise = velocity(C).y";
    check_same("measured", &format!("{}\n{measures}", scene("w1-four-bar")), 100);
    check_same("measured", &format!("{CARRIED}\ntrace Q; measure rise = velocity(Q).y"), 50);
}

#[test]
fn a_measure_without_a_value_ends_frames_where_it_has_none() {
    // Beside others as by itself: when the crank has gone 84 degrees.
    let scene = format!("{}\nmeasure m = sqrt(B.x - 0.12)", scene("w1-four-bar"));
    for run in ["step 360", "for i in 1..83 { step }; step"] {
        let mut talking = Talking::after(&scene);
        let problem = talking.execute(run).unwrap_err();
        let told = talking.drawn(&problem);
        assert!(told.contains("at frame 84"), "{told}");
    }
}

#[test]
fn a_motor_that_is_changed_between_runs_goes_on_from_where_it_is() {
    let script = scene("w1-four-bar").replace("motor A B", "crank: motor A B");
    let changed = "step 50; change crank speed 0.5rev; step 50; off crank; step 5; on crank";
    check_same("changed", &format!("{script}\n{changed}"), 60);
}

/// A four-bar whose coupler carries a hinge, a copy of it beside, and a dyad on both.
const CARRIED: &str = "point A = (0, 0) frozen, D = (4, 0) frozen, B = (1, 0), C = (3, 3)
    point H = (2, 1), U = (0, 6) frozen, V = (2, 7), W = (2, 7), Q = (5, 6)
    motor A B radius 1 speed 1rev
    length B C = 3.5
    length C D = 3
    hinge H on B C at 0.3
    equivalence A H, U V
    coincidence V W
    length W Q = 4
    length D Q = 6";

/// A quick return: a crank drives a link through a slider on it.
const SLOTTED: &str = "point A = (0, 0) frozen, O = (0, -2) frozen
    point B = (1, 0), E = (2, 3)
    motor A B speed 1rev
    length O E = 4
    glider B on O E";

#[test]
fn points_that_others_carry_are_steps() {
    check_same("carried", CARRIED, 100);
    let mut talking = Talking::after(&format!("{CARRIED}\nset dt 1/360\nstep 359"));
    talking.run(
        "assert H = B + 0.3 * (C - B) within 1e-12
         assert V = U + H within 1e-12
         assert W = V within 1e-12
         assert distance(W, Q) = 4 within 1e-12",
    );
}

#[test]
fn a_slotted_link_points_where_its_slider_is() {
    for scene in [SLOTTED.to_owned(), SLOTTED.replace("glider B on O E", "glider B on E O")] {
        check_same("slotted", &scene, 100);
        let mut talking = Talking::after(&format!("{scene}\nset dt 1/360"));
        for _ in 0..4 {
            talking.run("step 90; assert E = O + 4 / norm(B - O) * (B - O) within 1e-12");
        }
    }
}

#[test]
fn a_slider_that_comes_to_its_pivot_is_followed() {
    // Crank and ground are of one length: the line of the link is lost once a turn, and found again.
    let scene = SLOTTED.replace("(0, -2)", "(-1, 0)").replace("(2, 3)", "(3, 0)");
    check_same("through the pivot", &format!("{scene} unbounded"), 100);
}

/// A crank on a bar of 100 that reaches too far for 0.3 degrees on both sides of one direction, so
/// that frames of 10 degrees may begin and end where the bars meet, and none of its motion does.
const GAP: &str = "point A = (0, 0) frozen, D = (199.5, 0) frozen
    point B = polar(0.501, 15deg), C = (100, 10)
    motor A B radius 0.501 phase 15deg speed 1rev
    length B C = 100
    length C D = 100
    set dt 1/36";

#[test]
fn a_gap_within_a_frame_is_not_jumped_over() {
    let mut talking = Talking::after(&format!("{GAP}\nstep 36"));
    let told = talking.talk.told();
    assert!(told[0].contains("frame 17 may have changed branch"), "{told:?}");
}
