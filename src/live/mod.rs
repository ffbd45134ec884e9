//! A session that pages look at and take hold of.
//!
//! A page sends messages, texts of JSON, and gets messages, texts and frames; `docs/view.md` says
//! which. What carries them, a socket or a worker with the library in it, is the same to a [`Live`]:
//! it knows neither clocks nor files nor threads, and is lent the session with each message.
//!
//! All that changes the world is a statement, and stands in the journal: a point that is led by the
//! mouse is led at once, and when it is let go that is written as one `pull` or `drag` that gives the
//! same bits; time that passed is written as `step`.
//!
//! Messages are taken with [`receive`](Live::receive); points are led and time passes in
//! [`work`](Live::work), so that of many moves that wait only the last counts; what is to be told is
//! gathered by [`take`](Live::take).

mod drawn;
mod files;
mod listener;
mod pace;
mod pose;
mod request;
mod state;
mod units;
mod viewer;

use std::collections::{BTreeMap, VecDeque};

use serde_json::{Map, Value, json};

use crate::constraint::Point;
use crate::diag::Diagnostic;
use crate::lang::is_incomplete;
use crate::render::Scene;
use crate::session::{
    Attempt, Completion, EXAMPLES, Flow, Host, Ongoing, Outcome, Session, Transcript,
};
use crate::world::PointId;
use listener::{Listener, told};
use pace::Pace;
use pose::Pose;
use request::{Request, Wish};
use units::{from_utf16, to_utf16};
use viewer::{News, Viewer};

/// The version of the protocol.
pub const PROTOCOL: u32 = 1;

/// A page, by a number of its own.
pub type ClientId = u32;

/// What a page is told.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Message {
    /// A JSON object.
    Text(String),
    /// A frame.
    Frame(Vec<u8>),
}

/// Statements of the journal that a page gets when it comes.
const RECENT: usize = 500;
/// Places of a gesture that are written in one statement; one that goes on is written in several.
const MOST_PLACES: u64 = 5000;
/// What texts are called in messages that were sent by a page.
const PAGE: &str = "page";

/// What pages and a session have with one another.
pub struct Live {
    carrier: &'static str,
    viewers: BTreeMap<ClientId, Viewer>,
    transcript: Transcript,
    completion: Completion,
    /// What goes on: a point that is led, or time that passes.
    ongoing: Option<Ongoing>,
    grip: Option<Grip>,
    pace: Option<Pace>,
    attempt: Option<Attempt>,
    journal: VecDeque<Value>,
    n_journal: u64,
    /// How many of the session's statements are in the journal.
    n_typed: usize,
    scene: Option<Scene>,
    /// Count what pages may be told of.
    pose_number: u64,
    state_number: u64,
    /// What pages were told of the state, and of which state that was.
    state: (u64, Map<String, Value>),
    /// The parts of it that are the same while time passes.
    is_restated: bool,
    structure: Map<String, Value>,
    analysis: Map<String, Value>,
    pose: Option<(u64, Pose)>,
    outbox: Vec<(ClientId, Message)>,
}

/// A point that a page holds.
#[derive(Debug, Clone, Copy)]
struct Grip {
    client: ClientId,
    point: PointId,
    /// Where it was led last.
    place: Option<Point>,
    /// Whether it is to be led there still.
    is_to_move: bool,
}

impl Live {
    /// Nobody looks on yet. `carrier` tells pages what carries messages.
    pub fn new(carrier: &'static str, session: &Session) -> Self {
        Self {
            carrier,
            viewers: BTreeMap::new(),
            transcript: Transcript::conversation(PAGE),
            completion: Completion::default(),
            ongoing: None,
            grip: None,
            pace: None,
            attempt: None,
            journal: VecDeque::new(),
            n_journal: 0,
            n_typed: session.n_typed(),
            scene: None,
            pose_number: 1,
            state_number: 1,
            state: (0, Map::new()),
            is_restated: true,
            structure: Map::new(),
            analysis: Map::new(),
            pose: None,
            outbox: Vec::new(),
        }
    }

    /// Another page is there.
    pub fn join(&mut self, client: ClientId) {
        self.viewers.insert(client, Viewer::default());
    }

