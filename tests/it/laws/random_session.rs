//! Random sessions on a mechanism that moves: a four-bar, an actuator, wheels and a chain.

use proptest::prelude::*;

/// What there is before anything random happens: a four-bar with a driven crank, an actuator,
/// wheels, and a chain.
pub const SCENE: &str = "
    point A = (0, 0) frozen, D = (4, 0) frozen, B = (1, 0), C = (3, 3)
    let r = 3.5
    crank: motor A B speed 1rev
    coupler: length B C = r
    rocker: length C D = 3
    point E = (6, 1), F = (7, 2) frozen
    act: length F E = 2 + sin(time)
    point K = (5, -1)
    gauge: length D K = 1 + F.y / 4
    point O = (9, 0) frozen, G = (10, 0), Q = (12, 0) frozen, H = (11, 0)
    wheels: cog O G, Q H ratio 2
    spin: motor O G speed 90deg
    point R = (12, 5) frozen, S = (13, 5), V = (14, 6), W = (14, 4.5), Z = (15, 5.2), T = (17, 8) frozen
    turner: motor R S speed 1rev
    length S V; brace: length S W; length V W; length V Z; tie: length W Z; length S Z; length T Z
    define tail(P, l) { point X = P + (l, 0), Y = P + (2 * l, 0); length P X = l; length X Y = l }
    use tail(C, r / 4) as tail
    define shade(P) {
      point B = P + (1, 0), C = B + (1, 0)
      let r = 1
      crank: length P B = r
      coupler: length B C = r / 2
      off crank; on crank; freeze B; step; thaw B; change coupler <= r
    }
    set dt 1/30
";

