//! Statements that pages send: carried out, or tried.

use serde_json::{Value, json};

use super::listener::{Listener, told};
use super::live_session::Live;
use super::message::PAGE;
use crate::session::{Flow, Host, Outcome, Session};

impl Live {
    pub(super) fn execute(
        &mut self,
        text: &str,
        session: &mut Session,
        host: &mut dyn Host,
    ) -> Value {
        self.rest(session, host);
        let mut listener = Listener::new(host);
        listener.source = Some(session.sources().next_id());
        let Outcome { flow, failure } = self.transcript.enter(text, session, &mut listener);
        let Listener { said, wrote, .. } = listener;
        host.forget_stop();
        self.keep_hold(session);
        self.note_change();
        let mut answer = json!({ "ok": failure.is_none(), "said": said, "wrote": wrote });
        match flow {
            Flow::On => {}
            Flow::Quit => answer["quit"] = json!(true),
            Flow::Stopped => answer["stopped"] = json!(true),
        }
        answer
    }

    pub(super) fn attempt(
        &mut self,
        text: &str,
        session: &mut Session,
        host: &mut dyn Host,
    ) -> Value {
        self.lead(session, host);
        self.close(session, host);
        if let Some(attempt) = self.attempt.take() {
            session.take_back(&attempt);
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
    pub(super) fn keep(&mut self, session: &mut Session, host: &mut dyn Host) {
        if let Some(attempt) = self.attempt.take() {
            session.keep_attempt(&attempt, host);
            self.note_change();
        }
    }
}
