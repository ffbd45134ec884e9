//! The laws of a session: a command is whole or nothing, `undo` and `redo` are exact, and what
//! is saved goes on to the same bits.

use crate::support::compare::check_same;
use crate::support::talk::Talking;
use proptest::prelude::*;

/// What there is before anything random happens: a four-bar with a driven crank, an actuator,
/// wheels, and a chain.
const SCENE: &str = "
    point A = (0, 0) frozen, D = (4, 0) frozen, B = (1, 0), C = (3, 3)
    let r = 3.5
    crank: motor A B speed 1rev
    coupler: length B C = r
    rocker: length C D = 3
    point E = (6, 1), F = (7, 2) frozen
    act: length F E = 2 + sin(time)
    point O = (9, 0) frozen, G = (10, 0), Q = (12, 0) frozen, H = (11, 0)
    wheels: cog O G, Q H ratio 2
    spin: motor O G speed 90deg
    define tail(P, l) { point X = P + (l, 0), Y = P + (2 * l, 0); length P X = l; length X Y = l }
    use tail(C, r / 4) as tail
    set dt 1/30
";

/// Statements that may or may not make sense when their turn comes.
fn statement() -> impl Strategy<Value = String> {
    let point = || prop::sample::select(vec!["B", "C", "E", "G", "K1", "K2", "tail.X", "tail.Y"]);
    let constraint = || {
        let names = vec!["crank", "coupler", "rocker", "act", "wheels", "spin", "rod1", "rod2"];
        prop::sample::select(names)
    };
    let number = || (-40..40_i32).prop_map(|n| f64::from(n) / 8.0);
    let place = move || (number(), number()).prop_map(|(x, y)| format!("({x}, {y})"));
    prop_oneof![
        4 => (0..12_u32).prop_map(|n| format!("step {n}")),
        2 => (number(),).prop_map(|(t,)| format!("run {}", t / 16.0)),
        2 => (1..3_u32, place()).prop_map(|(k, at)| format!("point K{k} = {at}")),
        2 => (point(), place()).prop_map(|(p, at)| format!("move {p} to {at}")),
        2 => (point(), place(), 1..6_u32).prop_map(|(p, at, n)| format!("drag {p} to {at} over {n}")),
        1 => (point(), point(), place()).prop_map(|(p, q, at)| format!("drag {p} to {at}, {q} to (1, 1) over 2")),
        1 => point().prop_map(|p| format!("freeze {p}")),
        1 => point().prop_map(|p| format!("thaw {p}")),
        2 => (1..3_u32, point(), point()).prop_map(|(k, p, q)| format!("rod{k}: length {p} {q}")),
        1 => (point(), point(), number()).prop_map(|(p, q, l)| format!("length {p} {q} <= {l}")),
        1 => (point(), point()).prop_map(|(p, q)| format!("length {p} {q} = 2 + sin(3 * time)")),
        1 => (point(), number()).prop_map(|(p, x)| format!("coordinate {p} at ({x} + time, 2)")),
        1 => (point(), point()).prop_map(|(p, q)| format!("motor {p} {q} speed 0.5rev")),
        1 => (point(), point()).prop_map(|(p, q)| format!("glider {p} on F {q}")),
        1 => (point(), point()).prop_map(|(p, q)| format!("rigid {p} {q} A")),
        1 => (point(), point()).prop_map(|(p, q)| format!("parallel {p} {q}, A D")),
        1 => (point(), point()).prop_map(|(p, q)| format!("length {p} {q} = distance(A, B) + 1")),
        2 => constraint().prop_map(|c| format!("off {c}")),
        2 => constraint().prop_map(|c| format!("on {c}")),
        2 => (constraint(), number()).prop_map(|(c, v)| format!("change {c} = {v}")),
        1 => (constraint(), number()).prop_map(|(c, v)| format!("change {c} speed {v} * 90deg")),
        1 => (number(),).prop_map(|(v,)| format!("change wheels ratio {v}")),
        1 => (number(),).prop_map(|(v,)| format!("change wheels ratio 2 + sin(time) * {v} / 8")),
        2 => (number(),).prop_map(|(v,)| format!("let r = {v}")),
        1 => (number(),).prop_map(|(v,)| format!("let r = 3.5 + {v} / 20 * sin(time)")),
        1 => (number(),).prop_map(|(v,)| format!("let s = r * {v}, u = 1 / s")),
        1 => Just("let s = distance(A, C)".to_owned()),
        1 => point().prop_map(|p| format!("delete {p}")),
        1 => point().prop_map(|p| format!("delete {p} cascade")),
        1 => constraint().prop_map(|c| format!("delete {c}")),
        1 => Just("delete tail cascade".to_owned()),
        1 => Just("delete r cascade".to_owned()),
        1 => Just("use tail(B, 1)".to_owned()),
        1 => Just("use tail(C, r / 4) as tail".to_owned()),
        1 => Just("define tail(P, l) { point X = P; length P F = l }".to_owned()),
        1 => (point(), 1..4_u32).prop_map(|(p, n)| format!("trace {p} every {n}")),
        1 => point().prop_map(|p| format!("untrace {p}")),
        1 => Just("expose every 3".to_owned()),
        1 => Just("expose".to_owned()),
        1 => (constraint(), 1..15_u32).prop_map(|(c, n)| format!("set rho {} for {c}", f64::from(n) / 8.0)),
        1 => (point(), 1..5_u32).prop_map(|(p, n)| format!("set weight {n} for {p}")),
        1 => (1..5_u32).prop_map(|n| format!("set dt 1/{}", 10 * n)),
        1 => prop::sample::select(vec!["auto", "relaxation", "successive", "newton"])
            .prop_map(|m| format!("set method {m}")),
        1 => Just("reset".to_owned()),
        1 => Just("clear".to_owned()),
        1 => Just("solve".to_owned()),
        1 => (0..5_u32).prop_map(|n| format!("relax {n}")),
        1 => (1..4_u32, place()).prop_map(|(n, at)| format!("for i in 1..{n} {{ step; move B to {at}; let r = 3 + i / 8 }}")),
        1 => (1..3_u32,).prop_map(|(n,)| format!("for i in 1..{n} {{ point L[i] = (i, i); step; length L[i] A; reset; off crank }}")),
        1 => (1..4_u32,).prop_map(|(n,)| format!("for i in 1..{n} {{ off crank; step 2; on crank; trace B; step; untrace B }}")),
        1 => point().prop_map(|p| format!("for i in 1..2 {{ freeze {p}; step; thaw {p}; change act = 2 + i / 4; step; length {p} nowhere }}")),
        1 => Just("print velocity(C), list".to_owned()),
    ]
}

