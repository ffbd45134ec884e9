//! `fit`: numbers that were planted, minima of closed forms, and that it is one step of undo.

use std::path::PathBuf;

use linkwork::session::{Answer, Flow, Quota};
use linkwork::{Session, errors};

use crate::support::compare::check_same;
use crate::support::talk::Talking;

fn number(talking: &mut Talking, expression: &str) -> f64 {
    let value = talking.session.evaluate(expression);
    value.unwrap_or_else(|problem| panic!("{expression}: {}", problem.message)).number()
}

/// A four-bar with a coupler point, its lengths parameters.
const FOUR_BAR: &str = "
    point A = (0, 0) frozen, D = (4, 0) frozen, B = (1, 0), C = (3, 3), E = (2, 3)
    motor A B radius 1 speed 1rev
    length B C = b
    length C D = c
    length B E = e
    length C E = f
    set dt 1/60
";

#[test]
fn planted_lengths_are_recovered_from_the_coupler_curve() {
    let planted = [("b", 3.5), ("c", 3.1), ("e", 2.05), ("f", 2.2)];
    let mut answer = Answer::default();
    let lets = |of: &[(&str, f64)]| {
        let lets: Vec<String> =
            of.iter().map(|(name, value)| format!("let {name} = {value}; ")).collect();
        lets.concat()
    };
    let mut drawn = Session::new();
    let script = format!(
        "{}{FOUR_BAR} solve; record \"curve.csv\" of time, E; step 60; record stop",
        lets(&planted)
    );
    let source = drawn.add_source("drawn", &script, None);
    drawn.execute_all(source, &mut answer).expect("it is drawn");
    let mut session = Session::new();
    let script = format!(
        "{}{FOUR_BAR} solve
         fit b in 3..4, c in 2.6..3.6, e in 1.5..2.5, f in 1.7..2.7 to \"curve.csv\"",
        lets(&[("b", 3.3), ("c", 3.3), ("e", 2.3), ("f", 2.0)])
    );
    let source = session.add_source("fitted", &script, None);
    session.execute_all(source, &mut answer).expect("it is fitted");
    for (name, wanted) in planted {
        let found = session.evaluate(name).expect("a parameter").number();
        assert!((found - wanted).abs() < 1e-9, "{name} is {found}, not {wanted}");
    }
    let told: Vec<String> = answer.told.iter().map(ToString::to_string).collect();
    let told = told.join("\n");
    assert!(told.contains("root mean square distance") && told.contains(" runs"), "{told}");
}

/// The height of the tracing point of a Hoeken linkage of crank 1, the other bars as long as `l`, the
/// pivots `g` apart, at a crank angle.
fn height(g: f64, l: f64, t: f64) -> Option<f64> {
    let b = (t.cos(), t.sin());
    let (ex, ey) = (g - b.0, -b.1);
    let apart = ex.hypot(ey);
    if apart > 2.0 * l {
        return None;
    }
    let up = (l * l - 0.25 * apart * apart).sqrt();
    // The middle joint, above the line of the pivots; the tracing point is as far beyond it.
    let joint = b.1 + 0.5 * ey + up * ex / apart;
    Some(2.0 * joint - b.1)
}

fn straightness(g: f64, l: f64) -> Option<f64> {
    let angle = |k: i32| std::f64::consts::FRAC_PI_2 + f64::from(k) * std::f64::consts::PI / 600.0;
    let heights: Option<Vec<f64>> = (0..=600).map(|k| height(g, l, angle(k))).collect();
    let heights = heights?;
    let most = heights.iter().copied().fold(f64::MIN, f64::max);
    Some(most - heights.iter().copied().fold(f64::MAX, f64::min))
}

#[test]
fn a_hoeken_linkage_is_made_straighter() {
    let mut talking = Talking::after(
        "let g = 2, l = 2.5
         point A = (0, 0) frozen, D = (2, 0), B = (0, 1), C = (1.5, 2.5), P = (3, 4)
         coordinate D at (g, 0)
         motor A B radius 1 phase 90deg speed 1rev
         length B C = l
         length C D = l
         hinge P on B C at 2
         set dt 1/120
         solve
         measure d = P.y
         step 60",
    );
    let before = number(&mut talking, "d.span");
    let wanted = straightness(2.0, 2.5).expect("it can be assembled");
    assert!((before - wanted).abs() < 1e-4 * wanted, "{before} {wanted}");
    talking.run("reset");
    let whole = talking.script();
    talking.run("fit g in 1.6..2.4, l in 2..3 to minimise d.span over 60");
    let (g, l) = (number(&mut talking, "g"), number(&mut talking, "l"));
    let after = straightness(g, l).expect("it can be assembled");
    assert!(after < 0.4 * before, "{after} at {g}, {l}; {before} before");
    // No place of a grid is better.
    for i in 0..=80 {
        for j in 0..=80 {
            let (g, l) = (1.6 + 0.01 * f64::from(i), 2.0 + 0.0125 * f64::from(j));
            let there = straightness(g, l).unwrap_or(f64::MAX);
            assert!(after <= there * (1.0 + 1e-3) + 1e-6, "{after}, but {there} at {g}, {l}");
        }
    }
    // The run from here is the one that was found best.
    talking.run("measure d = P.y; step 60");
    let measured = number(&mut talking, "d.span");
    assert!((measured - after).abs() < 1e-4 * after + 1e-9, "{measured} {after}");
    talking.run("undo 3");
    check_same(&talking.script(), &whole, "undone");
}

