//! Laws of sessions on random scenes of all constraint types under random edits.

use super::random_scene::{after, edit, renamed, scene, shadow, use_of_shadow};
use crate::support::draws::draws;
use crate::support::talk::Talking;
use linkwork::constraint::ConstraintKind as _;
use linkwork::constraint::Row;
use linkwork::world::{Entity, World};
use proptest::prelude::*;

fn assert_finite(world: &World) {
    let points = world.points();
    for p in points.ids() {
        assert!(points.at(p).is_finite(), "{} is at {:?}", points.name(p), points.at(p));
    }
}

/// Where all points are, to the bit, in the order in which they were made.
fn places(world: &World) -> Vec<[u64; 2]> {
    let points = world.points();
    points.ids().map(|p| [points.at(p).x.to_bits(), points.at(p).y.to_bits()]).collect()
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
    assert_finite(talking.world());
    let told = talking.talk.told().concat();
    let has_converged = told.starts_with("converged");
    let is_best_fit = told.starts_with("best fit") || told.starts_with("no solution found");
    let points = talking.world().points();
    let x = points.column();
    let w = talking.world().points().inverse_masses();
    let size = points.ids().map(|p| x[p.idx()].to_vector().norm()).fold(1.0, f64::max);
    let mut rows = Vec::new();
    let mut has_collapsed = false;
    for (_, record) in talking.world().constraints().filter(|(_, record)| record.is_on) {
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

proptest! {
    #![proptest_config(draws(60))]

    #[test]
    fn whatever_is_edited_all_is_finite_and_a_refusal_changes_nothing(
        scene in scene(),
        edits in prop::collection::vec(edit(), 1..25),
    ) {
        let mut talking = after(&scene);
        for edit in &edits {
            let before = talking.script();
            let result = talking.execute(edit);
            assert_finite(talking.world());
            if let Err(why) = result {
                prop_assert_eq!(talking.script(), before, "{}: {}", edit, why.message);
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
            let before = talking.script();
            if talking.execute(edit).is_err() {
                continue;
            }
            let after = talking.script();
            if after == before {
                continue;
            }
            talking.run("undo");
            prop_assert_eq!(talking.script(), before, "undo {}", edit);
            talking.run("redo");
            prop_assert_eq!(talking.script(), after, "redo {}", edit);
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
        let kept = talking.script();
        let mut again = Talking::after(&kept);
        prop_assert_eq!(again.script(), kept);
        for session in [&mut talking, &mut again] {
            let _ = session.execute("step 3");
        }
        prop_assert_eq!(again.script(), talking.script());
    }

    #[test]
    fn what_a_definition_makes_does_not_depend_on_the_names_outside(
        scene in scene(),
        definition in shadow(),
        instance in use_of_shadow(),
        edits in prop::collection::vec(edit(), 1..15),
    ) {
        let mut talking = after(&scene);
        let mut other = after(&scene.iter().map(|statement| renamed(statement)).collect::<Vec<_>>());
        for statement in [definition, instance].iter().chain(&edits) {
            let is_done = talking.execute(statement).is_ok();
            prop_assert_eq!(other.execute(&renamed(statement)).is_ok(), is_done, "{}", statement);
            prop_assert_eq!(places(other.world()), places(talking.world()), "{}", statement);
        }
    }

    #[test]
    fn every_question_has_an_answer(scene in scene(), edits in prop::collection::vec(edit(), 1..8)) {
        let mut talking = after(&[scene, edits].concat());
        let before = talking.script();
        talking.run("check");
        let names: Vec<(String, bool)> = talking.world().constraints()
            .map(|(id, record)| {
                let is_motor = record.constraint.kind() == linkwork::constraint::Kind::Motor;
                (talking.world().name_of(Entity::Constraint(id)).to_owned(), is_motor)
            })
            .collect();
        for (name, is_motor) in names {
            talking.run(&format!("why {name}"));
            if is_motor {
                talking.run(&format!("limits {name}"));
            }
        }
        prop_assert_eq!(talking.script(), before);
    }
}

proptest! {
    // Of several best fits the one that is found need not be the least: about one scene in three
    // thousand, and none of these.
    #![proptest_config(draws(120))]

    #[test]
    fn what_auto_calls_a_best_fit_is_no_worse_than_what_relaxation_finds(scene in scene()) {
        let talking = after(&scene);
        let kept = talking.script();
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
        let kept = talking.script();
        let mut again = Talking::after(&kept);
        assert_eq!(again.script(), kept);
        for session in [&mut talking, &mut again] {
            session.run("step 3");
        }
        assert_eq!(again.script(), talking.script());
        assert_ne!(again.script(), kept);
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
    let mut again = Talking::after(&talking.script());
    for session in [&mut talking, &mut again] {
        session.run("step 3");
    }
    assert_eq!(again.script(), talking.script());
}

#[test]
fn a_deletion_that_was_undone_is_no_edit() {
    let mut talking = Talking::after(
        "point p0 = (0, 0) frozen, p1 = (0, 0) frozen, p6 = (0, -0.1)
         c1: hinge p1 on p0 p6 at 0.1
         step
         delete p6 cascade
         undo",
    );
    let mut again = Talking::after(&talking.script());
    for session in [&mut talking, &mut again] {
        session.run("step 3");
    }
    assert_eq!(again.script(), talking.script());
}