    /// A page has gone. What it held is let go.
    pub fn leave(&mut self, client: ClientId, session: &mut Session, host: &mut dyn Host) {
        self.viewers.remove(&client);
        if self.grip.is_some_and(|grip| grip.client == client) {
            self.let_go(session, host);
        }
        if self.viewers.is_empty() {
            self.pause(session, host);
        }
    }

    /// Whether there is something to be done without another message: a point to be led, time that
    /// passes.
    pub fn is_busy(&self) -> bool {
        self.pace.is_some() || self.grip.is_some_and(|grip| grip.is_to_move)
    }

    /// The session is to be asked by others: what goes on is written, what was tried stays.
    pub fn hand_over(&mut self, session: &mut Session, host: &mut dyn Host) {
        self.close(session, host);
        self.keep(session, host);
    }

    /// Others may have changed the session.
    pub fn take_back_over(&mut self, session: &Session) {
        if self.note_journal(session, "prompt") {
            self.note_change();
        }
    }

    /// Takes a message of a page.
    pub fn receive(
        &mut self,
        client: ClientId,
        message: &str,
        session: &mut Session,
        host: &mut dyn Host,
    ) {
        if !self.viewers.contains_key(&client) {
            return;
        }
        let request = match Request::parse(message) {
            Ok(request) => request,
            Err(problem) => return self.say(client, &json!({ "refused": problem })),
        };
        let answer = self.grant(client, request.wish, session, host);
        if let (Some(id), Some(mut answer)) = (request.id, answer) {
            answer["answer"] = id;
            self.say(client, &answer);
        }
    }

    /// Does what a page wishes; gives the answer, if it is to be given now.
    fn grant(
        &mut self,
        client: ClientId,
        wish: Wish,
        session: &mut Session,
        host: &mut dyn Host,
    ) -> Option<Value> {
        match wish {
            Wish::Hello => {
                self.welcome(client);
                return Some(json!({ "ok": true }));
            }
            Wish::Execute { text, is_more_to_come } => {
                let viewer = self.viewers.get_mut(&client)?;
                viewer.pending.push_str(&text);
                if is_more_to_come {
                    return None;
                }
                let text = std::mem::take(&mut viewer.pending);
                return Some(self.execute(&text, session, host));
            }
            Wish::Try(text) => return Some(self.attempt(&text, session, host)),
            Wish::Keep => self.keep(session, host),
            Wish::Drop => {
                if let Some(attempt) = self.attempt.take() {
                    session.take_back(attempt);
                    self.note_change();
                }
            }
            Wish::Grab(point) => return Some(self.grab(client, point, session, host)),
            Wish::Move(to) => {
                let scale = self.viewers.get(&client).map_or(1.0, Viewer::scale);
                if let Some(grip) = self.grip.as_mut().filter(|grip| grip.client == client) {
                    grip.place = Some(rounded(to, scale));
                    grip.is_to_move = true;
                }
            }
            Wish::Release => {
                if self.grip.is_none_or(|grip| grip.client != client) {
                    return Some(json!({ "ok": false, "said": [], "statement": null }));
                }
                return Some(self.let_go(session, host));
            }
            Wish::Cancel => {
                if self.grip.take_if(|grip| grip.client == client).is_some() {
                    if let Some(ongoing) = self.ongoing.take() {
                        session.give_up(&ongoing);
                    }
                    self.note_change();
                }
            }
            Wish::Play(speed) => {
                if self.pace.is_none() {
                    self.close(session, host);
                    self.keep(session, host);
                }
                self.pace = Some(Pace::new(speed));
                self.note_change();
            }
            Wish::Pause => self.pause(session, host),
            Wish::Complete { text, at } => {
                self.completion.refresh(session);
                return Some(complete(&self.completion, &text, at));
            }
            Wish::File(wish) => {
                self.close(session, host);
                return Some(match files::file(&wish, session, host) {
                    Ok(mut file) => {
                        file["ok"] = json!(true);
                        file
                    }
                    Err(why) => json!({ "ok": false, "said": [{ "kind": "error", "text": why }] }),
                });
            }
            Wish::View(scale) => self.viewers.get_mut(&client)?.set_scale(scale),
            Wish::Seen(seq) => self.viewers.get_mut(&client)?.has_seen(seq),
            Wish::Stop => {}
            Wish::Examples => {
                let examples = EXAMPLES.iter().map(|example| {
                    json!({ "name": example.name, "about": example.summary(), "text": example.text })
                });
                return Some(json!({ "ok": true, "examples": examples.collect::<Vec<_>>() }));
            }
        }
        Some(json!({ "ok": true }))
    }

