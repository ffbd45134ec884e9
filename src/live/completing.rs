//! What may stand at a place of a text that is being typed, as a page is told.

use serde_json::{Value, json};

use super::units::{from_utf16, to_utf16};
use crate::lang::is_incomplete;
use crate::session::Completion;

/// What may stand at a place of a text, and what its pieces are.
pub(super) fn complete(completion: &Completion, text: &str, at: usize) -> Value {
    let cursor = from_utf16(text, at);
    let before = &text[..cursor];
    let offer = completion.offer(before);
    let candidates = offer
        .candidates
        .iter()
        .map(|candidate| json!({ "text": candidate.text, "shown": candidate.shown }));
    let pieces = completion.pieces(text, cursor).into_iter().map(|piece| {
        json!({
            "from": to_utf16(text, piece.range.start),
            "to": to_utf16(text, piece.range.end),
            "class": format!("{:?}", piece.class).to_lowercase(),
            "unknown": piece.is_unknown,
        })
    });
    json!({
        "ok": true,
        "start": to_utf16(text, offer.start),
        "candidates": candidates.collect::<Vec<_>>(),
        "hint": if cursor == text.len() { completion.hint(before) } else { None },
        "pieces": pieces.collect::<Vec<_>>(),
        "incomplete": is_incomplete(text),
    })
}
