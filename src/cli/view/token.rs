//! A token that nobody guesses, for the address of a page.

use std::fmt::Write;
use std::io;

/// Bytes of a token.
const N_BYTES: usize = 16;

/// A new token, in letters that stand in an address.
///
/// # Errors
/// Where the system has no random numbers.
pub fn token() -> io::Result<String> {
    let mut bytes = [0; N_BYTES];
    getrandom::fill(&mut bytes).map_err(io::Error::other)?;
    Ok(bytes.iter().fold(String::new(), |mut text, byte| {
        // Writing to a string cannot fail.
        let _ = write!(text, "{byte:02x}");
        text
    }))
}

/// Whether a text is the token; how long that takes tells nothing about where they differ.
pub fn is_same(text: &str, token: &str) -> bool {
    let (a, b) = (text.as_bytes(), token.as_bytes());
    a.len() == b.len() && a.iter().zip(b).fold(0, |all, (a, b)| all | (a ^ b)) == 0
}
