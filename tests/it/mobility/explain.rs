//! `check` and `why` on mechanisms whose answers are known, and repairs that are carried out.

use std::process::Command;

use crate::support::talk::Talking;
use linkwork::mobility::PoseClass as Pose;

/// `check` finds these counts and nothing that contradicts.
#[track_caller]
fn check(script: &str, degrees_of_freedom: usize, n_redundant: usize, pose: Pose) -> Talking {
    let talking = Talking::after(script);
    let found = talking.session.examine();
    let counts = (found.degrees_of_freedom, found.redundant.len(), found.pose);
    assert_eq!(counts, (degrees_of_freedom, n_redundant, pose), "{found:?}");
    assert!(found.is_sound(), "{found:?}");
    talking
}

#[test]
fn a_crank_rocker_has_one_freedom_and_none_with_its_motor() {
    let bars = "point A = (0, 0) frozen, D = (4, 0) frozen, B = (1, 0), C = (3, 3)
        length B C = 3.5; length C D = 3";
    check(&format!("{bars}; length A B = 1; solve"), 1, 0, Pose::Regular);
    check(&format!("{bars}; motor A B radius 1 speed 1rev; solve"), 0, 0, Pose::Regular);
}

/// K(3,3) with the one triple on the one axis, the other on the other.
const DIXON_1: &str = "point A[1] = (1, 0), A[2] = (2.5, 0), A[3] = (-1.7, 0)
    point B[1] = (0, 1.2), B[2] = (0, 2.1), B[3] = (0, -1.6)
    for i in 1..3 { for j in 1..3 { length A[i] B[j] } }";

/// The other kind: two rectangles with parallel sides and a common centre make a mobile K(4,4),
/// and with it K(3,3).
const DIXON_2: &str = "point A[1] = (2, 1), A[2] = (-2, 1), A[3] = (-2, -1), A[4] = (2, -1)
    point B[1] = (1.2, 2.4), B[2] = (-1.2, 2.4), B[3] = (-1.2, -2.4), B[4] = (1.2, -2.4)
    for i in 1..4 { for j in 1..4 { length A[i] B[j] } }";

#[test]
fn dixons_mechanisms_are_mobile() {
    // Twelve coordinates, nine bars: three motions as a whole and one that should not be.
    let first = check(DIXON_1, 4, 1, Pose::MobileSingular).session.examine();
    assert_eq!(first.redundant[0].1.len(), 8, "{first:?}");
    // Sixteen coordinates, sixteen bars.
    let second = Talking::after(DIXON_2).session.examine();
    assert_eq!((second.degrees_of_freedom, second.redundant.len()), (4, 4), "{second:?}");
    assert_eq!(second.pose, Pose::MobileSingular);
}

#[test]
fn a_general_k33_is_rigid() {
    let script = DIXON_1.replace("(1, 0)", "(1, 0.3)").replace("(0, 2.1)", "(0.4, 2.1)");
    check(&script, 3, 0, Pose::Regular);
}

#[test]
fn a_shaky_prism_is_locked() {
    // Two triangles, one a half-size copy of the other: the three bars between them meet in
    // one point. It can move at the first instant only.
    let prism = "point A = (0, 0), B = (4, 0), C = (1, 3)
        point P = (5/3, 1) + 0.5 * (A - (5/3, 1)), Q = (5/3, 1) + 0.5 * (B - (5/3, 1))
        point R = (5/3, 1) + 0.5 * (C - (5/3, 1))
        length A B; length B C; length C A; length P Q; length Q R; length R P
        length A P; length B Q; length C R";
    check(prism, 4, 1, Pose::Locked);
}

#[test]
fn coupled_locomotive_wheels_are_mobile_with_a_rod_too_many() {
    let wheels = "for i in 0..2 {
            point O[i] = (3 * i, 0) frozen, P[i] = (3 * i, 0) + polar(1, 40deg)
            length O[i] P[i] = 1
        }
        length P[0] P[1] = 3; length P[1] P[2] = 3; length P[0] P[2] = 6";
    check(wheels, 1, 1, Pose::MobileSingular);
}

