//! What a page and a prompt see of one another.

use serde_json::json;

use super::browser::Viewed;
use crate::support::program::{folder, run, text};

const FOUR_BAR: &str = "
    point A = (0, 0) frozen, D = (4, 0) frozen, B = (1, 0), C = (3, 3)
    crank: motor A B radius 1 speed 1rev
    coupler: length B C = 3.5
    rocker: length C D = 3
    solve
";

#[test]
fn a_page_is_told_the_mechanism() {
    let viewed = Viewed::on(FOUR_BAR);
    let page = viewed.open();
    assert_eq!(page.last("hello")["protocol"], 1);
    let drawing = page.last("drawing").clone();
    let figures = drawing["figures"].as_array().expect("figures");
    let n_points = drawing["points"].as_u64().expect("a number") as usize;
    assert_eq!(n_points, 4);
    // All that there is lies on its points.
    assert_eq!(page.frame.len(), 24 + 16 * n_points);
    assert_eq!(page.at(1), [4.0, 0.0]);
    let [x, y] = page.at(3);
    assert!(((x - 4.0).hypot(y) - 3.0).abs() < 1e-12);
    let state = page.last("state");
    assert_eq!(state["constraints"][1]["text"], "coupler: length B C = 3.5");
    assert_eq!(state["motors"][0]["shown"], "1rev");
    assert_eq!(state["freedoms"], 0);
    assert_eq!(page.last("off"), &json!([]));
    // Each class that is drawn has a look.
    let shapes = figures.iter().flat_map(|it| it["shapes"].as_array().expect("shapes"));
    for shape in shapes {
        assert!(page.last("classes").get(shape["class"].as_str().expect("a class")).is_some());
    }
}

#[test]
fn a_bar_that_is_level_lies_on_both_ends() {
    let viewed = Viewed::on("point A = (0, 0) frozen, B = (1, 0)\nlength A B");
    let mut page = viewed.open();
    let figures = page.last("drawing")["figures"].as_array().expect("figures").clone();
    let bar = figures.iter().find(|it| it["constraint"] == 0).expect("a bar");
    assert_eq!(bar["on"], json!([0, 1]));
    // So no frame has to tell where it is.
    page.exec("move B to (0, 1)");
    while page.at(1) != [0.0, 1.0] {
        page.until_frame();
    }
    assert_eq!(page.frame.len(), 24 + 16 * 2);
}

#[test]
fn what_is_typed_shows_at_once() {
    let mut viewed = Viewed::on("point A = (0, 0), B = (3, 4)");
    let mut page = viewed.open();
    viewed.enter("move A to (1, 2)");
    page.until(|message| message["journal"][0]["by"] == "prompt");
    while page.at(0) != [1.0, 2.0] {
        page.until_frame();
    }
    assert_eq!(page.journal(), ["move A to (1, 2)"]);
    // What only looks is no part of the journal, and what failed is not.
    viewed.enter("print A; move Q to A");
    viewed.enter("length A B");
    page.until(|message| message["drawing"]["figures"].as_array().is_some_and(|it| it.len() == 3));
    assert_eq!(page.journal(), ["move A to (1, 2)", "length A B"]);
}

#[test]
fn a_mistake_is_told_with_its_place() {
    let viewed = Viewed::on("point A = (0, 0)");
    let mut page = viewed.open();
    let answer = page.exec("print \"ä😀\"; lenght A B");
    assert_eq!(answer["ok"], false);
    let said = answer["said"].as_array().expect("a list");
    assert_eq!(said[0], json!({ "kind": "line", "text": "ä😀" }));
    assert_eq!(said[1]["message"], "unknown command `lenght`");
    assert_eq!(said[1]["code"], "E0101");
    assert_eq!(said[1]["helps"], json!(["did you mean `length`?"]));
    // In units of UTF-16, as a page counts.
    assert_eq!([&said[1]["from"], &said[1]["to"]], [13, 19]);
    assert!(said[1]["text"].as_str().expect("a text").contains("^^^^^^"));
}

#[test]
fn what_is_off_is_told_by_how_much() {
    let viewed = Viewed::on("point A = (0, 0) frozen, B = (5, 0) frozen\nrod: length A B = 3");
    let mut page = viewed.open();
    assert_eq!(page.last("off")[0]["name"], "rod");
    assert_eq!(page.last("off")[0]["shown"], "2");
    page.exec("thaw B; solve");
    page.until(|message| message["off"] == json!([]));
}

#[test]
fn time_passes_until_it_is_stopped_and_is_one_step() {
    let viewed = Viewed::on(FOUR_BAR);
    let mut page = viewed.open();
    let before = page.script();
    page.ask(json!({ "do": "play", "speed": 4 }));
    for _ in 0..5 {
        page.until_frame();
    }
    page.ask(json!({ "do": "pause" }));
    page.until(|message| message["journal"][0]["text"].is_string());
    let journal = page.journal();
    let n: u64 = journal[0].strip_prefix("step ").expect("frames").parse().expect("a number");
    assert_eq!(journal.len(), 1);
    let after = page.script();
    page.exec("undo");
    assert_eq!(page.script(), before);
    assert_eq!(page.exec(&format!("step {n}"))["ok"], true);
    assert_eq!(page.script(), after);
}

