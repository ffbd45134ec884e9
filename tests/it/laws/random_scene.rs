//! Random points with constraints of every kind among them, and edits of such scenes.

use crate::support::talk::Talking;
use proptest::prelude::*;

const N_POINTS: usize = 7;
const N_CONSTRAINTS: usize = 9;

fn point() -> impl Strategy<Value = String> {
    (0..N_POINTS).prop_map(|k| format!("p{k}"))
}

fn constraint_name() -> impl Strategy<Value = String> {
    (0..N_CONSTRAINTS).prop_map(|k| format!("c{k}"))
}

/// A number as a user may type it: mostly ordinary, some hard.
fn number() -> impl Strategy<Value = String> {
    prop_oneof![
        8 => (-50..50i32).prop_map(|n| format!("{}", f64::from(n) / 10.0)),
        1 => Just("0".to_owned()),
        1 => prop_oneof![Just("1e-9"), Just("1e6"), Just("-1"), Just("1 + sin(time)")]
            .prop_map(str::to_owned),
    ]
}

fn angle() -> impl Strategy<Value = String> {
    (-36..=36i32).prop_map(|n| format!("{}deg", 10 * n))
}

fn relation(value: impl Strategy<Value = String> + Clone) -> impl Strategy<Value = String> {
    prop_oneof![
        2 => Just(String::new()),
        4 => value.clone().prop_map(|v| format!("= {v}")),
        1 => value.clone().prop_map(|v| format!("<= {v}")),
        1 => value.prop_map(|v| format!(">= {v}")),
    ]
}

/// A number that is measured on the pose.
fn measure() -> impl Strategy<Value = String> {
    prop_oneof![
        (point(), point()).prop_map(|(a, b)| format!("distance({a}, {b})")),
        point().prop_map(|a| format!("{a}.x")),
        (point(), point(), point())
            .prop_map(|(a, b, c)| format!("(distance({a}, {b}) + 2 * distance({b}, {c}))")),
        (point(), point(), point()).prop_map(|(a, b, c)| format!("dot({a} - {b}, {c} - {b})")),
        (point(), point()).prop_map(|(a, b)| format!("sin({a}.x - {b}.y)")),
    ]
}