#[test]
fn a_net_with_both_diagonals_pinned_at_two_corners_has_26_redundant_bars() {
    let net = "for i in 0..4 { for j in 0..4 { point p[i].x[j] = (i, j) } }
        for i in 0..4 { for j in 1..4 {
            length p[i].x[j-1] p[i].x[j]
            length p[j-1].x[i] p[j].x[i]
        } }
        for i in 1..4 { for j in 1..4 {
            length p[i-1].x[j-1] p[i].x[j]
            length p[i].x[j-1] p[i-1].x[j]
        } }
        freeze p[0].x[0] p[4].x[0]";
    let found = Talking::after(net).session.examine();
    assert_eq!((found.degrees_of_freedom, found.redundant.len()), (0, 26), "{found:?}");
    assert!(found.is_sound());
}

#[test]
fn duplicates_name_what_they_repeat() {
    let mut talking = check(
        "point A = (0, 0) frozen, B = (1, 0)
         first: length A B = 1; second: length A B = 1; third: length B A = 1",
        1,
        2,
        Pose::Regular,
    );
    assert_eq!(
        talking.ask("check")[1..3],
        ["redundant: second, implied by first", "redundant: third, implied by first"]
    );
    assert_eq!(
        talking.ask("why second"),
        ["second is satisfied", "it is redundant: first implies it"]
    );
    assert_eq!(talking.ask("why first"), ["first is satisfied"]);
}

/// A sound net with an impossible triangle hanging on one of its corners.
fn corner() -> Talking {
    Talking::after(
        "for i in 0..8 { for j in 0..8 { point p[i].x[j] = (i, j) } }
         for i in 0..8 { for j in 1..8 {
             length p[i].x[j-1] p[i].x[j]
             length p[j-1].x[i] p[j].x[i]
         } }
         for i in 1..8 { for j in 1..8 { length p[i-1].x[j-1] p[i].x[j] } }
         freeze p[0].x[0] p[8].x[0]
         point T = (9, 9), U = (8.5, 9.5)
         a: length p[8].x[8] T = 1
         b: length T U = 1
         c: length U p[8].x[8] = 3",
    )
}

#[test]
fn an_impossible_triangle_in_a_corner_is_named_alone() {
    let found = corner().session.examine();
    assert_eq!(found.conflicting.len(), 1, "{found:?}");
    assert_eq!(found.conflicting[0].0, ["a", "b", "c"]);
    assert!((found.conflicting[0].1 - 0.2).abs() < 0.1, "{found:?}");
    assert!(found.unsatisfiable.is_empty(), "{found:?}");
}

#[test]
fn frozen_points_that_contradict_are_named() {
    let mut talking = Talking::after(
        "point A = (0, 0) frozen, B = (3, 0) frozen, C = (1, 1)
         l: length A B = 1
         length A C",
    );
    let found = talking.session.examine();
    assert!(!found.is_sound());
    assert_eq!(found.unsatisfiable[0].constraint, "l");
    assert_eq!(talking.ask("check")[1], "unsatisfiable: l, off by 2: A and B are frozen");
    assert_eq!(
        talking.ask("why l"),
        ["l is off by 2: all its points are frozen", "lengthen l by 2, thaw A or B, or drop l"]
    );
}

/// What `why` says of a constraint: the first line, the ways out, and commands that take them.
fn ways_out(talking: &mut Talking, name: &str) -> (String, String, Vec<String>) {
    let mut lines = talking.ask(&format!("why {name}")).into_iter();
    let (first, ways) = (lines.next().unwrap(), lines.next().unwrap());
    (first, ways, lines.map(|line| line.trim().to_owned()).collect())
}

/// Every way out that is told makes the scene converge.
#[track_caller]
fn carry_out(script: &str, name: &str, n_commands: usize) -> (String, String) {
    let (first, ways, commands) = ways_out(&mut Talking::after(script), name);
    assert_eq!(commands.len(), n_commands, "{commands:?}");
    for command in &commands {
        let mut talking = Talking::after(script);
        talking.run(command);
        talking.run("solve within 1e-9");
    }
    let dropped = ways.rsplit("or drop ").next().unwrap();
    for name in dropped.split(", ").flat_map(|names| names.split(" or ")) {
        let mut talking = Talking::after(script);
        talking.run(&format!("off {name}; solve within 1e-9"));
    }
    (first, ways)
}

