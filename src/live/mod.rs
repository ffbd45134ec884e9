//! A session that pages look at and take hold of.
//!
//! A page sends messages, texts of JSON, and gets messages, texts and frames; `docs/protocol.md` says
//! which. What carries them, a socket or a worker with the library in it, is the same to a [`Live`]:
//! it knows neither clocks nor files nor threads, and is lent the session with each message.
//!
//! All that changes the world is a statement, and stands in the journal: a point that is led by the
//! mouse is led at once, and when it is let go that is written as one `pull` or `drag` that gives the
//! same bits; time that passed is written as `step`.
//!
//! Messages are taken with [`receive`](Live::receive); points are led and time passes in
//! [`work`](Live::work), so that of many moves that wait only the last counts; what is to be told is
//! gathered by [`take`](Live::take).

mod anchor;
mod completing;
mod drawn;
mod files;
mod grip;
mod hands;
mod journal;
mod listener;
mod live_session;
mod message;
mod pace;
mod pieces;
mod pose;
mod receiving;
mod request;
mod state;
mod statements;
mod telling;
mod units;
mod viewer;

pub use live_session::Live;
pub use message::{ClientId, Message, PROTOCOL};
pub use receiving::is_stop;
