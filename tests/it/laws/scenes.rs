//! Laws of sessions on random scenes of all constraint types under random edits.

use crate::support::talk::Talking;
use linkwork::constraint::ConstraintKind as _;
use linkwork::constraint::Row;
use linkwork::session::Session;
use linkwork::world::{Entity, PointId};
use proptest::prelude::*;
use proptest::test_runner::{Config, RngSeed};

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
        2 => ([point(), point(), point(), point()], relation(angle().boxed()))
            .prop_map(|([a, b, c, d], r)| format!("orientation {a} {b}, {c} {d} {r}")),
        2 => (point(), point(), number(), number())
            .prop_map(|(a, b, r, v)| format!("motor {a} {b} radius abs({r}) speed {v}")),
        2 => ([point(), point(), point()], any::<bool>()).prop_map(|([a, b, c], free)| {
            format!("glider {a} on {b} {c} {}", if free { "unbounded" } else { "" })
        }),
        1 => ([point(), point(), point()], number())
            .prop_map(|([a, b, c], mu)| format!("hinge {a} on {b} {c} at {mu}")),
        1 => ([point(), point(), point(), point()], number())
            .prop_map(|([a, b, c, d], r)| format!("cog {a} {b}, {c} {d} ratio {r}")),
        1 => ([point(), point(), point()], relation(number().boxed()))
            .prop_map(|([a, b, c], r)| format!("distance {a} to {b} {c} {r}")),
        1 => ([point(), point(), point(), point()], prop_oneof![Just("parallel"), Just("perpendicular")])
            .prop_map(|([a, b, c, d], word)| format!("{word} {a} {b}, {c} {d}")),
        1 => [point(), point(), point()].prop_map(|[a, b, c]| format!("rigid {a} {b} {c}")),
        1 => [point(), point(), point(), point()]
            .prop_map(|[a, b, c, d]| format!("rack {a} {b} on {c} {d}")),
    ];
    (constraint_name(), body).prop_map(|(name, body)| format!("{name}: {body}"))
}

/// Any edit or run.
fn edit() -> impl Strategy<Value = String> {
    prop_oneof![
        8 => constraint(),
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
        2 => (point(), number(), number(), 1..6u32)
            .prop_map(|(p, x, y, n)| format!("drag {p} to ({x}, {y}) over {n}")),
        3 => (1..8u32).prop_map(|n| format!("step {n}")),
        1 => Just("solve".to_owned()),
        1 => Just("relax 5".to_owned()),
        1 => point().prop_map(|p| format!("trace {p}")),
        1 => Just("reset".to_owned()),
        1 => prop_oneof![Just("hold"), Just("stop"), Just("reverse")]
            .prop_map(|word| format!("set dead-points {word}")),
        1 => prop_oneof![Just("auto"), Just("relaxation"), Just("newton"), Just("nesterov")]
            .prop_map(|word| format!("set method {word}")),
        1 => (1..3u32).prop_map(|n| format!("undo {n}")),
        1 => Just("redo".to_owned()),
    ]
}