#[test]
fn a_slider_on_its_way_leaves_one_statement() {
    let viewed = Viewed::on(
        "let r = 3
         point A = (0, 0) frozen, B = (3, 0)
         length A B = r
         set live on",
    );
    let mut page = viewed.open();
    let before = page.script();
    for k in 1..=50 {
        let text = format!("let r = {}", 3.0 + f64::from(k) / 10.0);
        assert_eq!(page.ask(json!({ "do": "try", "text": text }))["ok"], true);
    }
    page.ask(json!({ "do": "keep" }));
    assert_eq!(page.print("r"), ["8"]);
    let journal = page.journal();
    let tried: Vec<_> = journal.iter().filter(|text| text.starts_with("let")).collect();
    assert_eq!(tried, ["let r = 8"]);
    page.exec("undo");
    assert_eq!(page.script(), before);
    // What is tried may be dropped, and what cannot be tried is refused.
    page.ask(json!({ "do": "try", "text": "let r = 7" }));
    page.ask(json!({ "do": "drop" }));
    assert_eq!(page.script(), before);
    for text in ["step 3", "let r = 4; let r = 5", "svg \"a.svg\"", "lett r = 4", ""] {
        assert_eq!(page.ask(json!({ "do": "try", "text": text }))["ok"], false, "{text}");
    }
    assert_eq!(page.script(), before);
}

#[test]
fn texts_longer_than_a_message_come_in_pieces() {
    let viewed = Viewed::on("");
    let mut page = viewed.open();
    let points: Vec<String> = (0..1000).map(|k| format!("point p[{k}] = ({k}, {k})\n")).collect();
    let script = points.concat();
    let mut pieces: Vec<&str> = Vec::new();
    let mut rest = script.as_str();
    while !rest.is_empty() {
        let (piece, after) = rest.split_at(rest.len().min(3000));
        pieces.push(piece);
        rest = after;
    }
    for piece in pieces {
        page.say(&json!({ "do": "exec", "text": piece, "more": true }));
    }
    assert_eq!(page.print("p[999]"), ["(999, 999)"]);
}

#[test]
fn completion_counts_as_a_page_does() {
    let viewed = Viewed::on("point crank_pin = (0, 0)");
    let mut page = viewed.open();
    let answer = page.ask(json!({ "do": "complete", "text": "print \"😀\", cran", "at": 16 }));
    assert_eq!(answer["start"], 12);
    assert_eq!(answer["candidates"][0]["text"], "crank_pin");
    assert_eq!(answer["incomplete"], false);
    let string = &answer["pieces"][1];
    assert_eq!([&string["from"], &string["to"]], [6, 10]);
}

#[test]
fn files_are_of_a_copy() {
    let viewed = Viewed::on(&format!("{FOUR_BAR}\ntrace C"));
    let mut page = viewed.open();
    let before = page.script();
    let file = |kind: &str, page: &mut super::browser::Page| {
        let answer = page.ask(json!({ "do": "file", "kind": kind, "frames": 10 }));
        assert_eq!(answer["ok"], true, "{answer}");
        answer["text"].as_str().expect("a text").to_owned()
    };
    assert!(file("svg", &mut page).starts_with("<svg"));
    assert!(file("animation", &mut page).contains("<animate"));
    let table = file("csv", &mut page);
    assert_eq!(table.lines().next(), Some("time,C.x,C.y"));
    assert_eq!(table.lines().count(), 11);
    assert_eq!(file("script", &mut page), before);
    assert_eq!(page.script(), before);
    let wrong = page.ask(json!({ "do": "file", "kind": "written", "name": "nowhere.svg" }));
    assert_eq!(wrong["ok"], false);
}

#[test]
fn leaving_the_session_ends_its_pages() {
    let mut viewed = Viewed::on(FOUR_BAR);
    let mut page = viewed.open();
    viewed.enter("quit");
    let end = page.until_closed().expect("it says why");
    assert_eq!((u16::from(end.code), &*end.reason), (1001, "the session has ended"));
    assert!(viewed.leave().success());
}

#[test]
fn a_page_that_quits_leaves_the_session_to_others() {
    let viewed = Viewed::on("point A = (0, 0)");
    let (mut first, mut second) = (viewed.open(), viewed.open());
    assert_eq!(first.exec("quit")["quit"], true);
    assert_eq!(second.print("A"), ["(0, 0)"]);
}

#[test]
fn view_is_for_sessions() {
    let folder = folder(&[("scene.link", "view")]);
    let out = run(folder.path(), &["scene.link"], "");
    assert_eq!(out.status.code(), Some(2));
    assert!(text(&out.stderr).contains("linkwork view FILE"), "{}", text(&out.stderr));
    // In a session there is one address, however often it is asked for.
    let out = run(folder.path(), &[], "view\nview\n");
    let out = text(&out.stdout);
    let addresses: Vec<&str> = out.lines().collect();
    assert!(addresses[0].starts_with("http://127.0.0.1:"), "{out}");
    assert_eq!(addresses[0], addresses[1]);
    let taken = std::net::TcpListener::bind("127.0.0.1:0").expect("a port");
    let port = taken.local_addr().expect("an address").port().to_string();
    let out = run(folder.path(), &["view", "--port", &port], "");
    assert_eq!(out.status.code(), Some(3));
    assert!(text(&out.stderr).contains("no page can be shown"), "{}", text(&out.stderr));
}