#[test]
fn the_least_and_the_greatest_of_a_pose_are_found_without_frames() {
    let mut talking = Talking::after(
        "let r = 1, s = 0.5
         point A = (0, 0) frozen, B = (1, 0)
         length A B = r
         hold angle(A, B) = s",
    );
    talking.run("fit r in 0.5..3, s in 0..1.5 to minimise abs(B.x - 1) + abs(B.y - 1)");
    assert!((number(&mut talking, "r") - 2.0_f64.sqrt()).abs() < 1e-6);
    assert!((number(&mut talking, "s") - std::f64::consts::FRAC_PI_4).abs() < 1e-6);
    // The pose is that of the numbers.
    assert!((number(&mut talking, "B.x") - 1.0).abs() < 1e-5);
    talking.run("fit s in 0..1.5 to maximise B.x + B.y");
    assert!((number(&mut talking, "s") - std::f64::consts::FRAC_PI_4).abs() < 1e-4);
}

#[test]
fn it_is_told_how_good_it_is_and_where_a_range_ends() {
    let mut talking = Talking::after(
        "let r = 1.5; point A = (0, 0) frozen, B = (1.5, 0)
         motor A B radius r speed 1rev; set dt 1/60; measure d = B.x",
    );
    talking.talk.told.clear();
    talking.run("fit r in 1..2 to minimise d.span over 60");
    let told = talking.talk.told();
    assert!(told.iter().any(|it| it == "r = 1"), "{told:?}");
    let how = told.iter().find(|it| it.starts_with("d.span = ")).expect("how good it is");
    assert!(how.contains("2, 3 before; ") && how.contains(" runs"), "{how}");
    assert!(told.iter().any(|it| it.contains("at the end of its range")), "{told:?}");
    // What was measured before is as it was.
    assert_eq!(number(&mut talking, "d.count"), 1.0);
    let again = talking.session.evaluate("r").expect("it is there").number().to_bits();
    talking.run("undo; fit r in 1..2 to minimise d.span over 60");
    assert_eq!(number(&mut talking, "r").to_bits(), again);
}

/// A crank that is stopped and turned back by its rod, which is `l`; how far the slider goes.
const STOPPED: &str = "
    let l = 1.4
    point O = (0, 0) frozen, P = (2, 0), S = (3.4, 0), E = (20, 0) frozen
    crank: motor O P radius 2 speed 1rev
    length P S = l
    glider S on O E unbounded
    set dt 1/20
    measure x = S.x
    measure y = P.y";

#[test]
fn a_trial_is_a_run() {
    // Whatever a run heeds: motors that turn back, extremes of frames alone, what is exposed or traced.
    for settings in [
        "set dead-points reverse",
        "set dead-points reverse; set measures sampled",
        "set dead-points reverse; trace S; expose every 7; trace P every 5",
        "set dead-points reverse; set method relaxation; set iterations 3000",
        "set measures sampled; change crank speed 1/50 * 1rev",
        "change crank speed 1/50 * 1rev",
    ] {
        let mut talking = Talking::after(&format!("{STOPPED}\n{settings}"));
        talking.talk.told.clear();
        talking.run("fit l in 1.2..1.6 to maximise x.span over 30");
        let told = talking.talk.told();
        let best = told.iter().find_map(|it| it.strip_prefix("l = ")).expect("the best");
        let best: f64 = best.parse().expect("a number");
        assert_eq!(number(&mut talking, "l").to_bits(), best.to_bits());
        let how =
            told.iter().find(|it| it.starts_with("x.span = ")).expect("how good it is").clone();
        talking.run("measure x = S.x; step 30");
        let found = number(&mut talking, "x.span");
        let said = how["x.span = ".len()..].split(',').next().expect("a value").to_owned();
        let said: f64 = said.parse().expect("a number");
        assert!((found - said).abs() < 0.01 * said, "{settings}: {found}, but {how}");
    }
    // Where the run ends before its frames, nothing is found.
    let mut talking = Talking::after(&format!("{STOPPED}\nset dead-points stop"));
    let problem =
        talking.execute("fit l in 1.2..1.6 to maximise x.span over 30").expect_err("stopped");
    assert!(talking.drawn(&problem).contains("none of these numbers gives a motion"));
}

