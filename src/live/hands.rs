//! What goes on until it is told to end: a point that a page leads, and time that passes.

use serde_json::{Value, json};

use super::grip::Grip;
use super::listener::{Listener, refused, told};
use super::live_session::Live;
use super::message::{ClientId, PAGE};
use crate::constraint::Point;
use crate::session::{Flow, Host, Ongoing, Session};
use crate::world::PointId;

/// Places of a gesture that are written in one statement, minutes of it: its text is about a megabyte. One
/// that goes on is written in several.
const MOST_PLACES: u64 = 50_000;

impl Live {
    pub(super) fn grab(
        &mut self,
        client: ClientId,
        point: PointId,
        session: &mut Session,
        host: &mut dyn Host,
    ) -> Value {
        if self.grip.is_some() {
            return refused("a point is held already");
        }
        self.rest(session, host);
        match session.take_hold(point, self.pace.is_some()) {
            Ok(_) => {
                self.grip = Some(Grip::new(client, point, session));
                self.note_change();
                json!({ "ok": true, "said": [] })
            }
            Err(problem) => refused(&problem.message),
        }
    }

    /// What was carried out may have taken away what is held.
    pub(super) fn keep_hold(&mut self, session: &Session) {
        self.grip.take_if(|grip| !grip.holds(session));
    }

    pub(super) fn hold_still(&mut self, session: &Session) {
        if let Some(grip) = &mut self.grip
            && session.world().points().is_alive(grip.point)
        {
            grip.place = Some(session.world().points().at(grip.point));
        }
    }

    /// One step of what goes on; whether another may follow.
    pub(super) fn go_on(
        &mut self,
        to: Option<Point>,
        session: &mut Session,
        host: &mut dyn Host,
    ) -> bool {
        if self.ongoing.as_ref().is_some_and(|it| it.point().is_some() && it.len() >= MOST_PLACES) {
            self.close(session, host);
        }
        if self.ongoing.is_none() {
            // It begins with what was tried.
            self.keep(session, host);
            self.ongoing = match &self.grip {
                None => Some(Ongoing::time()),
                Some(grip) => session.take_hold(grip.point, self.pace.is_some()).ok(),
            };
        }
        let Some(ongoing) = &mut self.ongoing else {
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
        self.say_to_all(&said);
        if !goes_on {
            host.forget_stop();
            self.pace = None;
            self.close(session, host);
        }
        goes_on
    }

    /// Something else is to be done: what goes on is written, what was tried stays.
    pub(super) fn rest(&mut self, session: &mut Session, host: &mut dyn Host) {
        self.lead(session, host);
        self.close(session, host);
        self.keep(session, host);
    }

    /// Writes what goes on as a statement; gives it.
    pub(super) fn close(&mut self, session: &mut Session, host: &mut dyn Host) -> Option<String> {
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
        self.say_to_all(&said);
        self.note_change();
        statement
    }

    /// Lets go of what is held.
    pub(super) fn let_go(&mut self, session: &mut Session, host: &mut dyn Host) -> Value {
        self.lead(session, host);
        let statement = self.close(session, host);
        self.grip = None;
        self.note_change();
        json!({ "ok": true, "said": [], "statement": statement })
    }

    pub(super) fn pause(&mut self, session: &mut Session, host: &mut dyn Host) {
        if self.pace.take().is_some() {
            self.close(session, host);
            self.note_change();
        }
    }
}
