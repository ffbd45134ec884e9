//! Settings that change while a mechanism is solved already.

use crate::support::talk::Talking;
use linkwork::solve::Method;

#[test]
fn a_tighter_tolerance_unsettles_what_was_solved() {
    for method in Method::ALL {
        for run in ["solve", "set iterations 10000; step"] {
            // Off by less than is asked for at first.
            let mut talking = Talking::after(&format!(
                "set method {}
                 point A = (0, 0) frozen, B = (1.04, 0)
                 length A B = 1
                 set tolerance 5e-2
                 solve; step",
                method.word()
            ));
            talking.run(&format!("set tolerance 1e-12; {run}"));
            talking.run("assert B = (1, 0) within 1e-11");
        }
    }
}

#[test]
fn a_looser_tolerance_leaves_what_was_solved() {
    let mut talking = Talking::after(
        "point A = (0, 0) frozen, B = (1.04, 0)
         length A B = 1
         solve
         set tolerance 5e-2",
    );
    talking.run("step 3; solve; assert B = (1, 0) within 1e-12");
}

#[test]
fn a_promise_within_less_unsettles_what_was_solved() {
    let mut talking = Talking::after(
        "point A = (0, 0) frozen, B = (1.04, 0)
         length A B = 1
         set tolerance 5e-2
         solve
         assert B = (1.04, 0)
         solve within 1e-12",
    );
    talking.run("assert B = (1, 0) within 1e-11");
}
