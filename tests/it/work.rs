//! What a frame does, counted by the solver itself: nothing that the scene does not call for.
//! `benches/counting.py` counts instructions of the whole program for the same claims.

use std::cell::Cell;
use std::io;
use std::path::Path;
use std::sync::LazyLock;
use std::time::Instant;

use linkwork::constraint::Point;
use linkwork::diag::{Diagnostic, Sources};
use linkwork::session::{Host, Nowhere, Session};
use linkwork::solve::{Budget, Counters, Report, Settings, Solver, Status, is_one_sided};
use linkwork::world::{Edit, Entity, World};

use crate::support::talk::Talking;

/// When the first clock was made.
static BEGUN: LazyLock<Instant> = LazyLock::new(Instant::now);

/// Frames for what is new to come to rest, and frames that are counted.
const FIRST: usize = 5;
const COUNTED: usize = 60;

const FOUR_BAR: &str = "
point A = (0, 0) frozen, D = (4, 0) frozen
point B = (1, 0), C = (3, 2.9)
motor A B radius 1 speed 1rev
length B C = 3.5
length C D = 3
set dt 1/360
";

/// A host with a clock of its own, which counts how often it was looked at.
struct Clock {
    /// The time at the look of this number, seconds.
    time: fn(u64) -> f64,
    n_looks: Cell<u64>,
}

impl Host for Clock {
    fn print(&mut self, _line: &str) {}

    fn tell(&mut self, _what: &Diagnostic, _sources: &Sources) {}

    fn read(&mut self, _path: &Path) -> io::Result<String> {
        Err(io::Error::from(io::ErrorKind::NotFound))
    }

    fn write(&mut self, _path: &Path, _bytes: &[u8]) -> io::Result<()> {
        Ok(())
    }

    fn seconds(&self) -> Option<f64> {
        self.n_looks.update(|n| n + 1);
        Some((self.time)(self.n_looks.get()))
    }
}

/// The world that a script makes.
fn world(script: &str) -> World {
    let mut session = Session::new();
    let source = session.add_source("work", script, None);
    session.execute_all(source, &mut Nowhere).expect("a script that works");
    session.world().clone()
}

fn pass(world: &mut World, solver: &mut Solver) -> Counters {
    pass_with(world, solver, |_| {})
}

fn pass_with(world: &mut World, solver: &mut Solver, hand: impl FnOnce(&mut World)) -> Counters {
    frame(world, solver, &Settings::default(), hand)
}

fn frame(
    world: &mut World,
    solver: &mut Solver,
    settings: &Settings,
    hand: impl FnOnce(&mut World),
) -> Counters {
    let report = solver.step(world, settings, &Budget::default(), hand);
    report.expect("values at every time").counters
}

/// The work of some frames of a scene, once it has come to rest.
fn work(script: &str) -> Counters {
    let mut world = world(script);
    let mut solver = Solver::new();
    (0..FIRST).for_each(|_| _ = pass(&mut world, &mut solver));
    let mut all = Counters::default();
    (0..COUNTED).for_each(|_| all.add(&pass(&mut world, &mut solver)));
    all
}

fn check_same(moving: &str, with: &str) {
    let alone = work(moving);
    assert!(alone.evaluations > 0, "the scene moves");
    assert_eq!(alone, work(&format!("{moving}{with}")), "{with}");
}

#[test]
fn where_a_hand_only_passes_nothing_is_searched_for() {
    let work = |solve: fn(&mut Solver, &mut World, &Settings, &Budget<'_>) -> Report| {
        let (mut world, mut solver) = (world(FOUR_BAR), Solver::new());
        let (settings, budget) = (Settings::default(), Budget::default());
        solver.settle(&mut world, &settings, &budget);
        let Some(Entity::Point(d)) = world.names().get("D") else { panic!("there is a D") };
        // Out of reach: the hand goes on from here.
        world.apply(Edit::Move(d, Point::new(9.0, 0.0)));
        let there = solve(&mut solver, &mut world, &settings, &budget);
        assert_eq!(there.status, Status::BestFit);
        // And back: all holds as well as ever.
        world.apply(Edit::Move(d, Point::new(4.0, 0.0)));
        assert_eq!(solve(&mut solver, &mut world, &settings, &budget).status, Status::Converged);
        there.counters.evaluations
    };
    let (passing, stopping) = (work(Solver::lead), work(Solver::settle));
    assert!(3 * passing < stopping, "{passing} and {stopping} evaluations");
}

#[test]
fn where_a_hand_lets_go_it_is_settled() {
    let mut talking = Talking::after(FOUR_BAR);
    talking.run("drag D through (9, 0), (8.5, 0) over 0");
    let place = |talking: &mut Talking| talking.session.evaluate("C").expect("a place").vector();
    let there = place(&mut talking);
    talking.run("solve");
    let settled = place(&mut talking);
    assert!((settled - there).norm() < 1e-9, "{there:?}, {settled:?}");
}

