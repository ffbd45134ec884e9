//! Bodies: points that bars tie together, or `rigid`, and what hangs on them.

use super::closed_form::{bits, check_same, scene};
use crate::support::draws::draws;
use crate::support::talk::Talking;
use linkwork::constraint::{ConstraintKind as _, Point};
use proptest::prelude::*;

/// A crank and a rocker, between which a coupler is missing.
const ENDS: &str = "point A = (0, 0) frozen, D = (4, 0) frozen, B = (1, 0), C = (3, 3)
    motor A B radius 1 speed 1rev
    length C D
    set dt 1/72";

/// A truss from B to C with both diagonals in each field, and no bar that joins its ends.
const TRUSS: &str = "point P = (1, 1), Q = (2, 0.3), R = (1.8, 2), S = (2.8, 1.4)
    length B P; length B Q; length P Q; length P R
    tie: length Q R; length P S; length Q S; length R S; length R C; length S C";

/// The lengths of a scene's bars, each against what it is to be.
#[track_caller]
pub fn check_bars(talking: &Talking) {
    for (_, record) in talking.world().constraints().filter(|(_, record)| record.is_on) {
        let x = talking.world().points().column();
        let violation = record.constraint.violation(x, &talking.world().points().inverse_masses());
        assert!(violation <= 4e-12, "{:?}: {violation:e}", record.constraint);
    }
}

/// Lets frames pass, none of which is found in another way than by closed steps but the first, and
/// what must be.
#[track_caller]
pub fn check_closed(scene: &str, n: u64) -> Talking {
    let mut talking = Talking::after(&format!("{scene}\nstep"));
    let before = talking.session.frame_counts();
    talking.run(&format!("step {n}"));
    let after = talking.session.frame_counts();
    assert_eq!(after.closed - before.closed, n, "{after:?}\n{scene}");
    check_bars(&talking);
    talking
}

/// Where B and C are after frames with a bar of that length between them.
fn four_bar(length: f64, n: u64) -> Talking {
    Talking::after(&format!("{ENDS}\nlength B C = {length:?}\nstep {n}"))
}

/// The distance of two points.
fn distance(talking: &Talking, a: &str, b: &str) -> f64 {
    let [a, b] = [a, b].map(|p| talking.session.position(p).unwrap());
    a.distance(b)
}

#[test]
fn a_truss_goes_as_a_bar_between_its_ends_would() {
    let rigid = "point P = (1, 2), Q = (2, 2.5), R = (3, 1)
        rigid B P Q
        length P R; length Q R; length Q C; length R C";
    for body in [TRUSS, rigid, "point P = (2, 1)\nrigid B P C", "point P = (2, 3)\nrigid P C B"] {
        let scene = format!("{ENDS}\n{body}");
        let length = distance(&Talking::after(&scene), "B", "C");
        let talking = check_closed(&scene, 71);
        let plain = four_bar(length, 72);
        for p in ["B", "C"] {
            let [one, other] = [&talking, &plain].map(|t| t.session.position(p).unwrap());
            assert!(one.distance(other) < 1e-11, "{p} in {body}: {one:?} {other:?}");
        }
        check_same(body, &scene, 60);
    }
}

#[test]
fn bodies_hang_on_each_other_and_on_lines() {
    let hinged = "point P = (1, 1.5), Q = (2.4, 1), R = (4.4, 1.5), S = (3.2, 1)
        length B P; length B Q; length P Q; length P C; length Q C
        length D R; length D S; length R S; length R C; length S C
        point E = (6, 2), F = (7, 0) frozen
        length R E = 2.5; length F E = 2.5";
    let sliding = "point L = (-9, 1.5) frozen, K = (9, 1.5) frozen, P = (2, 1), Q = (2, 2)
        length B P; length P Q; length B Q; length P C; length Q C
        glider C on L K unbounded";
    let turned = "point P = (2, 0), Q = (2.5, 1), R = (3.5, 1)
        length B P; length P Q; length B Q; length P R; length Q R
        orientation B P, A D = 20deg * sin(time * 1rev)";
    let ends = ENDS.replace("length C D", "");
    let hinged = format!("{}\n{hinged}", ends.replace("C = (3, 3)", "C = (3, 2.6)"));
    let sliding = format!("{}\n{sliding}", ends.replace("C = (3, 3)", "C = (4, 1.5)"));
    for scene in [hinged, sliding, format!("{ends}\n{turned}")] {
        check_closed(&scene, 71);
        check_same("hanging", &scene, 60);
    }
}

/// A net of squares with both diagonals, held by a frozen corner; another point is heavy.
fn net(n: u32) -> String {
    format!(
        "for i in 0..{n} {{ for j in 0..{n} {{ point p[i][j] = (i, j) }} }}
         for i in 0..{n} {{ for j in 1..{n} {{ length p[i][j-1] p[i][j] = 1; length p[j-1][i] p[j][i] = 1 }} }}
         for i in 1..{n} {{ for j in 1..{n} {{
             length p[i-1][j-1] p[i][j] = sqrt(2); length p[i-1][j] p[i][j-1] = sqrt(2)
         }} }}
         freeze p[0][0]"
    )
}

