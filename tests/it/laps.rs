//! Paths that come round again: kept once, and told as if each lap were kept.

use linkwork::Session;
use linkwork::world::{Sample, Trace};

const FOUR_BAR: &str = "point A = (0, 0) frozen, D = (4, 0) frozen, B = (1, 0), C = (3, 3)
    motor A B radius 1 speed 1rev; coupler: length B C = 3.5; length C D = 3
    solve; trace B, C\n";

fn traces(session: &Session) -> &[Trace] {
    session.world().traces()
}

/// The bits of all samples.
fn bits(trace: &Trace) -> Vec<(u64, u64, bool)> {
    let of = |s: &Sample| (s.at.x.to_bits(), s.at.y.to_bits(), s.missed);
    trace.samples.iter().map(of).collect()
}

fn after(statements: &str) -> Session {
    let mut session = Session::new();
    session.run(&format!("{FOUR_BAR}{statements}")).unwrap_or_else(|e| panic!("{e}"));
    session
}

#[test]
fn a_hundred_laps_take_the_room_of_one() {
    for per_turn in [60, 100, 360] {
        let bytes = |n_laps: u32| -> Vec<usize> {
            let session = after(&format!("set dt 1/{per_turn}; step {}", n_laps * per_turn));
            let n = traces(&session).iter().map(|trace| trace.samples.len());
            assert!(n.eq([(n_laps * per_turn) as usize; 2]), "each frame has its sample");
            traces(&session).iter().map(|trace| trace.samples.n_bytes()).collect()
        };
        let (one, hundred) = (bytes(1), bytes(100));
        // The rocker comes back to the bit. The crank may be off by a last digit once a turn.
        assert_eq!(hundred[1], one[1], "{per_turn} frames a turn");
        assert!(hundred[0] <= one[0] + 100 * 32, "{per_turn} frames a turn: {one:?} {hundred:?}");
    }
}

#[test]
fn what_is_kept_once_is_as_what_is_kept() {
    // Steps of one frame each, by another way, with and without an undo in the midst of a lap.
    let whole = after("set dt 1/60; step 1234");
    let wanted: Vec<_> = traces(&whole).iter().map(bits).collect();
    let check = |what: &str, session: &Session| {
        let found: Vec<_> = traces(session).iter().map(bits).collect();
        assert!(found == wanted, "{what}");
    };
    check("frame by frame", &after(&format!("set dt 1/60\n{}", "step\n".repeat(1234))));
    check("undone", &after("set dt 1/60; step 900; step 71; undo; step 334"));
    check("done again", &after("set dt 1/60; step 400; step 834; undo 2; redo 2"));
    let mut loaded = Session::new();
    loaded.run(&whole.to_script()).unwrap_or_else(|e| panic!("{e}"));
    check("saved", &loaded);
    assert_eq!(loaded.to_script(), whole.to_script());
    // Of a session that goes on, and one that was saved in between.
    let mut first = after("set dt 1/60; step 700");
    let mut second = Session::new();
    second.run(&first.to_script()).unwrap_or_else(|e| panic!("{e}"));
    for session in [&mut first, &mut second] {
        session.run("step 534").unwrap_or_else(|e| panic!("{e}"));
    }
    check("gone on", &first);
    check("gone on from a file", &second);
}

#[test]
fn another_lap_is_another_lap() {
    // The coupler is changed for some laps, and the point is put elsewhere for a frame.
    let session = after(
        "set dt 1/60; step 600; change coupler = 3.4; step 600; change coupler = 3.5; step 630",
    );
    let trace = &traces(&session)[1];
    assert_eq!(trace.samples.len(), 1830);
    let lap = 60 * size_of::<Sample>();
    assert!(trace.samples.n_bytes() < 12 * lap, "{} laps", trace.samples.n_bytes() / lap);
    let again = after(
        "set dt 1/60; for i in 1..600 { step }; change coupler = 3.4; for i in 1..600 { step }
         change coupler = 3.5; for i in 1..630 { step }",
    );
    assert!(bits(trace) == bits(&traces(&again)[1]));
    let shift = |k: usize| trace.samples[k].at.distance(trace.samples[k - 60].at);
    assert!(shift(600 + 59) > 1e-3 && shift(1200 + 59) > 1e-3, "each change is seen");
}

#[test]
fn what_undo_keeps_of_laps_is_a_lap() {
    let bytes = |n: u32| {
        let mut session = after(&format!("set dt 1/60; step {n}"));
        session.run("undo").unwrap_or_else(|e| panic!("{e}"));
        session.undo_bytes()
    };
    let (one, hundred) = (bytes(60), bytes(6000));
    assert!(hundred < 2 * one + 10_000, "{one} bytes, and {hundred} of a hundred laps");
}