#[test]
fn still_constraints_are_no_work() {
    check_same(
        FOUR_BAR,
        "for i in 1..25000 {
           point P[i] = (i, 10) frozen, Q[i] = (i, 11), R[i] = (i + 1, 11), S[i] = (i + 1, 10)
           length P[i] Q[i] = 1
           length Q[i] R[i] = 1
           length R[i] S[i] = 1
           length S[i] P[i] = 1
         }",
    );
}

#[test]
fn still_constraints_between_frozen_points_are_no_work() {
    check_same(
        FOUR_BAR,
        "point F[0] = (0, 10) frozen
         for i in 1..20000 { point F[i] = (i, 10) frozen; length F[i-1] F[i] = 1 }",
    );
}

#[test]
fn a_large_still_island_is_no_work() {
    check_same(
        FOUR_BAR,
        "point F[0] = (0, 10) frozen
         for i in 1..5000 { point F[i] = (i, 10); length F[i-1] F[i] = 1 }",
    );
}

#[test]
fn a_still_island_that_cannot_be_solved_is_no_work() {
    check_same(
        FOUR_BAR,
        "point U = (0, 10), V = (2, 10), W = (1, 11)
         length U V = 3; length V W = 1; length W U = 1",
    );
}

/// Four-bars of which each but the first is made to stand still in some way.
fn four_bars(n: usize, still: &str) -> String {
    format!(
        "set dt 1/360
         for i in 1..{n} {{
           point A[i] = (0, 6 * i) frozen, D[i] = (4, 6 * i) frozen
           point B[i] = (1, 6 * i), C[i] = (3, 6 * i + 2.9)
           length B[i] C[i] = 3.5
           length C[i] D[i] = 3
         }}
         motor A[1] B[1] radius 1 speed 1rev
         for i in 2..{n} {{ {still} }}"
    )
}

#[test]
fn one_driven_mechanism_of_many_is_the_work_of_one() {
    let alone = work(&four_bars(1, ""));
    for still in ["freeze B[i]", "motor A[i] B[i] radius 1 speed 0", "length A[i] B[i] = 1"] {
        assert_eq!(alone, work(&four_bars(10_000, still)), "{still}");
    }
}

#[test]
fn dragging_one_of_many_is_the_work_of_one() {
    let drag = |n: usize| {
        let mut world = world(&four_bars(n, "freeze B[i]"));
        let mut solver = Solver::new();
        (0..FIRST).for_each(|_| _ = pass(&mut world, &mut solver));
        let Some(Entity::Point(d)) = world.names().get("D[1]") else { panic!("no point") };
        let mut all = Counters::default();
        for k in 1..=COUNTED {
            let to = Point::new(4.0 + 0.01 * k as f64, 6.0);
            all.add(&pass_with(&mut world, &mut solver, |world| {
                world.apply(Edit::Move(d, to));
            }));
        }
        all
    };
    assert_eq!(drag(1), drag(1000));
}

/// The work of a hand that moves one end of a triangle by this much while time stands still.
fn nudge(apex: &str, by: f64) -> Counters {
    let mut world = world(&format!(
        "point A = (0, 0) frozen, D = (4, 0) frozen, C = {apex}\nlength A C\nlength C D"
    ));
    let mut solver = Solver::new();
    let mut settle =
        |world: &mut World| solver.settle(world, &Settings::default(), &Budget::default()).counters;
    settle(&mut world);
    let Some(Entity::Point(d)) = world.names().get("D") else { panic!("no point") };
    world.apply(Edit::Move(d, Point::new(4.0 + by, 0.0)));
    settle(&mut world)
}

#[test]
fn what_moves_farther_than_the_hand_is_not_solved_again_from_around() {
    // The apex of the flat one moves ten times as far as the hand does, and both go straight.
    let [steep, flat] = ["(2, 2)", "(2, 0.2)"].map(|apex| nudge(apex, 1e-4));
    assert!(flat.factorisations <= 2 * steep.factorisations, "{flat:?}, {steep:?}");
}

/// Scenes that call for one effect more than a four-bar does.
const EFFECTS: [(&str, &str); 6] = [
    ("wheel angles", "point E = (2, 0) frozen, F = (3, 0)\ncog A B, E F ratio 1"),
    (
        "wheel angles",
        "point G = (-9, -1) frozen, H = (9, -1) frozen, W = (6, 0), R = (6, -1)
                      length W R = 1\nrack W R on G H",
    ),
    ("inequalities", "point E = (9, 9) frozen, F = (9, 8)\nlength E F <= 5"),
    ("traces", "trace C"),
    ("ghosts", "expose every 10"),
    ("derivatives", "let v = norm(velocity(C))"),
];

