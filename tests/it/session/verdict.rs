//! One pose, one verdict: whoever asks is told what is so on the screen, and what solving from
//! there would come to where that is another.

use crate::support::talk::Talking;
use linkwork::session::FromHere;
use linkwork::solve::Status;

/// What a script tells, all of it in one text.
fn told(script: &str) -> String {
    Talking::after(script).talk.said
}

/// A rod of 3 that is drawn 1 long.
const SHORT: &str = "point A = (0, 0) frozen, B = (1, 0)
    r: length A B = 3";

#[test]
fn a_pose_that_is_not_solved_is_judged_as_drawn_and_as_solved_from_there() {
    let mut talking = Talking::after(SHORT);
    let check = talking.ask("check");
    let status = check.last().unwrap();
    assert!(status.starts_with("status: as drawn: off by 2 (r); solved from here: "), "{status}");
    let after: f64 = status.rsplit(' ').next().unwrap().parse().unwrap();
    assert!(after <= 1e-12, "{status}");
    assert_eq!(talking.ask("show r")[0], "r: length A B = 3  # residual -2");
    assert_eq!(talking.ask("why r"), ["as drawn: r is off by 2; solved from here: satisfied"]);
    assert_eq!(talking.ask("why B")[0], "as drawn: off by 2 (r); solved from here:");
    let found = talking.session.examine();
    assert_eq!(found.status, Status::Stalled);
    assert!((found.residual - 2.0 / 3.0).abs() < 1e-15, "{found:?}");
    assert!(matches!(found.from_here, Some(FromHere { status: Status::Converged, .. })));
    assert!(found.is_sound(), "{found:?}");
    // Once solved there is one verdict.
    talking.run("solve");
    assert!(talking.ask("check").last().unwrap().starts_with("status: converged, residual "));
    assert_eq!(talking.ask("why r"), ["r is satisfied"]);
}

#[test]
fn what_a_hand_tore_is_off_on_the_screen() {
    let mut talking = Talking::after(
        "point O = (0, 0) frozen, A = (2, 0)
         rod: length O A = 2
         step
         drag A to (5, 0) over 5",
    );
    let told = std::mem::take(&mut talking.talk.said);
    assert!(told.contains("rod is off by 3: O and A are frozen"), "{told}");
    assert!(told.contains("`thaw O` lets it give way"), "{told}");
    assert!(!told.contains("thaw A"), "a hand holds A: {told}");
    let status = talking.ask("check").pop().unwrap();
    assert!(status.starts_with("status: as drawn: off by 3 (rod); solved from here: "), "{status}");
    assert_eq!(talking.ask("show rod")[0], "rod: length O A = 2  # residual 3");
}

#[test]
fn a_moved_point_is_off_by_the_value_measured_now() {
    let mut talking = Talking::after(
        "point A = (0, 0) frozen, B = (1, 0), C = (0, 5) frozen, D = (3, 5) frozen
         l: length A B = distance(C, D)
         solve
         move D to (7, 5)",
    );
    assert!((talking.session.residual("l").unwrap() + 4.0).abs() < 1e-12);
    assert!(talking.ask("show l")[0].ends_with("# residual -4"));
    let status = talking.ask("check").pop().unwrap();
    assert!(status.starts_with("status: as drawn: off by 4 (l); solved from here: "), "{status}");
}

#[test]
fn a_run_that_cannot_be_solved_names_who_is_to_blame() {
    // B is 2 from A and 1 from C, and these are 5 apart.
    let told = told(
        "point A = (0, 0) frozen, B = (2, 0), C = (5, 0) frozen
         ab: length A B = 2; bc: length B C = 1
         step 3",
    );
    assert!(told.contains("best fit: the constraints contradict each other"), "{told}");
    assert!(told.contains("ab and bc cannot hold together, off by 1"), "{told}");
    assert!(told.contains("`thaw A` or `thaw C` lets it give way"), "{told}");
    assert!(told.contains("`why ab` tells the ways out"), "{told}");
}

#[test]
fn no_more_than_three_are_named() {
    let told = told(
        "point A = (0, 0) frozen, B = (2, 0), C = (4, 0.1), D = (6, 0), E = (9, 0) frozen
         length A B = 1; length B C = 1; length C D = 1; length D E = 1
         solve",
    );
    assert!(told.contains("length1, length2, length3 and 1 more cannot hold together"), "{told}");
}

#[test]
fn a_shape_taken_from_a_pose_that_was_not_solved_is_named_with_what_it_contradicts() {
    let told = told(
        "point A = (0, 0) frozen, D = (4, 0) frozen, B = (1, 0), C = (3, 3)
         motor A B radius 1 speed 1rev
         length B C = 3.5; length C D = 3
         point P = C + (1, 1); rigid B C P
         step 60",
    );
    assert!(told.contains("length1 and rigid1 cannot hold together"), "{told}");
    assert!(told.contains("`solve` first"), "{told}");
}

