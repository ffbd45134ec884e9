//! How pictures look: what their statement says, and what does not hold in them.

use std::path::Path;

use linkwork::diag::{Diagnostic, Sources};
use linkwork::live::{Live, Message};
use linkwork::render::{Drawable, Options, svg};
use linkwork::session::{Grid, Host, Sweep, SweepScript, parse_axis};
use linkwork::{Answer, Session};

use crate::support::program::{folder, run, text};

const SCENE: &str = "
    point A = (0, 0) frozen, D = (4, 0) frozen, B = (1, 0), C = (3, 3)
    crank: motor A B radius 1 speed 1rev
    coupler: length B C = 3.5
    length C D = 3
    set dt 1/36
";

fn answer(text: &str) -> Answer {
    Session::new().run(text).unwrap_or_else(|e| panic!("{e}\nof {text}"))
}

fn picture(statements: &str) -> String {
    let answer = answer(&format!("{SCENE}solve\n{statements}"));
    let bytes = answer.files.get(Path::new("p.svg")).expect("a picture");
    String::from_utf8(bytes.clone()).expect("a text")
}

/// A number among the attributes of the document.
fn attribute(svg: &str, name: &str) -> f64 {
    let (_, rest) = svg.split_once(&format!(" {name}=\"")).expect("the attribute");
    rest.split_once('"').expect("its end").0.parse().expect("a number")
}

#[test]
fn a_large_width_scales_the_whole_and_letters_of_a_small_one_can_be_read() {
    let shown = |width: &str| picture(&format!("svg \"p.svg\" {width}"));
    let (as_drawn, wide, narrow) = (shown(""), shown("width 1200"), shown("width 300"));
    let widths = [&as_drawn, &wide, &narrow].map(|svg| attribute(svg, "width"));
    assert_eq!(widths, [800.0, 1200.0, 300.0]);
    let of_box = |svg: &str| {
        let (_, rest) = svg.split_once("viewBox=\"0 0 ").expect("a box");
        let (width, rest) = rest.split_once(' ').expect("its height");
        let height = rest.split_once('"').expect("its end").0;
        [width, height].map(|text| text.parse::<f64>().expect("a number"))
    };
    assert_eq!(of_box(&wide), of_box(&as_drawn));
    let heights = [&as_drawn, &wide].map(|svg| attribute(svg, "height"));
    assert!((1.5 * heights[0] - heights[1]).abs() < 0.1, "{heights:?}");
    // A px of the drawing is one of the page, so letters have the size that the sheet says.
    assert_eq!(of_box(&narrow), ["width", "height"].map(|side| attribute(&narrow, side)));
    let size = narrow.split_once("font-style:italic;font-size:").expect("a name").1;
    let size: f64 = size.split_once("px").expect("px").0.parse().expect("a number");
    assert!(size > 10.0, "{size}");
}

#[test]
fn each_word_changes_what_it_says() {
    let plain = picture("svg \"p.svg\"");
    assert!(plain.contains("fill=\"#fdfdfb\"") && plain.contains("class=\"name\""));
    let dark = picture("svg \"p.svg\" dark");
    assert!(!dark.contains("#fdfdfb") && !dark.contains("#273542"), "{dark}");
    let transparent = picture("svg \"p.svg\" transparent");
    assert!(!transparent.contains("class=\"paper\""));
    let nameless = picture("svg \"p.svg\" without names");
    assert!(!nameless.contains("class=\"name\"") && nameless.contains("<title>coupler</title>"));
    let titled = picture("svg \"p.svg\" title \"a & b\"");
    assert!(titled.contains("<title>a &amp; b</title>"));
    assert!(titled.contains("class=\"headline\"") && titled.contains(">a &amp; b</text>"));
    assert!((attribute(&titled, "height") - attribute(&plain, "height") - 34.0).abs() < 1e-9);
}

