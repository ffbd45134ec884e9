//! What pages did, in whatever order their messages, ticks of the clock and looks at the mechanism came,
//! is what the journal says of it.

use linkwork::Session;
use linkwork::live::{Live, Message};
use linkwork::session::{Answer, Transcript};
use linkwork::world::Entity;
use proptest::prelude::*;
use serde_json::{Value, json};

use crate::laws::random_session::{SCENE, statement};
use crate::support::compare::check_same;
use crate::support::draws::draws;

const PAGES: u32 = 2;

/// What happens next.
#[derive(Debug, Clone)]
enum Deed {
    /// A page says something.
    Says(u32, Value),
    /// A page takes hold of a point.
    Grabs(u32, &'static str),
    /// So many ms go by, then what waits is done.
    Works(u32),
    /// Pages are told; one of them has not looked yet.
    Tells(Option<u32>),
    /// A statement at the prompt.
    Types(String),
    /// A page goes, and comes again.
    Leaves(u32),
}

fn deed() -> impl Strategy<Value = Deed> {
    let page = || 0..PAGES;
    let point = prop::sample::select(vec!["A", "B", "C", "D", "E", "F", "G", "K", "tail.X"]);
    let number = || (-40..40_i32).prop_map(|x| f64::from(x) / 7.0);
    let says = |words: Vec<&'static str>| {
        let word = prop::sample::select(words);
        (page(), word).prop_map(|(page, word)| Deed::Says(page, json!({ "do": word })))
    };
    let tries =
        prop::sample::select(vec!["let r = 3.4", "change crank speed 0.5rev", "set rho 0.5"]);
    prop_oneof![
        4 => (page(), point).prop_map(|(page, point)| Deed::Grabs(page, point)),
        9 => (page(), number(), number())
            .prop_map(|(page, x, y)| Deed::Says(page, json!({ "do": "move", "to": [x, y] }))),
        6 => (0..50_u32).prop_map(Deed::Works),
        4 => prop::option::of(page()).prop_map(Deed::Tells),
        3 => says(vec!["release", "release", "cancel", "keep", "drop"]),
        2 => says(vec!["play", "play", "pause"]),
        1 => (page(), 1..200_u32)
            .prop_map(|(page, scale)| Deed::Says(page, json!({ "do": "view", "scale": scale }))),
        1 => (page(), tries).prop_map(|(page, text)| Deed::Says(page, json!({ "do": "try", "text": text }))),
        2 => (page(), statement())
            .prop_map(|(page, text)| Deed::Says(page, json!({ "do": "exec", "text": text }))),
        1 => statement().prop_map(Deed::Types),
        1 => page().prop_map(Deed::Leaves),
        1 => page().prop_map(|page| Deed::Says(page, json!({ "do": "file", "kind": "script" }))),
    ]
}

/// A session with pages, and a clock that is set by hand.
struct Theatre {
    session: Session,
    live: Live,
    host: Answer,
    prompt: Transcript,
    now: f64,
}

impl Theatre {
    fn on(scene: &str) -> Self {
        let mut session = Session::new();
        session.run(scene).expect("the scene is right");
        let mut live = Live::new("test");
        live.take_back_over(&session);
        let host = Answer::default();
        let mut theatre =
            Self { session, live, host, prompt: Transcript::conversation("prompt"), now: 0.0 };
        (0..PAGES).for_each(|page| theatre.come(page));
        theatre
    }

    fn come(&mut self, page: u32) {
        self.live.join(page);
        self.say(page, &json!({ "do": "hello" }));
    }

    fn say(&mut self, page: u32, message: &Value) {
        self.live.receive(page, &message.to_string(), &mut self.session, &mut self.host);
    }

    /// What pages are told now; those that look say so.
    fn tell(&mut self, inattentive: Option<u32>) -> Vec<(u32, Message)> {
        let told = self.live.take(&mut self.session);
        for (page, message) in &told {
            if let (Message::Frame(frame), true) = (message, Some(*page) != inattentive) {
                let seq = u64::from_le_bytes(frame[..8].try_into().expect("eight bytes"));
                self.say(*page, &json!({ "do": "seen", "seq": seq }));
            }
        }
        told
    }

