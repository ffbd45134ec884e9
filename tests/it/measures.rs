//! Measures and results, against closed forms and against each other.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use linkwork::world::Tally;

use crate::support::compare::check_same;
use crate::support::talk::Talking;

/// A four-bar with its crank, 360 frames a turn, begun where no frame is at an extremum.
const FOUR_BAR: &str = "
    point A = (0, 0) frozen, D = (4, 0) frozen, B = polar(1, 0.1234), C = (3, 3)
    crank: motor A B radius 1 speed 1rev
    coupler: length B C = 3.5
    length C D = 3
    point E = (2, 3)
    length B E = 2
    length C E = 2.2
    set dt 1/360
    solve
";

fn number(talking: &mut Talking, expression: &str) -> f64 {
    let value = talking.session.evaluate(expression);
    value.unwrap_or_else(|problem| panic!("{expression}: {}", problem.message)).number()
}

#[track_caller]
fn check_near(talking: &mut Talking, expression: &str, wanted: f64, within: f64) {
    let found = number(talking, expression);
    assert!((found - wanted).abs() <= within, "{expression} is {found}, not {wanted}");
}

/// The numbers that a measure keeps.
fn kept(talking: &Talking, name: &str) -> Vec<u64> {
    let mut measures = talking.world().measures();
    let tally = measures.find(|(_, it)| &*it.name == name).map(|(_, it)| it.tally.to_numbers());
    tally.expect("it is measured").into_iter().map(f64::to_bits).collect()
}

/// The place of the greatest value of a smooth function between two places, and the value.
fn top(f: impl Fn(f64) -> f64, lo: f64, hi: f64) -> (f64, f64) {
    let n = 20_000;
    let at = |k: i32| lo + (hi - lo) * f64::from(k) / f64::from(n);
    let best = (0..=n).max_by(|&a, &b| f(at(a)).total_cmp(&f(at(b)))).expect("there are some");
    let (mut lo, mut hi) = (at((best - 1).max(0)), at((best + 1).min(n)));
    for _ in 0..200 {
        let (a, b) = (lo + (hi - lo) / 3.0, hi - (hi - lo) / 3.0);
        if f(a) < f(b) {
            lo = a;
        } else {
            hi = b;
        }
    }
    (0.5 * (lo + hi), f(0.5 * (lo + hi)))
}

#[test]
fn the_stroke_of_a_slider_is_twice_its_crank() {
    let mut talking = Talking::after(
        "point O = (0, 0) frozen, X = (1, 0) frozen, A = polar(1, 0.1234), P = (4, 0)
         motor O A radius 1 speed 1rev
         length A P = 3
         glider P on O X unbounded
         set dt 1/360
         solve
         measure x = P.x
         measure v = velocity(P).x
         measure a = acceleration(P).x
         step 360",
    );
    check_near(&mut talking, "x.span", 2.0, 2e-13);
    check_near(&mut talking, "x.max", 4.0, 2e-13);
    // Both dead centres, by the angle at the start.
    check_near(&mut talking, "x.at_min", (PI - 0.1234) / TAU, 1e-9);
    check_near(&mut talking, "x.at_max", (TAU - 0.1234) / TAU, 1e-9);
    check_near(&mut talking, "x.count", 361.0, 0.0);
    // x = cos t + sqrt(9 - sin^2 t), differentiated by hand.
    let root = |t: f64| (9.0 - t.sin().powi(2)).sqrt();
    let speed = |t: f64| TAU * (-t.sin() - t.sin() * t.cos() / root(t));
    let (at, fastest) = top(speed, 0.1234, 0.1234 + TAU);
    check_near(&mut talking, "v.max", fastest, 1e-9 * 2.0 * fastest);
    check_near(&mut talking, "v.at_max", (at - 0.1234) / TAU, 1e-6);
    let second = |t: f64| {
        let (s, c, r) = (t.sin(), t.cos(), root(t));
        TAU * TAU * (-c - (c * c - s * s) / r - s * s * c * c / (r * r * r))
    };
    let (_, most) = top(second, 0.1234, 0.1234 + TAU);
    let (_, least) = top(|t| -second(t), 0.1234, 0.1234 + TAU);
    check_near(&mut talking, "a.max", most, 1e-9 * (most + least));
    check_near(&mut talking, "a.min", -least, 1e-9 * (most + least));
}

