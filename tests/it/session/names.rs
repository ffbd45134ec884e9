//! Inside of a definition a name means the instance's own thing before anything outside.

use crate::support::compare::check_same;
use crate::support::talk::Talking;

/// Things outside of a definition, each with a name that its instances use too.
const OUTSIDE: &str = "
    point O = (0, 0) frozen, Q = (10, 10) frozen
    let l = 7
    rod: length O Q = 20
    off rod
";

#[test]
fn a_member_is_found_before_a_point_of_the_same_name_outside() {
    let mut talking = Talking::after(OUTSIDE);
    talking.run(
        "define arm(P) { point Q = P + (1, 0); length P Q = 2 }
         use arm(O) as left
         solve",
    );
    // Along the x axis, where it stands already: with the point outside, a rod of length 2
    // between two frozen points could not hold.
    talking.run("assert left.Q = (2, 0) within 1e-9; assert Q = (10, 10)");
}

#[test]
fn a_member_is_found_before_a_parameter_of_the_same_name_outside() {
    let mut talking = Talking::after(OUTSIDE);
    talking.run(
        "define arm(P) { let l = 3; point E = P + (0, 1); length P E = l }
         use arm(O) as left
         solve
         assert left.E = (0, 3) within 1e-9
         let l = 8; solve
         assert left.E = (0, 3) within 1e-9
         let left.l = 4; solve
         assert left.E = (0, 4) within 1e-9",
    );
}

#[test]
fn a_member_is_found_before_a_constraint_of_the_same_name_outside() {
    let mut talking = Talking::after(OUTSIDE);
    talking.run(
        "define arm(P) { point E = P + (0, 1); rod: length P E = 3; change rod = 5; off rod; on rod }
         use arm(O) as left
         solve
         assert left.E = (0, 5) within 1e-9",
    );
    assert!(talking.ask("show rod")[0].contains("= 20"), "{:?}", talking.ask("show rod"));
}

#[test]
fn an_instance_within_an_instance_is_found_before_one_outside() {
    let mut talking = Talking::after(OUTSIDE);
    talking.run(
        "define tip(P, l) { point E = P + (0, 1); rod: length P E = l }
         define arm(P) { use tip(P, 3) as part; off part; on part; change part.rod = 6 }
         use tip(O, 2) as part
         use arm(O) as left
         solve
         assert part.E = (0, 2) within 1e-9
         assert left.part.E = (0, 6) within 1e-9",
    );
}

#[test]
fn what_is_not_a_member_is_found_outside() {
    let mut talking = Talking::after(OUTSIDE);
    talking.run(
        "define arm(P) { point E = P + (1, 0); length P E = l }
         use arm(O) as left
         solve
         assert left.E = (7, 0) within 1e-9
         let l = 8; solve
         assert left.E = (8, 0) within 1e-9",
    );
}

#[test]
fn what_a_parameter_stood_for_may_be_gone() {
    for body in [
        "clear; print P",
        "clear; point X = (5, 5); print P.x",
        "clear; point X = (5, 5), Y = (6, 5); length X P",
        "clear; point X = (5, 5), Y = (6, 5); let z = r",
        "delete P cascade; print P",
        "delete P cascade; point X = (5, 5); length P X",
        "delete P cascade; let z = r",
    ] {
        let mut talking = Talking::after(&format!(
            "define d(P, r) {{ {body} }}
             point A = (0, 0), B = (1, 0); let q = A.x"
        ));
        let before = talking.script();
        let problem = talking.execute("use d(A, q + A.x)").expect_err(body);
        assert_eq!(&*problem.message, "what this stands for is gone", "in {body}");
        check_same(&talking.script(), &before, body);
    }
    let mut talking = Talking::after("define d(P, r) { clear; let z = r }; point A = (0, 0)");
    talking.run("use d(A, 3) as left");
    assert_eq!(talking.ask("left.z"), ["3"]);
}
