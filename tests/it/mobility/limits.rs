//! How far motors turn: `limits` against closed forms, and what runs do at dead points.

use crate::support::talk::Talking;
use linkwork::constraint::geometry::wrap;
use linkwork::mobility::{DriverRange, RangeEnd as End, Reach};
use linkwork::session::Session;

fn range(session: &Session, name: &str) -> DriverRange {
    let entity = session.world().names().get(name).unwrap_or_else(|| panic!("nothing is {name}"));
    session.range(entity).expect("it drives")
}

/// A four-bar of crank `a`, coupler `b`, rocker `c` and ground `d`, its crank at `theta` degrees.
fn four_bar(a: f64, b: f64, c: f64, d: f64, theta: f64) -> Talking {
    Talking::after(&format!(
        "point A = (0, 0) frozen, D = ({d}, 0) frozen
         point B = polar({a}, {theta}deg)
         point C = B + polar({b}, 60deg)
         crank: motor A B radius {a} speed 1rev phase {theta}deg
         length B C = {b}
         length C D = {c}
         solve within 1e-11"
    ))
}

/// Where the crank is as far from the ground pivot `d` as `e`, degrees.
fn reaching(a: f64, d: f64, e: f64) -> f64 {
    ((a * a + d * d - e * e) / (2.0 * a * d)).acos().to_degrees()
}

#[track_caller]
/// Both ends are dead points at these angles, degrees.
fn check_ends(talking: &Talking, lower: f64, upper: f64) {
    let Reach::Between(End::DeadPoint(from), End::DeadPoint(to)) =
        range(&talking.session, "crank").reach
    else {
        panic!("{:?}", range(&talking.session, "crank"))
    };
    let errors = [from.to_degrees() - lower, to.to_degrees() - upper];
    assert!(errors.iter().all(|e| e.abs() < 1e-9), "{errors:?}: {lower} {upper}");
}

#[track_caller]
fn check_full(talking: &Talking, change_points: &[f64]) {
    let found = range(&talking.session, "crank");
    assert_eq!(found.reach, Reach::Full(1), "{found:?}");
    let angles: Vec<f64> =
        found.change_points.iter().map(|a| wrap(*a).to_degrees().abs()).collect();
    assert_eq!(angles.len(), change_points.len(), "{found:?}");
    for expected in change_points {
        assert!(angles.iter().any(|a| (a - expected).abs() < 1e-6), "{angles:?}");
    }
}

#[test]
fn cranks_of_grashof_linkages_turn_fully() {
    check_full(&four_bar(1.0, 3.5, 3.0, 4.0, 20.0), &[]);
    // The ground is the shortest: a drag link.
    check_full(&four_bar(3.0, 2.5, 2.8, 1.0, 20.0), &[]);
}

#[test]
fn rockers_of_grashof_linkages_swing_between_two_dead_points() {
    for (a, b, c, d) in [(3.0, 3.5, 1.0, 4.0), (3.0, 4.0, 1.0, 3.5), (3.0, 1.0, 3.5, 4.0)] {
        let lower = reaching(a, d, b - c);
        let upper = reaching(a, d, b + c);
        let (lower, upper) = if b > c { (lower, upper) } else { (reaching(a, d, c - b), upper) };
        check_ends(&four_bar(a, b, c, d, 0.5 * (lower + upper)), lower, upper);
    }
}

#[test]
fn non_grashof_linkages_swing_symmetrically() {
    // Stretched at both ends.
    let upper = reaching(3.0, 4.0, 5.0);
    check_ends(&four_bar(3.0, 2.5, 2.5, 4.0, 40.0), -upper, upper);
    let upper = reaching(4.0, 3.0, 2.8 + 3.5);
    check_ends(&four_bar(4.0, 2.8, 3.5, 3.0, 50.0), -upper, upper);
    // Folded at both ends.
    let lower = reaching(2.0, 2.5, 4.4 - 1.5);
    check_ends(&four_bar(2.0, 4.4, 1.5, 2.5, 180.0), lower, 360.0 - lower);
}