#[test]
fn a_whitworth_lever_goes_back_faster_by_the_angle_of_its_swing() {
    let mut talking = Talking::after(
        "point O = (0, 0) frozen, A = polar(1, 0.1234), L = (0, -2.5) frozen, U = (0, 5)
         motor O A radius 1 speed 1rev
         length L U = 7.5
         glider A on L U unbounded
         set dt 1/360
         solve
         measure swing = angle(L, U)
         step 360",
    );
    let half = (1.0_f64 / 2.5).asin();
    check_near(&mut talking, "swing.span", 2.0 * half, 1e-12);
    let forth = number(&mut talking, "mod(swing.at_max - swing.at_min, 1)");
    let ratio = (PI + 2.0 * half) / (PI - 2.0 * half);
    assert!((forth / (1.0 - forth) - ratio).abs() < 1e-7, "{forth}");
}

#[test]
fn a_coupler_curve_has_the_extremes_of_its_closed_form() {
    let mut talking = Talking::after(FOUR_BAR);
    let shape = number(&mut talking, "angle(B, C, B, E)");
    let arm = number(&mut talking, "distance(B, E)");
    talking
        .run("measure x = E.x; measure y = E.y; measure mu = angle(C, B, C, D) in deg; step 360");
    let pose = |t: f64| {
        let b = (t.cos(), t.sin());
        let (ex, ey) = (4.0 - b.0, -b.1);
        let apart = ex.hypot(ey);
        let turned = ((3.5_f64.powi(2) + apart * apart - 9.0) / (2.0 * 3.5 * apart)).acos();
        let coupler = ey.atan2(ex) + turned + shape;
        let mu = ((3.5_f64.powi(2) + 9.0 - apart * apart) / (2.0 * 3.5 * 3.0)).acos();
        (b.0 + arm * coupler.cos(), b.1 + arm * coupler.sin(), mu.to_degrees())
    };
    let range = (0.1234, 0.1234 + TAU);
    for (name, f) in [
        ("x", Box::new(|t| pose(t).0) as Box<dyn Fn(f64) -> f64>),
        ("y", Box::new(|t| pose(t).1)),
        ("mu", Box::new(|t| pose(t).2)),
    ] {
        let (at, most) = top(&f, range.0, range.1);
        let (_, least) = top(|t| -f(t), range.0, range.1);
        let span = most + least;
        check_near(&mut talking, &format!("{name}.max"), most, 1e-11 * span);
        check_near(&mut talking, &format!("{name}.min"), -least, 1e-11 * span);
        check_near(&mut talking, &format!("{name}.at_max"), (at - 0.1234) / TAU, 1e-6);
        // Far better than the frames alone.
        let readings = talking.world().measures().find(|(_, it)| &*it.name == name);
        let readings = readings.expect("it is measured").1.tally.readings();
        let sampled = readings.iter().map(|it| it.value).fold(f64::MIN, f64::max);
        assert!(most - sampled > 1e-7 * span, "{name} has a frame at its extremum");
    }
}

#[test]
fn the_mean_is_that_over_time() {
    let mut talking = Talking::after(
        "point A = (0, 0) frozen, B = (1, 0)
         length A B = 3 + sin(tau * time)
         horizontal A B
         solve
         measure d = distance(A, B)
         measure t = time
         set dt 1/100
         step 100
         set dt 1/400
         step 400",
    );
    check_near(&mut talking, "d.mean", 3.0, 1e-12);
    check_near(&mut talking, "t.mean", 1.0, 1e-12);
    check_near(&mut talking, "t.span", 2.0, 1e-12);
    check_near(&mut talking, "d.max", 4.0, 1e-12);
}

