//! What a page is to be told and was not yet: the session puts it in, a thread of the page takes it
//! out. The session never waits.

use std::collections::VecDeque;
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use tungstenite::Message;
use tungstenite::protocol::CloseFrame;
use tungstenite::protocol::frame::coding::CloseCode;

/// Bytes that may wait for a page; one that leaves more unread has its socket closed. A message
/// that is longer waits alone.
const MOST_BYTES: usize = 16 << 20;

/// Messages for one page.
#[derive(Debug, Default)]
pub struct Outlet {
    queue: Mutex<Queue>,
    has_changed: Condvar,
}

#[derive(Debug, Default)]
struct Queue {
    messages: VecDeque<Message>,
    n_bytes: usize,
    /// Why no more will come, once that is so.
    end: Option<CloseFrame>,
    /// Whether nobody takes anything out any more.
    is_left: bool,
}

impl Outlet {
    fn queue(&self) -> MutexGuard<'_, Queue> {
        self.queue.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Puts a message in.
    pub fn put(&self, message: Message) {
        let mut queue = self.queue();
        if queue.end.is_some() || queue.is_left {
            return;
        }
        if !queue.messages.is_empty() && queue.n_bytes + message.len() > MOST_BYTES {
            queue.messages.clear();
            queue.n_bytes = 0;
            queue.end = Some(frame(CloseCode::Policy, "too much was left unread"));
        } else {
            queue.n_bytes += message.len();
            queue.messages.push_back(message);
        }
        self.has_changed.notify_all();
    }

    /// Says that no more will come.
    pub fn close(&self, code: CloseCode, reason: &'static str) {
        self.queue().end.get_or_insert(frame(code, reason));
        self.has_changed.notify_all();
    }

    /// The next message; the reason why there is none, once that is so.
    pub fn take(&self) -> Result<Message, CloseFrame> {
        let mut queue = self.queue();
        loop {
            if let Some(message) = queue.messages.pop_front() {
                queue.n_bytes -= message.len();
                return Ok(message);
            }
            if let Some(end) = &queue.end {
                return Err(end.clone());
            }
            queue = self.has_changed.wait(queue).unwrap_or_else(PoisonError::into_inner);
        }
    }

    /// Nobody takes anything out any more.
    pub fn leave(&self) {
        let mut queue = self.queue();
        queue.is_left = true;
        queue.messages.clear();
        drop(queue);
        self.has_changed.notify_all();
    }

    /// Waits until all was taken out, or for so long.
    pub fn wait_until_left(&self, most: Duration) {
        let queue = self.queue();
        drop(self.has_changed.wait_timeout_while(queue, most, |queue| !queue.is_left));
    }
}

fn frame(code: CloseCode, reason: &'static str) -> CloseFrame {
    CloseFrame { code, reason: reason.into() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn who_reads_nothing_is_closed_and_keeps_no_memory() {
        let outlet = Outlet::default();
        let message = || Message::text("x".repeat(1 << 20));
        (0..1000).for_each(|_| outlet.put(message()));
        assert!(outlet.queue().n_bytes <= MOST_BYTES);
        let end = loop {
            if let Err(end) = outlet.take() {
                break end;
            }
        };
        assert_eq!(end.code, CloseCode::Policy);
        outlet.put(message());
        assert!(outlet.take().is_err());
    }

    #[test]
    fn one_long_message_goes_through() {
        let outlet = Outlet::default();
        outlet.put(Message::text("x".repeat(MOST_BYTES + 1)));
        assert_eq!(outlet.take().map(|message| message.len()), Ok(MOST_BYTES + 1));
    }
}
