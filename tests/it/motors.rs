//! Motors whose speed is an expression turn by its integral, by closed forms.

use linkwork::Session;

/// A crank with this speed, after these statements.
fn crank(before: &str, speed: &str) -> Session {
    let mut session = Session::new();
    let text = format!(
        "point A = (0, 0) frozen, B = (1, 0); {before}
         crank: motor A B radius 1 speed {speed}"
    );
    session.run(&text).unwrap();
    session
}

fn angle(session: &mut Session) -> f64 {
    number(session, "angle(A, B)")
}

fn number(session: &mut Session, expression: &str) -> f64 {
    let text = session.run(&format!("print {expression}")).unwrap().to_string();
    text.trim().parse().unwrap_or_else(|_| panic!("`{text}` is no number"))
}

/// Holds the crank to an angle, whole turns aside.
#[track_caller]
fn assert_angle(session: &mut Session, expected: f64, what: &str) {
    let difference = angle(session) - expected;
    let off =
        (difference - (difference / std::f64::consts::TAU).round() * std::f64::consts::TAU).abs();
    assert!(off < 1e-12 * expected.abs().max(1.0), "{what}: off by {off:e}");
}

/// The integral of |sin| from 0.
fn of_abs_sin(t: f64) -> f64 {
    let n = (t / std::f64::consts::PI).floor();
    2.0 * n + 1.0 - (t - n * std::f64::consts::PI).cos()
}

#[test]
fn the_angle_is_the_integral_of_the_speed() {
    type Case = (&'static str, &'static str, fn(f64) -> f64);
    let cases: [Case; 9] = [
        ("", "2 * time", |t| t * t),
        ("", "sin(time)", |t| 1.0 - t.cos()),
        ("", "1 / (1 + time^2)", f64::atan),
        ("", "abs(sin(time))", of_abs_sin),
        ("", "exp(-time)", |t| -(-t).exp_m1()),
        ("", "sqrt(time)", |t| t.powf(1.5) / 1.5),
        ("", "min(time, 0.7345)", |t| {
            if t < 0.7345 { 0.5 * t * t } else { 0.7345 * t - 0.5 * 0.7345 * 0.7345 }
        }),
        ("", "sign(time - 0.77)", |t| (t - 0.77).abs() - 0.77),
        ("let b = 3; let a = b * time^2; let c = a + 1", "c - 1", |t| t.powi(3)),
    ];
    for (before, speed, integral) in cases {
        let mut session = crank(before, speed);
        for n in [1, 59, 300, 1640] {
            session.run(&format!("step {n}")).unwrap();
            let time = number(&mut session, "time");
            assert_angle(&mut session, integral(time), &format!("speed {speed} to {time}"));
        }
    }
}

#[test]
fn a_long_frame_is_as_exact_as_a_short_one() {
    for dt in ["1/7", "1", "5"] {
        let mut session = crank("", "sin(time)");
        session.run(&format!("set dt {dt}; step 8")).unwrap();
        let time = number(&mut session, "time");
        assert_angle(&mut session, 1.0 - time.cos(), dt);
    }
}

#[test]
fn a_speed_that_happens_not_to_change_turns_as_a_number_does() {
    let (mut ramp, mut plain) = (crank("", "1rev + 0 * time"), crank("", "1rev"));
    for _ in 0..200 {
        ramp.run("step").unwrap();
        plain.run("step").unwrap();
        assert_eq!(angle(&mut ramp).to_bits(), angle(&mut plain).to_bits());
    }
}

#[test]
fn a_change_of_speed_is_no_jump_and_the_rest_is_integrated_too() {
    let mut session = crank("", "2 * time");
    session.run("step 60").unwrap();
    let before = angle(&mut session);
    session.run("change crank speed 3").unwrap();
    assert_eq!(angle(&mut session).to_bits(), before.to_bits());
    session.run("step 30").unwrap();
    assert_angle(&mut session, 1.0 + 1.5, "then a number");
    session.run("change crank speed cos(time); step 30").unwrap();
    assert_angle(&mut session, 2.5 + 2.0_f64.sin() - 1.5_f64.sin(), "then another expression");
}

