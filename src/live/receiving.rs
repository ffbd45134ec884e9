//! What pages say, and what is done then: messages are taken, points led, time passes.

use serde_json::{Value, json};

use super::completing::complete;
use super::files;
use super::grip::rounded;
use super::listener::refused;
use super::live_session::Live;
use super::message::{ClientId, PAGE};
use super::pace::Pace;
use super::request::{Request, Wish};
use super::viewer::Viewer;
use crate::session::{EXAMPLES, Host, Quota, Session};

/// Whether a message wants what is under way to stop: a carrier hears that while the session works.
pub fn is_stop(message: &str) -> bool {
    message.len() < 100 && Request::parse(message).is_ok_and(|it| it.wish == Wish::Stop)
}

impl Live {
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
                let pieces = &mut self.viewers.get_mut(&client)?.pieces;
                pieces.add(&text, session.quota(Quota::SourceBytes));
                if is_more_to_come {
                    return None;
                }
                return Some(match pieces.take() {
                    Some(text) => self.execute(&text, session, host),
                    None => refused(&format!(
                        "the text is longer than the limit `{}`",
                        Quota::SourceBytes.word()
                    )),
                });
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
                if self.grip.as_ref().is_none_or(|grip| grip.client != client) {
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
                    Err(why) => refused(&why),
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
            if self.grip.as_ref().is_some_and(|grip| grip.place.is_none()) {
                // Held and not led: it stays where it is.
                self.hold_still(session);
            }
            let to = self.grip.as_ref().and_then(|grip| grip.place);
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
}
