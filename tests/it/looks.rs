//! How pictures look: what their statement says, and what does not hold in them.

use std::path::Path;

use linkwork::{Answer, Session};

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
fn a_width_scales_the_whole() {
    let (as_drawn, narrow) = (picture("svg \"p.svg\""), picture("svg \"p.svg\" width 400"));
    assert_eq!([attribute(&as_drawn, "width"), attribute(&narrow, "width")], [800.0, 400.0]);
    let heights = [attribute(&as_drawn, "height"), attribute(&narrow, "height")];
    assert!((heights[0] - 2.0 * heights[1]).abs() < 0.1, "{heights:?}");
    let of_box = |svg: &str| svg.split_once("viewBox=").map(|(_, rest)| rest[..20].to_owned());
    assert_eq!(of_box(&as_drawn), of_box(&narrow));
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

#[test]
fn amounts_do_not_lie_on_each_other() {
    // All in one line, the middles of the bars close together.
    let drawn = picture(
        "freeze all; delete C cascade
         point P = (2, 0) frozen
         for i in 1..4 { point Q[i] = (2 + i / 10, 0) frozen; length P Q[i] = i }
         svg \"p.svg\"",
    );
    let document = roxmltree::Document::parse(&drawn).expect("it is well formed");
    let amounts = document.descendants().filter(|node| node.attribute("class") == Some("amount"));
    let boxes: Vec<[f64; 3]> = amounts
        .map(|node| {
            let number = |name: &str| -> f64 {
                node.attribute(name).map_or(0.0, |text| text.parse().expect("a number"))
            };
            let place = node.parent().and_then(|group| group.attribute("transform"));
            let place = place.and_then(|it| it.strip_prefix("translate(")?.strip_suffix(')'));
            let place: Vec<f64> =
                place.expect("it is moved").split(' ').map(|it| it.parse().expect("px")).collect();
            let n_letters = node.text().expect("an amount").len() as f64;
            // Letters of 13 px are on average some 6 px wide.
            [place[0] + number("x"), place[1] + number("y"), 3.0 * n_letters]
        })
        .collect();
    assert_eq!(boxes.len(), 4, "{drawn}");
    for (k, [x, y, half]) in boxes.iter().enumerate() {
        for [other_x, other_y, other_half] in &boxes[k + 1..] {
            let is_apart = (x - other_x).abs() > half + other_half || (y - other_y).abs() >= 13.0;
            assert!(is_apart, "{boxes:?}");
        }
    }
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

#[cfg(feature = "pictures")]
mod pixels {
    use super::*;

    fn file(statements: &str, name: &str) -> Vec<u8> {
        let answer = answer(&format!("{SCENE}solve\n{statements}"));
        answer.files.get(Path::new(name)).expect("a picture").clone()
    }

    /// Width and height in the header of a PNG.
    fn size(png: &[u8]) -> [u32; 2] {
        assert!(png.starts_with(b"\x89PNG\r\n\x1a\n"));
        [16, 20].map(|at| u32::from_be_bytes(png[at..at + 4].try_into().expect("four bytes")))
    }

    #[test]
    fn a_png_is_as_wide_as_its_statement_says_and_twice_the_drawing_without() {
        let [width, height] = size(&file("svg \"p.png\"", "p.png"));
        assert_eq!(width, 1600);
        let [narrow, low] = size(&file("svg \"p.png\" width 400", "p.png"));
        assert_eq!((narrow, low), (400, (height + 2) / 4));
    }

    #[test]
    fn names_are_drawn_without_fonts_of_the_machine() {
        let png = |statement| file(statement, "p.png");
        let named = png("svg \"p.png\"");
        assert!(named == png("svg \"p.png\""), "the same bytes again");
        assert!(named.len() > png("svg \"p.png\" without names").len() + 500);
        let marks = named.windows(21).filter(|part| part == b"tEXtSoftware\0linkwork");
        assert_eq!(marks.count(), 1);
        let chart = png("sample \"a\" = 1, 4, 2; plot \"p.png\" title \"three\"");
        assert_eq!(size(&chart)[0] % 2, 0);
    }

    #[test]
    fn a_gif_has_the_frames_that_can_be_shown() {
        let frames = |gif: &[u8]| gif.windows(3).filter(|part| part == b"\x21\xf9\x04").count();
        let gif = file("record \"m.gif\" width 200; step 36; record stop", "m.gif");
        assert!(gif.starts_with(b"GIF89a\xc8\0"), "200 px wide");
        assert!(gif[..64].windows(8).any(|part| part == b"linkwork"));
        assert_eq!(frames(&gif), 36);
        // A second of a thousand frames: no browser shows more than fifty.
        let fast = "set dt 1/1000; record \"m.gif\" width 60 transparent; step 1000; record stop";
        assert_eq!(frames(&file(fast, "m.gif")), 50);
    }
}