    fn act(&mut self, deed: &Deed) {
        match deed {
            Deed::Says(page, message) => self.say(*page, message),
            Deed::Grabs(page, point) => {
                if let Some(Entity::Point(id)) = self.session.world().names().get(point) {
                    self.say(*page, &json!({ "do": "grab", "point": id.0 }));
                }
            }
            Deed::Works(ms) => {
                self.now += f64::from(*ms) / 1000.0;
                self.live.work(self.now, &mut self.session, &mut self.host);
            }
            Deed::Tells(inattentive) => drop(self.tell(*inattentive)),
            Deed::Types(text) => {
                self.live.hand_over(&mut self.session, &mut self.host);
                self.prompt.enter(text, &mut self.session, &mut self.host);
                self.live.take_back_over(&self.session);
            }
            Deed::Leaves(page) => {
                self.live.leave(*page, &mut self.session, &mut self.host);
                self.come(*page);
            }
        }
    }

    /// The statements that a page is told of which comes when all is over.
    fn journal(&mut self) -> Vec<String> {
        self.live.hand_over(&mut self.session, &mut self.host);
        self.come(PAGES);
        let told = self.tell(None).into_iter().filter(|(page, _)| *page == PAGES);
        let texts = told.filter_map(|(_, message)| match message {
            Message::Text(text) => serde_json::from_str::<Value>(&text).ok(),
            Message::Frame(_) => None,
        });
        let journals = texts.filter_map(|message| message["journal"].as_array().cloned());
        let entries =
            journals.flatten().map(|entry| entry["text"].as_str().unwrap_or("").to_owned());
        entries.collect()
    }
}

fn is_as_its_journal(deeds: &[Deed]) {
    let mut theatre = Theatre::on(SCENE);
    deeds.iter().for_each(|deed| theatre.act(deed));
    let journal = theatre.journal();
    let mut again = Session::new();
    again.run(SCENE).expect("the scene is right");
    for statement in &journal {
        again.run(statement).unwrap_or_else(|problem| panic!("{statement}: {problem}"));
    }
    check_same(&theatre.session.to_script(), &again.to_script(), &format!("{journal:#?}"));
}

proptest! {
    #![proptest_config(draws(24))]

    #[test]
    fn what_pages_did_is_what_the_journal_says(deeds in prop::collection::vec(deed(), 1..60)) {
        is_as_its_journal(&deeds);
    }
}

#[test]
fn a_gesture_of_twenty_thousand_places_is_one_statement_and_one_step_of_undo() {
    const SCENE: &str = "point A = (0, 0) frozen, B = (3, 0), C = (6, 0)\nlength A B; length B C";
    let mut theatre = Theatre::on(SCENE);
    theatre.act(&Deed::Tells(None));
    let (before, bytes_before) = (theatre.session.to_script(), theatre.session.undo_bytes());
    theatre.act(&Deed::Grabs(0, "C"));
    for k in 0..20_000 {
        let phi = f64::from(k) / 100.0;
        let to = [4.0 * phi.cos(), 4.0 * phi.sin()];
        theatre.act(&Deed::Says(0, json!({ "do": "move", "to": to })));
        theatre.act(&Deed::Works(1));
    }
    theatre.act(&Deed::Says(0, json!({ "do": "release" })));
    let bytes = theatre.session.undo_bytes() - bytes_before;
    assert!(bytes < 4096, "what undo keeps is where points were before, not their ways: {bytes}");
    let journal = theatre.journal();
    assert_eq!(journal.len(), 1);
    assert_eq!(journal[0].matches('(').count(), 20_000);
    let mut again = Session::new();
    again.run(SCENE).expect("the scene is right");
    again.run(&journal[0]).expect("the statement is right");
    assert_eq!(theatre.session.to_script(), again.to_script());
    theatre.session.run("undo").expect("there is something to undo");
    assert_eq!(theatre.session.to_script(), before);
}