#[test]
fn a_body_that_is_dragged_by_a_corner_turns_no_farther_than_it_has_to() {
    let scene = net(4);
    check_same("net", &format!("{scene}\ndrag p[0][0] to (0.3, 0.1) over 30"), 3);
    let mut talking = Talking::after(&format!("{scene}\ndrag p[0][0] to (0.01, 0.005)  over 1"));
    let places = |talking: &Talking| -> Vec<_> {
        let points = talking.world().points();
        points.ids().map(|p| points.at(p)).collect()
    };
    for k in 2..20 {
        let before = places(&talking);
        talking.run(&format!("drag p[0][0] to {k} * (0.01, 0.005) over 1"));
        let after = places(&talking);
        // About its corner no other turn brings its points nearer to where they were.
        let way = |turn: f64| -> f64 {
            let there = |p: Point| after[0] + (p - after[0]).rotate(turn);
            before.iter().zip(&after).map(|(old, new)| (there(*new) - *old).norm_squared()).sum()
        };
        assert!(way(0.0) <= way(1e-6) && way(0.0) <= way(-1e-6), "frame {k}");
        check_bars(&talking);
    }
    assert!(talking.session.frame_counts().closed >= 18, "{:?}", talking.session.frame_counts());
}

#[test]
fn a_truss_that_turns_as_a_whole_is_one_step() {
    // Joint by joint from its base, how far each went at most is not known well enough.
    let scene = net(8).replace("freeze p[0][0]", "freeze p[0][0]; delete length2");
    let scene = format!("{scene}\nmotor p[0][0] p[1][0] radius 1 speed 1rev\nset dt 1/360");
    let talking = check_closed(&scene, 29);
    let [far, centre] = ["p[8][8]", "p[0][0]"].map(|p| talking.session.position(p).unwrap());
    let turned = linkwork::constraint::Vector::new(8.0, 8.0).rotate(std::f64::consts::TAU / 12.0);
    assert!((far - centre - turned).norm() < 1e-11);
    check_same("turned", &scene, 9);
}

#[test]
fn a_bar_that_is_changed_or_taken_off_dissolves_the_body() {
    let scene = format!("{ENDS}\n{TRUSS}");
    let mut talking = check_closed(&scene, 10);
    // One that is left out is no loss; with another the body has a joint more.
    talking.run("off tie; step 10; assert distance(B, P) = sqrt(1) within 1e-12");
    check_bars(&talking);
    talking.run("on tie; step 10");
    check_bars(&talking);
    let told = talking.ask("check").join("\n");
    assert!(told.contains("redundant"), "{told}");
    talking.run("trace C; change tie = 1.5; step 5");
    let samples = &talking.world().traces()[0].samples;
    assert!(samples.len() == 5 && samples.iter().all(|sample| sample.missed));
    check_same("changed", &format!("{scene}\nstep 9; off tie; step 9; on tie"), 30);
}

#[test]
fn a_bar_of_a_body_that_changes_for_a_while_is_as_long_as_it_says() {
    for n in 1..5 {
        let length = format!("tie: length Q R = 1.7 + 0.5 * min(time, {n}/72)");
        // Without the other diagonal: with both only one length of a field fits the others.
        let truss = TRUSS.replace("tie: length Q R", &length).replace("length P S; ", "");
        let scene = format!("{ENDS}\n{truss}");
        let mut talking = Talking::after(&scene);
        for then in ["step", "step", "step", "step", "step", "step", "step 60"] {
            talking.run(then);
            check_bars(&talking);
        }
        check_same(&format!("{n} frames"), &scene, 40);
    }
}

#[test]
fn a_joint_that_was_in_line_makes_no_difference_to_what_goes_on_from_a_file() {
    // Two bars that meet nearly in line hardly hold a point, one of them shrinks, and then they do.
    let steps = [1e-6, 2e-6, 5e-6, 1e-5, 2e-5, 4e-5];
    for less in steps {
        let apart = 0.7_f64.hypot(0.8);
        let (x, y) = (0.8 - 0.3 * (0.7 / apart), 3.0 - 0.3 * (0.8 / apart));
        let scene = format!(
            "{}
             length B C
             point P = (1.5, 2), Q = (2.2, 3.4), R = (1.5, 3.8), S = (0.8, 3), T = ({x:?}, {y:?})
             length B P; length C P; length P Q; length C Q; length P R; length Q R
             length R S; length P S
             length S T = 0.3; length R T = {:?} - 0.1 * min(time, 0.2)",
            ENDS.replace("1/72", "1/180"),
            apart + 0.3 - less
        );
        let mut talking = Talking::after(&format!("{scene}\nsolve\nstep 50"));
        talking.assert_goes_on_from_its_file("step 30");
        talking.assert_goes_on_from_its_file("step 30");
    }
}

