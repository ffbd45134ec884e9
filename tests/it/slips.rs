//! Statements that ask for nothing are refused, and likely slips are said once.

use crate::support::talk::Talking;

const POINTS: &str = "point A = (0, 0) frozen, B = (3, 0), C = (1, 1), D = (2, -1)";

#[test]
fn what_asks_for_nothing_is_refused_and_leaves_nothing() {
    let mut talking = Talking::after(POINTS);
    for statement in [
        "hinge C on A C at 0.5",
        "hinge A on A C at 0.5",
        "glider C on A C",
        "glider C on A C unbounded",
        "distance C to A C = 1",
        "parallel A B, A B",
        "parallel A B, B A",
        "perpendicular A B, A B",
        "equal A B, A B",
        "equal A B, B A = 1",
        "equivalence A B, B A",
        "orientation A B, A B = 30deg",
        "orientation A B, A C in -450deg..450deg",
        "orientation A B, A C <= 400deg",
    ] {
        let problem = talking.execute(statement).expect_err(statement);
        assert!(!problem.labels.is_empty(), "{statement}");
        assert_eq!(talking.session.world().constraints().count(), 0, "{statement}");
    }
    talking.run("orientation A B, A C in -180deg..180deg; g: glider C on A B");
    talking.execute("change g on A C").expect_err("its own line");
    talking.execute("change orientation1 in -4..4").expect_err("wider than a turn");
}

#[test]
fn likely_slips_are_said_once_with_what_to_type() {
    for (statement, expected) in [
        ("orientation A B, A C = 90", Some("`90deg`")),
        ("orientation A B, A C = -45", Some("`-45deg`")),
        ("orientation A B, A C in 10..11", Some("`10deg`")),
        ("motor A B phase 90", Some("`90deg`")),
        ("distance C to A B = -1", Some("did you mean `1`")),
        ("distance D to A B = 4", Some("did you mean `-4`")),
        ("orientation A B, A C = 90deg", None),
        ("orientation A B, A C = 1.57", None),
        ("motor A B phase 6.3 speed 90", None),
        ("distance C to A B = 4", None),
        ("distance D to A B = -0.1", None),
        ("distance D to A B >= 1", None),
    ] {
        let mut talking = Talking::after(POINTS);
        talking.run(statement);
        let told = talking.talk.told();
        match expected {
            None => assert!(told.is_empty(), "{statement}: {told:?}"),
            Some(text) => assert!(told[0].contains(text), "{statement}: {told:?}"),
        }
    }
}

#[test]
fn a_change_is_looked_at_as_what_is_made() {
    for (made, change, expected) in [
        ("orientation A B, A C = 1", "change it = 90", Some("`90deg`")),
        ("orientation A B, A C = 1", "change it in -45..-42", Some("`-45deg`")),
        ("motor A B", "change it phase 90", Some("`90deg`")),
        ("distance C to A B = 2", "change it = -1", Some("did you mean `1`")),
        ("distance C to A B", "change it to B A = 2", Some("did you mean `-2`")),
        ("orientation A B, A C = 1", "change it = 90deg", None),
        ("motor A B phase 90", "change it speed 90", None),
        ("distance C to A B = -1", "change it to B A", None),
        ("length B C = 2", "change it = 90", None),
    ] {
        let mut talking = Talking::after(POINTS);
        talking.run(&format!("it: {made}"));
        talking.talk.told();
        talking.run(change);
        let told = talking.talk.told();
        match expected {
            None => assert!(told.is_empty(), "{change}: {told:?}"),
            Some(text) => assert!(told[0].contains(text), "{change}: {told:?}"),
        }
    }
}

#[test]
fn a_slip_in_a_loop_is_said_once_and_two_are_said_twice() {
    let mut talking = Talking::after(POINTS);
    talking.run("for i in 1..5 { point P[i] = (i, 2); o[i]: orientation A B, A P[i] = 90 }");
    assert_eq!(talking.talk.told().len(), 1);
    talking
        .run("for i in 1..5 { change o[i] = 90; for k in 1..3 { orientation A C, A P[i] = 45 } }");
    assert_eq!(talking.talk.told().len(), 2);
    talking.run("define arm(P) { orientation A B, A P = 90 }; for i in 1..5 { use arm(P[i]) }");
    assert_eq!(talking.talk.told().len(), 1);
    talking.run("change o[1] = 90");
    assert_eq!(talking.talk.told().len(), 1, "another statement is another slip");
}