#[test]
fn linkages_that_fold_flat_turn_fully_through_their_change_points() {
    check_full(&four_bar(1.0, 4.0, 1.0, 4.0, 50.0), &[0.0, 180.0]);
    // Through a single one it comes out folded the other way, and back the next time.
    let found = range(&four_bar(2.0, 3.0, 3.0, 4.0, 50.0).session, "crank");
    assert_eq!(found.reach, Reach::Full(2), "{found:?}");
    assert_eq!(found.change_points.len(), 2);
    assert!((found.change_points[0] - std::f64::consts::PI).abs() < 1e-8, "{found:?}");
}

#[test]
fn a_linkage_that_nearly_folds_flat_is_told_from_one_that_does() {
    let (b, c) = (4.0, 1.001);
    let upper = reaching(1.0, 4.0, b + c);
    assert!(upper.is_nan());
    // The crank is 0.001 too short for the rocker to follow all the way round on its branch,
    // and passes on the other one: twice round, or not.
    let found = range(&four_bar(1.0, b, c, 4.0, 50.0).session, "crank");
    assert!(matches!(found.reach, Reach::Full(_)) && found.change_points.is_empty(), "{found:?}");
    let lower = reaching(1.0, 4.0, 4.0 - 0.999);
    let upper = reaching(1.0, 4.0, 4.0 + 0.999);
    assert!(lower.is_finite() || upper.is_finite());
    let found = range(&four_bar(1.0, 4.0, 0.999, 4.0, 50.0).session, "crank");
    assert!(
        matches!(found.reach, Reach::Between(End::DeadPoint(_), End::DeadPoint(_))),
        "{found:?}"
    );
}

fn slider_crank(crank: f64, rod: f64, offset: f64, theta: f64, slide: &str) -> Talking {
    Talking::after(&format!(
        "point A = (0, 0) frozen, X = (-20, {offset}) frozen, Y = (20, {offset}) frozen
         point B = polar({crank}, {theta}deg), C = B + ({rod}, 0)
         crank: motor A B radius {crank} speed 1rev phase {theta}deg
         length B C = {rod}
         {slide}
         solve within 1e-11"
    ))
}

#[test]
fn slider_cranks_agree_with_closed_forms() {
    let on = "glider C on X Y unbounded";
    check_full(&slider_crank(1.0, 2.0, 0.5, 30.0, on), &[]);
    let upper = (0.6_f64).asin().to_degrees();
    check_ends(&slider_crank(1.0, 0.6, 0.0, 10.0, on), -upper, upper);
    let upper = (0.8_f64).asin().to_degrees();
    let lower = (0.3 - 0.5_f64).asin().to_degrees();
    check_ends(&slider_crank(1.0, 0.5, 0.3, 10.0, on), lower, upper);
    check_full(&slider_crank(1.0, 1.0, 0.0, 30.0, on), &[90.0, 90.0]);
}

#[test]
fn an_end_stop_stops_the_crank_where_it_says() {
    let mut talking =
        slider_crank(1.0, 2.0, 0.0, 90.0, "point Z = (2.5, 0) frozen; s: glider C on X Z");
    let found = range(&talking.session, "crank");
    let Reach::Between(End::Stop(from, _), End::Stop(to, _)) = found.reach else {
        panic!("{found:?}")
    };
    let at = (0.65_f64).acos().to_degrees();
    assert!((from.to_degrees() - at).abs() < 1e-9, "{}", from.to_degrees() - at);
    assert!((to.to_degrees() - (360.0 - at)).abs() < 1e-9, "{}", to.to_degrees());
    // The angles were held to 1e-9 above; here the words count.
    let told = talking.ask("limits crank").concat();
    assert!(told.starts_with("crank turns from 49.4583981"), "{told}");
    assert!(told.contains("deg, where s stops it, to 310.5416018"), "{told}");
    assert!(told.ends_with("deg, where s stops it; it is at 90 deg"), "{told}");
}

#[test]
fn a_cord_ends_the_way_too() {
    let talking = Talking::after(
        "point A = (0, 0) frozen, W = (-3, 0) frozen, B = (1, 0)
         crank: motor A B radius 1 speed 1rev
         cord: length W B >= 2.5
         solve",
    );
    let found = range(&talking.session, "crank");
    let Reach::Between(End::Stop(from, 1), End::Stop(to, 1)) = found.reach else {
        panic!("{found:?}")
    };
    let at = std::f64::consts::PI - ((1.0 + 9.0 - 6.25) / 6.0_f64).acos();
    assert!((from + at).abs() < 1e-11 && (to - at).abs() < 1e-11, "{from} {to} {at}");
}

