//! Listens on this machine for pages: lets in who knows the token, and gives up on who dawdles.

use std::collections::VecDeque;
use std::io::{self, Read, Write};
use std::net::{Ipv4Addr, Shutdown, TcpListener, TcpStream};
use std::sync::atomic::{AtomicBool, AtomicU32, AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use tungstenite::handshake::derive_accept_key;

use super::outlet::Outlet;
use super::request::{Door, Verdict};
use super::{client, page, token};
use crate::live::ClientId;

/// Sockets that there may be.
const MOST_SOCKETS: usize = 64;
/// Connections that have not said what they want; of more the oldest is closed.
const MOST_UNFINISHED: usize = 64;
/// How long they may take to say it.
const PATIENCE: Duration = Duration::from_secs(10);
/// How long a page may take to read what it is told while there is no room for more.
const UNREAD: Duration = Duration::from_secs(30);
/// The longest head of a request, bytes.
const LONGEST_HEAD: usize = 8192;
/// Messages that may wait for the session; who sends more waits.
const MOST_EVENTS: usize = 256;

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
    door: Door,
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

/// A server that listens, until it is dropped.
#[derive(Debug)]
pub struct Server {
    shared: Arc<Shared>,
}

impl Server {
    /// Listens at a port, or at any that is free; gives what comes from outside too.
    ///
    /// # Errors
    /// Where the port is taken, or not to be had.
    pub fn begin(port: Option<u16>) -> io::Result<(Self, Receiver<Event>)> {
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, port.unwrap_or(0)))?;
        let door = Door { port: listener.local_addr()?.port(), token: token::token()? };
        let (events, received) = sync_channel(MOST_EVENTS);
        let shared = Arc::new(Shared {
            door,
            events,
            unfinished: Mutex::default(),
            n_connections: AtomicUsize::new(0),
            n_sockets: AtomicUsize::new(0),
            n_clients: AtomicU32::new(0),
            is_over: AtomicBool::new(false),
            is_working: AtomicBool::new(false),
            is_stopped: AtomicBool::new(false),
        });
        let ours = shared.clone();
        thread::Builder::new().spawn(move || listen(&listener, &ours))?;
        Ok((Self { shared }, received))
    }

    /// Where the page is.
    pub fn address(&self) -> String {
        let Door { port, token } = &self.shared.door;
        format!("http://127.0.0.1:{port}/{token}/")
    }

    /// What connections know of it.
    pub fn shared(&self) -> Arc<Shared> {
        self.shared.clone()
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        self.shared.is_over.store(true, Ordering::Relaxed);
        // Whoever waits for a connection gets one.
        drop(TcpStream::connect((Ipv4Addr::LOCALHOST, self.shared.door.port)));
    }
}

impl Shared {
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
    fn note_unfinished(&self, stream: &TcpStream) -> io::Result<u64> {
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

    fn forget_unfinished(&self, number: u64) {
        let mut unfinished = self.unfinished.lock().unwrap_or_else(PoisonError::into_inner);
        unfinished.retain(|(other, _)| *other != number);
    }
}

/// Takes connections, each to a thread of its own.
fn listen(listener: &TcpListener, shared: &Arc<Shared>) {
    for stream in listener.incoming() {
        if shared.is_over.load(Ordering::Relaxed) {
            return;
        }
        let Ok(stream) = stream else {
            // Too many files are open: some will be closed.
            thread::sleep(Duration::from_millis(10));
            continue;
        };
        let Ok(number) = shared.note_unfinished(&stream) else { continue };
        let ours = shared.clone();
        let work = move || {
            // Who hangs up has had what they wanted.
            drop(receive(&stream, number, &ours));
            ours.forget_unfinished(number);
        };
        if thread::Builder::new().spawn(work).is_err() {
            shared.forget_unfinished(number);
        }
    }
}

/// Hears what a connection wants and gives it that.
fn receive(mut stream: &TcpStream, number: u64, shared: &Arc<Shared>) -> io::Result<()> {
    stream.set_nodelay(true)?;
    stream.set_write_timeout(Some(UNREAD))?;
    let (head, rest) = read_head(stream)?;
    match shared.door.judge(&head) {
        Verdict::Page => stream.write_all(&page::answer()),
        Verdict::Refused(status, reason) => stream.write_all(&page::refusal(status, reason)),
        Verdict::Socket(key) => {
            let accept = derive_accept_key(key.as_bytes());
            let head = format!(
                "HTTP/1.1 101 Switching Protocols\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n\
                 Sec-WebSocket-Accept: {accept}\r\n\r\n"
            );
            stream.write_all(head.as_bytes())?;
            stream.set_read_timeout(None)?;
            shared.forget_unfinished(number);
            client::carry(stream, rest, shared)
        }
    }
}

/// The head of a request, and what of the rest came along with it.
fn read_head(mut stream: &TcpStream) -> io::Result<(Vec<u8>, Vec<u8>)> {
    let end = Instant::now() + PATIENCE;
    let mut head = Vec::new();
    let mut buffer = [0; 1024];
    loop {
        let left = end.saturating_duration_since(Instant::now());
        if left.is_zero() || head.len() > LONGEST_HEAD {
            return Err(io::ErrorKind::TimedOut.into());
        }
        stream.set_read_timeout(Some(left))?;
        let n = stream.read(&mut buffer)?;
        if n == 0 {
            return Err(io::ErrorKind::UnexpectedEof.into());
        }
        // The end may have begun in the piece before.
        let from = head.len().saturating_sub(3);
        head.extend_from_slice(&buffer[..n]);
        if let Some(at) = head[from..].windows(4).position(|four| four == b"\r\n\r\n") {
            let rest = head.split_off(from + at + 4);
            return Ok((head, rest));
        }
    }
}
