//! What commands leave behind for `undo`: as much as they changed, and nothing where they failed.

use crate::support::compare::check_same;
use crate::support::talk::Talking;
use linkwork::session::Telling;

/// A driven four-bar, so many still ones, and a point far from all of them.
fn scene(n: usize) -> Talking {
    let mut talking = Talking::after(&format!(
        "set dt 1/360
         for i in 0..{n} {{
           point A[i] = (0, 6 * i) frozen, D[i] = (4, 6 * i) frozen
           point B[i] = (1, 6 * i), C[i] = (3, 6 * i + 2.9)
           length A[i] B[i] = 1
           length B[i] C[i] = 3.5
           length C[i] D[i] = 3
         }}
         let r = 2
         point Y = (-90, 0) frozen, Z = (-90, 1)
         length Y Z = r"
    ));
    talking.run("step 3");
    talking
}

/// The bytes that a command adds to what is kept.
fn kept_by(talking: &mut Talking, command: &str) -> isize {
    let before = talking.session.undo_bytes();
    // One that fails is one of those.
    let _ = talking.execute(command);
    talking.session.undo_bytes().cast_signed() - before.cast_signed()
}

#[test]
fn poses_that_the_commands_before_kept_are_not_kept_again() {
    let n: isize = 50;
    let mut talking = Talking::after(&format!(
        "set dt 1/360
         for i in 1..{n} {{
           point A[i] = (0, 6 * i) frozen, D[i] = (4, 6 * i) frozen
           point B[i] = (1, 6 * i), C[i] = (3, 6 * i + 2.9)
           length B[i] C[i] = 3.5
           length C[i] D[i] = 3
         }}
         for i in 1..{n} {{ motor A[{n} + 1 - i] B[{n} + 1 - i] speed 1rev }}"
    ));
    talking.run("step 4; step 4");
    let alone = kept_by(&mut talking, "step 4");
    talking.run("step; step; step; step");
    let [first, second] = [(); 2].map(|()| kept_by(&mut talking, "step"));
    assert_eq!(first, second);
    // Three poses of two points of each.
    let shared = 3 * 2 * 16 * n;
    assert!(alone - first >= shared, "{alone} bytes alone, {first} behind another");
    // Two places, a heading, and three numbers of the solver's.
    let own = 2 * 16 + 40 + 3 * 8;
    assert!(first <= own * n + 1000, "{first} bytes for {n} four-bars");
    talking.run("print velocity(B[1]), velocity(B[2])");
    assert_eq!(kept_by(&mut talking, "step"), first, "behind a look");
    let mut before = Vec::new();
    for _ in 0..8 {
        before.push(talking.script());
        talking.run("step");
    }
    let end = talking.script();
    for script in before.iter().rev() {
        talking.run("undo");
        check_same(&talking.script(), script, "taken back");
    }
    talking.run("redo 8");
    check_same(&talking.script(), &end, "done again");
}

/// How many handles of each kind were given out.
fn handles(talking: &Talking) -> [usize; 4] {
    let world = talking.world();
    [
        world.points().column().len(),
        world.next_constraint().idx(),
        world.next_parameter().idx(),
        world.next_measure().idx(),
    ]
}

#[test]
fn handles_that_nothing_has_any_more_are_given_out_again() {
    const MAKES: &str = "for i in 1..3 {
        point P[i] = (i, 0); let q[i] = i; measure d[i] = P[i].x; step; length P[i] Z; step
      }";
    let mut talking = scene(3);
    let before = handles(&talking);
    for k in 0..20 {
        assert!(talking.execute(&MAKES.replace("length", "print nowhere; length")).is_err());
        assert_eq!(handles(&talking), before, "{k} failed");
        talking.run(MAKES);
        talking.run("delete P[2] cascade");
        let after = handles(&talking);
        talking.run("undo 2; redo 2");
        assert_eq!(handles(&talking), after, "{k} done again");
        let script = talking.script();
        talking.run("undo 2");
        assert_eq!(handles(&talking), before, "{k} taken back");
        talking.run("redo 2");
        check_same(&talking.script(), &script, "done again");
        talking.run("step; undo 3; clear; point P = (0, 0), Q = (1, 0)");
        assert_eq!(handles(&talking), [2, 0, 0, 0], "{k} cleared");
        talking.run("length P Q = 2; solve; undo 4");
        let before = talking.script();
        talking.run("for i in 1..1 { step; move Z to (-90, 1.5); solve; clear }");
        assert_eq!(handles(&talking), [0; 4], "{k} moved and cleared");
        talking.run("undo");
        check_same(&talking.script(), &before, "moved and cleared");
    }
}