#[test]
fn geared_motors_turn_until_what_they_drive_stops() {
    // The second wheel carries the input of a rocker; the first turns four times as far.
    let mut talking = Talking::after(
        "point O = (0, 0) frozen, P = (1, 0), A = (5, 0) frozen, B = A + polar(3, 60deg)
         crank: motor O P radius 1 speed 1rev
         cog O P, A B ratio -4
         point D = (9, 0) frozen, C = B + (1, 1)
         length A B = 3; length B C = 2; length C D = 3.5
         solve within 1e-11",
    );
    let found = range(&talking.session, "crank");
    let Reach::Between(End::DeadPoint(from), End::DeadPoint(to)) = found.reach else {
        panic!("{found:?}")
    };
    let swing = reaching(3.0, 4.0, 5.5) - reaching(3.0, 4.0, 1.5);
    assert!(((to - from).to_degrees() - 4.0 * swing).abs() < 1e-8, "{}", (to - from).to_degrees());
    assert_eq!(talking.ask("limits crank").len(), 1);
}

#[test]
fn what_else_time_drives_is_held() {
    let mut talking = four_bar(3.0, 2.5, 2.5, 4.0, 40.0);
    talking.run("change crank speed 0rev\nchange length1 = 2.5 + 0.5 * time\nset dt 0.1\nstep 10");
    let upper = reaching(3.0, 4.0, 5.5);
    check_ends(&talking, -upper, upper);
}

#[test]
fn limits_says_what_it_cannot_tell() {
    let mut chain = Talking::after(
        "point A = (0, 0) frozen, B = (1, 0), C = (2, 1), D = (3, 0), E = (3.5, 0) frozen
         crank: motor A B radius 1 speed 1rev
         length B C = 1; length C D = 1; length D E = 1
         solve",
    );
    let told = chain.ask("limits crank");
    assert_eq!(
        told,
        ["it cannot be told how far crank turns: another freedom leaves the motion open"]
    );
    let mut loose = Talking::after(
        "point A = (0, 0) frozen, B = (1, 0), C = (2, 0)\ncrank: motor A B speed 1rev\nlength B C",
    );
    assert_eq!(loose.ask("limits crank"), ["crank turns fully"]);
    let mut broken = four_bar(3.0, 2.5, 2.5, 4.0, 40.0);
    broken.run("change length2 = 20\nsolve");
    let told = broken.ask("limits crank");
    assert_eq!(told, ["it cannot be told how far crank turns: the constraints do not hold now"]);
    let mut off = four_bar(3.0, 2.5, 2.5, 4.0, 40.0);
    assert_eq!(off.ask("off crank; limits crank"), ["crank is switched off"]);
    let told = off.ask("limits length1").concat();
    assert!(told.starts_with("length1 goes from 0, beyond which there would be a"), "{told}");
    let mut measured = four_bar(1.0, 3.5, 3.0, 4.0, 20.0);
    let told = measured.ask("change length1 = 3.5 + 0.001 * C.x; limits crank");
    assert_eq!(told, ["crank turns fully"]);
}

#[test]
fn a_steering_rack_goes_until_an_arm_is_in_line_with_its_rod() {
    let script = include_str!("../../../scripts/gallery/ackermann-steering.link");
    let (at_rest, _) = script.split_once("set dt").expect("it runs after it was set up");
    let found = range(&Talking::after(at_rest).session, "rack");
    let Reach::Between(End::DeadPoint(from), End::DeadPoint(to)) = found.reach else {
        panic!("{found:?}")
    };
    // The end of the rack and the knuckle are an arm and a tie rod apart.
    let (track, base, arm, half, low) = (1.4_f64, 2.6_f64, 0.15, 0.3, 0.19);
    let lean = (0.5 * track).atan2(base);
    let rod = (0.5 * track - arm * lean.sin() - half).hypot(arm * lean.cos() - low);
    let reach = ((arm + rod).powi(2) - low * low).sqrt() - (0.5 * track - half);
    let errors = [from - (-reach - half), to - (reach - half)];
    assert!(errors.iter().all(|e| e.abs() < 1e-9), "{errors:?}");
}