#[test]
fn what_is_off_is_red_and_says_by_how_much() {
    assert!(!picture("svg \"p.svg\"").contains("unmet"));
    let off = picture("off crank; change coupler = 9; svg \"p.svg\"");
    assert_eq!(off.matches("class=\"unmet\"").count(), 1, "{off}");
    assert!(off.contains(".unmet path,.unmet circle{stroke:#c8102e}"));
    // Nothing moved since it was 3.5 long.
    assert!(off.contains(">coupler off by 5.5</text>"), "{off}");
    let turned = picture(
        "point F = (6, 0) frozen, G = (6, 2) frozen
         tilt: orientation A D, F G = 60deg
         svg \"p.svg\" dark",
    );
    assert!(turned.contains(">tilt off by 30 deg</text>"), "{turned}");
    assert!(turned.contains(".unmet path,.unmet circle{stroke:#ff5c6c}"));
}

/// Keeps the last picture that was to be shown on the spot.
#[derive(Default)]
struct Shown(String);

impl Host for Shown {
    fn print(&mut self, _: &str) {}
    fn tell(&mut self, _: &Diagnostic, _: &Sources) {}
    fn draw(&mut self, what: Drawable) {
        self.0 = what.svg();
    }
}

#[test]
fn what_is_off_is_red_wherever_a_pose_is_drawn() {
    let script = format!("{SCENE}let r = 9\nsolve\noff crank\nchange coupler = r\n");
    let check = |way: &str, drawn: &str| {
        assert!(drawn.contains(">coupler off by 5.5</text>"), "{way}: {drawn}");
    };
    let mut session = Session::new();
    session.run(&script).expect("no mistake");
    check("the library", &svg(&session.scene(), &Options::default()));

    let mut shown = Shown::default();
    let source = session.add_source("test", "show", None);
    session.execute_all(source, &mut shown).expect("no mistake");
    check("show", &shown.0);

    let (mut live, mut files) = (Live::new("test"), Answer::default());
    live.join(0);
    live.receive(0, r#"{"do": "hello"}"#, &mut session, &mut files);
    live.receive(0, r#"{"do": "file", "kind": "svg", "id": 1}"#, &mut session, &mut files);
    let told = live.take(&mut session).into_iter();
    let texts = told.filter_map(|(_, message)| match message {
        Message::Text(text) => Some(text.clone()),
        Message::Frame(_) => None,
    });
    check("a page", &texts.collect::<String>().replace("\\\"", "\""));

    let out = run(folder(&[]).path(), &["--json"], &format!("{script}{{\"get\": \"svg\"}}\n"));
    check("json", &text(&out.stdout).replace("\\\"", "\""));

    let script = SweepScript::read("s", &script, "".into(), Vec::new()).expect("no mistake");
    let grid = Grid { axes: vec![parse_axis("r=9").expect("an axis")] };
    let mut host = Answer::default();
    let sweep = Sweep::begin(script, grid, &mut host).expect("it runs");
    let swept = sweep.picture(0, &Options::default(), &mut host);
    check("a sweep", &swept.expect("a picture"));
}

/// The middles and halves of the boxes around the amounts of a picture, px.
fn amounts(drawn: &str) -> Vec<(String, [f64; 2], [f64; 2])> {
    let document = roxmltree::Document::parse(drawn).expect("it is well formed");
    let amounts = document.descendants().filter(|node| node.attribute("class") == Some("amount"));
    amounts
        .map(|node| {
            let number = |name: &str| -> f64 {
                node.attribute(name).map_or(0.0, |text| text.parse().expect("a number"))
            };
            let place = node.parent().and_then(|group| group.attribute("transform"));
            let place = place.and_then(|it| it.strip_prefix("translate(")?.strip_suffix(')'));
            let place: Vec<f64> =
                place.expect("it is moved").split(' ').map(|it| it.parse().expect("px")).collect();
            let text = node.text().expect("an amount").to_owned();
            // Letters of 13 px are on average some 6 px wide, and stand on their line.
            let half = [3.0 * text.len() as f64, 6.0];
            (text, [place[0] + number("x"), place[1] + number("y") - 4.5], half)
        })
        .collect()
}

#[test]
fn amounts_do_not_lie_on_each_other() {
    // All in one line, the middles of the bars close together.
    let drawn = picture(
        "freeze all; delete C cascade
         point P = (2, 0) frozen
         for i in 1..4 { point Q[i] = (2 + i / 10, 0) frozen; length P Q[i] = i }
         svg \"p.svg\"",
    );
    let boxes = amounts(&drawn);
    assert_eq!(boxes.len(), 4, "{drawn}");
    for (k, (_, at, half)) in boxes.iter().enumerate() {
        for (_, other, other_half) in &boxes[k + 1..] {
            let is_apart =
                |axis: usize| (at[axis] - other[axis]).abs() >= half[axis] + other_half[axis];
            assert!(is_apart(0) || is_apart(1), "{boxes:?}");
        }
    }
}

#[test]
fn an_amount_stands_beside_what_is_off_and_not_on_it() {
    // Two bars and two that are to be equal, far apart; none is half as long as the page is wide.
    let drawn = picture(
        "delete A cascade; delete B cascade; delete C cascade; delete D cascade
         point P = (0, 0) frozen, Q = (4, 0) frozen, R = (0, 9) frozen, S = (0, 6) frozen
         point T = (9, 9) frozen, U = (9, 8) frozen
         level: length P Q = 5; upright: length R S = 5; alike: equal R S, T U
         svg \"p.svg\"",
    );
    // The page shows 9 by 9 units within 48 px on each side.
    let px = |x: f64, y: f64| [48.0 + x * (704.0 / 9.0), 752.0 - y * (704.0 / 9.0)];
    let bars = [
        ("level", [px(0.0, 0.0), px(4.0, 0.0)]),
        ("upright", [px(0.0, 9.0), px(0.0, 6.0)]),
        ("alike", [px(9.0, 9.0), px(9.0, 8.0)]),
    ];
    let found = amounts(&drawn);
    assert_eq!(found.len(), 3, "{drawn}");
    for (text, at, half) in &found {
        let gap = |[a, b]: [[f64; 2]; 2]| {
            // The least distance of the box from the bar, which is upright or level.
            let beyond = |axis: usize| {
                let (lo, hi) = (a[axis].min(b[axis]), a[axis].max(b[axis]));
                (lo - at[axis] - half[axis]).max(at[axis] - half[axis] - hi).max(0.0)
            };
            f64::hypot(beyond(0), beyond(1))
        };
        for (name, bar) in bars {
            let gap = gap(bar);
            assert!(gap > 3.0, "{text} lies on {name}: {found:?}");
            assert!(!text.starts_with(name) || name == "alike" || gap < 30.0, "{text}: {found:?}");
        }
        let is_of_pair = bars[1..].iter().any(|(_, bar)| gap(*bar) < 30.0);
        assert!(!text.starts_with("alike") || is_of_pair, "{text}: {found:?}");
    }
}

#[test]
fn more_than_can_be_read_is_counted() {
    let drawn = picture(
        "for i in 1..40 { point P[i] = (i, 9) frozen, Q[i] = (i, 10) frozen; length P[i] Q[i] = 3 }
         svg \"p.svg\"",
    );
    let found = amounts(&drawn);
    assert_eq!(drawn.matches("class=\"unmet\"").count(), 40);
    assert_eq!(found.len(), 17, "{found:?}");
    assert!(found.iter().any(|(text, ..)| text == "and 24 more off"), "{found:?}");
}

#[test]
fn a_title_that_is_too_wide_has_several_lines_and_an_empty_one_none() {
    let plain = picture("svg \"p.svg\"");
    assert_eq!(picture("svg \"p.svg\" title \"\""), plain);
    let long = ["a word"; 30].join(" ");
    let titled = picture(&format!("svg \"p.svg\" title \"{long}\""));
    assert!(titled.contains(&format!("<title>{long}</title>")));
    let lines: Vec<&str> = titled.split("class=\"headline\"").skip(1).collect();
    assert!(lines.len() >= 2, "{titled}");
    let extra = attribute(&titled, "height") - attribute(&plain, "height");
    assert!(extra > 50.0, "{extra} px for {} lines", lines.len());
    let chart =
        |title: &str| picture(&format!("sample \"s\" = 1; plot \"p.svg\" title \"{title}\""));
    let (short, wide) = (chart("a word"), chart(&long));
    assert!(attribute(&wide, "height") > attribute(&short, "height"));
    assert!(
        wide.matches("font-weight=\"bold\"").count()
            > short.matches("font-weight=\"bold\"").count()
    );
}

#[test]
fn a_lap_that_is_closed_is_as_long_as_it_is_drawn() {
    // A turn in 24 frames: the path goes on from the last to the first.
    let moving = answer(
        "point O = (0, 0) frozen, P = (1, 0); motor O P speed 1rev; set dt 1/24; trace P
         record \"p.svg\"; step 24; record stop",
    );
    let moving = String::from_utf8(moving.files[Path::new("p.svg")].clone()).expect("a text");
    let length = attribute(&moving, "pathLength");
    // A circle of two units across the page, but for its margins, as a polygon.
    let radius = 0.5 * (attribute(&moving, "width") - 96.0);
    let polygon = 48.0 * radius * (std::f64::consts::PI / 24.0).sin();
    assert!((length / polygon - 1.0).abs() < 1e-3, "{length}, not {polygon}");
}

#[test]
fn a_picture_that_moves_fits_its_window() {
    let rule = "svg:root{max-width:100%;max-height:100vh}";
    assert!(picture("record \"p.svg\"; step 36; record stop").contains(rule));
    assert!(!picture("svg \"p.svg\"").contains(rule));
}

#[test]
fn recordings_look_as_their_statement_says() {
    let moving =
        picture("record \"p.svg\" every 2 dark without names width 300; step 6; record stop");
    assert!(!moving.contains("#fdfdfb") && !moving.contains("class=\"name\""));
    assert_eq!(attribute(&moving, "width"), 300.0);
    let files = answer(&format!("{SCENE}record \"f/\" transparent; step 2; record stop")).files;
    assert_eq!(files.len(), 2);
    for (name, bytes) in files {
        let text = String::from_utf8(bytes).expect("a text");
        assert!(!text.contains("class=\"paper\""), "{}", name.display());
    }
}

#[test]
fn an_ending_that_fits_nothing_is_told_what_fits() {
    for (statement, wanted) in [
        ("svg \"p.gif\"", "`record \"p.gif\"` writes that"),
        ("svg \"p.dxf\"", "`export \"p.dxf\"` writes that"),
        ("svg \"p\"", "for example `\"p.svg\"`"),
        ("plot \"p.csv\"", "`record \"p.csv\"` writes that"),
        ("record \"p.png\"", "`svg \"p.png\"` writes one picture"),
        ("export \"p.png\"", "`svg \"p.png\"` writes that"),
        ("export \"p.link\"", "`save \"p.link\"` writes that"),
        ("export \"p.dxf\"", "`export \"p.dxf\" in mm scale 10 width 12 hole 4`"),
        ("export \"p.svg\" hole 4", "`width 12` makes parts so wide"),
        ("export \"p.svg\" in inch", "`in mm scale 25.4` where a unit of the plane is an inch"),
    ] {
        let text = format!("{SCENE}sample \"a\" = 1\n{statement}");
        let problem = Session::new().run(&text).expect_err(statement);
        assert!(problem.helps.iter().any(|help| help == wanted), "of {statement}: {problem:?}");
    }
}

#[cfg(not(feature = "pictures"))]
#[test]
fn a_program_without_pixels_says_how_to_have_them() {
    for statement in ["svg \"p.png\"", "record \"p.gif\"", "sample \"a\" = 1; plot \"p.png\""] {
        let problem = Session::new().run(&format!("{SCENE}{statement}")).expect_err(statement);
        let told = format!("{problem:?}");
        assert!(told.contains("without pictures in pixels"), "of {statement}: {told}");
        assert!(told.contains("--features pictures"), "of {statement}: {told}");
    }
}
