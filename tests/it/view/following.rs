//! What a page knows by following is what it would be told if it came now.

use std::collections::BTreeMap;

use linkwork::Session;
use linkwork::live::{Live, Message};
use linkwork::session::Answer;
use proptest::prelude::*;
use serde_json::{Value, json};

use crate::laws::random_session::{SCENE, statement};
use crate::support::draws::draws;

/// A page that follows, message by message.
#[derive(Default)]
struct Follower {
    drawing: Value,
    off: Value,
    state: Value,
    traces: BTreeMap<usize, Vec<f64>>,
    frame: Vec<u8>,
    seq: u64,
    /// Where it has the figures: x, y and turn in turn.
    places: Vec<f32>,
}

impl Follower {
    fn hear(&mut self, message: &Message) {
        let text = match message {
            Message::Frame(frame) => {
                self.frame.clone_from(frame);
                self.seq = u64::from_le_bytes(frame[..8].try_into().expect("eight bytes"));
                assert_eq!(
                    self.topology(),
                    self.drawing["topology"],
                    "the frame is of the drawing"
                );
                self.place();
                return;
            }
            Message::Text(text) => text,
        };
        let message: Value = serde_json::from_str(text).expect("JSON");
        for (kind, what) in message.as_object().expect("an object") {
            match &**kind {
                "drawing" => {
                    self.drawing = what.clone();
                    self.places.clear();
                }
                "off" => self.off = what.clone(),
                "state" => self.state = what.clone(),
                "shapes" => {
                    assert_eq!(what["topology"], self.drawing["topology"]);
                    for change in what["figures"].as_array().expect("a list") {
                        let k = change[0].as_u64().expect("a number") as usize;
                        self.drawing["figures"][k]["shapes"] = change[1].clone();
                    }
                }
                "traces" => self.follow_traces(what, &message["n"]),
                _ => {}
            }
        }
    }

    fn follow_traces(&mut self, changed: &Value, n: &Value) {
        for trace in changed.as_array().expect("a list") {
            let number = |name: &str| trace[name].as_u64().expect("a number") as usize;
            let kept = self.traces.entry(number("trace")).or_default();
            kept.truncate(2 * number("from"));
            assert_eq!(kept.len(), 2 * number("from"), "there is what it goes on from");
            let at = trace["at"].as_array().expect("a list");
            kept.extend(at.iter().map(|x| x.as_f64().expect("a number")));
        }
        let n = n.as_u64().expect("a number") as usize;
        self.traces.retain(|&k, _| k < n);
    }

    fn topology(&self) -> Value {
        json!(u32::from_le_bytes(self.frame[8..12].try_into().expect("four bytes")))
    }

    fn n_points(&self) -> usize {
        self.drawing["points"].as_u64().expect("a number") as usize
    }

    /// The numbers of its last frame that are no places of figures.
    fn poses(&self) -> &[u8] {
        &self.frame[12..24 + 16 * self.n_points()]
    }

    /// Puts the figures where the last frame has them.
    fn place(&mut self) {
        let figures = self.drawing["figures"].as_array().expect("a list");
        self.places.resize(3 * figures.len(), f32::NAN);
        let number = |value: &Value| value.as_f64().expect("a number");
        let scale = number(&self.drawing["scale"]);
        let centre = [0, 1].map(|k| number(&self.drawing["centre"][k]));
        let poses = &self.frame[24..24 + 16 * self.n_points()];
        let px = |handle: &Value| {
            let from = 16 * handle.as_u64().expect("a handle") as usize;
            let coordinate = |k: usize| {
                let bytes = &poses[from + 8 * k..from + 8 * k + 8];
                f64::from_le_bytes(bytes.try_into().expect("eight bytes"))
            };
            [(coordinate(0) - centre[0]) * scale, (centre[1] - coordinate(1)) * scale]
        };
        for (figure, place) in figures.iter().zip(self.places.chunks_mut(3)) {
            let Some(on) = figure["on"].as_array() else { continue };
            let [x, y] = px(&on[0]);
            let turn = on.get(1).map_or(0.0, |towards| {
                let [u, v] = px(towards);
                libm::atan2(v - y, u - x).to_degrees()
            });
            place.copy_from_slice(&[x as f32, y as f32, turn as f32]);
        }
        for news in self.frame[24 + 16 * self.n_points()..].chunks(16) {
            let word = |k: usize| news[4 * k..4 * k + 4].try_into().expect("four bytes");
            let figure = u32::from_le_bytes(word(0)) as usize;
            for k in 0..3 {
                self.places[3 * figure + k] = f32::from_le_bytes(word(k + 1));
            }
        }
        assert!(self.places.iter().all(|number| number.is_finite()), "each has been told");
    }
}

/// The numbers of shapes, in their order; what is no number stays a text.
fn numbers(figures: &Value) -> (Vec<f64>, String) {
    let mut numbers = Vec::new();
    let mut rest = String::new();
    let text = figures.to_string();
    let is_of_number = |c: char| c.is_ascii_digit() || matches!(c, '.' | '-');
    let mut word = String::new();
    for c in text.chars().chain([' ']) {
        if is_of_number(c) {
            word.push(c);
        } else {
            match word.parse() {
                Ok(number) => numbers.push(number),
                Err(_) => rest.push_str(&word),
            }
            word.clear();
            rest.push(c);
        }
    }
    (numbers, rest)
}

fn is_near(a: &[f64], b: &[f64]) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| (a - b).abs() <= 0.2)
}