#[test]
fn a_command_keeps_what_it_changes_however_large_the_scene() {
    let kept = |n: usize| {
        let mut talking = scene(n);
        [
            "step",
            "move Z to (-90, 1.5)",
            "step",
            "step 20",
            "let r = 2.5",
            "step",
            "undo",
            "redo",
            "for i in 1..3 { step; move Z to (-90, i); print nowhere }",
            "print velocity(Z)",
            "pull Z to (-88, 0)",
            "drag Z to (-90, 2) over 3",
            "solve",
            "off length4; on length4; step",
            "undo 3",
            "step",
        ]
        .map(|command| (command, kept_by(&mut talking, command)))
    };
    let few = kept(5);
    assert_eq!(few, kept(500));
    let failed = few.iter().find(|(command, _)| command.contains("nowhere"));
    assert_eq!(failed.expect("it is one of them").1, 0);
    // What was taken back is kept for `redo`.
    assert!(few.iter().all(|(_, n_bytes)| n_bytes.abs() < 4_000), "{few:?}");
}

#[test]
fn what_failed_leaves_no_trace_in_the_bits_of_what_follows() {
    // The heading of a motor that has not turned is not quite that of one that was set back.
    let motor = "point A = (0, 0) frozen, B = (1, 0)
                 motor A B radius 1 speed 1rev phase -3.470";
    let live = "point A = (0, 0) frozen, B = (1, 0), C = (2, 2)
                length A B = 1 + sin(7 * time); length B C = 3; hold C.y = B.x + 1";
    let wheels = "point A = (0, 0) frozen, B = (1, 0), C = (4, 0) frozen, D = (5, 0)
                  motor A B speed 1rev from C D phase 0.7; cog A B, C D ratio 2; set cog velocity";
    for scene in [motor, live, wheels] {
        let mut plain = Talking::after(scene);
        let mut failing = Talking::after(scene);
        for next in ["solve", "step 2", "move B to (0.5, 0.7)", "step"] {
            for wrong in
                ["for i in 0..3 { step; print nowhere }", "for i in 1..1 { reset; solve; bad }"]
            {
                assert!(failing.execute(wrong).is_err(), "{wrong}");
            }
            plain.run(next);
            failing.run(next);
            check_same(&failing.script(), &plain.script(), &format!("{next}, {scene}"));
        }
    }
}

#[test]
fn a_motor_that_was_made_late_and_taken_back_begins_anew() {
    let make = |speed: f64| format!("m: motor A B radius 1 phase {speed} speed {speed}");
    let mut talking = Talking::after("point A = (0, 0) frozen, B = (1, 0); step 2");
    let mut plain = Talking::after("point A = (0, 0) frozen, B = (1, 0); step 2");
    talking.run(&make(1.0));
    talking.run("step; undo 2");
    for talking in [&mut talking, &mut plain] {
        talking.run(&make(0.5));
        talking.run("step 3; reset");
    }
    check_same(&talking.script(), &plain.script(), "the same motor at the start");
}