    /// Leads a point on, and lets time pass; `now` is what a clock on the wall shows, seconds.
    pub fn work(&mut self, now: f64, session: &mut Session, host: &mut dyn Host) {
        let dt = session.world().clock().dt;
        if let Some(pace) = &mut self.pace {
            let n = pace.due(now, dt);
            for _ in 0..n {
                let to = self.grip.and_then(|grip| grip.place);
                if self.grip.is_some() && to.is_none() {
                    // Held where it is: it stays there until it is led.
                    self.hold_still(session);
                }
                let to = self.grip.and_then(|grip| grip.place);
                if !self.go_on(to, session, host) {
                    break;
                }
            }
            if let Some(grip) = self.grip.as_mut().filter(|_| n > 0) {
                grip.is_to_move = false;
            }
        } else if let Some(grip) = self.grip.as_mut().filter(|grip| grip.is_to_move) {
            grip.is_to_move = false;
            let to = grip.place;
            self.go_on(to, session, host);
        }
    }

    /// What is to be told now, to whom.
    pub fn take(&mut self, session: &mut Session) -> Vec<(ClientId, Message)> {
        self.note_journal(session, PAGE);
        self.tell_journal();
        let (pose_number, state_number) = (self.pose_number, self.state_number);
        let is_due = |viewer: &Viewer| viewer.is_due(pose_number, state_number);
        if self.viewers.values().any(is_due) {
            self.refresh(session);
            self.tell_news(session);
        }
        std::mem::take(&mut self.outbox)
    }
}

// Statements.
impl Live {
    fn execute(&mut self, text: &str, session: &mut Session, host: &mut dyn Host) -> Value {
        self.close(session, host);
        self.keep(session, host);
        let mut listener = Listener::new(host);
        listener.source = Some(session.sources().next_id());
        let Outcome { flow, failure } = self.transcript.enter(text, session, &mut listener);
        let Listener { said, wrote, .. } = listener;
        host.forget_stop();
        self.note_change();
        let mut answer = json!({ "ok": failure.is_none(), "said": said, "wrote": wrote });
        match flow {
            Flow::On => {}
            Flow::Quit => answer["quit"] = json!(true),
            Flow::Stopped => answer["stopped"] = json!(true),
        }
        answer
    }

    fn attempt(&mut self, text: &str, session: &mut Session, host: &mut dyn Host) -> Value {
        self.close(session, host);
        if let Some(attempt) = self.attempt.take() {
            session.take_back(attempt);
        }
        let mut listener = Listener::new(host);
        let source = Some(session.sources().next_id());
        listener.source = source;
        let result = session.attempt(PAGE, text, &mut listener);
        let mut said = listener.said;
        let ok = result.is_ok();
        match result {
            Ok(attempt) => self.attempt = Some(attempt),
            Err(problem) => said.push(told(&problem, session.sources(), source)),
        }
        if self.pace.is_some() {
            // Time goes on: it cannot be taken back any more.
            self.keep(session, host);
        }
        self.note_change();
        json!({ "ok": ok, "said": said, "wrote": [] })
    }

    /// What was tried stays.
    fn keep(&mut self, session: &mut Session, host: &mut dyn Host) {
        if let Some(attempt) = self.attempt.take() {
            session.keep_attempt(&attempt, host);
            self.note_change();
        }
    }
}

// What goes on.
impl Live {
    fn grab(
        &mut self,
        client: ClientId,
        point: PointId,
        session: &mut Session,
        host: &mut dyn Host,
    ) -> Value {
        let refused =
            |why: &str| json!({ "ok": false, "said": [{ "kind": "error", "text": why }] });
        if self.grip.is_some() {
            return refused("a point is held already");
        }
        self.close(session, host);
        self.keep(session, host);
        match session.take_hold(point, self.pace.is_some()) {
            Ok(_) => {
                self.grip = Some(Grip {
                    client,
                    point,
                    place: None,
                    is_to_move: false,
                });
                self.note_change();
                json!({ "ok": true, "said": [] })
            }
            Err(problem) => refused(&problem.message),
        }
    }