#[test]
fn a_trial_is_left_between_two_frames() {
    let crank = "let r = 1.5; point A = (0, 0) frozen, B = (1.5, 0)
         motor A B radius r speed 1rev; measure d = B.x";
    let mut talking = Talking::after(crank);
    talking.talk.n_polls.set(0);
    talking.run("fit r in 1..2 to minimise d.span over 2000");
    let told = talking.talk.told();
    let (runs, _) = told.iter().find_map(|it| it.split_once(" runs")).expect("how many");
    let runs: u64 = runs.rsplit(' ').next().and_then(|n| n.parse().ok()).expect("a number");
    let n_polls = talking.talk.n_polls.get();
    assert!(n_polls > 20 * runs, "asked {n_polls} times in {runs} trials");
    // In the first as in any other: then nothing has changed.
    for most in [0, 30, n_polls / 2, n_polls - 30] {
        let mut talking = Talking::after(crank);
        let before = talking.script();
        talking.talk.n_polls.set(0);
        talking.talk.most_polls = Some(most);
        let flow = talking.execute("fit r in 1..2 to minimise d.span over 2000");
        assert_eq!(flow.expect("it is stopped"), Flow::Stopped, "after {most}");
        check_same(&talking.script(), &before, "stopped");
    }
    let mut talking = Talking::after(crank);
    talking.talk.tick = 0.01;
    talking.session.limit(Quota::Seconds, 1);
    let problem =
        talking.execute("fit r in 1..2 to minimise d.span over 1e6").expect_err("too long");
    assert!(talking.drawn(&problem).contains("`seconds`"));
}

#[test]
fn a_trial_keeps_no_more_than_a_run_may() {
    let check = |limit: (Quota, u64), script: &str, table: &str, wanted: &str| {
        let mut talking = Talking::after(
            "let r = 1.5; point A = (0, 0) frozen, B = (1.5, 0)
             motor A B radius r speed 1rev; set dt 1/60; measure d = B.x; measure e = B.y",
        );
        talking.talk.files.insert(PathBuf::from("c.csv"), table.to_owned());
        talking.session.limit(limit.0, limit.1);
        let problem = talking.execute(script).expect_err(script);
        let drawn = talking.drawn(&problem);
        assert!(drawn.contains(wanted), "{script}: {drawn}");
    };
    let span = "fit r in 1..2 to minimise d.span over";
    check((Quota::Frames, 99), &format!("{span} 100"), "", "expected 0 to 99 frames");
    check((Quota::MeasureSamples, 199), &format!("{span} 99"), "", "`measure-samples` is exceeded");
    let path = "fit r in 1..2 to \"c.csv\"";
    let table = "time,B.x,B.y\n0,1,0\n1,1,0\n";
    check((Quota::Frames, 59), path, table, "`frames` is exceeded");
    check((Quota::TraceSamples, 60), path, table, "`trace-samples` is exceeded");
    let endless = "time,B.x,B.y\n0,1,0\n1e14,1,0\n";
    check((Quota::Points, 9), path, endless, "`frames` is exceeded");
}

#[test]
fn what_is_over_the_columns_of_a_path_is_read_as_it_is_written() {
    // A unit, and an expression with a comma in it: they come before the point.
    let mut talking = Talking::after(
        "let r = 1.25; point A = (0, 0) frozen, C = (1.25, 0)
         crank: motor A C radius r speed 1rev; set dt 1/60
         record \"c.csv\" of angle(A, C) in deg, time in ms, distance(A, C), C
         step 30; record stop; reset; let r = 1",
    );
    talking.run("fit r in 0.5..2 to \"c.csv\"");
    assert!((number(&mut talking, "r") - 1.25).abs() < 1e-9);
}

#[test]
fn a_table_that_is_no_path_says_what_is_wrong() {
    let check = |table: &str, wanted: &str| {
        let mut talking = Talking::after("let r = 1; point A = (0, 0) frozen, C = (1, 0)");
        talking.run("length A C = r");
        talking.talk.files.insert(PathBuf::from("c.csv"), table.to_owned());
        let problem = talking.execute("fit r in 0.5..2 to \"c.csv\"").expect_err(table);
        assert_eq!(problem.code, Some(errors::NOT_A_PATH), "{table:?}");
        let drawn = talking.drawn(&problem);
        assert!(drawn.contains(wanted), "{table:?}: {drawn}");
    };
    check("", "no columns `P.x` and `P.y`");
    check("time,Q.x,Q.y\n0,1,2\n", "no columns `P.x` and `P.y`");
    check("time,C.x,C.y\n", "it has no row");
    check("time,C.x,C.y\n0,1\n", "row 1 has no number under `C.y`");
    check("time,C.x,C.y\n0,1,1\n0.01,1,1\n", "row 2 is between two frames");
    check("C.x,C.y\n1,one\n", "row 1 has no number under `C.y`");
    check("\"C.x\",\"C.y\"\n1,\"one\"\n", "row 1 has no number under `C.y`");
    check("time in ms,C.x,C.y\n0,1,1\n1,1,1\n", "row 2 is between two frames");
    check("time in weeks,C.x,C.y\n0,1,1\n", "`time in weeks`: no unit `weeks`");
    check("C.x,\"C.y\n", "no columns `P.x` and `P.y`");
}
