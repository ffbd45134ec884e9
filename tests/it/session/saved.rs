//! Whatever pose a world has come to, what `save` writes of it makes it again.

use crate::support::compare::check_same;
use crate::support::talk::Talking;
use linkwork::lang::catalogue::{ConstraintWord, Slot};

/// Points that are apart, no three on a line.
const PLACES: [&str; 4] = ["(0, 0)", "(4, 1)", "(5, 3)", "(1, 6)"];

/// The statement of a constraint among the points `p0` to `p3`, with a name in front.
fn statement(word: ConstraintWord) -> String {
    let pattern = word.pattern();
    let mut names = (0..PLACES.len()).map(|k| format!("p{k}"));
    let mut take = |n: usize| names.by_ref().take(n).collect::<Vec<_>>().join(" ");
    let mut text = format!("it: {}", pattern.entry.keyword);
    let mut before = None;
    for slot in pattern.slots {
        text.push_str(match (before, slot) {
            (Some(Slot::Points(_)), Slot::Points(_)) => ", ",
            _ => " ",
        });
        let part = match slot {
            Slot::Points(n) => take(*n),
            Slot::AllPoints => take(PLACES.len()),
            Slot::Line(role) => format!("{} {}", role.word(), take(2)),
            Slot::Value(role) | Slot::Optional(role, _) => format!("{} 2", role.word()),
            Slot::Place(role) => format!("{} (2, 3)", role.word()),
            Slot::Gearing => "ratio 2".to_owned(),
            Slot::Defined | Slot::Touching => unreachable!("stated by hand"),
            Slot::Measure => "distance(p0, p1) + angle(p0, p1, p2, p3)".to_owned(),
            Slot::Relation { .. } if word == ConstraintWord::Hold => "= 2".to_owned(),
            Slot::Relation { .. } | Slot::Flag(_) | Slot::Point(_) => String::new(),
        };
        text.push_str(&part);
        before = Some(*slot);
    }
    text
}

/// The statements of circles, arcs, and of what slides on them or touches them.
const CURVES: [&str; 7] = [
    "circle it = p0 radius 2",
    "circle it = p0 through p1",
    "arc it = p0 from p1 to p2",
    "circle z = p0 radius 2; it: tangent p1 p2 to z",
    "circle z = p0 through p1; circle y = p2 radius 1; it: tangent z to y inside",
    "circle z = p0 through p1; it: glider p2 on z",
    "arc z = p0 from p1 to p2; it: glider p3 on z",
];

/// A statement of each constraint.
fn statements() -> Vec<String> {
    let by_hand = [ConstraintWord::Circle, ConstraintWord::Arc, ConstraintWord::Tangent];
    let others = ConstraintWord::ALL.iter().filter(|word| !by_hand.contains(word));
    others.map(|&word| statement(word)).chain(CURVES.map(str::to_owned)).collect()
}

/// Saves a world and loads it; both then go on alike.
fn check(talking: &mut Talking, what: &str) {
    let script = talking.script();
    let mut again = Talking::default();
    if let Err(problem) = again.execute(&script) {
        panic!("{what}: {}\n{script}", again.drawn(&problem));
    }
    check_same(&again.script(), &script, what);
    for next in ["step", "move p1 to (3, 3); step 2", "off it; on it; step"] {
        let is_done = talking.execute(next).is_ok();
        assert_eq!(again.execute(next).is_ok(), is_done, "{what}: {next}");
        check_same(&again.script(), &talking.script(), &format!("{what}: {next}"));
    }
}

#[test]
fn a_constraint_of_any_kind_whose_points_were_moved_onto_each_other_is_loaded_again() {
    for statement in statements() {
        for form in ["holonomic", "velocity"] {
            for moves in ["p1 to p0", "p2 to p3", "p0 to p2", "p1 to p3", "p2 to p0; move p3 to p0"]
            {
                for before in ["", "freeze p0; step; "] {
                    let places = PLACES.iter().enumerate();
                    let points: Vec<_> =
                        places.map(|(k, at)| format!("point p{k} = {at}")).collect();
                    let mut talking = Talking::after(&format!("set cog {form}"));
                    talking.run(&points.join("; "));
                    talking.run(&statement);
                    talking.run(&format!("{before}move {moves}"));
                    check(&mut talking, &format!("{statement}: {before}{moves}"));
                }
            }
        }
    }
}

#[test]
fn what_was_made_and_deleted_before_a_constraint_is_not_seen() {
    for statement in statements() {
        let points = PLACES.iter().enumerate().map(|(k, at)| format!("point p{k} = {at}\n"));
        let points: String = points.collect();
        let mut talking = Talking::after(&format!(
            "{points}circle other = p0 radius 1; bar: length p2 p3 = 1; delete other, bar\n{statement}"
        ));
        talking.assert_goes_on_from_its_file("step 2");
    }
}