struct Theatre {
    session: Session,
    live: Live,
    files: Answer,
    followers: BTreeMap<u32, Follower>,
}

impl Theatre {
    fn new() -> Self {
        let mut session = Session::new();
        session.run(SCENE).expect("the scene is right");
        Self {
            session,
            live: Live::new("test"),
            files: Answer::default(),
            followers: BTreeMap::new(),
        }
    }

    fn join(&mut self, client: u32) {
        self.live.join(client);
        self.followers.insert(client, Follower::default());
        self.say(client, &json!({ "do": "hello" }));
        self.say(client, &json!({ "do": "view", "scale": 60 }));
    }

    fn say(&mut self, client: u32, message: &Value) {
        let Self { session, live, files, .. } = self;
        live.receive(client, &message.to_string(), session, files);
        live.lead(session, files);
    }

    /// Tells those who are ready, until nobody has anything to hear.
    fn tell(&mut self) {
        loop {
            let told = self.live.take(&mut self.session);
            if told.is_empty() {
                return;
            }
            for (client, message) in told {
                let follower = self.followers.get_mut(&client).expect("it is there");
                follower.hear(&message);
                if matches!(message, Message::Frame(_)) {
                    let seen = json!({ "do": "seen", "seq": follower.seq });
                    self.say(client, &seen);
                }
            }
        }
    }
}

fn follows(texts: &[String]) {
    let mut theatre = Theatre::new();
    theatre.join(0);
    theatre.tell();
    for (k, text) in texts.iter().enumerate() {
        theatre.say(0, &json!({ "do": "exec", "text": text }));
        theatre.tell();
        let late = k as u32 + 1;
        theatre.join(late);
        theatre.tell();
        let (early, late) = (&theatre.followers[&0], &theatre.followers[&late]);
        let when = format!("after `{text}`");
        assert_eq!(early.poses(), late.poses(), "{when}");
        assert_eq!(early.off, late.off, "{when}");
        assert_eq!(early.state, late.state, "{when}");
        let traces = |it: &Follower| it.traces.clone();
        assert_eq!(traces(early), traces(late), "{when}");
        // Marks are as large as suited the mechanism when it was drawn.
        if early.drawing["mark"] != late.drawing["mark"] {
            continue;
        }
        assert_eq!(early.drawing["centre"], late.drawing["centre"], "{when}");
        let (a, b) = (&early.drawing["figures"], &late.drawing["figures"]);
        let names = |it: &Value| {
            // Names stand where they stood best when the drawing was made.
            let mut figures = it.clone();
            for figure in figures.as_array_mut().expect("a list") {
                let shapes = figure["shapes"].as_array_mut().expect("a list");
                shapes.retain(|shape| shape.get("text").is_none());
                // What it seemed to lie on then; frames tell where that is not so.
                figure.as_object_mut().expect("an object").remove("on");
            }
            figures
        };
        let ((a, s), (b, t)) = (numbers(&names(a)), numbers(&names(b)));
        assert_eq!(s, t, "{when}");
        assert!(is_near(&a, &b), "{when}");
        let widened =
            |it: &Follower| it.places.iter().map(|&number| f64::from(number)).collect::<Vec<_>>();
        assert!(is_near(&widened(early), &widened(late)), "{when}");
    }
}

proptest! {
    #![proptest_config(draws(16))]

    #[test]
    fn who_follows_knows_what_who_comes_is_told(texts in prop::collection::vec(statement(), 1..14)) {
        follows(&texts);
    }
}

/// A statement that failed leaves no point, but its handle is gone.
#[test]
fn frames_after_a_failure_are_of_as_many_points_as_the_drawing() {
    follows(&["clear", "for i in 1..1 { point L[i] = (i, i); length L[i] A }"].map(str::to_owned));
}

/// A page that looks on while others are told: what it asks for does not change what they see.
#[test]
fn pages_have_scales_of_their_own() {
    let mut theatre = Theatre::new();
    theatre.join(0);
    theatre.join(1);
    theatre.tell();
    let before = theatre.followers[&0].drawing.clone();
    theatre.say(1, &json!({ "do": "view", "scale": 200 }));
    theatre.tell();
    assert_eq!(theatre.followers[&0].drawing, before);
    let drawing = &theatre.followers[&1].drawing;
    assert_eq!(drawing["scale"], 200.0);
    // World units to px, y down.
    let at = &theatre.followers[&1].frame[24..40];
    let x = f64::from_le_bytes(at[..8].try_into().expect("eight bytes"));
    let figures = drawing["figures"].as_array().expect("a list");
    let of_first = |it: &&Value| it["point"] == 0 && it["layer"] == "joint";
    let k = figures.iter().position(|it| of_first(&it)).expect("its joint");
    let place = theatre.followers[&1].places[3 * k];
    let centre = drawing["centre"][0].as_f64().expect("a number");
    assert!((f64::from(place) - (x - centre) * 200.0).abs() < 1e-3);
}

#[test]
fn a_cord_that_sags_is_told_by_its_shape() {
    let mut theatre = Theatre::new();
    theatre
        .session
        .run("clear; point A = (0, 0) frozen, B = (3, 0); length A B <= 5")
        .expect("right");
    theatre.join(0);
    theatre.tell();
    let before = theatre.followers[&0].drawing.clone();
    theatre.say(0, &json!({ "do": "exec", "text": "move B to (2, 0)" }));
    theatre.tell();
    let after = &theatre.followers[&0].drawing;
    assert_eq!(before["topology"], after["topology"]);
    assert_ne!(before["figures"], after["figures"]);
}