/// A rectangle whose diagonal does not fit.
const SQUARE: &str =
    "point A = (0, 0) frozen, B = (1000, 0) frozen, C = (1000, 1000), D = (0, 1000)
    bc: length B C = 1000
    cd: length C D = 1000
    da: length D A = 1000
    square: perpendicular A B, B C
    diag: length A C = 2000
    solve";

#[test]
fn repairs_are_exact_for_changes_of_any_size() {
    let (first, ways) = carry_out(SQUARE, "diag", 2);
    assert_eq!(first, "diag is off by 299: it cannot hold together with bc and square");
    assert_eq!(
        ways,
        "shorten diag by 585.79, lengthen bc by 732.05, thaw A or B, or drop bc, square or diag"
    );
}

#[test]
fn repairs_stop_where_others_can_just_hold() {
    let triangle = "point A = (0, 0), B = (1, 0), C = (0.5, 0.5)
        ab: length A B = 1; bc: length B C = 1; ca: length C A = 3; solve";
    let (first, ways) = carry_out(triangle, "ca", 3);
    assert_eq!(first, "ca is off by 0.333: it cannot hold together with ab and bc");
    assert!(ways.contains("shorten ca by 1"), "{ways}");
    let uneven = "point A = (0, 0) frozen, B = (1, 0), C = (0.5, 0.5), D = (5, 1) frozen
        ab: length A B = 1.2; bc: length B C = 0.9; cd: length C D = 1.1; solve";
    let gap = f64::hypot(5.0, 1.0) - 3.2;
    let (_, ways) = carry_out(uneven, "bc", 3);
    let expected = format!("lengthen bc by {}", format!("{gap:.4}").trim_end_matches('0'));
    assert!(ways.contains(&expected), "{ways} {expected}");
}

#[test]
fn repairs_of_angles_and_bounds_are_told_in_their_terms() {
    let angle = "point A = (0, 0) frozen, B = (2, 0) frozen, C = (2, 1)
        bc: length B C = 1; ac: length A C = 2; turn: orientation B A, B C = -90deg; solve";
    let (_, ways) = carry_out(angle, "turn", 3);
    assert!(ways.contains("turn turn counter-clockwise by 14.478 deg"), "{ways}");
    let bounds = "point A = (0, 0) frozen, B = (5, 0) frozen, C = (2, 1)
        cord: length A C <= 2; rod: length C B = 2; solve";
    let (_, ways) = carry_out(bounds, "cord", 2);
    assert!(ways.contains("lengthen cord by 1"), "{ways}");
    let line = "point A = (0, 0) frozen, B = (5, 0) frozen, C = (2, 1)
        up: distance C to A B = 2; rod: length C B = 1; solve";
    let (_, ways) = carry_out(line, "up", 2);
    assert!(ways.contains("decrease up by 1"), "{ways}");
}

#[test]
fn a_large_scene_has_its_corner_mended() {
    let mut talking = corner();
    let (first, _, commands) = ways_out(&mut talking, "a");
    assert!(first.ends_with("it cannot hold together with b and c"), "{first}");
    assert_eq!(commands.len(), 3);
    talking.run(&format!("{}; solve within 1e-9", commands[0]));
}

#[test]
fn two_conflicts_are_told_apart() {
    let mut talking = Talking::after(
        "point A = (0, 0), B = (1, 0), C = (0.5, 0.5), D = (5, 0), E = (6, 0), F = (5.5, 0.5)
         ab: length A B = 1; bc: length B C = 1; ca: length C A = 3
         de: length D E = 1; ef: length E F = 1; fd: length F D = 4
         link: length C D = 4
         solve",
    );
    let found = talking.session.examine();
    let sets: Vec<_> = found.conflicting.iter().map(|(names, _)| names.join(" ")).collect();
    assert_eq!(sets, ["ab bc ca", "de ef fd"]);
    let (first, _, commands) = ways_out(&mut talking, "bc");
    assert!(first.ends_with("with ab and ca"), "{first}");
    talking.run(&format!("{}; solve", commands[0]));
    assert_eq!(talking.ask("why bc"), ["bc is satisfied"]);
}

