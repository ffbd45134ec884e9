//! What pages are told, and what they are called.

/// The version of the protocol.
pub const PROTOCOL: u32 = 1;

/// A page, by a number of its own.
pub type ClientId = u32;

/// What a page is told.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Message {
    /// A JSON object.
    Text(String),
    /// A frame.
    Frame(Vec<u8>),
}

/// What texts are called in messages that were sent by a page.
pub(super) const PAGE: &str = "page";
