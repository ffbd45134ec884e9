//! What pages are told, and when.

use serde_json::{Value, json};

use super::live_session::Live;
use super::message::{ClientId, Message, PAGE, PROTOCOL};
use super::pose::Pose;
use super::state;
use super::viewer::{News, Viewer};
use crate::render::Scene;
use crate::session::Session;

impl Live {
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

    /// Something was done.
    pub(super) fn note_change(&mut self) {
        self.pose_number += 1;
        self.state_number += 1;
        self.is_restated = true;
    }

    pub(super) fn say(&mut self, client: ClientId, what: &Value) {
        self.outbox.push((client, Message::Text(what.to_string())));
    }

    pub(super) fn say_to_all(&mut self, said: &[Value]) {
        if said.is_empty() {
            return;
        }
        let text = json!({ "said": said }).to_string();
        let here = self.viewers.iter().filter(|(_, viewer)| viewer.is_here);
        self.outbox.extend(here.map(|(&client, _)| (client, Message::Text(text.clone()))));
    }

    pub(super) fn welcome(&mut self, client: ClientId) {
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
    pub(super) fn note_journal(&mut self, session: &Session, by: &str) -> bool {
        let n = session.n_typed();
        for text in session.changes_since(self.n_typed) {
            self.journal.write(text, by);
        }
        std::mem::replace(&mut self.n_typed, n) != n
    }

    pub(super) fn tell_journal(&mut self) {
        for (&client, viewer) in &mut self.viewers {
            if viewer.is_here && viewer.n_journal != self.journal.n() {
                let text = self.journal.message_since(viewer.n_journal);
                viewer.n_journal = self.journal.n();
                self.outbox.push((client, Message::Text(text)));
            }
        }
    }

    /// Looks at the session, as far as it changed since.
    pub(super) fn refresh(&mut self, session: &mut Session) {
        if self.state.0 != self.state_number {
            if std::mem::take(&mut self.is_restated) {
                self.structure = state::structure(session);
                // While something goes on there will be another state soon.
                if self.ongoing.is_none() && self.attempt.is_none() && self.pace.is_none() {
                    self.analysis = state::analysis(session);
                }
            }
            let held = self.grip.as_ref().map(|grip| (grip.point, grip.client));
            let mut state = state::progress(session, held);
            state.insert("playing".to_owned(), json!(self.pace.is_some()));
            state.insert("speed".to_owned(), json!(self.speed));
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

    pub(super) fn tell_news(&mut self, session: &Session) {
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