#[test]
fn the_sign_of_zero_is_not_left_out() {
    let points = "point p0 = (0, 0), p1 = (4, 1), p2 = (5, 3), p3 = (1, 6)";
    for statement in [
        "equal p0 p1, p2 p3 = -0",
        "distance p0 to p1 p2 = -0",
        "orientation p0 p1, p2 p3 = -0",
        "hinge p0 on p1 p2 at -0",
        "motor p0 p1 speed -0 phase -0",
        "coordinate p0 at (-0, 1)",
        "hold p0.x = -0",
    ] {
        let mut talking = Talking::after(points);
        assert!(talking.execute(statement).is_ok(), "{statement}");
        talking.assert_goes_on_from_its_file("step 2");
    }
}

#[test]
fn a_zero_that_changes_its_sign_is_a_change() {
    let points =
        "point p0 = (0, 0), p1 = (4, 1), p2 = (5, 3), p3 = (1, 6), q = (0, 0) frozen; let a = 0";
    let turned = |to: &str| to.replace('0', "-0");
    for (statement, change) in [
        ("it: length p0 p1 = 0", "= 0"),
        ("it: length p0 p1 <= 0", "<= 0"),
        ("it: equal p0 p1, p2 p3 = 0", "= 0"),
        ("it: distance p0 to p1 p2 = 0", "= 0"),
        ("it: orientation p0 p1, p2 p3 = 0", "= 0"),
        ("it: hinge p0 on p1 p2 at 0", "at 0"),
        ("it: motor p0 p1 speed 0 phase 0", "speed 0 phase 0"),
        ("it: coordinate p0 at (0, 1)", "at (0, 1)"),
        ("it: hold p0.x = 0", "= 0"),
    ] {
        for before in ["", "step 2; ", "off it; step; "] {
            let mut talking = Talking::after(points);
            talking.run(statement);
            // A pose may be met or not.
            drop(talking.execute(&format!("{before}change it {}", turned(change))));
            talking.assert_goes_on_from_its_file("step 2");
        }
    }
    for (statement, change) in [
        ("it: length p0 p1 = a", "let a = -0"),
        ("it: hold p0.x = a + a", "let a = -0"),
        ("it: length q p1 = 2", "move q to (-0, 0)"),
        ("it: length q p1 = 2", "move q to (0, -0)"),
        ("it: motor p0 p1 speed a", "let a = -0"),
    ] {
        for before in ["", "step 2; "] {
            let mut talking = Talking::after(points);
            talking.run(&format!("{statement}; {before}{change}"));
            talking.assert_goes_on_from_its_file("step 2");
        }
    }
}

#[test]
fn an_expression_that_has_no_value_in_the_pose_of_now_is_loaded_again() {
    for live in [
        "it: length p0 p1 = 8 / p0.x",
        "it: length p0 p1 = p0.x",
        "it: length p0 p1 in p0.x..4",
        "it: length p0 p1 in 4..6 + p0.x",
        "it: coordinate p1 at (1 / p0.x, 2)",
        "it: motor p0 p1 radius p0.x phase 1 / p0.x speed sqrt(p0.x)",
        "it: cog p0 p1, p2 p3 ratio p0.x - 1",
        "it: hinge p0 on p1 p2 at sqrt(p0.x)",
        "let s = sqrt(p0.x - 1), t = 1 / s, v = (t, 1); it: length p0 p1 <= t",
    ] {
        for place in ["(0, 0)", "(1, 0)", "(-8, 0)"] {
            let mut talking =
                Talking::after("point p0 = (3, 0), p1 = (4, 2), p2 = (6, 6), p3 = (1, 7)");
            talking.run(live);
            talking.run("set dt 1/10; step");
            talking.run(&format!("move p0 to {place}"));
            check(&mut talking, &format!("{live}, then {place}"));
        }
    }
}

#[test]
fn values_that_became_live_one_by_one_are_loaded_each_in_its_place() {
    for changes in [
        "speed time; change it phase time^2; change it radius 1 + time",
        "phase time; change it speed time^2",
        "speed time; change it radius 1 + time; change it speed -time",
    ] {
        let mut talking =
            Talking::after("point p0 = (3, 0), p1 = (4, 2); it: motor p0 p1; step 20");
        talking.run(&format!("change it {changes}; step 2; set dt 1/10"));
        check(&mut talking, changes);
    }
    let mut talking = Talking::after("point p0 = (3, 0), p1 = (4, 2); it: length p0 p1 in time..9");
    talking.run("step 20; change it in 0..20 + time; change it in time..20; step; set dt 1/10");
    check(&mut talking, "a range");
}

#[test]
fn what_is_said_of_a_parameter_without_a_value_is_what_was_said_before_it_was_saved() {
    let mut talking =
        Talking::after("point p = (1, 0); let s = 1 / p.x; let t = s + 1; move p to (0, 0)");
    let mut again = Talking::after(&talking.script());
    for question in ["print s", "print t", "step"] {
        let problem = talking.execute(question).expect_err(question);
        assert_eq!(again.execute(question).expect_err(question).message, problem.message);
        assert_eq!(&*problem.message, "division by zero");
    }
}