#[test]
fn what_no_statement_calls_for_has_no_memory() {
    let effects = |with: &str| {
        let mut session = Session::new();
        let source = session.add_source("work", &format!("{FOUR_BAR}{with}\nstep 30"), None);
        session.execute_all(source, &mut Nowhere).expect("a script that works");
        session.effects_on(&Nowhere).rows
    };
    let without = effects("");
    for (name, with) in EFFECTS {
        let off = without.iter().find(|row| row.name == name).expect("a known effect");
        assert!(!off.is_on && off.n_bytes == 0, "{name}");
        for row in effects(with) {
            let is_on = row.name == name || without.iter().any(|r| r.name == row.name && r.is_on);
            assert_eq!(row.is_on, is_on, "{}, asked for: {with}", row.name);
            assert!(row.is_on || row.n_bytes == 0, "{}, asked for: {with}", row.name);
        }
    }
}

#[test]
fn shares_are_parts_of_the_frame_that_was_timed() {
    type Named = (&'static str, fn(u64) -> f64);
    // Without those that would declare a point a second time.
    let all = EFFECTS[1..].iter().map(|(_, with)| *with).filter(|with| !with.contains("point E"));
    let all = all.collect::<Vec<_>>().join("\n");
    let mut session = Session::new();
    session.run(&format!("{FOUR_BAR}{all}\nrecord \"a.svg\" every 7\nstep 30")).expect("it works");
    let clocks: [Named; 5] = [
        ("of this machine", |_| BEGUN.elapsed().as_secs_f64()),
        ("that stands", |_| 1.0),
        ("that ticks", |n| n as f64 * 1e-6),
        ("that is slower early than late", |n| (n * n) as f64 * 1e-9),
        ("on which what is done later takes ever longer", |n| 1e-9 * 1.2_f64.powf(n as f64)),
    ];
    for (name, time) in clocks {
        let effects = session.effects_on(&Clock { time, n_looks: Cell::new(0) });
        assert!(effects.n_frames > 0, "clock {name}");
        let sum: f64 = effects.rows.iter().map(|row| row.seconds).sum();
        assert!(effects.rows.iter().all(|row| row.seconds >= 0.0), "clock {name}");
        assert!(sum <= effects.seconds * (1.0 + 1e-12), "clock {name}: {sum} {}", effects.seconds);
    }
}

#[test]
fn an_effect_is_timed_on_the_islands_that_are_visited() {
    let still = "for i in 1..200 { point P[i] = (i, 10) frozen, Q[i] = (i, 11)
                 length P[i] Q[i] = 1.5; length P[i] Q[i] <= 9 }";
    let mut world = world(&format!("{FOUR_BAR}{still}\nlength A C <= 9"));
    let mut solver = Solver::new();
    (0..FIRST).for_each(|_| _ = pass(&mut world, &mut solver));
    assert_eq!(solver.n_islands(), (201, 1));
    assert_eq!(solver.rehearse_predictions(), 1);
    assert_eq!(solver.rehearse_constraints(is_one_sided), 1);
}

#[test]
fn no_wheels_no_evaluations_of_wheels() {
    assert_eq!(work(FOUR_BAR).wheel_evaluations, 0);
    let all = [EFFECTS[2].1, EFFECTS[3].1, EFFECTS[4].1, EFFECTS[5].1].join("\n");
    assert_eq!(work(&format!("{FOUR_BAR}{all}")).wheel_evaluations, 0);
    // And each frame looks at a wheel that is there.
    let cog = "point E = (2, 0) frozen, F = (3, 0)\ncog A B, E F ratio 1\n";
    assert!(work(&format!("{FOUR_BAR}{cog}")).wheel_evaluations >= COUNTED as u64);
}

#[test]
fn a_still_scene_is_no_work_at_all() {
    let still = "point A = (0, 0) frozen, B = (1, 1)\nlength A B = 2\n";
    assert_eq!(work(still), Counters::default());
}

#[test]
fn an_island_is_built_once() {
    let counters = work(FOUR_BAR);
    assert_eq!(counters.islands_rebuilt, 0);
    assert_eq!(counters.islands_visited, COUNTED as u64);
}

#[test]
fn a_looser_tolerance_is_no_more_work() {
    let crankshaft = include_str!("../../scripts/bench/w4-crankshaft.link");
    let crankshaft = crankshaft.replace("step frames", "");
    for script in [FOUR_BAR, &crankshaft] {
        let work = |tolerance: f64| {
            let (mut world, mut solver) = (world(script), Solver::new());
            let settings = Settings { tolerance, ..Settings::default() };
            let mut all = Counters::default();
            (0..360).for_each(|_| all.add(&frame(&mut world, &mut solver, &settings, |_| {})));
            all
        };
        let tight = work(1e-12);
        for tolerance in [1e-8, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2] {
            let loose = work(tolerance);
            assert!(loose.evaluations <= tight.evaluations, "{tolerance}: {loose:?} {tight:?}");
            assert!(loose.substeps <= tight.substeps, "{tolerance}: {loose:?} {tight:?}");
        }
    }
}