    fn hold_still(&mut self, session: &Session) {
        if let Some(grip) = &mut self.grip
            && session.world().points().is_alive(grip.point)
        {
            grip.place = Some(session.world().points().at(grip.point));
        }
    }

    /// One step of what goes on; whether another may follow.
    fn go_on(&mut self, to: Option<Point>, session: &mut Session, host: &mut dyn Host) -> bool {
        if self.ongoing.as_ref().is_some_and(|it| it.point().is_some() && it.len() >= MOST_PLACES) {
            self.close(session, host);
        }
        if self.ongoing.is_none() {
            self.ongoing = match self.grip {
                None => Some(Ongoing::time()),
                Some(grip) => session.take_hold(grip.point, self.pace.is_some()).ok(),
            };
        }
        let Some(ongoing) = &mut self.ongoing else {
            // It was deleted meanwhile.
            self.grip = None;
            return false;
        };
        let mut listener = Listener::new(host);
        let result = session.go_on(ongoing, to, &mut listener);
        let mut said = listener.said;
        self.pose_number += 1;
        let goes_on = matches!(result, Ok(Flow::On));
        if let Err(problem) = result {
            said.push(told(&problem, session.sources(), None));
        }
        self.say_to_all(said);
        if !goes_on {
            host.forget_stop();
            self.pace = None;
            self.close(session, host);
        }
        goes_on
    }

    /// Writes what goes on as a statement; gives it.
    fn close(&mut self, session: &mut Session, host: &mut dyn Host) -> Option<String> {
        let ongoing = self.ongoing.take()?;
        let mut listener = Listener::new(host);
        let result = session.end_ongoing(ongoing, PAGE, &mut listener);
        let mut said = listener.said;
        let statement = result.unwrap_or_else(|problem| {
            said.push(told(&problem, session.sources(), None));
            None
        });
        // A receipt is part of the state.
        said.retain(|what| what["kind"] != "note" || statement.is_none());
        self.say_to_all(said);
        self.note_change();
        statement
    }

    /// Lets go of what is held.
    fn let_go(&mut self, session: &mut Session, host: &mut dyn Host) -> Value {
        if self.pace.is_none()
            && let Some(grip) = self.grip.as_mut().filter(|grip| grip.is_to_move)
        {
            grip.is_to_move = false;
            let to = grip.place;
            self.go_on(to, session, host);
        }
        let statement = self.close(session, host);
        self.grip = None;
        self.note_change();
        json!({ "ok": true, "said": [], "statement": statement })
    }

    fn pause(&mut self, session: &mut Session, host: &mut dyn Host) {
        if self.pace.take().is_some() {
            self.close(session, host);
            self.note_change();
        }
    }
}

// What pages are told.
impl Live {
    /// Something was done.
    fn note_change(&mut self) {
        self.pose_number += 1;
        self.state_number += 1;
        self.is_restated = true;
    }

    fn say(&mut self, client: ClientId, what: &Value) {
        self.outbox.push((client, Message::Text(what.to_string())));
    }

    fn say_to_all(&mut self, said: Vec<Value>) {
        if said.is_empty() {
            return;
        }
        let text = json!({ "said": said }).to_string();
        let here = self.viewers.iter().filter(|(_, viewer)| viewer.is_here);
        self.outbox.extend(here.map(|(&client, _)| (client, Message::Text(text.clone()))));
    }

    fn welcome(&mut self, client: ClientId) {
        let hello = json!({ "hello": {
            "protocol": PROTOCOL,
            "version": env!("CARGO_PKG_VERSION"),
            "engine": self.carrier,
            "client": client,
        } });
        self.say(client, &hello);
        if let Some(viewer) = self.viewers.get_mut(&client) {
            viewer.begin_anew();
        }
    }

    /// Takes what was carried out since into the journal; whether there was anything.
    fn note_journal(&mut self, session: &Session, by: &str) -> bool {
        let n = session.n_typed();
        for text in session.changes_since(self.n_typed) {
            self.journal.push_back(json!({ "number": self.n_journal, "text": text, "by": by }));
            self.n_journal += 1;
        }
        while self.journal.len() > RECENT {
            self.journal.pop_front();
        }
        std::mem::replace(&mut self.n_typed, n) != n
    }