/// A statement of a constraint of any type, with its name in front.
fn constraint() -> impl Strategy<Value = String> {
    let body = prop_oneof![
        4 => (point(), point(), relation(number().boxed())).prop_map(|(a, b, r)| format!("length {a} {b} {r}")),
        1 => (point(), number(), number()).prop_map(|(a, x, y)| format!("coordinate {a} at ({x}, {y})")),
        1 => (point(), point()).prop_map(|(a, b)| format!("coincidence {a} {b}")),
        1 => [point(), point(), point(), point()]
            .prop_map(|[a, b, c, d]| format!("equivalence {a} {b}, {c} {d}")),
        1 => ([point(), point(), point(), point()], relation(number().boxed()))
            .prop_map(|([a, b, c, d], r)| format!("equal {a} {b}, {c} {d} {r}")),
        1 => ([point(), point(), point(), point()], number(), relation(number().boxed()))
            .prop_map(|([a, b, c, d], k, r)| format!("equal {a} {b}, {c} {d} ratio abs({k}) {r}")),
        2 => ([point(), point(), point(), point()], relation(angle().boxed()))
            .prop_map(|([a, b, c, d], r)| format!("orientation {a} {b}, {c} {d} {r}")),
        2 => (point(), point(), number(), number())
            .prop_map(|(a, b, r, v)| format!("motor {a} {b} radius abs({r}) speed {v}")),
        1 => ([point(), point(), point(), point()], number(), number()).prop_map(
            |([a, b, c, d], r, v)| format!("motor {a} {b} radius abs({r}) speed {v} from {c} {d}")
        ),
        2 => ([point(), point(), point()], any::<bool>()).prop_map(|([a, b, c], free)| {
            format!("glider {a} on {b} {c} {}", if free { "unbounded" } else { "" })
        }),
        1 => ([point(), point(), point()], number())
            .prop_map(|([a, b, c], mu)| format!("hinge {a} on {b} {c} at {mu}")),
        1 => ([point(), point(), point(), point()], number())
            .prop_map(|([a, b, c, d], r)| format!("cog {a} {b}, {c} {d} ratio {r}")),
        1 => ([point(), point(), point(), point()], 1..60u32, prop_oneof![Just(""), Just("inside")])
            .prop_map(|([a, b, c, d], n, way)| format!("cog {a} {b}, {c} {d} teeth 20, {n} {way}")),
        1 => ([point(), point(), point(), point()], number(), prop_oneof![Just(""), Just("crossed")])
            .prop_map(|([a, b, c, d], r, way)| format!("belt {a} {b}, {c} {d} ratio abs({r}) {way}")),
        1 => ([point(), point(), point()], relation(number().boxed()))
            .prop_map(|([a, b, c], r)| format!("distance {a} to {b} {c} {r}")),
        1 => ([point(), point(), point(), point()], prop_oneof![Just("parallel"), Just("perpendicular")])
            .prop_map(|([a, b, c, d], word)| format!("{word} {a} {b}, {c} {d}")),
        1 => [point(), point(), point(), point()]
            .prop_map(|[a, b, c, d]| format!("symmetric {a} {b} about {c} {d}")),
        1 => (point(), point(), prop_oneof![Just("horizontal"), Just("vertical")])
            .prop_map(|(a, b, word)| format!("{word} {a} {b}")),
        1 => [point(), point(), point()].prop_map(|[a, b, c]| format!("rigid {a} {b} {c}")),
        1 => [point(), point(), point(), point()]
            .prop_map(|[a, b, c, d]| format!("rack {a} {b} on {c} {d}")),
        1 => ([point(), point(), point(), point()], number())
            .prop_map(|([a, b, c, d], r)| format!("rack {a} {b} on {c} {d} radius abs({r})")),
        2 => (point(), point(), measure()).prop_map(|(a, b, m)| format!("length {a} {b} = abs({m})")),
        1 => (point(), point(), point(), measure())
            .prop_map(|(a, b, c, m)| format!("orientation {a} {b}, {a} {c} = {m} / 4")),
        2 => (measure(), relation(number().boxed()))
            .prop_map(|(m, r)| format!("hold {m} {}", if r.is_empty() { "= 1" } else { &*r })),
        1 => [point(), point(), point()]
            .prop_map(|[a, b, c]| format!("hold {a} = midpoint({b}, {c})")),
        1 => (point(), constraint_name()).prop_map(|(a, c)| format!("glider {a} on {c}")),
        1 => (point(), point(), constraint_name())
            .prop_map(|(a, b, c)| format!("tangent {a} {b} to {c}")),
        1 => (constraint_name(), constraint_name(), any::<bool>()).prop_map(|(c, d, is_inside)| {
            format!("tangent {c} to {d} {}", if is_inside { "inside" } else { "" })
        }),
    ];
    let curve = prop_oneof![
        (constraint_name(), point(), number())
            .prop_map(|(c, o, r)| format!("circle {c} = {o} radius abs({r})")),
        (constraint_name(), point(), point())
            .prop_map(|(c, o, p)| format!("circle {c} = {o} through {p}")),
        (constraint_name(), point(), point(), point())
            .prop_map(|(c, o, p, q)| format!("arc {c} = {o} from {p} to {q}")),
    ];
    let named = (constraint_name(), body).prop_map(|(name, body)| format!("{name}: {body}"));
    prop_oneof![9 => named, 1 => curve]
}

/// A constraint with an expression that has no value, or none that it could have, in some poses.
fn live() -> impl Strategy<Value = String> {
    let points = [point(), point(), point()];
    (constraint_name(), points, any::<bool>()).prop_map(|(name, [a, b, c], is_quotient)| {
        if is_quotient {
            format!("{name}: length {a} {b} = 2 / distance({a}, {c})")
        } else {
            format!("{name}: length {a} {b} <= {c}.x")
        }
    })
}

/// A definition with names of its own that are names outside too.
pub fn shadow() -> impl Strategy<Value = String> {
    (point(), constraint_name(), number()).prop_map(|(p, c, l)| {
        format!(
            "define shadow(O) {{ point {p} = O + (1, 0); {c}: length O {p} = abs({l})
             off {c}; on {c}; freeze {p}; step; thaw {p}; change {c} <= 2 }}"
        )
    })
}

/// An instance of it.
pub fn use_of_shadow() -> impl Strategy<Value = String> {
    (point(), 0..3u32).prop_map(|(p, k)| format!("use shadow({p}) as s{k}"))
}

