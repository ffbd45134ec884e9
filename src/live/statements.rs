//! Statements that pages send: carried out, tried, completed.

use serde_json::{Value, json};

use super::listener::{Listener, told};
use super::units::{from_utf16, to_utf16};
use super::{Live, PAGE};
use crate::lang::is_incomplete;
use crate::session::{Completion, Flow, Host, Outcome, Session};

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

/// What may stand at a place of a text, and what its pieces are.
pub(super) fn complete(completion: &Completion, text: &str, at: usize) -> Value {
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