/// Statements that may or may not make sense when their turn comes.
pub fn statement() -> impl Strategy<Value = String> {
    let point =
        || prop::sample::select(vec!["B", "C", "E", "G", "K1", "K2", "Z", "tail.X", "tail.Y"]);
    let held = || prop::sample::select(vec!["B", "C", "D", "E", "F", "G", "K1", "V", "shade1.B"]);
    let constraint = || {
        let names = vec![
            "crank", "coupler", "rocker", "act", "wheels", "spin", "rod1", "rod2", "mesh", "roll",
            "brace", "tie",
        ];
        prop::sample::select(names)
    };
    let number = || (-40..40_i32).prop_map(|n| f64::from(n) / 8.0);
    let place = move || (number(), number()).prop_map(|(x, y)| format!("({x}, {y})"));
    prop_oneof![
        4 => (0..12_u32).prop_map(|n| format!("step {n}")),
        2 => (number(),).prop_map(|(t,)| format!("run {}", t / 16.0)),
        2 => (1..3_u32, place()).prop_map(|(k, at)| format!("point K{k} = {at}")),
        2 => (point(), place()).prop_map(|(p, at)| format!("move {p} to {at}")),
        2 => (point(), held()).prop_map(|(p, q)| format!("move {p} to {q}")),
        2 => (point(), place(), 1..6_u32).prop_map(|(p, at, n)| format!("drag {p} to {at} over {n}")),
        1 => (point(), point(), place()).prop_map(|(p, q, at)| format!("drag {p} to {at}, {q} to (1, 1) over 2")),
        2 => (point(), place(), 0..6_u32).prop_map(|(p, at, n)| format!("pull {p} to {at} over {n}")),
        1 => (point(), place()).prop_map(|(p, at)| format!("pull {p} through {at}, (0, 2), B to (1, 1) over 4")),
        1 => (point(), place()).prop_map(|(p, at)| format!("drag {p} through {at}, (0, 2) over 0")),
        2 => held().prop_map(|p| format!("freeze {p}")),
        2 => held().prop_map(|p| format!("thaw {p}")),
        2 => Just("thaw F".to_owned()),
        2 => (1..3_u32, point(), point()).prop_map(|(k, p, q)| format!("rod{k}: length {p} {q}")),
        1 => (point(), point(), number()).prop_map(|(p, q, l)| format!("length {p} {q} <= {l}")),
        1 => (point(), point()).prop_map(|(p, q)| format!("length {p} {q} = 2 + sin(3 * time)")),
        1 => (point(), number()).prop_map(|(p, x)| format!("coordinate {p} at ({x} + time, 2)")),
        1 => (point(), point()).prop_map(|(p, q)| format!("motor {p} {q} speed 0.5rev")),
        1 => (point(), number()).prop_map(|(p, v)| format!("motor F {p} radius 1 speed {v}")),
        1 => (point(), point()).prop_map(|(p, q)| format!("motor {p} {q} speed 0.3rev from A {p}")),
        1 => point().prop_map(|p| format!("change spin from A {p}")),
        1 => (point(), number()).prop_map(|(p, r)| format!("cog O {p}, Q H ratio {r}")),
        1 => (point(), point()).prop_map(|(p, q)| format!("mesh: cog {p} {q}, D C ratio -0.5")),
        1 => (point(), point()).prop_map(|(p, q)| format!("roll: rack {p} {q} on A D")),
        1 => (number(),).prop_map(|(r,)| format!("change roll radius {r}")),
        1 => Just("change roll radius 1 + sin(time) / 2".to_owned()),
        1 => (point(), point()).prop_map(|(p, q)| format!("glider {p} on F {q}")),
        1 => (point(), point()).prop_map(|(p, q)| format!("rigid {p} {q} A")),
        1 => (point(), point()).prop_map(|(p, q)| format!("parallel {p} {q}, A D")),
        1 => (point(), point()).prop_map(|(p, q)| format!("vertical {p} {q}")),
        1 => (point(), point()).prop_map(|(p, q)| format!("length {p} {q} = distance(A, B) + 1")),
        1 => (point(), point()).prop_map(|(p, q)| format!("length {p} {q} = 3 + F.y / 4")),
        1 => (point(), point()).prop_map(|(p, q)| format!("rope: hold distance(A, {p}) + distance({p}, {q}) = 5")),
        1 => (point(), point()).prop_map(|(p, q)| format!("hold {p}.y <= {q}.x + sin(time)")),
        1 => (point(), point()).prop_map(|(p, q)| format!("hold {p} = midpoint(A, {q}) + (s, 0)")),
        1 => number().prop_map(|v| format!("change rope = {v} * r")),
        1 => (point(), number()).prop_map(|(p, v)| format!("circle ring = {p} radius 1 + abs({v}) * r / 9")),
        1 => (point(), point()).prop_map(|(p, q)| format!("circle ring = {p} through {q}")),
        1 => (point(), point()).prop_map(|(p, q)| format!("tangent {p} {q} to ring")),
        1 => point().prop_map(|p| format!("slide: glider {p} on ring")),
        1 => number().prop_map(|v| format!("change ring radius {v} + sin(time)")),
        1 => (point(), point()).prop_map(|(p, q)| format!("length {p} {q} = 3 + sin(crank.angle)")),
        1 => (number(),).prop_map(|(v,)| format!("change spin speed {v} + crank.angle")),
        1 => (constraint(),).prop_map(|(c,)| format!("change {c} = 3 + u / 8")),
        1 => Just("let u = spin.angle, r = 3.5 + sin(u) / 20".to_owned()),
        1 => (constraint(),).prop_map(|(c,)| format!("let m = {c}.residual + r, n = {c}.value + m")),
        1 => (point(), point()).prop_map(|(p, q)| format!("let v = turn({p}, {q}), w = turn(A, B)")),
        1 => (point(), point()).prop_map(|(p, q)| format!("print turn(A, D, {p}, {q}), turn(O, G)")),
        1 => (point(), point()).prop_map(|(p, q)| format!("length {p} {q} = 3 + turn(O, G) / 9")),
        2 => constraint().prop_map(|c| format!("off {c}")),
        2 => constraint().prop_map(|c| format!("on {c}")),
        2 => (constraint(), number()).prop_map(|(c, v)| format!("change {c} = {v}")),
        1 => (constraint(), number()).prop_map(|(c, v)| format!("change {c} speed {v} * 90deg")),
        1 => (number(),).prop_map(|(v,)| format!("change wheels ratio {v}")),
        1 => (1..60_u32,).prop_map(|(n,)| format!("change wheels teeth 20, {n}")),
        1 => Just("change wheels teeth 10, 20 + 10 * floor(3 * time)".to_owned()),
        1 => (point(), point()).prop_map(|(p, q)| format!("mesh: belt {p} {q}, D C ratio 2")),
        1 => (number(),).prop_map(|(v,)| format!("change wheels ratio 2 + sin(time) * {v} / 8")),
        2 => (number(),).prop_map(|(v,)| format!("let r = {v}")),
        1 => (number(),).prop_map(|(v,)| format!("let r = 3.5 + {v} / 20 * sin(time)")),
        1 => (number(),).prop_map(|(v,)| format!("let s = r * {v}, u = 1 / s")),
        1 => Just("let s = distance(A, C)".to_owned()),
        1 => (point(), held()).prop_map(|(p, q)| format!("let s = 1 / distance({p}, {q})")),
        1 => point().prop_map(|p| format!("let s = sqrt({p}.x)")),
        1 => (point(), point()).prop_map(|(p, q)| format!("length {p} {q} = F.y / distance({p}, F)")),
        1 => (point(), held()).prop_map(|(p, q)| format!("length F {p} = 3 * {q}.x")),
        1 => point().prop_map(|p| format!("delete {p}")),
        1 => point().prop_map(|p| format!("delete {p} cascade")),
        1 => constraint().prop_map(|c| format!("delete {c}")),
        1 => (point(), 1..3_u32).prop_map(|(p, k)| format!("rename {p} to K{k}")),
        1 => (1..3_u32, point()).prop_map(|(k, p)| format!("rename K{k} to {p}")),
        1 => (constraint(), 1..3_u32).prop_map(|(c, k)| format!("rename {c} to rod{k}")),
        1 => (1..3_u32, constraint()).prop_map(|(k, c)| format!("rename rod{k} to {c}")),
        1 => prop::sample::select(vec![
            "rename s to u", "rename u to s", "rename d1 to d2", "rename tail to shade1", "rename shade1 to tail",
            "for i in 1..2 { step; rename B to K1; step; rename K1 to B }",
        ])
        .prop_map(str::to_owned),
        1 => Just("delete tail cascade".to_owned()),
        1 => Just("delete r cascade".to_owned()),
        1 => Just("use tail(B, 1)".to_owned()),
        1 => (point(), 1..3_u32).prop_map(|(p, k)| format!("use shade({p}) as shade{k}")),
        1 => Just("use tail(C, r / 4) as tail".to_owned()),
        1 => Just("define tail(P, l) { point X = P; length P F = l }".to_owned()),
        1 => (point(), 1..4_u32).prop_map(|(p, n)| format!("trace {p} every {n}")),
        1 => point().prop_map(|p| format!("untrace {p}")),
        1 => (point(), 1..3_u32).prop_map(|(p, k)| format!("trace {p} as \"path {k}\"")),
        1 => (1..3_u32).prop_map(|k| format!("untrace \"path {k}\"")),
        2 => (1..3_u32, point(), point()).prop_map(|(k, p, q)| format!("measure d{k} = distance({p}, {q}) + s / 9")),
        1 => point().prop_map(|p| format!("measure d1 = norm(velocity({p})) in deg")),
        1 => Just("measure d2 = crank.angle + coupler.residual in rev".to_owned()),
        1 => (1..3_u32, point()).prop_map(|(k, p)| format!("let s = d{k}.span + {p}.x, m = d{k}.count")),
        1 => (1..3_u32).prop_map(|k| format!("delete d{k}")),
        1 => Just("delete d1 cascade".to_owned()),
        1 => Just("set measures sampled".to_owned()),
        1 => Just("result far = d1.max, at = C".to_owned()),
        1 => point().prop_map(|p| format!("for i in 1..3 {{ step; measure d1 = {p}.x; step 2; reset; step }}")),
        1 => Just("expose every 3".to_owned()),
        1 => Just("expose".to_owned()),
        1 => (constraint(), 1..15_u32).prop_map(|(c, n)| format!("set rho {} for {c}", f64::from(n) / 8.0)),
        1 => (point(), 1..5_u32).prop_map(|(p, n)| format!("set weight {n} for {p}")),
        1 => (1..5_u32).prop_map(|n| format!("set dt 1/{}", 10 * n)),
        1 => prop::sample::select(vec!["auto", "relaxation", "successive", "newton", "anderson"])
            .prop_map(|m| format!("set method {m}")),
        2 => (2..13_u32).prop_map(|n| format!("set tolerance 1e-{n}")),
        1 => (1..60_u32).prop_map(|n| format!("set iterations {n}")),
        1 => prop::sample::select(vec!["holonomic", "velocity"])
            .prop_map(|form| format!("set cog {form}")),
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

/// Fewer than `most` of them.
pub fn statements(most: usize) -> impl Strategy<Value = Vec<String>> {
    prop::collection::vec(statement(), 1..most)
}
