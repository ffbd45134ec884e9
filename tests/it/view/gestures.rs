//! What the mouse does is a statement that does the same.

use linkwork::Session;
use serde_json::json;

use super::browser::{Page, Viewed};

const SCENE: &str = "
    point A = (0, 0) frozen, D = (4, 0) frozen, B = (1, 0), C = (3, 3)
    coupler: length B C = 3.5
    rocker: length C D = 3
    crank: length A B = 1
    tail: motor D E radius 1 speed 1rev
    solve
";
const SCENE_WITH_TAIL: &str = "point E = (5, 0)\n";

fn scene() -> String {
    format!("{SCENE_WITH_TAIL}{SCENE}")
}

fn hold(page: &mut Page, point: &str) {
    let points = page.last("state")["points"].as_array().expect("points").clone();
    let point = points.iter().find(|it| it["name"] == point).expect("it is there");
    let answer = page.ask(json!({ "do": "grab", "point": point["handle"] }));
    assert_eq!(answer["ok"], true, "{answer}");
}

/// Leads what is held from place to place, each before the next is said.
fn lead(page: &mut Page, places: &[(f64, f64)]) {
    for (x, y) in places {
        page.say(&json!({ "do": "move", "to": [x, y] }));
        page.ask(json!({ "do": "keep" }));
    }
}

fn release(page: &mut Page) -> String {
    let answer = page.ask(json!({ "do": "release" }));
    answer["statement"].as_str().map(str::to_owned).unwrap_or_default()
}

/// The world that the script and the journal make in a session of their own.
fn replayed(page: &Page) -> String {
    let mut session = Session::new();
    session.run(&scene()).expect("the script is right");
    for statement in page.journal() {
        session.run(&statement).expect("the journal is right");
    }
    session.to_script()
}

const WAY: [(f64, f64); 4] = [(1.5, 1.0), (1.234_567_8, 2.0), (0.5, 2.5), (-1.0, 0.25)];

#[test]
fn a_gesture_is_one_statement_that_gives_the_same_bits() {
    let viewed = Viewed::on(&scene());
    let mut page = viewed.open();
    let before = page.script();
    for (point, begins) in [("C", "pull C through ("), ("A", "drag A through (")] {
        hold(&mut page, point);
        lead(&mut page, &WAY);
        let statement = release(&mut page);
        assert!(statement.starts_with(begins) && statement.ends_with(" over 0"), "{statement}");
        assert_eq!(page.journal().last(), Some(&statement));
    }
    let after = page.script();
    assert_eq!(after, replayed(&page));
    assert_ne!(after, before);
    page.exec("undo 2");
    assert_eq!(page.script(), before);
    page.exec("redo 2");
    assert_eq!(page.script(), after);
}

#[test]
fn a_gesture_while_time_passes_gives_the_same_bits() {
    let viewed = Viewed::on(&scene());
    let mut page = viewed.open();
    page.ask(json!({ "do": "play", "speed": 1 }));
    page.until_later();
    for point in ["C", "A"] {
        hold(&mut page, point);
        lead(&mut page, &WAY);
        page.until_later();
        release(&mut page);
        // Without a hand for a while.
        page.until_later();
    }
    page.ask(json!({ "do": "pause" }));
    assert_eq!(page.script(), replayed(&page));
    let journal = page.journal();
    let firsts: Vec<&str> = journal.iter().map(|it| &it[..6]).collect();
    assert!(firsts.contains(&"pull C") && firsts.contains(&"drag A"), "{journal:?}");
    assert!(journal.iter().any(|it| it.starts_with("step ")), "{journal:?}");
}

#[test]
fn what_is_typed_meanwhile_parts_a_gesture() {
    let mut viewed = Viewed::on(&scene());
    let mut page = viewed.open();
    hold(&mut page, "C");
    lead(&mut page, &WAY[..2]);
    viewed.enter("freeze C");
    page.until(|message| message["journal"][0]["text"] == "freeze C");
    lead(&mut page, &WAY[2..]);
    let statement = release(&mut page);
    // It is frozen now: it goes where it is led.
    assert_eq!(statement, "drag C through (0.5, 2.5), (-1, 0.25) over 0");
    assert_eq!(page.journal().len(), 3);
    assert_eq!(page.script(), replayed(&page));
}