fn statements(most: usize) -> impl Strategy<Value = Vec<String>> {
    prop::collection::vec(statement(), 1..most)
}

/// Carries out a statement; whether it took effect. One that fails must have none.
fn tries(talking: &mut Talking, statement: &str) -> bool {
    let before = talking.script();
    let is_done = talking.execute(statement).is_ok();
    if !is_done {
        check_same(&talking.script(), &before, &format!("`{statement}` failed"));
    }
    is_done
}

fn undo_and_redo(statements: &[String]) {
    let mut talking = Talking::after(SCENE);
    let mut worlds = vec![talking.script()];
    for statement in statements {
        tries(&mut talking, statement);
        let world = talking.script();
        if worlds.last() != Some(&world) {
            worlds.push(world);
        }
    }
    // Commands that left no mark in the text are steps of their own: walk until it changes.
    let mut walk = |command: &str, wanted: &String| {
        for _ in 0..=statements.len() {
            if talking.script() == *wanted {
                return;
            }
            assert!(talking.execute(command).is_ok(), "`{command}` led nowhere");
        }
        check_same(&talking.script(), wanted, &format!("after `{command}`"));
    };
    worlds.iter().rev().for_each(|world| walk("undo", world));
    worlds.iter().for_each(|world| walk("redo", world));
}

fn saved_goes_on(before: &[String], after: &[String]) {
    let mut talking = Talking::after(SCENE);
    for statement in before {
        tries(&mut talking, statement);
    }
    let script = talking.script();
    let mut other = Talking::after(&script);
    check_same(&other.script(), &script, "a loaded world saves otherwise");
    for statement in after {
        let is_done = tries(&mut talking, statement);
        assert_eq!(tries(&mut other, statement), is_done, "`{statement}` knows what was loaded");
        check_same(&other.script(), &talking.script(), &format!("after `{statement}`"));
    }
}

/// As many cases as a test run has time for; `PROPTEST_CASES` asks for more.
fn config() -> ProptestConfig {
    let cases = std::env::var("PROPTEST_CASES").ok().and_then(|n| n.parse().ok()).unwrap_or(24);
    let failure_persistence = None;
    ProptestConfig {
        cases,
        failure_persistence,
        max_shrink_iters: 2_000,
        ..ProptestConfig::default()
    }
}

#[test]
fn what_was_at_rest_when_it_was_saved_is_not_solved_again() {
    let mut talking = Talking::after(
        "point A = (0.8, -1.77), B = (0.35, -2.2) frozen, C = (-1.94, 2.21) frozen
         point D = (-0.49, -0.97)
         hinge A on B C at 0.3
         length D A = 1.21
         length D B = 1.3
         length D C = 9
         step 2",
    );
    let mut other = Talking::after(&talking.script());
    for statement in ["solve", "step"] {
        talking.run(statement);
        other.run(statement);
        check_same(&other.script(), &talking.script(), &format!("after `{statement}`"));
    }
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn undo_takes_back_and_redo_brings_back_to_the_bit(statements in statements(16)) {
        undo_and_redo(&statements);
    }

    #[test]
    fn what_is_saved_goes_on_to_the_same_bits(before in statements(12), after in statements(6)) {
        saved_goes_on(&before, &after);
    }

    #[test]
    fn looking_changes_nothing(statements in statements(10)) {
        let mut talking = Talking::after(SCENE);
        let mut looked_at = Talking::after(SCENE);
        for statement in &statements {
            let is_done = talking.execute(statement).is_ok();
            assert_eq!(tries(&mut looked_at, statement), is_done);
            looked_at.type_in("list; show B; print velocity(B), time; set; check; assert B = A");
        }
        check_same(&looked_at.script(), &talking.script(), "looked at");
    }
}