#[test]
fn sampled_extremes_are_those_of_the_frames() {
    let mut talking = Talking::after(FOUR_BAR);
    talking.run("set measures sampled; measure y = B.y; measure w = omega(D, C); step 360");
    for name in ["y", "w"] {
        let measures = talking.world().measures();
        let tally = measures.filter(|(_, it)| &*it.name == name).map(|(_, it)| &it.tally);
        let values: Vec<f64> = tally.flat_map(Tally::readings).map(|it| it.value).collect();
        assert_eq!(values.len(), 361);
        let most = values.iter().copied().fold(f64::MIN, f64::max);
        let least = values.iter().copied().fold(f64::MAX, f64::min);
        assert_eq!(number(&mut talking, &format!("{name}.max")), most);
        assert_eq!(number(&mut talking, &format!("{name}.min")), least);
    }
}

const MEASURES: &str = "
    measure x = E.x
    measure turned = crank.angle + coupler.value in rev
    measure w = norm(velocity(E))
    measure off = coupler.residual
    measure t = time * distance(A, E)
";

#[test]
fn in_one_loop_and_frame_by_frame_the_same_is_measured() {
    let mut at_once = Talking::after(FOUR_BAR);
    let mut one_by_one = Talking::after(FOUR_BAR);
    // Ghosts are kept frame by frame.
    one_by_one.run("expose every 1000000");
    for talking in [&mut at_once, &mut one_by_one] {
        talking.run(MEASURES);
        talking.run("step 500");
    }
    let summary = at_once.session.last_run().expect("it ran");
    assert_eq!(summary.n_frames, 500);
    for name in ["x", "turned", "w", "off", "t"] {
        assert_eq!(kept(&at_once, name), kept(&one_by_one, name), "{name}");
    }
}

/// What follows the places of points alone, by every function of them.
const OF_PLACES: [&str; 24] = [
    "E.x",
    "-E.y / 3",
    "E.x ^ 2 + far * E.y",
    "norm(C - E)",
    "dot(C - B, E - B)",
    "cross(C - B, E - B)",
    "rotate(E - A, 0.3).x + rotate(E - A, E.x).y",
    "polar(E.x, E.y).x",
    "midpoint(C, E).y * midpoint(A, E).x",
    "distance(A, E)",
    "distance(E, A, C)",
    "angle(B, C)",
    "angle(B, C, D, C)",
    "clamp(E.x, 1.2, 1.8) + clamp(E.y, C.y / 2, far)",
    "sin(E.x) + cos(E.x) * tan(C.y)",
    "asin(E.x / 9) + acos(C.x / 9) + atan(E.y)",
    "atan2(E.y, C.x) + hypot(E.x, C.x)",
    "sqrt(abs(E.x - 1.5)) + sign(E.x - 1.5)",
    "min(E.x, C.x, B.y, far) + max(E.y, C.y, B.x, A.x, D.y)",
    "floor(3 * E.x) + ceil(2 * C.y) + round(E.y)",
    "exp(E.x) - ln(C.x)",
    "triangle(E.x) + mod(E.y, 0.7)",
    "distance(P, E) / distance(A, D)",
    "E.x - mid.y",
];

#[test]
fn what_follows_places_is_the_same_in_one_loop_and_frame_by_frame() {
    let beside = "let far = 2.7; let mid = midpoint(A, D)
        point O = (9, 0) frozen, P = (10, 0), Q = (12, 3), R = (13, 0) frozen
        motor O P speed 0.7rev; length P Q = 3.5; length Q R = 3";
    for extremes in ["refined", "sampled"] {
        let mut all: Vec<Talking> = (0..2).map(|_| Talking::after(FOUR_BAR)).collect();
        // Ghosts are kept frame by frame.
        all[1].run("expose every 1000000");
        for talking in &mut all {
            talking.run(beside);
            talking.run(&format!("set measures {extremes}"));
            for (k, of_places) in OF_PLACES.iter().enumerate() {
                talking.run(&format!("measure m{k} = {of_places}"));
            }
            talking.run("measure turned = angle(B, C, D, C) in deg");
            for motion in ["step 5", "step 700", "set dt 1/90; step 19; set dt 1/360; step 100"] {
                talking.run(motion);
            }
        }
        let [at_once, one_by_one] = &all[..] else { unreachable!() };
        for (k, of_places) in OF_PLACES.iter().enumerate() {
            let name = format!("m{k}");
            assert_eq!(kept(at_once, &name), kept(one_by_one, &name), "{of_places}");
        }
        assert_eq!(kept(at_once, "turned"), kept(one_by_one, "turned"));
        let [counts, others] = [at_once, one_by_one].map(|it| it.session.frame_counts().abreast);
        assert!(counts > 1400 && others == 0, "{counts} {others}");
        let [script, other] = [at_once, one_by_one].map(Talking::script);
        let kept = |it: &str| !it.starts_with("expose") && !it.contains("ghost");
        let lines =
            |it: &str| it.lines().filter(|it| kept(it)).collect::<Vec<_>>().join("\n") + "\n";
        check_same(&lines(&script), &lines(&other), extremes);
    }
}