#[test]
fn what_is_kept_counts_recordings_traces_and_ghosts() {
    let mut talking = Talking::after("point A = (0, 0) frozen, B = (1, 0); motor A B speed 1rev");
    talking.run("trace B; record \"a.csv\"; expose every 1");
    talking.run("step 1000");
    let n_rows = 1000;
    // A place of a trace, a row of a table, a ghost of two points.
    assert!(kept_by(&mut talking, "undo") > n_rows * (16 + 24 + 48));
    assert!(kept_by(&mut talking, "redo") < -n_rows * (16 + 24 + 48));
    assert!(kept_by(&mut talking, "record stop") > n_rows * 24);
    assert!(kept_by(&mut talking, "clear") > n_rows * (16 + 48));
}

#[test]
fn a_motion_is_studied_from_where_it_began_after_it_was_taken_back_and_done_again() {
    let mut talking = Talking::after("point A = (0, 0) frozen, B = (1, 0), C = (3, 0)");
    talking.run("motor A B speed 1rev; length B C = 2; let r = 1");
    talking.run("step 7; drag C to (2, 2) over 20; print 1; let r = 3");
    let before = talking.script();
    for way in ["undo 2; redo 2", "undo 2"] {
        talking.run(way);
        let now = talking.script();
        let Talking { session, talk } = &mut talking;
        session.study_accuracy(Some(1), Telling::Json, talk).expect("there is a motion");
        check_same(&talking.script(), &now, "looking changes nothing");
    }
    talking.run("redo 2");
    check_same(&talking.script(), &before, "nor what is done again");
}

#[test]
fn a_freeze_that_is_taken_back_gives_what_measures_the_point_its_values_back() {
    // What is driven by a value is as old as the frame that gave it, and by how it is bound then.
    let scene = "point O = (0, 0) frozen, G = (1, 0), A = (5, 0), B = (7, 0), E = (0, 5)
                 motor O G speed 1rev; set dt 1/7; let far = distance(A, B)
                 length E B = 2 + turn(O, G) / 9; length O A = 4 + far / 3
                 hold E.x = (A.y + G.y) / 5; step 5";
    let freezes = [
        "freeze G",
        "freeze A B",
        "freeze G; thaw G",
        "thaw O; freeze O G",
        "freeze B; step 3; thaw B",
        "for i in 1..3 { freeze G; step; thaw G; freeze A }",
        "freeze all; thaw all",
    ];
    for freeze in freezes {
        let mut talking = Talking::after(scene);
        let mut plain = Talking::after(scene);
        talking.run(&format!("for i in 1..1 {{ {freeze} }}"));
        let frozen = talking.script();
        talking.run("undo");
        check_same(&talking.script(), &plain.script(), &format!("{freeze} taken back"));
        talking.run("redo");
        check_same(&talking.script(), &frozen, &format!("{freeze} done again"));
        talking.run("undo; step 2");
        plain.run("step 2");
        check_same(&talking.script(), &plain.script(), &format!("after {freeze}"));
    }
}

#[test]
fn how_much_a_bar_is_missed_by_is_told_with_the_values_of_now() {
    // At time 0 its length is 3, and so far apart are its ends.
    let scene = "point A = (0, 0) frozen, B = (3, 0); let r = 3; bar: length A B = r
        let q = 3 + time; let r = q; measure m = bar.residual";
    for (then, first) in [
        (&["step 2", "undo"][..], 0.0),
        (&["for i in 1..2 { step; length B nowhere }"], 0.0),
        (&["step 2", "reset"], 0.0),
        (&["step 2", "let r = q + 1", "undo 2"], 0.0),
        // The other way round it is longer by 1 before the first frame.
        (&["let r = q + 1", "step 2", "undo"], -1.0),
    ] {
        let after = || {
            let mut talking = Talking::after(scene);
            // What fails is one of those.
            then.iter().for_each(|statement| drop(talking.execute(statement)));
            talking
        };
        assert_eq!(after().ask("bar.residual"), [first.to_string()], "{then:?}");
        let mut talking = after();
        talking.run("let missed = bar.residual");
        assert_eq!(talking.ask("missed"), [first.to_string()], "{then:?}");
        // It is solved before it is measured.
        let mut talking = after();
        talking.run("step");
        assert_eq!(talking.ask("m.first"), ["0"], "{then:?}");
    }
}