#[test]
fn a_jansen_leg_turns_fully() {
    let script = include_str!("../../../scripts/hard/jansen.link");
    let mut talking = Talking::after(&format!(
        "{script}\npoint O = (0, 0) frozen\nuse jansen(O, 1) as leg\nsolve"
    ));
    let told = talking.ask("limits leg.crank");
    assert_eq!(told, ["leg.crank turns fully"]);
}

/// A rocker that meets its dead point at 90 degrees, a degree a frame.
fn run_into(policy: &str) -> Talking {
    let mut talking = four_bar(3.0, 2.5, 2.5, 4.0, 40.0);
    talking.run(&format!("set dt 1/360\nset dead-points {policy}"));
    talking.talk.told();
    talking
}

#[test]
fn a_held_motor_says_where_its_dead_point_is_once_and_picks_up_again() {
    let mut talking = run_into("hold");
    talking.run("step 60\nstep 20");
    let told = talking.talk.told();
    let met: Vec<_> = told.iter().filter(|t| t.contains("dead point")).collect();
    let at = reaching(3.0, 4.0, 5.0);
    let at = format!("{}", (at * 1e9).round() / 1e9);
    let expected = format!(
        "crank meets a dead point at {at} deg in frame 51; the best fit is held until it can go on"
    );
    assert_eq!(met, [&expected], "{told:?}");
    // The dead points lie at +-86.4: it comes in again from the other side.
    talking.run("step 160\nstep 10 within 1e-9\nassert distance(C, D) = 2.5 within 1e-9");
}

#[test]
fn a_run_may_end_at_the_last_good_frame() {
    let mut talking = run_into("stop");
    talking.run("trace C\nstep 60");
    assert_eq!(talking.session.world().clock().frame, 50);
    assert_eq!(talking.session.world().traces()[0].samples.len(), 50);
    let told = talking.talk.told();
    assert!(told[0].ends_with("deg: stopped after 50 of 60 frames"), "{told:?}");
    talking.run("assert distance(C, D) = 2.5 within 1e-9\nassert angle(A, B) = 90deg within 1e-9");
    talking.run("step 3\nundo 2\nassert angle(A, B) = 40deg within 1e-9");
}

#[test]
fn a_run_that_ends_early_is_as_one_that_was_never_longer() {
    // Frames that are done again keep to the tolerance that was asked of them.
    for promise in ["", "within 1e-3"] {
        let mut stopped = run_into("stop");
        stopped.run("trace C\nexpose every 7\nrecord \"a.csv\"");
        stopped.run(&format!("step 60 {promise}"));
        let mut stepped = run_into("stop");
        stepped.run("trace C\nexpose every 7\nrecord \"a.csv\"");
        stepped.run(&format!("for i in 1..50 {{ step 1 {promise} }}"));
        assert_eq!(stopped.session.to_script(), stepped.session.to_script(), "{promise}");
        let table = |talking: &mut Talking| {
            talking.run("record stop");
            std::mem::take(&mut talking.talk.files)
        };
        assert_eq!(table(&mut stopped), table(&mut stepped), "{promise}");
    }
}

#[test]
fn a_motor_may_turn_back() {
    let mut talking = run_into("reverse");
    talking.run("step 60");
    let told = talking.talk.told();
    // The receipt of the run follows.
    assert!(told.len() == 2 && told[0].ends_with("in frame 51; it turns back"), "{told:?}");
    talking.run("assert angle(A, B) = 80deg within 1e-9\nassert distance(C, D) = 2.5 within 1e-9");
    let kept = talking.session.to_script();
    assert!(kept.contains("set dead-points reverse"), "{kept}");
    let mut again = Talking::after(&kept);
    for both in [&mut talking, &mut again] {
        both.run("step 500");
    }
    assert_eq!(talking.session.to_script(), again.session.to_script());
    talking.run("undo 2\nassert angle(A, B) = 40deg within 1e-9\nstep 10\nassert angle(A, B) = 50deg within 1e-9");
    talking.run("undo\nredo\nassert angle(A, B) = 50deg within 1e-9");
}