/// Points all over the place, a few of them frozen.
fn scene() -> impl Strategy<Value = Vec<String>> {
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

fn assert_finite(session: &Session) {
    let points = session.world().points();
    for p in points.ids() {
        assert!(points.at(p).is_finite(), "{} is at {:?}", points.name(p), points.at(p));
    }
}

/// What the constraints of a scene that are on ask for: for each row the value, and what makes it
/// a distance; and how far the scene extends.
struct Demands {
    rows: Vec<(f64, f64)>,
    has_converged: bool,
    is_best_fit: bool,
    size: f64,
    /// Whether points that one constraint holds are in one place. Angles ask for nothing there:
    /// that is a way out of every contradiction.
    has_collapsed: bool,
}

fn demands(talking: &mut Talking, method: &str) -> Demands {
    talking.talk.told();
    talking.run(&format!("set method {method}; solve"));
    assert_finite(&talking.session);
    let told = talking.talk.told().concat();
    let (has_converged, is_best_fit) =
        (told.starts_with("converged"), told.starts_with("best fit"));
    let points = talking.session.world().points();
    let x = points.column();
    let all = (0..x.len()).map(PointId::new);
    let w: Vec<f64> =
        all.map(|p| if points.is_alive(p) { points.inverse_mass(p) } else { 0.0 }).collect();
    let size = points.ids().map(|p| x[p.idx()].to_vector().norm()).fold(1.0, f64::max);
    let mut rows = Vec::new();
    let mut has_collapsed = false;
    for (_, record) in talking.session.world().constraints().filter(|(_, record)| record.is_on) {
        let held = record.constraint.points();
        let is_near = |a: u32, b: u32| (x[a as usize] - x[b as usize]).norm() <= 1e-6 * size;
        has_collapsed |= held.iter().any(|&a| held.iter().any(|&b| a < b && is_near(a, b)));
        record.constraint.jacobian(x, &mut |row| {
            let f = row.f;
            let scale = if row.is_active { Row { f: 1.0, ..row }.distance(&w) } else { 0.0 };
            rows.push((f, scale));
        });
    }
    Demands { rows, has_converged, is_best_fit, size, has_collapsed }
}

/// Half the sum of squares of the distances to satisfaction, measured at a pose.
fn energy(demands: &Demands, measured_at: &Demands) -> f64 {
    let rows = demands.rows.iter().zip(&measured_at.rows);
    let scaled = rows.map(|((f, own), (_, scale))| f * if *scale > 0.0 { scale } else { own });
    0.5 * scaled.map(|f| f * f).sum::<f64>()
}

fn after(statements: &[String]) -> Talking {
    let mut talking = Talking::after("");
    for statement in statements {
        // A refusal is an answer too.
        let _ = talking.execute(statement);
    }
    talking
}

proptest! {
    #![proptest_config(Config::with_cases(60))]

    #[test]
    fn whatever_is_edited_all_is_finite_and_a_refusal_changes_nothing(
        scene in scene(),
        edits in prop::collection::vec(edit(), 1..25),
    ) {
        let mut talking = after(&scene);
        for edit in &edits {
            let before = talking.session.to_script();
            let result = talking.execute(edit);
            assert_finite(&talking.session);
            if let Err(why) = result {
                prop_assert_eq!(talking.session.to_script(), before, "{}: {}", edit, why.message);
            }
        }
    }

    #[test]
    fn undo_brings_everything_back_to_the_bit(
        scene in scene(),
        edits in prop::collection::vec(edit(), 1..15),
    ) {
        let mut talking = after(&scene);
        for edit in edits.iter().filter(|e| !e.starts_with("undo") && !e.starts_with("redo")) {
            let before = talking.session.to_script();
            if talking.execute(edit).is_err() {
                continue;
            }
            let after = talking.session.to_script();
            if after == before {
                continue;
            }
            talking.run("undo");
            prop_assert_eq!(talking.session.to_script(), before, "undo {}", edit);
            talking.run("redo");
            prop_assert_eq!(talking.session.to_script(), after, "redo {}", edit);
        }
    }

    #[test]
    fn a_session_goes_on_from_its_file_to_the_same_bits(
        scene in scene(),
        edits in prop::collection::vec(edit(), 1..15),
    ) {
        let mut talking = after(&scene);
        for edit in &edits {
            let _ = talking.execute(edit);
        }
        let kept = talking.session.to_script();
        let mut again = Talking::after(&kept);
        prop_assert_eq!(again.session.to_script(), kept);
        for session in [&mut talking, &mut again] {
            let _ = session.execute("step 3");
        }
        prop_assert_eq!(again.session.to_script(), talking.session.to_script());
    }

    #[test]
    fn every_question_has_an_answer(scene in scene(), edits in prop::collection::vec(edit(), 1..8)) {
        let mut talking = after(&[scene, edits].concat());
        let before = talking.session.to_script();
        talking.run("check");
        let names: Vec<(String, bool)> = talking.session.world().constraints()
            .map(|(id, record)| {
                let is_motor = record.constraint.kind() == linkwork::constraint::Kind::Motor;
                (talking.session.world().name_of(Entity::Constraint(id)).to_owned(), is_motor)
            })
            .collect();
        for (name, is_motor) in names {
            talking.run(&format!("why {name}"));
            if is_motor {
                talking.run(&format!("limits {name}"));
            }
        }
        prop_assert_eq!(talking.session.to_script(), before);
    }
}

proptest! {
    // Of several best fits the one that is found need not be the least: about one scene in three
    // thousand. The same scenes in every run, so that this law fails for a reason.
    #![proptest_config(Config { rng_seed: RngSeed::Fixed(1), ..Config::with_cases(120) })]

    #[test]
    fn what_auto_calls_a_best_fit_is_no_worse_than_what_relaxation_finds(scene in scene()) {
        let kept = after(&scene).session.to_script();
        let auto = demands(&mut Talking::after(&kept), "auto");
        let relaxation = demands(&mut Talking::after(&kept), "relaxation");
        prop_assume!(!relaxation.has_collapsed);
        prop_assert!(auto.has_converged || !relaxation.has_converged, "{}", kept);
        // What makes an angle a distance depends on the pose, and a best fit is one by the measure
        // of its own. Distances of 1e-8 are as good as none: constraints that ask for lengths of
        // 1e-9 contradict each other by no more.
        let (least, most) = (energy(&auto, &auto), energy(&relaxation, &auto));
        let none = (1e-8 * auto.size).powi(2);
        prop_assert!(!auto.is_best_fit || least <= most * (1.0 + 1e-4) + none, "{least:e} {most:e}\n{kept}");
    }
}

#[test]
fn a_session_saved_after_a_change_of_settings_solves_anew_as_the_one_it_was_saved_from() {
    for change in ["set tolerance 1e-12", "set method relaxation"] {
        let mut talking = Talking::after(
            "set tolerance 1e-3
             point A = (0, 0) frozen, B = (1.5, 0), C = (1, 1), D = (3, 0) frozen
             length A B = 1; length B C = 2; length C D = 1.5
             solve; step 2",
        );
        talking.run(change);
        let kept = talking.session.to_script();
        let mut again = Talking::after(&kept);
        assert_eq!(again.session.to_script(), kept);
        for session in [&mut talking, &mut again] {
            session.run("step 3");
        }
        assert_eq!(again.session.to_script(), talking.session.to_script());
        assert_ne!(again.session.to_script(), kept);
    }
}

#[test]
fn a_session_saved_after_a_point_was_deleted_leaves_a_saddle_to_the_same_side() {
    let mut talking = Talking::after(
        "point p0 = (0, 0) frozen, p1 = (0, -1.5) frozen, p2 = (0, 0) frozen, p4 = (0.8, 0) frozen
         point p5 = (0, 2.1), p6 = (-0.7, -0.1) frozen
         length p6 p5 = 0
         orientation p1 p4, p0 p5 = 0.288
         delete p2",
    );
    let mut again = Talking::after(&talking.session.to_script());
    for session in [&mut talking, &mut again] {
        session.run("step 3");
    }
    assert_eq!(again.session.to_script(), talking.session.to_script());
}

#[test]
fn a_deletion_that_was_undone_is_no_edit() {
    let mut talking = Talking::after(
        "point p0 = (0, 0) frozen, p1 = (0, 0) frozen, p6 = (0, -0.1)
         c1: hinge p1 on p1 p6 at 0.1
         step
         delete p6 cascade
         undo",
    );
    let mut again = Talking::after(&talking.session.to_script());
    for session in [&mut talking, &mut again] {
        session.run("step 3");
    }
    assert_eq!(again.session.to_script(), talking.session.to_script());
}