#[test]
fn why_says_where_a_point_can_go() {
    let mut talking = Talking::after(
        "point A = (0, 0) frozen, B = polar(2, 30deg), C = (9, 9), X = (4, 0) frozen
         ab: length A B = 2
         point E = (4, 1); xe: length X E = 1; x: coordinate E at (4, 1)",
    );
    assert_eq!(
        talking.ask("why B"),
        ["B can move along -60 deg and back only: ab stops it across"]
    );
    assert_eq!(talking.ask("why C"), ["C can move in every direction"]);
    assert_eq!(talking.ask("why A"), ["A is frozen"]);
    assert!(talking.ask("why E")[0].starts_with("E cannot move: "));
}

#[test]
fn check_says_what_the_program_says() {
    let script = std::env::temp_dir().join(format!("linkwork-check-{}.link", std::process::id()));
    let run = |text: &str, more: &[&str]| {
        std::fs::write(&script, text).unwrap();
        let program = env!("CARGO_BIN_EXE_linkwork");
        let out = Command::new(program).arg("check").arg(&script).args(more).output().unwrap();
        (out.status.code(), String::from_utf8(out.stdout).unwrap())
    };
    let sound =
        "point A = (0, 0) frozen, B = (1, 0)\nfirst: length A B = 1\nsecond: length A B = 1\n";
    let (status, text) = run(sound, &[]);
    assert_eq!(status, Some(0));
    assert_eq!(
        text,
        "degrees of freedom: 1\nredundant: second, implied by first\npose: regular\n\
         status: converged, residual 0\n"
    );
    let (status, text) = run(sound, &["--json"]);
    assert_eq!(status, Some(0));
    let found: serde_json::Value = serde_json::from_str(&text).unwrap();
    let expected = serde_json::json!({
        "type": "check",
        "version": 1,
        "sound": true,
        "degrees_of_freedom": 1,
        "redundant": [{ "constraint": "second", "depends_on": ["first"] }],
        "conflicting": [],
        "unsatisfiable": [],
        "pose": "regular",
        "status": "converged",
        "residual": 0.0,
    });
    assert_eq!(found, expected);
    let (status, text) = run(SQUARE, &["--json"]);
    assert_eq!(status, Some(1));
    let found: serde_json::Value = serde_json::from_str(&text).unwrap();
    assert_eq!(found["conflicting"][0]["constraints"], serde_json::json!(["bc", "square", "diag"]));
    assert_eq!(found["status"], "best-fit");
    assert_eq!(
        run("point A = (0, 0) frozen, B = (2, 0) frozen\nl: length A B = 1\n", &[]).0,
        Some(1)
    );
    assert_eq!(run("lenght A B\n", &[]).0, Some(2));
    std::fs::remove_file(&script).unwrap();
}

#[test]
fn what_keeps_bars_on_a_line_is_part_of_the_conflict() {
    // Bars of 3.5 and 7 over a span of 10 meet 1.46 beside the line, where the glider is not.
    let mut talking = Talking::after(
        "point A = (0, 0) frozen, B = (10, 0) frozen, P = (3, 0)
         line: glider P on A B unbounded
         l1: length A P = 3.5
         l2: length P B = 7
         solve",
    );
    let found = talking.session.examine();
    assert_eq!(found.conflicting.len(), 1, "{found:?}");
    assert_eq!(found.conflicting[0].0, ["line", "l1", "l2"]);
    // `why` names the same of each member that is off.
    for name in ["l1", "l2"] {
        let said = talking.ask(&format!("why {name}")).remove(0);
        for other in ["line", "l1", "l2"].iter().filter(|other| **other != name) {
            assert!(said.contains(other), "{said}");
        }
    }
    talking.run("off line; solve within 1e-9");
}

#[test]
fn an_arc_of_a_radius_of_a_million_is_nearly_singular_and_not_mobile() {
    for radius in [1e6, 3e6, 3e5] {
        let turn = 1.745_329_251_994_329_5 / radius;
        let mut talking = check(
            &format!(
                "let r = {radius}, turn = {turn}
                 point P = (0, 0) frozen, D = (-10, 0) frozen, M = (0, r) frozen
                 point Q = (1.7, 0.0001), E = (11, 0.001)
                 length Q M = r; length Q E = 10
                 orientation Q E, Q M = 90deg
                 orientation D P, Q E = turn
                 solve"
            ),
            0,
            0,
            Pose::Regular,
        );
        assert!(talking.session.examine().near_singular.is_some());
        talking.run("assert Q.x = r * sin(turn) within 1e-6");
    }
}