#[test]
fn likely_slips_are_not_said_again_of_what_was_there_before() {
    let mut talking = Talking::after(
        "point A = (0, 0) frozen, B = (3, 0), C = (1, 1)
         orientation A B, A C = 90
         distance C to A B = -1",
    );
    assert_eq!(talking.talk.told().len(), 2);
    let mut again = Talking::after(&talking.script());
    assert!(again.talk.told().is_empty());
    again.run("move C to (1, 1); distance C to A B = -1");
    assert_eq!(again.talk.told().len(), 1, "what is new is looked at again");
}

#[test]
fn a_wheel_that_is_switched_on_with_its_rim_point_on_its_centre_rolls_as_before() {
    let mut talking = Talking::after(
        "point P = (0, 0) frozen, Q = (9, 0) frozen, O = (1, 1), A = (2, 1)
         distance O to P Q = 1
         length O A = 1
         roll: rack O A on P Q; off roll
         move A to O; on roll; move A to (2, 1)",
    );
    // A quarter turn back, a quarter of the circumference on.
    talking.run("solve; drag O to (1 + pi / 2, 1) over 20; assert A = (1 + pi / 2, 0) within 1e-9");
}

#[test]
fn wheels_that_are_switched_on_with_a_marker_on_its_centre_mesh_as_before() {
    let mut talking = Talking::after(
        "point O = (0, 0) frozen, A = (1, 0), Q = (3, 0) frozen, B = (3, 2)
         mesh: cog O A, Q B ratio 2; off mesh
         move B to Q; on mesh; move B to (5, 0); freeze A
         length Q B = 2; solve",
    );
    // With the first marker where it was, so is the second.
    talking.run("assert B = (3, 2) within 1e-9");
}

#[test]
fn a_wheel_needs_a_rim_and_a_line_with_two_ends() {
    let mut talking = Talking::after("point P = (0, 0), Q = (9, 0), O = (1, 1), A = (2, 1)");
    for statement in
        ["move A to O; rack O A on P Q", "move A to (2, 1); move P to Q; rack O A on P Q"]
    {
        let problem = talking.execute(statement).expect_err(statement);
        assert!(problem.message.contains(" on "), "{}", problem.message);
        assert_eq!(talking.world().constraints().count(), 0);
    }
}

#[test]
fn what_ran_away_to_where_there_are_no_numbers_is_where_the_world_has_it() {
    // The angle is measured from a direction that tends to one as p2 goes away for ever.
    let mut talking = Talking::after(
        "point p0 = (0, 0) frozen, p2 = (0.4, -0.2), p3 = (-0.2, -1.1) frozen
         point p4 = (-2.5, -0.9) frozen
         c0: motor p4 p0 radius 3.4 speed -0.1 from p3 p2
         move p3 to (0, 0); solve",
    );
    talking.assert_goes_on_from_its_file("step 3");
    assert!(talking.ask("check").iter().any(|line| line.contains("stalled")));
}

#[test]
fn what_is_said_in_another_way_goes_on_from_a_file_as_it_would_have() {
    let mut talking = Talking::after(
        "point O = (9, 0) frozen, G = (10, 0), Q = (12, 0) frozen, H = (11, 0)
         wheels: cog O G, Q H ratio 2
         spin: motor O G speed 90deg
         set dt 1/30; step
         change wheels teeth 10, 20",
    );
    talking.assert_goes_on_from_its_file("step 2");
}

#[test]
fn a_ratio_takes_the_place_of_teeth_that_come_to_the_same() {
    let mut talking = Talking::after(
        "point O = (9, 0) frozen, G = (10, 0), Q = (12, 0) frozen, H = (11, 0)
         wheels: cog O G, Q H teeth 10, 20 + floor(time)
         change wheels ratio 2 + time",
    );
    assert!(talking.ask("list")[4].contains("ratio 2 + time"), "{:?}", talking.ask("list"));
    let loaded = Talking::after(&talking.script());
    assert_eq!(loaded.script(), talking.script());
}

#[test]
fn a_joint_that_is_flat_for_good_goes_on_from_a_file_as_it_would_have() {
    // Both bars of X together are as long as the motor's arm, which is measured from a link.
    let flat = "point P = (5, 3), X = (4, 3); motor C P radius 2 from A D speed 0.3rev
        length C X = 1; length X P = 1; set dt 1/30";
    for carried in [
        "point A = (0, 0) frozen, D = (1, 0) frozen, C = (3, 3) frozen",
        "point A = (0, 0) frozen, D = (1, 0), C = (3, 3); motor A D speed 1rev; length D C; length A C",
    ] {
        for n in 1..8 {
            let mut talking = Talking::after(&format!("{carried}\n{flat}\nstep {n}"));
            talking.assert_goes_on_from_its_file("step 2");
        }
    }
}
