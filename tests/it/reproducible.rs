//! The same script gives the same bits: on every platform, in whatever order the constraints of
//! one scene are stated, and whether or not the run is interrupted in between.

use std::fs;
use std::path::Path;

use linkwork::lang::ast::{Command, Running};
use linkwork::session::{Nowhere, Session};

/// The places of all points and the clock after 1,000 frames of the guilloche. A change of the
/// solver's arithmetic changes it: the new one is to be pinned on purpose then.
const GUILLOCHE: u64 = 0x7ea7_5f2d_1435_be72;

/// The guilloche up to its first run.
fn guilloche() -> Session {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scripts/paper/guilloche.link");
    let text = fs::read_to_string(path).unwrap();
    let mut session = Session::new();
    let source = session.add_source("guilloche", &text, None);
    for statement in linkwork::lang::parse(source, &text) {
        let statement = statement.unwrap();
        if matches!(statement.command, Command::Running(Running::Step { .. })) {
            return session;
        }
        session.execute(&statement, &mut Nowhere).unwrap();
    }
    panic!("the script runs");
}

fn execute(session: &mut Session, text: &str) {
    let source = session.add_source("test", text, None);
    session.execute_all(source, &mut Nowhere).unwrap();
}

/// FNV-1a over the bits of all coordinates.
fn hash(session: &Session) -> u64 {
    let world = session.world();
    let coordinates = world.points().ids().map(|id| world.points().at(id));
    let numbers = coordinates.flat_map(|p| [p.x, p.y]).chain([world.clock().time()]);
    numbers
        .flat_map(|number| number.to_bits().to_le_bytes())
        .fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
            (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
        })
}

#[test]
fn a_thousand_frames_of_the_guilloche_are_pinned() {
    let mut session = guilloche();
    execute(&mut session, "step 1000");
    assert_eq!(hash(&session), GUILLOCHE, "{:#018x}", hash(&session));
}

#[test]
fn a_thousand_frames_one_by_one_are_the_same() {
    let mut session = guilloche();
    execute(&mut session, "for i in 1..1000 { step }");
    assert_eq!(hash(&session), GUILLOCHE);
}

#[test]
fn the_order_of_constraints_does_not_matter() {
    let parts = [
        "crank: motor A B radius 1 speed 1rev",
        "coupler: length B C = 3.5",
        "rocker: length C D = 3",
        "arm: rigid B C E",
        "bar: length E F = 2",
        "slide: glider F on A D",
    ];
    let ends = |order: &[usize]| {
        let mut session = Session::new();
        let points = "point A = (0, 0) frozen, D = (4, 0) frozen, B = (1, 0), C = (3, 2.9)
             point E = (2, 3), F = (3, 0)";
        execute(&mut session, points);
        order.iter().for_each(|&k| execute(&mut session, parts[k]));
        execute(&mut session, "set dt 1/360; step 400");
        hash(&session)
    };
    let first = ends(&[0, 1, 2, 3, 4, 5]);
    assert_eq!(ends(&[5, 4, 3, 2, 1, 0]), first);
    assert_eq!(ends(&[3, 0, 5, 1, 4, 2]), first);
}
