//! Pictures in pixels, as the feature `pictures` draws them. A crate of its own: with the feature
//! everything is built once more, and no other test needs it.

use std::cell::Cell;
use std::path::Path;
use std::rc::Rc;

use linkwork::diag::{Diagnostic, Sources};
use linkwork::session::{Flow, Host, Wish};
use linkwork::{Answer, Session};

const SCENE: &str = "
    point A = (0, 0) frozen, D = (4, 0) frozen, B = (1, 0), C = (3, 3)
    crank: motor A B radius 1 speed 1rev
    coupler: length B C = 3.5
    length C D = 3
    set dt 1/36
";

fn file(statements: &str, name: &str) -> Vec<u8> {
    let text = format!("{SCENE}solve\n{statements}");
    let answer = Session::new().run(&text).unwrap_or_else(|e| panic!("{e}\nof {text}"));
    answer.files.get(Path::new(name)).expect("a picture").clone()
}

/// Width and height in the header of a PNG.
fn size(png: &[u8]) -> [u32; 2] {
    assert!(png.starts_with(b"\x89PNG\r\n\x1a\n"));
    [16, 20].map(|at| u32::from_be_bytes(png[at..at + 4].try_into().expect("four bytes")))
}

#[test]
fn a_png_is_as_wide_as_its_statement_says_and_twice_the_drawing_without() {
    let drawn = |statement| String::from_utf8(file(statement, "p.svg")).expect("a text");
    let is_of = |svg: &str, [width, height]: [u32; 2]| {
        svg.contains(&format!(" height=\"{height}\" viewBox=\"0 0 {width} {height}\""))
    };
    let [width, height] = size(&file("svg \"p.png\"", "p.png"));
    assert_eq!(width, 1600);
    assert!(is_of(&drawn("svg \"p.svg\""), [width / 2, height / 2]), "{height}");
    // It is laid out for that width, as the drawing is.
    let narrow = size(&file("svg \"p.png\" width 400", "p.png"));
    assert_eq!(narrow[0], 400);
    assert!(is_of(&drawn("svg \"p.svg\" width 400"), narrow), "{narrow:?}");
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

/// A user who may want to stop.
struct Impatient {
    files: Answer,
    wants_to_stop: Rc<Cell<bool>>,
}

impl Host for Impatient {
    fn behind(&self) -> Option<&dyn Host> {
        Some(&self.files)
    }

    fn behind_mut(&mut self) -> Option<&mut dyn Host> {
        Some(&mut self.files)
    }

    fn print(&mut self, _: &str) {}

    fn tell(&mut self, _: &Diagnostic, _: &Sources) {}

    fn is_interrupted(&self) -> bool {
        self.wants_to_stop.get()
    }

    fn wish_to_stop(&self) -> Option<Wish> {
        let wants_to_stop = self.wants_to_stop.clone();
        Some(Rc::new(move || wants_to_stop.get()))
    }
}

#[test]
fn who_does_not_want_a_picture_any_more_leaves_it() {
    let mut session = Session::new();
    let files = session.run(&format!("{SCENE}solve")).expect("no mistake");
    let mut host = Impatient { files, wants_to_stop: Rc::default() };
    let mut draw = |wants_to_stop: bool, statement: &str| {
        host.wants_to_stop.set(wants_to_stop);
        host.files.files.clear();
        let source = session.add_source("test", statement, None);
        let flow = session.execute_all(source, &mut host).expect("no mistake");
        (flow, host.files.files.get(Path::new("p.png")).cloned())
    };
    let small = draw(false, "svg \"p.png\" width 300");
    assert_eq!(small.0, Flow::On);
    // Many times as long as it waits until it asks.
    assert_eq!(draw(true, "svg \"p.png\" width 8192"), (Flow::Stopped, None));
    // Who comes next may leave before it is their turn.
    assert_eq!(draw(true, "svg \"p.png\" width 300"), (Flow::Stopped, None));
    assert!(draw(false, "svg \"p.png\" width 300") == small, "what comes next is whole");
}
