//! A session that pages look at and take hold of.
//!
//! A page sends messages, texts of JSON, and gets messages, texts and frames; `docs/protocol.md` says
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

mod anchor;
mod drawn;
mod files;
mod hands;
mod listener;
mod pace;
mod pose;
mod request;
mod state;
mod statements;
mod telling;
mod units;
mod viewer;

use std::collections::{BTreeMap, VecDeque};

use serde_json::{Map, Value, json};

use crate::render::Scene;
use crate::session::{Attempt, Completion, EXAMPLES, Host, Ongoing, Session, Transcript};
use hands::{Grip, rounded};
use pace::Pace;
use pose::Pose;
use request::{Request, Wish};
use statements::complete;
use viewer::Viewer;

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

/// Whether a message wants what is under way to stop: a carrier hears that while the session works.
pub fn is_stop(message: &str) -> bool {
    message.len() < 100 && Request::parse(message).is_ok_and(|it| it.wish == Wish::Stop)
}

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
    /// Seconds of the mechanism a second, as it was wished last.
    speed: f64,
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

impl Live {
    /// Nobody looks on yet. `carrier` tells pages what carries messages.
    pub fn new(carrier: &'static str) -> Self {
        Self {
            carrier,
            viewers: BTreeMap::new(),
            transcript: Transcript::conversation(PAGE),
            completion: Completion::default(),
            ongoing: None,
            grip: None,
            pace: None,
            speed: 1.0,
            attempt: None,
            journal: VecDeque::new(),
            n_journal: 0,
            n_typed: 0,
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

    /// Whether there is something to be done without another message: time passes.
    pub const fn is_busy(&self) -> bool {
        self.pace.is_some()
    }

    /// The session is to be asked by others: what goes on is written, what was tried stays.
    pub fn hand_over(&mut self, session: &mut Session, host: &mut dyn Host) {
        self.rest(session, host);
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
        // What an answer speaks of stands in the journal by then.
        self.note_journal(session, PAGE);
        self.tell_journal();
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
                    session.take_back(&attempt);
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
                    self.rest(session, host);
                }
                self.pace = Some(Pace::new(speed));
                self.speed = speed;
                self.note_change();
            }
            Wish::Pause => self.pause(session, host),
            Wish::Complete { text, at } => {
                self.completion.refresh(session);
                return Some(complete(&self.completion, &text, at));
            }
            Wish::File(wish) => {
                self.lead(session, host);
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
        let Some(n) = self.pace.as_mut().map(|pace| pace.due(now, dt)) else {
            return self.lead(session, host);
        };
        for _ in 0..n {
            if self.grip.is_some_and(|grip| grip.place.is_none()) {
                // Held and not led: it stays where it is.
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
    }

    /// Leads a point on, where time stands still.
    pub fn lead(&mut self, session: &mut Session, host: &mut dyn Host) {
        if self.pace.is_none()
            && let Some(grip) = self.grip.as_mut().filter(|grip| grip.is_to_move)
        {
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