#[test]
fn a_value_that_ends_ends_the_frames_where_it_does_frame_by_frame() {
    for fails in ["sqrt(E.x - 1.1)", "1 / max(0, E.x - 1.1)", "angle(B, B) + E.x", "ln(C.y - 2.7)"]
    {
        let mut told = Vec::new();
        for keeping in ["", "expose every 1000000"] {
            let mut talking = Talking::after(FOUR_BAR);
            talking.run(&format!("{keeping}\nmeasure x = E.x\nmeasure y = E.y"));
            // One that is kept before the one that fails.
            let begun = talking.execute(&format!("measure it = {fails}"));
            let run = talking.execute("step 720");
            let problem = begun.and(run).expect_err(fails);
            told.push((
                talking.drawn(&problem),
                kept(&talking, "x"),
                talking.world().clock().frame,
            ));
        }
        assert_eq!(told[0], told[1], "{fails}");
    }
}

#[test]
fn what_is_measured_moves_as_what_is_not() {
    let mut plain = Talking::after(FOUR_BAR);
    let mut measured = Talking::after(FOUR_BAR);
    measured.run(MEASURES);
    for motion in ["step 100", "drag D to (4.1, 0) over 20", "run 1", "move C to (3, 2); step 7"] {
        plain.run(motion);
        measured.run(motion);
        let script = measured.script();
        let lines = script.lines();
        let others =
            lines.filter(|it| !it.starts_with("measure") && !it.contains("restore measure"));
        let others = others.collect::<Vec<_>>().join("\n") + "\n";
        check_same(&others, &plain.script(), motion);
    }
}

#[test]
fn undo_takes_the_values_back_and_redo_brings_them_again() {
    let mut talking = Talking::after(FOUR_BAR);
    talking.run(MEASURES);
    talking.run("step 90");
    let before = talking.script();
    for command in
        ["step 90", "reset", "measure x = E.y", "delete w", "for i in 1..3 { step; reset; step }"]
    {
        talking.run(command);
        let after = talking.script();
        talking.run("undo");
        check_same(&talking.script(), &before, &format!("undone {command}"));
        talking.run("redo");
        check_same(&talking.script(), &after, &format!("redone {command}"));
        talking.run("undo");
    }
    assert!(talking.execute("for i in 1..2 { step; print nowhere }").is_err());
    check_same(&talking.script(), &before, "failed");
}

#[test]
fn what_is_saved_goes_on_to_the_same_bits() {
    let mut talking = Talking::after(FOUR_BAR);
    talking.run(MEASURES);
    talking.run("let far = x.max + t.mean; measure y = E.y + far");
    for motion in ["step 33", "step 60", "reset", "step 5"] {
        talking.run(motion);
        talking.assert_goes_on_from_its_file("step 100");
    }
    talking.run("set measures sampled");
    talking.assert_goes_on_from_its_file("step 10");
}

#[test]
fn reset_empties_and_a_run_from_there_measures_the_same() {
    let mut talking = Talking::after(FOUR_BAR);
    talking.run(MEASURES);
    // What the solver remembers of the solution before is of no run from the start.
    talking.run("step; reset; step 200");
    let first = ["x", "turned", "w", "off", "t"].map(|name| kept(&talking, name));
    talking.run("reset; assert x.count = 0");
    let problem = talking.execute("print x.max").expect_err("there is none");
    assert_eq!(problem.code, Some(linkwork::errors::NOT_MEASURED));
    talking.run("step 200");
    assert_eq!(["x", "turned", "w", "off", "t"].map(|name| kept(&talking, name)), first);
}