    fn tell_journal(&mut self) {
        let first = self.n_journal - self.journal.len() as u64;
        for (&client, viewer) in &mut self.viewers {
            if !viewer.is_here || viewer.n_journal == self.n_journal {
                continue;
            }
            let from = viewer.n_journal.max(first) - first;
            let news: Vec<&Value> = self.journal.iter().skip(from as usize).collect();
            viewer.n_journal = self.n_journal;
            let text = json!({ "journal": news }).to_string();
            self.outbox.push((client, Message::Text(text)));
        }
    }

    /// Looks at the session, as far as it changed since.
    fn refresh(&mut self, session: &mut Session) {
        if self.state.0 != self.state_number {
            if std::mem::take(&mut self.is_restated) {
                self.structure = state::structure(session);
                // While something goes on there will be another state soon.
                if self.ongoing.is_none() && self.attempt.is_none() && self.pace.is_none() {
                    self.analysis = state::analysis(session);
                }
            }
            let held = self.grip.map(|grip| (grip.point, grip.client));
            let mut state = state::progress(session, held);
            state.insert("playing".to_owned(), json!(self.pace.is_some()));
            state.insert("speed".to_owned(), json!(self.pace.map(|pace| pace.speed)));
            state.extend(self.structure.clone());
            state.extend(self.analysis.clone());
            self.state = (self.state_number, state);
        }
        if self.pose.as_ref().is_none_or(|(number, _)| *number != self.pose_number) {
            self.pose = Some((self.pose_number, Pose::of(session)));
            let world = session.world();
            self.scene = Some(match &self.scene {
                Some(scene) => scene.next(world),
                None => Scene::new(world),
            });
        }
    }

    fn tell_news(&mut self, session: &Session) {
        let (Some((_, pose)), Some(scene)) = (&self.pose, &self.scene) else { return };
        let news = News {
            session,
            scene,
            pose,
            pose_number: self.pose_number,
            state: &self.state.1,
            state_number: self.state_number,
        };
        for (&client, viewer) in &mut self.viewers {
            if viewer.is_due(self.pose_number, self.state_number) {
                viewer.tell(&news, &mut |message| self.outbox.push((client, message)));
            }
        }
    }
}

/// What may stand at a place of a text, and what its pieces are.
fn complete(completion: &Completion, text: &str, at: usize) -> Value {
    let cursor = from_utf16(text, at);
    let before = &text[..cursor];
    let offer = completion.offer(before);
    let candidates = offer
        .candidates
        .iter()
        .map(|candidate| json!({ "text": candidate.text, "shown": candidate.shown }));
    let pieces = completion.pieces(text, cursor).into_iter().map(|piece| {
        json!({
            "from": to_utf16(text, piece.range.start),
            "to": to_utf16(text, piece.range.end),
            "class": format!("{:?}", piece.class).to_lowercase(),
            "unknown": piece.is_unknown,
        })
    });
    json!({
        "ok": true,
        "start": to_utf16(text, offer.start),
        "candidates": candidates.collect::<Vec<_>>(),
        "hint": if cursor == text.len() { completion.hint(before) } else { None },
        "pieces": pieces.collect::<Vec<_>>(),
        "incomplete": is_incomplete(text),
    })
}

/// Part of a px that nobody can point at.
const FINEST: f64 = 0.05;

/// A place with as many digits as can be pointed at where so many px are a world unit: its statement
/// is then one that can be read.
fn rounded(place: Point, scale: f64) -> Point {
    let mut factor = 1.0;
    while factor * FINEST < scale && factor < 1e12 {
        factor *= 10.0;
    }
    let round = |x: f64| {
        let whole = (x * factor).round();
        // Beyond that every digit is needed.
        if whole.abs() < 1e15 { whole / factor } else { x }
    };
    Point::new(round(place.x), round(place.y))
}

impl Live {
    /// A problem that came up outside of any page's wish, told to all.
    pub fn tell(&mut self, problem: &Diagnostic, session: &Session) {
        self.say_to_all(vec![told(problem, session.sources(), None)]);
    }
}
