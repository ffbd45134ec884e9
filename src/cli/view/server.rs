//! Listens on this machine for pages: lets in who knows the token, and gives up on who dawdles.

use std::io::{self, Read, Write};
use std::net::{Ipv4Addr, TcpListener, TcpStream};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, sync_channel};
use std::thread;
use std::time::{Duration, Instant};

use tungstenite::handshake::derive_accept_key;

use super::request::{Door, Verdict};
use super::shared::{Event, Shared};
use super::{client, page, token};

/// How long they may take to say it.
const PATIENCE: Duration = Duration::from_secs(10);
/// How long a page may take to read what it is told while there is no room for more.
const UNREAD: Duration = Duration::from_secs(30);
/// The longest head of a request, bytes.
const LONGEST_HEAD: usize = 8192;
/// Messages that may wait for the session; who sends more waits.
const MOST_EVENTS: usize = 256;

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
        let token = port.map_or_else(token::token, token::kept)?;
        let door = Door { port: listener.local_addr()?.port(), token };
        let (events, received) = sync_channel(MOST_EVENTS);
        let shared = Arc::new(Shared::new(door, events));
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
        self.shared.end();
        // Whoever waits for a connection gets one.
        drop(TcpStream::connect((Ipv4Addr::LOCALHOST, self.shared.door.port)));
    }
}

/// Takes connections, each to a thread of its own.
fn listen(listener: &TcpListener, shared: &Arc<Shared>) {
    for stream in listener.incoming() {
        if shared.is_over() {
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