#[test]
fn a_gesture_may_be_taken_back_on_its_way() {
    let viewed = Viewed::on(&scene());
    let mut page = viewed.open();
    let before = page.script();
    hold(&mut page, "C");
    lead(&mut page, &WAY);
    page.ask(json!({ "do": "cancel" }));
    assert_eq!(page.script(), before);
    assert!(page.journal().is_empty());
    // One that led nowhere is none.
    hold(&mut page, "C");
    assert_eq!(page.ask(json!({ "do": "release" }))["statement"], json!(null));
    assert_eq!(page.script(), before);
    assert!(page.journal().is_empty());
}

#[test]
fn two_pages_see_one_another_and_one_holds() {
    let viewed = Viewed::on(&scene());
    let (mut first, mut second) = (viewed.open(), viewed.open());
    hold(&mut first, "C");
    second.until(|message| message["state"]["held"]["client"] == 0);
    assert_eq!(second.ask(json!({ "do": "grab", "point": 1 }))["ok"], false);
    // Who does not hold it does not lead it.
    second.ask(json!({ "do": "move", "to": [9, 9] }));
    lead(&mut first, &WAY[..1]);
    while second.at(4) != first.at(4) {
        second.until_frame();
    }
    assert_eq!(second.ask(json!({ "do": "release" }))["ok"], false);
    // Who leaves lets go.
    drop(first);
    second.until(|message| message["journal"][0]["text"] == "pull C to (1.5, 1) over 0");
    assert_eq!(second.ask(json!({ "do": "grab", "point": 1 }))["ok"], true);
}

#[test]
fn a_point_that_is_gone_is_not_held() {
    let viewed = Viewed::on(&scene());
    let mut page = viewed.open();
    assert_eq!(page.ask(json!({ "do": "grab", "point": 99 }))["ok"], false);
    hold(&mut page, "C");
    page.exec("delete C cascade");
    page.say(&json!({ "do": "move", "to": [1, 1] }));
    assert_eq!(release(&mut page), "");
    assert_eq!(page.ask(json!({ "do": "grab", "point": 4 }))["ok"], false);
    hold(&mut page, "B");
    assert_eq!(page.script(), replayed(&page));
}

#[test]
fn another_point_in_the_place_of_what_was_held_is_not_held() {
    let mut viewed = Viewed::on(&scene());
    let mut page = viewed.open();
    let points = |k: u32| format!("point p[{k}] = (5, 0), q[{k}] = (0, 0), r[{k}] = (4, 0)");
    page.exec(&format!("clear; {}", points(0)));
    let seen = |page: &mut Page, k: u32| {
        let name = format!("q[{k}]");
        page.until(|message| message["state"]["points"][1]["name"] == name.as_str());
    };
    for k in [1, 2] {
        seen(&mut page, k - 1);
        hold(&mut page, &format!("q[{}]", k - 1));
        lead(&mut page, &WAY[..1]);
        let line = format!("clear; {}", points(k));
        if k == 1 {
            page.exec(&line);
        } else {
            viewed.enter(&line);
            seen(&mut page, k);
        }
        let before = page.script();
        lead(&mut page, &WAY[1..]);
        assert_eq!(page.ask(json!({ "do": "release" }))["ok"], false);
        assert_eq!(page.script(), before);
    }
}

#[test]
fn a_hand_that_is_not_moved_holds_its_point_while_time_passes() {
    let viewed = Viewed::on(&scene());
    let mut page = viewed.open();
    let at = page.at(4);
    hold(&mut page, "C");
    page.ask(json!({ "do": "play" }));
    for _ in 0..4 {
        page.until_frame();
    }
    let [x, y] = page.at(4);
    assert!((x - at[0]).hypot(y - at[1]) < 1e-9);
    let statement = release(&mut page);
    assert!(statement.starts_with("pull C "), "{statement}");
    page.ask(json!({ "do": "pause" }));
    assert_eq!(page.script(), replayed(&page));
}