/// The same statement with other names for the points and constraints outside of definitions.
pub fn renamed(statement: &str) -> String {
    if statement.starts_with("define ") {
        return statement.to_owned();
    }
    let mut text = String::new();
    let mut letters = statement.chars().peekable();
    let mut before = ' ';
    while let Some(letter) = letters.next() {
        let is_first = !before.is_alphanumeric() && before != '.';
        let is_name = is_first && letters.peek().is_some_and(char::is_ascii_digit);
        text.push(match letter {
            'p' if is_name => 'u',
            'c' if is_name => 'v',
            _ => letter,
        });
        before = letter;
    }
    text
}

/// Any edit or run.
pub fn edit() -> impl Strategy<Value = String> {
    prop_oneof![
        8 => constraint(),
        1 => live(),
        1 => constraint_name().prop_map(|c| format!("delete {c}")),
        1 => point().prop_map(|p| format!("delete {p} cascade")),
        1 => (point(), number(), number()).prop_map(|(p, x, y)| format!("point {p} = ({x}, {y})")),
        2 => point().prop_map(|p| format!("freeze {p}")),
        1 => point().prop_map(|p| format!("thaw {p}")),
        1 => constraint_name().prop_map(|c| format!("off {c}")),
        1 => constraint_name().prop_map(|c| format!("on {c}")),
        2 => (constraint_name(), number()).prop_map(|(c, v)| format!("change {c} = {v}")),
        1 => (constraint_name(), number()).prop_map(|(c, v)| format!("change {c} speed {v}")),
        1 => (point(), number(), number()).prop_map(|(p, x, y)| format!("move {p} to ({x}, {y})")),
        1 => (point(), point()).prop_map(|(p, q)| format!("move {p} to {q}")),
        2 => (point(), number(), number(), 1..6u32)
            .prop_map(|(p, x, y, n)| format!("drag {p} to ({x}, {y}) over {n}")),
        1 => (point(), number(), number(), 0..6u32)
            .prop_map(|(p, x, y, n)| format!("pull {p} to ({x}, {y}) over {n}")),
        1 => (point(), number(), number(), prop_oneof![Just(0), 2..6u32])
            .prop_map(|(p, x, y, n)| format!("drag {p} through ({x}, 0), ({x}, {y}) over {n}")),
        3 => (1..8u32).prop_map(|n| format!("step {n}")),
        1 => Just("solve".to_owned()),
        1 => Just("relax 5".to_owned()),
        1 => point().prop_map(|p| format!("trace {p}")),
        1 => Just("reset".to_owned()),
        1 => prop_oneof![Just("hold"), Just("stop"), Just("reverse")]
            .prop_map(|word| format!("set dead-points {word}")),
        1 => prop_oneof![Just("auto"), Just("relaxation"), Just("newton"), Just("nesterov")]
            .prop_map(|word| format!("set method {word}")),
        1 => (2..13u32).prop_map(|n| format!("set tolerance 1e-{n}")),
        1 => (1..60u32).prop_map(|n| format!("set iterations {n}")),
        1 => prop_oneof![Just("holonomic"), Just("velocity")]
            .prop_map(|word| format!("set cog {word}")),
        1 => shadow(),
        1 => use_of_shadow(),
        1 => (1..3u32).prop_map(|n| format!("undo {n}")),
        1 => Just("redo".to_owned()),
    ]
}

/// Points all over the place, a few of them frozen.
pub fn scene() -> impl Strategy<Value = Vec<String>> {
    let places = prop::collection::vec((-50..50i32, -50..50i32, 0..4u32), N_POINTS);
    let points = places.prop_map(|places| {
        let lines = places.into_iter().enumerate().map(|(k, (x, y, frozen))| {
            let frozen = if frozen == 0 { " frozen" } else { "" };
            format!("point p{k} = ({}, {}){frozen}", f64::from(x) / 10.0, f64::from(y) / 10.0)
        });
        lines.collect::<Vec<_>>()
    });
    (points, prop::collection::vec(constraint(), 0..N_CONSTRAINTS))
        .prop_map(|(points, constraints)| [points, constraints].concat())
}

/// After these statements.
pub fn after(statements: &[String]) -> Talking {
    let mut talking = Talking::after("");
    for statement in statements {
        // A refusal is an answer too.
        let _ = talking.execute(statement);
    }
    talking
}