#[test]
fn check_and_why_name_the_same_set_whichever_member_is_asked() {
    let mut talking = Talking::after(
        "point A = (0, 0) frozen, B = (1, 0), C = (0.5, 0.5), D = (5, 0) frozen
         ab: length A B = 1; bc: length B C = 1; cd: length C D = 1; bd: length B D = 1.5
         solve",
    );
    let found = talking.session.examine();
    assert!(!found.conflicting.is_empty(), "{found:?}");
    for (names, _) in &found.conflicting {
        for name in names {
            let why = talking.ask(&format!("why {name}"))[0].clone();
            let others = names.iter().filter(|other| *other != name);
            let said = why.split("it cannot hold together with ").nth(1).expect("a conflict");
            let said: Vec<_> = said.split(", ").flat_map(|part| part.split(" and ")).collect();
            assert_eq!(said, others.collect::<Vec<_>>(), "{why}");
        }
    }
}

#[test]
fn a_best_fit_that_nobody_tested_is_not_called_a_contradiction() {
    let phrase = Status::BestFit.phrase();
    assert_eq!(phrase, "no solution found from here");
    assert_eq!(Status::Contradictory.phrase(), "best fit: the constraints contradict each other");
    assert!(Status::BestFit < Status::Contradictory && Status::Contradictory < Status::Stalled);
    // Chains that are too short: the one is tested, the other is longer than what is.
    for (n_bars, expected, other) in [(20, "contradict", phrase), (520, phrase, "contradict")] {
        let mut talking = Talking::after(&format!(
            "point P[0] = (0, 0) frozen, P[{n_bars}] = (1.2 * {n_bars}, 0) frozen
             for i in 1..{n_bars} - 1 {{ point P[i] = (1.2 * i, 0) }}
             for i in 1..{n_bars} {{ length P[i - 1] P[i] = 1 }}"
        ));
        for command in ["solve", "step"] {
            talking.talk.said.clear();
            talking.run(command);
            let told = &talking.talk.said;
            assert!(told.contains(expected) && !told.contains(other), "{n_bars}: {told}");
        }
    }
}

#[test]
fn a_promise_below_rounding_is_refused_and_the_least_one_is_kept() {
    let four_bar = "point A = (0, 0) frozen, D = (4, 0) frozen, B = (1, 0), C = (3, 3)
        motor A B radius 1 speed 1rev
        length B C = 3.5
        length C D = 3";
    for command in ["step 1", "run 0.1", "solve"] {
        let mut talking = Talking::after(four_bar);
        let refused = talking.execute(&format!("{command} within 1e-30")).unwrap_err();
        assert_eq!(&*refused.message, "this cannot be promised here");
        // Eight roundings of a number of 4 units in a scene of 4.
        assert_eq!(
            refused.helps,
            ["the smallest tolerance that can be promised: `within 1.9e-15`"]
        );
        assert_eq!(talking.ask("print time"), ["0"], "a refusal lets no time pass");
        talking.run(&format!("{command} within 1.9e-15"));
        let off = talking.session.evaluate("distance(B, C) - 3.5").unwrap().number().abs();
        assert!(off <= 4.0 * 1.9e-15, "{off}");
    }
}

#[test]
fn what_sleeps_is_held_to_a_promise_too() {
    // Solved roughly, it is at rest: no frame looks at it again.
    let mut talking = Talking::after(
        "point A = (0, 0) frozen, B = (1, 0.2), C = (2, 0) frozen
         set method relaxation; set tolerance 1e-4
         length A B = 1.5; length B C = 1.5
         solve",
    );
    let residual = talking.session.examine().residual;
    assert!((1e-9..1e-4).contains(&residual), "{residual}");
    let problem = talking.execute("step within 1e-9").unwrap_err();
    assert!(problem.message.contains("did not reach the tolerance 1e-9"), "{problem:?}");
}

#[test]
fn a_rod_is_judged_by_its_own_size_and_not_by_that_of_a_circle_about_its_end() {
    let around = |radius: &str| {
        let script = format!(
            "set tolerance 1e-5
             point A = (0, 0) frozen, B = (1, 0)
             r: length A B = 1.2
             circle ring = B radius {radius}"
        );
        let mut talking = Talking::after(&script);
        [talking.ask("check"), talking.ask("why r")].concat()
    };
    assert!(around("1").contains(&"as drawn: r is off by 0.2; solved from here: satisfied".into()));
    assert_eq!(around("1"), around("1e6"));
}
