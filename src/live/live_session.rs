//! What pages and a session have with one another, and who of them is there.

use std::collections::BTreeMap;

use serde_json::{Map, Value};

use super::grip::Grip;
use super::journal::Journal;
use super::message::{ClientId, Message, PAGE};
use super::pace::Pace;
use super::pose::Pose;
use super::viewer::Viewer;
use crate::render::Scene;
use crate::session::{Attempt, Completion, Host, Ongoing, Session, Transcript};

/// What pages and a session have with one another.
pub struct Live {
    pub(super) carrier: &'static str,
    pub(super) viewers: BTreeMap<ClientId, Viewer>,
    pub(super) transcript: Transcript,
    pub(super) completion: Completion,
    /// What goes on: a point that is led, or time that passes.
    pub(super) ongoing: Option<Ongoing>,
    pub(super) grip: Option<Grip>,
    pub(super) pace: Option<Pace>,
    /// Seconds of the mechanism a second, as it was wished last.
    pub(super) speed: f64,
    pub(super) attempt: Option<Attempt>,
    pub(super) journal: Journal,
    /// How many of the session's statements are in the journal.
    pub(super) n_typed: usize,
    pub(super) scene: Option<Scene>,
    /// Count what pages may be told of.
    pub(super) pose_number: u64,
    pub(super) state_number: u64,
    /// What pages were told of the state, and of which state that was.
    pub(super) state: (u64, Map<String, Value>),
    /// The parts of it that are the same while time passes.
    pub(super) is_restated: bool,
    pub(super) structure: Map<String, Value>,
    pub(super) analysis: Map<String, Value>,
    pub(super) pose: Option<(u64, Pose)>,
    pub(super) outbox: Vec<(ClientId, Message)>,
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
            journal: Journal::default(),
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
        if self.grip.as_ref().is_some_and(|grip| grip.client == client) {
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

    /// How long there is nothing to be done while time passes, seconds; `now` is what a clock on the wall
    /// shows.
    pub fn until_due(&self, now: f64, session: &Session) -> f64 {
        self.pace.as_ref().map_or(0.0, |pace| pace.until_due(now, session.world().clock().dt))
    }

    /// The session is to be asked by others: what goes on is written, what was tried stays.
    pub fn hand_over(&mut self, session: &mut Session, host: &mut dyn Host) {
        self.rest(session, host);
    }

    /// Others may have changed the session.
    pub fn take_back_over(&mut self, session: &Session) {
        self.keep_hold(session);
        if self.note_journal(session, "prompt") {
            self.note_change();
        }
    }
}
