//! A text that a page sends in pieces, as it may be longer than a message.

/// What came of it so far.
#[derive(Debug, Default)]
pub struct Pieces {
    text: String,
    is_too_long: bool,
}

impl Pieces {
    /// Adds a piece. Of a text that comes to more than `most` bytes nothing is kept, whatever follows.
    pub fn add(&mut self, piece: &str, most: u64) {
        self.is_too_long |= (self.text.len() + piece.len()) as u64 > most;
        if self.is_too_long {
            self.text = String::new();
        } else {
            self.text.push_str(piece);
        }
    }

    /// The text, now that all of it came; none if it was too long.
    pub fn take(&mut self) -> Option<String> {
        let Self { text, is_too_long } = std::mem::take(self);
        (!is_too_long).then_some(text)
    }
}
