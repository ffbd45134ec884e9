//! Inside of a definition a name means the instance's own thing before anything outside.

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