#[test]
fn a_parameter_of_the_speed_may_change_to_mention_others() {
    let mut session = crank("let p = 2; let q = time; let w = q", "w");
    session.run("step 60; let w = p * q; step 60; let q = time^2; step 60").unwrap();
    // Halves of 1, then 4 - 1, then two thirds of 27 - 8.
    assert_angle(&mut session, 0.5 + 3.0 + 2.0 * 19.0 / 3.0, "w");
}

#[test]
fn the_velocity_is_that_of_the_end_of_the_frame() {
    let mut session = crank("", "2 * time");
    session.run("step 60").unwrap();
    // The speed is 2 and grows by 2: across 2, inward 4, across 2.
    for (expression, expected) in [
        ("norm(velocity(B))", 2.0),
        ("dot(acceleration(B), B)", -4.0),
        ("cross(B, acceleration(B))", 2.0),
    ] {
        let value = number(&mut session, expression);
        assert!((value - expected).abs() < 1e-9, "{expression} is {value}");
    }
}

#[test]
fn what_is_measured_on_the_pose_holds_still_while_time_is_integrated() {
    let mut session = crank("point F = (3, 0) frozen", "F.x * time^2");
    session.run("step 60").unwrap();
    assert_angle(&mut session, 1.0, "a frozen point and time");
}

#[test]
fn one_by_one_undone_saved_and_reset_it_comes_to_the_same_bits() {
    let scene = "point A = (0, 0) frozen, B = (1, 0), C = (3, 3), D = (4, 0) frozen
                 crank: motor A B radius 1 speed 3 * sin(time) + abs(cos(7 * time))
                 length B C = 3.5; length C D = 3";
    let at_once = |statements: &str| {
        let mut session = Session::new();
        session.run(scene).unwrap();
        session.run(statements).unwrap();
        session.run("print B, C, time").unwrap().to_string()
    };
    let expected = at_once("step 200");
    assert_eq!(at_once("for i in 1..200 { step }"), expected, "one by one");
    assert_eq!(at_once("step 120; step 80; undo; redo"), expected, "undone and redone");
    assert_eq!(at_once("step 120; step 80; undo; step 80"), expected, "undone and done again");
    assert_eq!(at_once("step 77; reset; step 200"), expected, "reset");

    let mut first = Session::new();
    first.run(scene).unwrap();
    first.run("step 120").unwrap();
    let mut second = Session::new();
    second.run(&first.to_script()).unwrap();
    second.run("step 80").unwrap();
    assert_eq!(second.run("print B, C, time").unwrap().to_string(), expected, "saved");
}

#[test]
fn a_run_that_stops_at_a_dead_point_stops_where_the_integral_meets_it() {
    // The arms reach the crank pin up to 3.1 from D: cos A = (4 + 9 - 3.1^2) / 12.
    let mut session = Session::new();
    session
        .run(
            "point A = (0, 0) frozen, B = (2, 0), C = (3, 1.5), D = (3, 0) frozen
             set dead-points stop
             length B C = 1.6; length C D = 1.5
             crank: motor A B radius 2 speed 2 * time phase 0
             step 300",
        )
        .unwrap();
    let last = f64::acos((4.0 + 9.0 - 3.1 * 3.1) / 12.0);
    let time = number(&mut session, "time");
    assert_angle(&mut session, time * time, "stopped");
    let next = time + 1.0 / 60.0;
    assert!(time * time < last && last < next * next, "{time} {last}");
}

#[test]
fn a_speed_without_a_value_within_a_frame_is_an_error_and_the_frame_is_not_done() {
    let mut session = crank("", "sqrt((time - 0.41)^2 - 1e-6)");
    let problem = session.run("step 60").unwrap_err();
    assert!(problem.message.contains("sqrt"), "{}", problem.message);
    assert_eq!(number(&mut session, "time"), 0.0);
}
