//! Wheels whose ratio is an expression: each frame they turn by the ratio of its end, on from where
//! they stood at its beginning.

use std::f64::consts::TAU;

use crate::support::draws::draws;
use crate::support::fresh::violation;
use crate::support::talk::Talking;
use proptest::prelude::*;

/// Where all points are, to the bit.
fn places(talking: &Talking) -> Vec<[u64; 2]> {
    let points = talking.world().points();
    points.ids().map(|p| [points.at(p).x.to_bits(), points.at(p).y.to_bits()]).collect()
}

/// A frame has converged; after every fourth one a `solve` finds nothing to do. More often it would
/// begin each motion anew.
fn check_frame(talking: &mut Talking, frame: u32) -> Result<(), TestCaseError> {
    talking.talk.told();
    talking.run("step");
    let summary = talking.session.last_run().expect("a frame has passed");
    prop_assert_eq!(summary.n_missed, 0, "{:?}", talking.talk.told());
    let off = violation(talking.world());
    prop_assert!(off < 1e-10, "off by {off:e}");
    if !frame.is_multiple_of(4) {
        return Ok(());
    }
    let before = places(talking);
    talking.talk.told();
    talking.run("solve");
    let told = talking.talk.told().concat();
    prop_assert!(told.starts_with("converged"), "{told}");
    prop_assert_eq!(places(talking), before, "a solve moved what was solved");
    Ok(())
}

/// Two wheels on fixed centres, the first driven.
fn pair(ratio: &str, speed: &str, dt: &str) -> Talking {
    Talking::after(&format!(
        "point O = (0, 0) frozen, G = (1, 0), Q = (3, 0) frozen, H = (2, 0)
         mesh: cog O G, Q H ratio {ratio}
         length Q H = 1
         crank: motor O G speed {speed}
         set dt {dt}"
    ))
}

proptest! {
    #![proptest_config(draws(40))]

    #[test]
    fn wheels_turn_by_the_ratio_of_each_frame(
        mean in prop_oneof![1.5..4.0, -4.0..-1.5],
        swing in -0.5..0.5,
        rate in 0.5..6.0,
        degrees in -40.0..40.0,
    ) {
        let dt = 0.1;
        let ratio = |time: f64| mean + swing * f64::sin(rate * time);
        let mut talking = pair(
            &format!("{mean} + {swing} * sin({rate} * time)"),
            &format!("{} * 1deg", degrees / dt),
            "1/10",
        );
        let mut angle = std::f64::consts::PI;
        for frame in 1..13 {
            check_frame(&mut talking, frame)?;
            angle -= f64::to_radians(degrees) / ratio(f64::from(frame) * dt);
            let found = talking.session.evaluate("angle(Q, H)").unwrap().number();
            let off = (found - angle) - ((found - angle) / TAU).round() * TAU;
            prop_assert!(off.abs() < 1e-9, "frame {frame}: off by {off:e}");
        }
    }

    #[test]
    fn a_planet_whose_ratio_changes_settles_in_every_frame(
        mean in prop_oneof![0.4..3.0, -0.7..-0.2],
        swing in -0.1..0.1,
        rate in 0.5..6.0,
        degrees in -25.0..25.0,
    ) {
        // The centre of the second wheel goes around the first, which turns too.
        let mut talking = Talking::after(&format!(
            "point O = (0, 0) frozen, G = (1, 0), Q = (3, 0), H = (3.5, 0.5)
             mesh: cog O G, Q H ratio {mean} + {swing} * sin({rate} * time)
             length Q H
             arm: motor O Q speed {degrees} * 10deg
             sun: motor O G speed 70deg * cos(time)
             set dt 1/10"
        ));
        for frame in 1..13 {
            check_frame(&mut talking, frame)?;
        }
    }
}

#[test]
fn finer_frames_come_near_the_integral_of_the_ratio() {
    // theta2' = -omega / (2 + t), so theta2 = pi - omega ln((2 + t) / 2).
    let off = |n: u32| {
        let mut talking = pair("2 + time", "90deg", &format!("1/{n}"));
        talking.run(&format!("step {n}"));
        let wanted = std::f64::consts::PI * (1.0 - 0.5 * 1.5_f64.ln());
        (talking.session.evaluate("angle(Q, H)").unwrap().number() - wanted).abs()
    };
    let (coarse, fine) = (off(20), off(80));
    assert!(fine < 2e-3 && fine < 0.3 * coarse, "{coarse:e} {fine:e}");
}
