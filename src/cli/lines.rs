//! Standard input line by line, read by a thread of its own: who waits for a line can be woken.

use std::io::{self, Read};
use std::sync::mpsc::{Receiver, sync_channel};

use super::interrupt;

/// Bytes that are read at a time.
const PIECE: usize = 1 << 16;
/// Pieces read ahead of what works on them.
const PIECES_AHEAD: usize = 16;

/// The lines of standard input.
pub struct Lines {
    pieces: Receiver<io::Result<Vec<u8>>>,
    /// What was read and not yet given.
    text: Vec<u8>,
    /// Where the next line begins in it.
    at: usize,
    /// Bytes of the longest line.
    most: usize,
}

impl Lines {
    /// The lines of standard input, none longer than `most` bytes.
    pub fn of_stdin(most: u64) -> Self {
        let (to, pieces) = sync_channel(PIECES_AHEAD);
        std::thread::spawn(move || {
            loop {
                let mut piece = vec![0; PIECE];
                let n = io::stdin().read(&mut piece);
                let is_last = n.as_ref().map_or_else(|e| !is_passing(e), |n| *n == 0);
                let piece = n.map(|n| {
                    piece.truncate(n);
                    piece
                });
                if to.send(piece).is_err() || is_last {
                    return;
                }
            }
        });
        let most = usize::try_from(most).unwrap_or(usize::MAX);
        Self { pieces, text: Vec::new(), at: 0, most }
    }

    /// The next line with its end; empty at the end of all, or where the program is asked to end.
    ///
    /// # Errors
    /// Where it cannot be read, or is too long.
    pub fn next(&mut self) -> io::Result<Vec<u8>> {
        let mut seen = self.at;
        loop {
            let end = self.text[seen..].iter().position(|&byte| byte == b'\n');
            let length = end.map_or(self.text.len(), |n| seen + n + 1) - self.at;
            if length > self.most {
                return Err(io::ErrorKind::FileTooLarge.into());
            }
            if end.is_some() {
                return Ok(self.take(length));
            }
            seen = length;
            self.text.drain(..self.at);
            self.at = 0;
            match interrupt::next_from(&self.pieces) {
                Some(Err(e)) if is_passing(&e) => {}
                Some(piece) => {
                    let piece = piece?;
                    if piece.is_empty() {
                        return Ok(self.take(length));
                    }
                    self.text.extend(piece);
                }
                None => return Ok(self.take(length)),
            }
        }
    }

    fn take(&mut self, length: usize) -> Vec<u8> {
        let line = self.text[self.at..self.at + length].to_vec();
        self.at += length;
        line
    }
}

/// Whether to read once more after an error.
fn is_passing(error: &io::Error) -> bool {
    error.kind() == io::ErrorKind::Interrupted
}