#[test]
fn a_speed_that_is_an_expression_is_its_negative_after_the_motor_turned_back() {
    let mut talking = run_into("reverse");
    talking.run("change crank speed 1rev * (1 + time)\nstep 60");
    let told = talking.talk.told();
    assert!(told.len() == 2 && told[0].ends_with("in frame 47; it turns back"), "{told:?}");
    // After n frames it would have turned by n + n^2 / 720 degrees: from 40 by 50 in frame 47.
    let turned = "46 + 46^2 / 720";
    talking.run(&format!(
        "let back = 60 + 60^2 / 720 - ({turned})
         assert angle(A, B) = (40 + {turned} - back) * 1deg within 1e-9
         assert distance(C, D) = 2.5 within 1e-9"
    ));
    let mut again = Talking::after(&talking.script());
    for both in [&mut talking, &mut again] {
        both.run("step 20; assert angle(A, B) = (40 + 2 * (46 + 46^2 / 720) - 80 - 80^2 / 720) * 1deg within 1e-9");
    }
    assert_eq!(talking.script(), again.script());
    talking.run("undo 3; step 10; assert angle(A, B) = (50 + 100 / 720) * 1deg within 1e-9");
    talking
        .run("step 50; assert angle(A, B) = (40 + 2 * (46 + 46^2 / 720) - 65) * 1deg within 1e-9");
    let speed = |talking: &mut Talking| talking.ask("list constraints").concat();
    assert!(speed(&mut talking).contains("speed -("), "{}", speed(&mut talking));
    talking.run("step 150");
    assert!(!speed(&mut talking).contains("speed -("), "{}", speed(&mut talking));
}

#[test]
fn a_motor_that_turned_back_still_follows_its_parameters() {
    let mut talking = run_into("reverse");
    talking.run("let w = 1rev; change crank speed w; step 60");
    talking.run("assert angle(A, B) = 80deg within 1e-9");
    talking.run("let w = 2rev; step 5; assert angle(A, B) = 70deg within 1e-9");
}

#[test]
fn an_unknown_way_to_meet_a_dead_point_lists_the_known() {
    let mut talking = run_into("hold");
    let problem = talking.execute("set dead-points revers").unwrap_err();
    assert_eq!(&*problem.message, "`revers` is not what happens at a dead point");
    assert_eq!(problem.helps, ["did you mean `reverse`?"]);
}

#[test]
fn a_jump_to_the_other_branch_is_not_silent() {
    // Dragged in one frame past a place that is out of reach: nothing says on which side C
    // comes out, but if it changed sides that is told.
    let mut talking = Talking::after(
        "point A = (0, 0) frozen, B = (2, 0) frozen, C = (1, 0.4)
         length A C = 1.2; length B C = 1.1
         solve
         drag B to (-2, -0.1) over 1",
    );
    let told = talking.talk.told();
    // The line AB has turned round, C has not.
    let is_over = talking.session.world().points().column()[2].y > 0.0;
    assert_eq!(told.iter().any(|t| t.contains("may have changed branch")), is_over, "{told:?}");
    talking.run("drag B to (2, 0) over 1\ndrag B to (-2, -0.1) over 100");
}

#[test]
fn each_frame_that_may_have_changed_branch_is_told_but_not_all_of_very_many() {
    let mut talking = Talking::after(
        "point A = (0, 0) frozen, B = (2, 0) frozen, C = (1, 0.4)
         length A C = 1.2; length B C = 1.1
         solve",
    );
    talking.talk.told();
    // To the other side of A and back, each time in one frame.
    talking.run("for i in 1..7 { drag B to (-2, -0.1) over 1; drag B to (2, 0.1) over 1 }");
    let told = talking.talk.told();
    assert_eq!(told[0], "14 frames may have changed branch, the first is frame 1");
    let summary = talking.session.last_run().unwrap();
    let frames: Vec<u64> = summary.turned_over.iter().map(|(frame, _)| *frame).collect();
    assert_eq!((frames, summary.n_turned_over), (vec![1, 2, 3, 4, 5], 14));
    talking.run("drag B to (1.9, 0) over 20");
    assert_eq!(talking.session.last_run().unwrap().n_turned_over, 0);
}

#[test]
fn what_changed_branch_is_named_though_it_is_gone() {
    for after in ["delete C cascade", "clear", "clear; point D = (0, 0), E = (1, 0), F = (2, 0)"] {
        let mut talking = Talking::after(
            "point A = (0, 0) frozen, B = (2, 0) frozen, C = (1, 0.4)
             length A C = 1.2; length B C = 1.1
             solve",
        );
        talking.talk.said.clear();
        talking.run(&format!("for i in 1..1 {{ drag B to (-2, -0.1) over 1; {after} }}"));
        let said = &talking.talk.said;
        assert!(said.contains("`C` changed sides in a single jump"), "{said}");
    }
}

