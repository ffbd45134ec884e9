//! What all connections share: who may come, how many there are, where what they say goes.

use std::collections::VecDeque;
use std::io;
use std::net::{Shutdown, TcpStream};
use std::sync::atomic::{AtomicBool, AtomicU32, AtomicUsize, Ordering};
use std::sync::mpsc::SyncSender;
use std::sync::{Arc, Mutex, PoisonError};

use super::outlet::Outlet;
use super::request::Door;
use crate::live::ClientId;

/// Sockets that there may be.
const MOST_SOCKETS: usize = 64;
/// Connections that have not said what they want; of more the oldest is closed.
const MOST_UNFINISHED: usize = 64;

/// What comes from outside.
#[derive(Debug)]
pub enum Event {
    /// A page is there, and is told so.
    Joined(ClientId, Arc<Outlet>),
    /// It says something.
    Said(ClientId, String),
    /// It is gone.
    Left(ClientId),
    /// Somebody else wants the session.
    Over,
}

/// What all connections share.
#[derive(Debug)]
pub struct Shared {
    pub door: Door,
    events: SyncSender<Event>,
    /// Connections that have not said what they want, the oldest first.
    unfinished: Mutex<VecDeque<(u64, TcpStream)>>,
    n_connections: AtomicUsize,
    n_sockets: AtomicUsize,
    n_clients: AtomicU32,
    is_over: AtomicBool,
    /// Whether a statement of a page is under way, and is to be stopped.
    is_working: AtomicBool,
    is_stopped: AtomicBool,
}

impl Shared {
    /// Nobody is there yet.
    pub const fn new(door: Door, events: SyncSender<Event>) -> Self {
        Self {
            door,
            events,
            unfinished: Mutex::new(VecDeque::new()),
            n_connections: AtomicUsize::new(0),
            n_sockets: AtomicUsize::new(0),
            n_clients: AtomicU32::new(0),
            is_over: AtomicBool::new(false),
            is_working: AtomicBool::new(false),
            is_stopped: AtomicBool::new(false),
        }
    }

    /// No more connections are to be taken.
    pub fn end(&self) {
        self.is_over.store(true, Ordering::Relaxed);
    }

    /// Whether that is so.
    pub fn is_over(&self) -> bool {
        self.is_over.load(Ordering::Relaxed)
    }

    /// Hands on an event; false where nobody wants any.
    pub fn send(&self, event: Event) -> bool {
        self.events.send(event).is_ok()
    }

    /// The number of a page that comes, if there may be one more.
    pub fn enter(&self) -> Option<ClientId> {
        if self.n_sockets.fetch_add(1, Ordering::Relaxed) < MOST_SOCKETS {
            Some(self.n_clients.fetch_add(1, Ordering::Relaxed))
        } else {
            self.leave();
            None
        }
    }

    /// A page is gone.
    pub fn leave(&self) {
        self.n_sockets.fetch_sub(1, Ordering::Relaxed);
    }

    /// Does something for pages, which they may stop.
    pub fn working<T>(&self, work: impl FnOnce() -> T) -> T {
        self.is_stopped.store(false, Ordering::Relaxed);
        self.is_working.store(true, Ordering::Relaxed);
        let result = work();
        self.is_working.store(false, Ordering::Relaxed);
        result
    }

    /// A page wants what is under way to stop.
    pub fn stop(&self) {
        if self.is_working.load(Ordering::Relaxed) {
            self.is_stopped.store(true, Ordering::Relaxed);
        }
    }

    /// Whether what is under way is to stop.
    pub fn is_stopped(&self) -> bool {
        self.is_stopped.load(Ordering::Relaxed)
    }

    /// It has stopped.
    pub fn forget_stop(&self) {
        self.is_stopped.store(false, Ordering::Relaxed);
    }

    /// Keeps a connection among those that have not said what they want; gives its number.
    pub fn note_unfinished(&self, stream: &TcpStream) -> io::Result<u64> {
        let number = self.n_connections.fetch_add(1, Ordering::Relaxed) as u64;
        let mut unfinished = self.unfinished.lock().unwrap_or_else(PoisonError::into_inner);
        unfinished.push_back((number, stream.try_clone()?));
        while unfinished.len() > MOST_UNFINISHED {
            if let Some((_, oldest)) = unfinished.pop_front() {
                drop(oldest.shutdown(Shutdown::Both));
            }
        }
        Ok(number)
    }

    /// It has said what it wants.
    pub fn forget_unfinished(&self, number: u64) {
        let mut unfinished = self.unfinished.lock().unwrap_or_else(PoisonError::into_inner);
        unfinished.retain(|(other, _)| *other != number);
    }
}
