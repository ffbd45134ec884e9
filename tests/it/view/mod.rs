//! `linkwork view` over real sockets, and what lies behind it without any.

mod browser;
mod following;
mod gestures;
mod hostile;
mod replayed;
mod sessions;