/// A crank-rocker with change points or dead points, and what else hangs on it.
fn with_followers(followers: &str) -> [Talking; 2] {
    let scene = |lengths: [f64; 4], theta: f64| {
        let [a, b, c, d] = lengths;
        Talking::after(&format!(
            "point A = (0, 0) frozen, D = ({d}, 0) frozen
             point B = polar({a}, {theta}deg), C = ({d}, {c})
             length B C = {b}; length C D = {c}
             crank: motor A B radius {a} speed 1rev phase {theta}deg
             solve
             {followers}"
        ))
    };
    [scene([1.0, 3.0, 2.0, 4.0], 60.0), scene([3.0, 2.5, 2.5, 4.0], 40.0)]
}

#[test]
fn what_constrains_nothing_changes_no_limit() {
    let upper = reaching(3.0, 4.0, 5.0);
    for followers in [
        "",
        "point P = B + 3 * (C - B); hinge P on B C at 3",
        "point P = B + 1000 * (C - B); hinge P on B C at 1000",
        "point P = B + 1000 * (C - B), Q = P + 7 * (A - P)
         hinge P on B C at 1000; hinge Q on P A at 7",
        "point P = C; coincidence P C; point F = (1e5, 1e5) frozen",
        "point F = (-3e4, 2e4) frozen, G = (-3e4, 2.1e4); length F G = 1000",
    ] {
        let [folding, swinging] = with_followers(followers);
        let found = range(&folding.session, "crank");
        assert_eq!(found.reach, Reach::Full(2), "{followers}: {found:?}");
        // It folds flat once a turn, as a + d = b + c: with the crank away from the other pivot.
        assert_eq!(found.change_points.len(), 2, "{followers}: {found:?}");
        for at in found.change_points {
            assert!((wrap(at).abs().to_degrees() - 180.0).abs() < 1e-6, "{followers}: {at}");
        }
        check_ends(&swinging, -upper, upper);
    }
}

#[test]
fn what_stands_around_a_mechanism_changes_no_bit_of_a_limit() {
    let around = "for i in 1..40 {
        point P[i] = (5 * i, 9) frozen, Q[i] = (5 * i + 1, 9), R[i] = (5 * i + 2, 12)
        length P[i] Q[i] = 1; length Q[i] R[i] = 3.2; motor P[i] Q[i] speed 0
    }";
    let mechanisms = [
        "point A = (0, 0) frozen, D = (4, 0) frozen, B = (1, 0), C = (3, 3)
         crank: motor A B radius 1 speed 1rev; length B C = 3.5; length C D = 3; solve",
        "point A = (0, 0) frozen, D = (4, 0) frozen, B = (1.5, 1), C = (3, 2)
         crank: motor A B radius 1.8 speed 1rev; length B C = 2.2; length C D = 1.6; solve",
        "point A = (0, 0) frozen, B = (0, 1), S = (3, 0.4), E = (20, 0.4) frozen, F = (-9, 0.4) frozen
         crank: motor A B radius 1 speed 1rev; length B S = 2.5; glider S on F E unbounded; solve",
        "let l = 3.5; point A = (0, 0) frozen, D = (4, 0) frozen, B = (1, 0), C = (3, 3), E = (6, 3)
         point G = (8, 0) frozen, H = (7, 3)
         crank: motor A B radius 1 speed 1rev; length B C = l; length C D = 3; length C E = 3
         length D E = 3.6; length E H = 2; length H G = 3; solve",
    ];
    for mechanism in mechanisms {
        let alone = Talking::after(mechanism);
        let first = Talking::after(&format!("{mechanism}; {around}"));
        let last = Talking::after(&format!("{around}; {mechanism}"));
        let names: &[&str] = if mechanism.contains("let l") { &["crank", "l"] } else { &["crank"] };
        for name in names {
            let wanted = format!("{:?}", range(&alone.session, name));
            for crowd in [&first, &last] {
                // Places in the scene are told of nothing here: no stop ends a way.
                assert_eq!(format!("{:?}", range(&crowd.session, name)), wanted, "{mechanism}");
            }
        }
    }
}
