//! Pictures are XML 1.0, whatever texts they hold.

use linkwork::render::{Animation, Options, Scene, View, svg};
use linkwork::session::Session;
use linkwork::world::World;
use proptest::prelude::*;

use crate::support::draws::draws;
use crate::support::talk::Talking;

/// What XML cannot hold, what it takes for its own, and what a terminal would obey.
const ODD: &str = "\u{0}\u{1}\u{7}\u{8}\u{b}\u{c}\r\u{1b}[31m\u{7f}\u{85}\u{9b}2J\u{fffe}\u{ffff}\
    \u{202e}]]>&amp;<!--\"'</title><script>\u{10ffff}\u{d7ff}\u{e000}";

/// Checks that a picture is well-formed; gives the texts in it.
#[track_caller]
fn check(picture: &str) -> String {
    match roxmltree::Document::parse(picture) {
        Ok(document) => document.descendants().filter_map(|node| node.text()).collect(),
        Err(e) => panic!("{e} in {picture:?}"),
    }
}

/// Draws what may hold a text, of any kind of picture.
fn draw(text: &str) {
    let options = Options {
        title: Some(text.to_owned()),
        receipt: vec![(text.to_owned(), text.to_owned())],
        ..Options::default()
    };
    let mut session = Session::new();
    session.run("point A = (0, 0) frozen, B = (1, 0); length A B; trace B").expect("it is right");
    let scene = Scene::new(session.world());
    let mut movie = Animation::new(View::of([&scene]), &options);
    movie.push(&scene, 0.0);
    for picture in [svg(&scene, &options), movie.finish()] {
        let told = check(&picture);
        assert!(told.chars().all(|c| !c.is_control() || matches!(c, '\n' | '\t')), "{told:?}");
    }
    assert!(svg(&Scene::new(&World::new()), &options).starts_with("<svg class=\"linkwork\""));

    let quoted = text.replace(['"', '\n', '\r', '\\'], " ");
    let mut talking = Talking::default();
    let chart = format!(
        "sample \"{quoted}\" = 1, 2, 3; sample \"b\" = 1
         plot \"p.svg\" title \"{quoted}\" x \"{quoted}\" y \"{quoted}\" log"
    );
    if talking.execute(&chart).is_ok() {
        let told = check(talking.talk.files.values().next().expect("a picture"));
        assert!(told.chars().all(|c| !c.is_control() || matches!(c, '\n' | '\t')), "{told:?}");
    }
}

#[test]
fn odd_texts_stand_in_pictures() {
    draw(ODD);
    ODD.chars().for_each(|c| draw(&c.to_string()));
}

proptest! {
    #![proptest_config(draws(256))]

    #[test]
    fn any_text_stands_in_pictures(text in "\\PC{0,20}|(?s:.{0,20})") {
        draw(&text);
    }
}

#[test]
fn names_of_any_script_stand_in_pictures() {
    let mut talking = Talking::after(
        "point Ä = (0, 0) frozen, 点 = (1, 0), p[-1] = (2, 1); rod: length Ä 点; length 点 p[-1]
         trace 点; record \"m.svg\"; record \"f/\"; expose every 1; step 3; record stop; svg \"s.svg\"",
    );
    assert!(talking.talk.files.len() > 4);
    std::mem::take(&mut talking.talk.files).values().for_each(|picture| drop(check(picture)));
}
