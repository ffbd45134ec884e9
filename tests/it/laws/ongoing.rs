//! The law of commands that go on until they are told to end: the statement that is written for one
//! gives the same bits, and one `undo` takes it back.

use super::random_session::{SCENE, statement};
use crate::support::compare::check_same;
use crate::support::draws::draws;
use crate::support::talk::Talking;
use linkwork::constraint::Point;
use linkwork::session::{Flow, Ongoing};
use linkwork::world::Entity;
use proptest::prelude::*;

/// What somebody does.
#[derive(Debug, Clone)]
enum Deed {
    Types(String),
    /// Leads a point through places, while time passes or stands still.
    Leads(&'static str, bool, Vec<Point>),
    /// Lets so many frames pass.
    Waits(u32),
    /// Takes hold, leads, and takes it back.
    Repents(&'static str, bool, Vec<Point>),
}

fn deed() -> impl Strategy<Value = Deed> {
    let point = || prop::sample::select(vec!["A", "B", "C", "D", "E", "F", "G", "K", "tail.X"]);
    let place = (-40..40_i32, -40..40_i32)
        .prop_map(|(x, y)| Point::new(f64::from(x) / 7.0, f64::from(y) / 7.0));
    let places = || prop::collection::vec(place.clone(), 0..6);
    prop_oneof![
        4 => statement().prop_map(Deed::Types),
        4 => (point(), any::<bool>(), places()).prop_map(|(p, t, way)| Deed::Leads(p, t, way)),
        2 => (0..6_u32).prop_map(Deed::Waits),
        1 => (point(), any::<bool>(), places()).prop_map(|(p, t, way)| Deed::Repents(p, t, way)),
    ]
}

fn take_hold(talking: &Talking, point: &str, is_timed: bool) -> Option<Ongoing> {
    let Some(Entity::Point(id)) = talking.world().names().get(point) else { return None };
    Some(talking.session.take_hold(id, is_timed).expect("a point that is there"))
}

fn go_on(talking: &mut Talking, ongoing: &mut Ongoing, to: Option<Point>) -> bool {
    let Talking { session, talk } = talking;
    matches!(session.go_on(ongoing, to, talk), Ok(Flow::On))
}

fn end(talking: &mut Talking, ongoing: Ongoing) -> Option<String> {
    let Talking { session, talk } = talking;
    session.end_ongoing(ongoing, "test", talk).expect("what was done can be done again")
}

fn is_as_its_statement(deeds: &[Deed]) {
    let mut live = Talking::after(SCENE);
    let mut typed = Talking::after(SCENE);
    for deed in deeds {
        let before = live.script();
        let statement = match deed {
            Deed::Types(text) => {
                live.execute(text).ok();
                Some(text.clone())
            }
            Deed::Leads(point, is_timed, places) => {
                let Some(mut ongoing) = take_hold(&live, point, *is_timed) else { continue };
                for &to in places {
                    if !go_on(&mut live, &mut ongoing, Some(to)) {
                        break;
                    }
                }
                end(&mut live, ongoing)
            }
            Deed::Waits(n) => {
                let mut ongoing = Ongoing::time();
                for _ in 0..*n {
                    if !go_on(&mut live, &mut ongoing, None) {
                        break;
                    }
                }
                end(&mut live, ongoing)
            }
            Deed::Repents(point, is_timed, places) => {
                let Some(mut ongoing) = take_hold(&live, point, *is_timed) else { continue };
                for &to in places {
                    if !go_on(&mut live, &mut ongoing, Some(to)) {
                        break;
                    }
                }
                live.session.give_up(&ongoing);
                check_same(&live.script(), &before, &format!("after {deed:?} was given up"));
                None
            }
        };
        if let Some(statement) = &statement {
            typed.execute(statement).ok();
        }
        let told = format!("after {deed:?}: {statement:?}");
        check_same(&live.script(), &typed.script(), &told);
        if !matches!(deed, Deed::Types(_)) && live.script() != before {
            live.run("undo");
            check_same(&live.script(), &before, &format!("undone {told}"));
            live.run("redo");
            check_same(&live.script(), &typed.script(), &format!("done again {told}"));
        }
    }
}

proptest! {
    #![proptest_config(draws(24))]

    #[test]
    fn what_a_hand_did_is_what_its_statement_does(deeds in prop::collection::vec(deed(), 1..12)) {
        is_as_its_statement(&deeds);
    }
}

/// Live values that have none stop a gesture; what it did before counts.
#[test]
fn a_gesture_that_goes_wrong_keeps_what_it_did() {
    let mut live = Talking::after(
        "point A = (0, 0) frozen, B = (3, 0), C = (1, 0) frozen
         length A B = sqrt(C.x)",
    );
    let mut ongoing = take_hold(&live, "C", false).expect("it is there");
    assert!(go_on(&mut live, &mut ongoing, Some(Point::new(4.0, 0.0))));
    assert!(!go_on(&mut live, &mut ongoing, Some(Point::new(-1.0, 0.0))));
    assert_eq!(end(&mut live, ongoing).as_deref(), Some("drag C to (4, 0) over 0"));
    assert_eq!(live.ask("distance(A, B)"), ["2"]);
    live.run("undo");
    assert_eq!(live.ask("C"), ["(1, 0)"]);
}

/// The way of twenty thousand moves is kept, and nothing else of them.
#[test]
fn what_a_long_gesture_keeps_grows_by_its_places_alone() {
    let mut live = Talking::after(
        "point A = (0, 0) frozen, B = (3, 0), C = (6, 0)
         length A B; length B C",
    );
    let before = live.session.undo_bytes();
    let mut ongoing = take_hold(&live, "C", false).expect("it is there");
    for k in 0..20_000 {
        let phi = f64::from(k) / 100.0;
        let to = Point::new(4.0 * phi.cos(), 4.0 * phi.sin());
        assert!(go_on(&mut live, &mut ongoing, Some(to)));
    }
    assert_eq!(ongoing.len(), 20_000);
    let statement = end(&mut live, ongoing).expect("it moved");
    assert!(statement.ends_with(" over 0"));
    assert!(live.session.undo_bytes() - before < 4096, "{}", live.session.undo_bytes() - before);
}
