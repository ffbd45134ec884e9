//! A token that nobody guesses, for the address of a page.

use std::fmt::Write as _;
use std::fs::{self, OpenOptions};
use std::io::{self, Write as _};
use std::path::Path;

use crate::cli::folders;

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

/// The token of who listens at a port that the user said: the same each time, so that a page finds the
/// session that follows. It is kept where only the user can read it.
///
/// # Errors
/// Where the system has no random numbers.
pub fn kept(port: u16) -> io::Result<String> {
    match folders::state() {
        Some(state) => kept_in(&state.join("view"), port),
        None => token(),
    }
}

fn kept_in(folder: &Path, port: u16) -> io::Result<String> {
    let path = folder.join(port.to_string());
    let is_token = |text: &String| {
        text.len() == 2 * N_BYTES && text.bytes().all(|letter| letter.is_ascii_hexdigit())
    };
    if let Some(token) = fs::read_to_string(&path).ok().filter(is_token) {
        return Ok(token);
    }
    let token = token()?;
    // Where it cannot be kept it holds for this session.
    drop(keep(&path, &token));
    Ok(token)
}

fn keep(path: &Path, token: &str) -> io::Result<()> {
    fs::create_dir_all(path.parent().unwrap_or(path))?;
    // Anew, so that it has no rights but those that are said here.
    drop(fs::remove_file(path));
    let mut options = OpenOptions::new();
    options.write(true).create_new(true);
    #[cfg(unix)]
    std::os::unix::fs::OpenOptionsExt::mode(&mut options, 0o600);
    options.open(path)?.write_all(token.as_bytes())
}

/// Whether a text is the token; how long that takes tells nothing about where they differ.
pub fn is_same(text: &str, token: &str) -> bool {
    let (a, b) = (text.as_bytes(), token.as_bytes());
    a.len() == b.len() && a.iter().zip(b).fold(0, |all, (a, b)| all | (a ^ b)) == 0
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A folder that is not there yet, and goes with the test.
    struct Folder(std::path::PathBuf);

    impl Folder {
        fn new() -> Self {
            Self(std::env::temp_dir().join(token().expect("a token")))
        }
    }

    impl Drop for Folder {
        fn drop(&mut self) {
            drop(fs::remove_dir_all(&self.0));
        }
    }

    #[test]
    fn a_port_keeps_its_token() {
        let folder = Folder::new();
        let view = folder.0.join("view");
        let first = kept_in(&view, 8080).expect("a token");
        assert_eq!(kept_in(&view, 8080).expect("a token"), first);
        assert_ne!(kept_in(&view, 8081).expect("a token"), first);
        // What is there and is none is replaced.
        for text in ["", "short", &"x".repeat(32)] {
            fs::write(view.join("8080"), text).expect("it is written");
            let other = kept_in(&view, 8080).expect("a token");
            assert_eq!(other.len(), 32);
            assert_eq!(kept_in(&view, 8080).expect("a token"), other);
        }
    }

    #[cfg(unix)]
    #[test]
    fn only_the_user_reads_it() {
        use std::os::unix::fs::PermissionsExt;
        let folder = Folder::new();
        kept_in(&folder.0, 8080).expect("a token");
        let kept = fs::metadata(folder.0.join("8080")).expect("it is there");
        assert_eq!(kept.permissions().mode() & 0o777, 0o600);
    }
}
