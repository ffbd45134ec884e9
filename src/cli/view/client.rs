//! One page's socket: a thread that reads what it says, and one that writes what it is told.

use std::io::{self, Read, Write};
use std::net::{Shutdown, TcpStream};
use std::sync::Arc;
use std::thread;

use tungstenite::protocol::frame::coding::CloseCode;
use tungstenite::protocol::{Role, WebSocketConfig};
use tungstenite::{Error, Message, WebSocket};

use super::outlet::Outlet;
use super::shared::{Event, Shared};
use crate::live::{ClientId, is_stop};

/// The longest message of a page, bytes.
const LONGEST: usize = 4096;

/// The side of a stream that is read. What a socket would write by itself while it reads is left to
/// who writes.
struct ReadSide(TcpStream);

impl Read for ReadSide {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        self.0.read(buffer)
    }
}

impl Write for ReadSide {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// Carries messages between a page and the session, until one of them leaves. `begun` is what of the
/// page's messages was read already.
///
/// # Errors
/// Where the stream is gone before it began.
pub fn carry(stream: &TcpStream, begun: Vec<u8>, shared: &Arc<Shared>) -> io::Result<()> {
    let outlet = Arc::new(Outlet::default());
    let config = WebSocketConfig::default()
        .max_message_size(Some(LONGEST))
        .max_frame_size(Some(LONGEST))
        .read_buffer_size(LONGEST);
    let side = ReadSide(stream.try_clone()?);
    let socket = WebSocket::from_partially_read(side, begun, Role::Server, Some(config));
    let writing = {
        let (stream, outlet) = (stream.try_clone()?, outlet.clone());
        thread::Builder::new().spawn(move || write(stream, &outlet))?
    };
    match shared.enter() {
        Some(client) => {
            if shared.send(Event::Joined(client, outlet.clone())) {
                read(socket, client, &outlet, shared);
                shared.send(Event::Left(client));
            }
            shared.leave();
        }
        None => outlet.close(CloseCode::Again, "as many pages are open as there may be"),
    }
    outlet.close(CloseCode::Normal, "");
    // Whoever is left to write has written what there was.
    drop(writing.join());
    Ok(())
}

/// Reads what a page says.
fn read(mut socket: WebSocket<ReadSide>, client: ClientId, outlet: &Outlet, shared: &Shared) {
    loop {
        match socket.read() {
            Ok(Message::Text(text)) => {
                if is_stop(&text) {
                    shared.stop();
                }
                if !shared.send(Event::Said(client, text.as_str().to_owned())) {
                    return;
                }
            }
            Ok(Message::Ping(data)) => outlet.put(Message::Pong(data)),
            Ok(Message::Binary(_)) => {
                return outlet.close(CloseCode::Unsupported, "messages are texts");
            }
            Ok(Message::Pong(_) | Message::Frame(_)) => {}
            Err(Error::Capacity(_)) => {
                return outlet.close(CloseCode::Size, "a message has 4096 bytes at most");
            }
            Err(Error::Utf8(_)) => return outlet.close(CloseCode::Invalid, "no text in UTF-8"),
            Ok(Message::Close(_)) | Err(_) => return,
        }
    }
}

/// Writes what a page is told, until there will be no more, or it cannot be written.
fn write(stream: TcpStream, outlet: &Outlet) {
    let Ok(reading) = stream.try_clone() else { return outlet.leave() };
    let mut socket = WebSocket::from_raw_socket(stream, Role::Server, None);
    loop {
        match outlet.take() {
            Ok(message) => {
                if socket.send(message).is_err() {
                    break;
                }
            }
            Err(end) => {
                drop(socket.close(Some(end)).and_then(|()| socket.flush()));
                break;
            }
        }
    }
    // Who reads from it, or waits for the rest, need not wait any longer.
    drop(reading.shutdown(Shutdown::Both));
    outlet.leave();
}