#[test]
fn a_pose_that_is_not_solved_gives_no_value() {
    let mut talking =
        Talking::after("point A = (0, 0) frozen, B = (2, 0); length A B = 1; measure x = B.x");
    assert_eq!(number(&mut talking, "x.count"), 0.0);
    talking.run("step 3");
    assert_eq!(number(&mut talking, "x.count"), 3.0);
    let mut talking = Talking::after("point A = (0, 0) frozen, B = (1, 0); length A B = 1");
    talking.run("measure x = B.x; step 3");
    assert_eq!(number(&mut talking, "x.count"), 4.0);
}

#[test]
fn members_stand_in_all_expressions_that_drive_nothing() {
    let mut talking = Talking::after(FOUR_BAR);
    talking.run(
        "measure y = B.y
         let top = y.max, later = top * 2
         step 90
         assert later = 2 within 1e-12
         assert y.max - y.min in 0.8..0.9
         point Q = (y.max, 0)
         for i in 1..2 { measure p[i] = i * B.x; step }
         print p[2].last",
    );
    assert!(talking.execute("let r = 3; length A C <= r + 9; let r = y.max").is_err());
    assert!(talking.execute("delete y").is_err(), "it is in use");
    assert!(talking.execute("delete B").is_err(), "it is in use");
    talking.run("delete y cascade");
    assert!(talking.execute("print top").is_err(), "it went with it");
}

#[test]
fn a_definition_measures_what_it_makes() {
    let mut talking = Talking::after(
        "define arm(A, l) { point P = A + (l, 0); length A P = l; motor A P speed 1rev; measure h = P.y }
         point O = (0, 0) frozen
         use arm(O, 2) as left
         step 60",
    );
    check_near(&mut talking, "left.h.max", 2.0, 1e-12);
    assert!(talking.ask("show left").iter().any(|line| line.starts_with("measure left.h")));
    talking.run("delete left cascade");
    assert!(talking.ask("list measures").is_empty());
}

#[test]
fn a_result_is_a_line_and_the_last_one_counts() {
    let mut talking = Talking::after("point A = (3, 4)");
    let lines = talking.ask("result far = norm(A), \"dead point\" = 90deg in deg, p = A in rev");
    let first = ["far = 5".to_owned(), "dead point = 90".to_owned()];
    assert_eq!(lines[..2], first);
    assert_eq!(lines.len(), 4);
    assert!(lines[3].starts_with("p.y = "));
    talking.run("result far = 6");
    let results = talking.session.results();
    let names: Vec<&str> = results.iter().map(|(name, _)| name).collect();
    assert_eq!(names, ["far", "dead point", "p.x", "p.y"]);
    assert_eq!(results.get("far"), Some(6.0));
    assert_eq!(results.get("p.x"), Some(3.0 / TAU));
    talking.run("undo");
    assert_eq!(talking.session.results().get("far"), Some(5.0));
    talking.run("undo 1; redo 1; clear");
    assert!(talking.session.results().is_empty());
}

#[test]
fn a_measure_is_shown_by_its_name() {
    let mut talking = Talking::after("point A = (0, 0) frozen, B = (1, 0)");
    talking.run("motor A B radius 1 speed 1rev; measure phi = turn(A, B) in deg; step 60");
    let shown = talking.ask("phi");
    assert_eq!(shown, talking.ask("show phi"));
    assert_eq!(shown[0], "measure phi = turn(A, B) in deg  # 61 values");
    assert!(shown.iter().any(|line| line.contains("max 360, at_max 1")), "{shown:?}");
    assert_eq!(number(&mut talking, "phi.at_max"), 1.0);
    assert!((number(&mut talking, "phi.mean") - 180.0).abs() < 1e-9);
    assert!((number(&mut talking, "phi.last * 1deg") / 4.0 - FRAC_PI_2).abs() < 1e-12);
}
