//! `view`: pages in a browser on this machine, at which a session is looked at and taken hold of.
//!
//! A session has one owner at a time: who types at the prompt, or, while the prompt waits for a line,
//! the thread that serves pages. Sockets have threads of their own, which hand on what they hear and
//! write what is put into their [`Outlet`]; nobody waits for them.

mod client;
mod host;
mod outlet;
mod page;
mod request;
mod server;
mod shared;
mod token;

use std::collections::BTreeMap;
use std::io;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, RecvTimeoutError};
use std::thread;
use std::time::{Duration, Instant};

use tungstenite::Message;
use tungstenite::protocol::frame::coding::CloseCode;

use crate::live::{self, ClientId, Live};
use crate::session::{Host, Session};
use host::PageHost;
use outlet::Outlet;
use server::Server;
use shared::Event;

/// The stack of the thread that serves pages: as large as that of the thread that types.
const STACK: usize = 8 << 20;
/// Events that are taken before what came of them is told.
const MOST_AT_ONCE: usize = 64;
/// How long a page may take to hear that the session has ended.
const FAREWELL: Duration = Duration::from_millis(500);

/// Pages that look at a session.
pub struct View {
    server: Server,
    address: String,
    events: Receiver<Event>,
    live: Live,
    outlets: BTreeMap<ClientId, Arc<Outlet>>,
    begun: Instant,
}

impl View {
    /// Lets pages in, at a port or at any that is free.
    ///
    /// # Errors
    /// Where the port is not to be had.
    pub fn open(port: Option<u16>) -> io::Result<Self> {
        let (server, events) = Server::begin(port)?;
        Ok(Self {
            address: server.address(),
            server,
            events,
            live: Live::new("socket"),
            outlets: BTreeMap::new(),
            begun: Instant::now(),
        })
    }

    /// Where the page is.
    pub fn address(&self) -> &str {
        &self.address
    }

    /// Waits for something while pages have the session.
    pub fn meanwhile<T>(
        &mut self,
        session: &mut Session,
        process: &mut (dyn Host + Send),
        told: &mut (dyn FnMut(&str) + Send),
        wait: impl FnOnce() -> T,
    ) -> T {
        let shared = self.server.shared();
        thread::scope(|scope| {
            let serve = || self.serve(session, process, told);
            let serving = thread::Builder::new().stack_size(STACK).spawn_scoped(scope, serve);
            let result = wait();
            if serving.is_ok() {
                shared.send(Event::Over);
            }
            result
        })
    }

    /// Serves pages until somebody else wants the session; `told` is told the statements of pages.
    fn serve(
        &mut self,
        session: &mut Session,
        process: &mut (dyn Host + Send),
        told: &mut dyn FnMut(&str),
    ) {
        self.live.take_back_over(session);
        let address = self.address.clone();
        let mut host = PageHost { process, shared: self.server.shared(), address: &address };
        let mut is_over = false;
        let mut n_typed = session.n_typed();
        while !is_over {
            self.tell(session);
            session.changes_since(n_typed).for_each(&mut *told);
            n_typed = session.n_typed();
            is_over = self.hear(session, &mut host);
            let now = self.begun.elapsed().as_secs_f64();
            let shared = host.shared.clone();
            shared.working(|| self.live.work(now, session, &mut host));
        }
        self.live.hand_over(session, &mut host);
        self.tell(session);
    }

    /// Takes what came from outside, and waits for it if there is nothing else to do; true when the
    /// session is wanted.
    fn hear(&mut self, session: &mut Session, host: &mut PageHost) -> bool {
        let first = if self.live.is_busy() {
            // Frames come at even times, so that a display shows all of them.
            let now = self.begun.elapsed().as_secs_f64();
            self.events.recv_timeout(Duration::from_secs_f64(self.live.until_due(now, session)))
        } else {
            self.events.recv().map_err(|_| RecvTimeoutError::Disconnected)
        };
        let mut event = match first {
            Ok(event) => event,
            Err(RecvTimeoutError::Timeout) => return false,
            Err(RecvTimeoutError::Disconnected) => return true,
        };
        for _ in 0..MOST_AT_ONCE {
            if self.take_in(event, session, host) {
                return true;
            }
            event = match self.events.try_recv() {
                Ok(event) => event,
                Err(_) => return false,
            };
        }
        self.take_in(event, session, host)
    }

    /// Takes in one event; true if the session is wanted.
    fn take_in(&mut self, event: Event, session: &mut Session, host: &mut PageHost) -> bool {
        match event {
            Event::Joined(client, outlet) => {
                self.outlets.insert(client, outlet);
                self.live.join(client);
            }
            Event::Said(client, message) => {
                let shared = host.shared.clone();
                shared.working(|| self.live.receive(client, &message, session, host));
            }
            Event::Left(client) => {
                self.outlets.remove(&client);
                self.live.leave(client, session, host);
            }
            Event::Over => return true,
        }
        false
    }

    /// Puts what pages are to be told where they find it.
    fn tell(&mut self, session: &mut Session) {
        for (client, message) in self.live.take(session) {
            if let Some(outlet) = self.outlets.get(&client) {
                outlet.put(match message {
                    live::Message::Text(text) => Message::text(text),
                    live::Message::Frame(frame) => Message::binary(frame),
                });
            }
        }
    }
}

impl Drop for View {
    fn drop(&mut self) {
        for outlet in self.outlets.values() {
            outlet.close(CloseCode::Away, "the session has ended");
        }
        let end = Instant::now() + FAREWELL;
        for outlet in self.outlets.values() {
            outlet.wait_until_left(end.saturating_duration_since(Instant::now()));
        }
    }
}