#[test]
fn a_body_that_is_mirrored_by_hand_goes_on_mirrored() {
    let scene = format!("{ENDS}\n{TRUSS}\npoint T = (2, 2.4)\nlength R T; length C T\nstep 5");
    let mirrored = format!("{scene}\nmove T to T + 2 * (midpoint(R, C) - T)\nstep");
    let mut talking = Talking::after(&format!("{mirrored}\nlet area = cross(C - R, T - R)"));
    talking.run("step 20; assert cross(C - R, T - R) = area within 1e-11");
    assert!(talking.session.frame_counts().closed >= 20);
    let other = Talking::after(&format!("{scene}\nlet area = cross(C - R, T - R)"));
    let area = |talking: &mut Talking| talking.session.evaluate("area").unwrap().number();
    let mut other = other;
    assert!(area(&mut talking) * area(&mut other) < 0.0);
    check_same("mirrored", &mirrored, 30);
}

/// A joint of a field of a truss: how far it is off the strip, and whether a diagonal ends there.
type Joint = (f64, f64, bool);

/// The statements of a truss with these fields from B to C.
fn truss_of(fields: &[(Joint, Joint)], is_rigid: bool, hung: usize) -> String {
    let n = fields.len();
    let mut lines = Vec::new();
    for (k, ((x, y, _), (v, w, _))) in fields.iter().enumerate() {
        let share = (k as f64 + 1.0) / (n as f64 + 1.0);
        let (at_x, at_y) = (1.0 + 2.0 * share, 3.0 * share);
        let (t, u) = ((at_x - 0.6 + x, at_y + 0.4 + y), (at_x + 0.6 + v, at_y - 0.4 + w));
        lines.push(format!("point T{k} = {t:?}, U{k} = {u:?}"));
    }
    lines.push("length B T0; length B U0; length T0 U0".to_owned());
    for (j, ((.., one), (.., other))) in fields[1..].iter().enumerate() {
        let k = j + 1;
        lines.push(format!("length T{j} T{k}; length U{j} U{k}; length T{k} U{k}"));
        // One diagonal at least.
        let rising = (*one || !other).then(|| format!("length T{j} U{k}"));
        let falling = other.then(|| format!("length U{j} T{k}"));
        lines.extend(rising.into_iter().chain(falling));
    }
    let end = n - 1;
    lines.push(if is_rigid {
        format!("rigid T{end} U{end} C")
    } else {
        format!("length T{end} C; length U{end} C")
    });
    let on_it = [
        format!("point H = (2, 9); hinge H on T{end} C at 0.4"),
        "point H = (9, 9), G = (9, 2) frozen; length U0 H; length G H".to_owned(),
        "point H = (9, 9), G = (9, 2) frozen
         length U0 H; length G H = 6 + sin(time * 3rev)"
            .to_owned(),
        "point H = (2, 5), I = (3, 5); length T0 H; length C H; length H I; length C I".to_owned(),
    ];
    lines.extend(on_it.get(hung).cloned());
    lines.join("\n")
}

/// A truss of some fields from B to C, its joints somewhere near a strip between them; which of the bars
/// more than it takes are there, and whether some of it is `rigid`.
fn truss() -> impl Strategy<Value = String> {
    let joint = || (-0.3..0.3, -0.3..0.3, any::<bool>());
    let fields = prop::collection::vec((joint(), joint()), 1..5);
    (fields, any::<bool>(), 0..5_usize)
        .prop_map(|(fields, is_rigid, hung)| truss_of(&fields, is_rigid, hung))
}

proptest! {
    #![proptest_config(draws(40))]

    #[test]
    fn trusses_go_as_bars_in_one_call_frame_by_frame_and_from_a_file(truss in truss(), n in 5..80_u64) {
        let scene = format!("{ENDS}\n{truss}");
        check_same(&truss, &scene, n as u32);
        let length = distance(&Talking::after(&scene), "B", "C");
        let talking = Talking::after(&format!("{scene}\nstep {n}"));
        let mut plain = four_bar(length, n);
        if plain.talk.told().iter().all(|told| told.contains("exact to")) {
            let [one, other] = [&talking, &plain].map(|t| t.session.position("C").unwrap());
            prop_assert!(one.distance(other) < 1e-9, "{:?} {:?}\n{}", one, other, scene);
            check_bars(&talking);
        }
    }
}

#[test]
fn a_body_beside_the_mechanism_makes_no_difference_to_it() {
    let alone = Talking::after(&format!("{}\nstep 100", scene("w1-four-bar")));
    let with = format!("{}\n{}\nstep 100", scene("w1-four-bar"), net(3));
    assert_eq!(bits(Talking::after(&with).world()).1[..4], bits(alone.world()).1[..]);
}
