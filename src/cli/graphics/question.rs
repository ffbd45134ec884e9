//! Asks the terminal what it can, and waits no longer than an answer takes.

use std::io::{self, IsTerminal, Write};
use std::os::fd::{AsFd, BorrowedFd};
use std::time::{Duration, Instant};

use nix::poll::{PollFd, PollFlags, PollTimeout, poll};
use nix::sys::termios::{LocalFlags, SetArg, Termios, tcgetattr, tcsetattr};
use nix::unistd::{getpgrp, read, tcgetpgrp};

/// What a terminal answered.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Answer {
    /// Whether it shows sixels.
    pub has_sixel: bool,
    /// Width and height of a letter, pixels.
    pub cell: Option<[usize; 2]>,
}

/// How long an answer may take. All terminals answer the second question; only what is none waits.
const PATIENCE: Duration = Duration::from_millis(500);

/// The size of a letter (xterm's `CSI 16 t`), and what it is (`CSI c`, ECMA-48 8.3.24).
const QUESTIONS: &[u8] = b"\x1b[16t\x1b[c";

/// Bytes of an answer at most.
const LONGEST: usize = 256;

/// Asks; none where there is nobody to ask, or somebody types.
pub fn ask() -> Option<Answer> {
    let stdin = io::stdin();
    let input = stdin.as_fd();
    // Who works behind another program would be stopped for changing the terminal.
    if !stdin.is_terminal() || tcgetpgrp(input) != Ok(getpgrp()) || is_ready(input, Duration::ZERO)
    {
        return None;
    }
    let _silence = Silence::begin(input)?;
    let mut out = io::stdout();
    out.write_all(QUESTIONS).and_then(|()| out.flush()).ok()?;
    let mut text = Vec::new();
    let begun = Instant::now();
    while text.len() < LONGEST && !is_whole(&text) {
        let left = PATIENCE.saturating_sub(begun.elapsed());
        if left.is_zero() || !is_ready(input, left) {
            break;
        }
        let mut piece = [0; 64];
        match read(input, &mut piece) {
            Ok(n @ 1..) => text.extend(&piece[..n]),
            _ => break,
        }
    }
    Some(understood(&text))
}

fn is_ready(input: BorrowedFd, patience: Duration) -> bool {
    let mut asked = [PollFd::new(input, PollFlags::POLLIN)];
    let timeout = PollTimeout::try_from(patience).unwrap_or(PollTimeout::ZERO);
    matches!(poll(&mut asked, timeout), Ok(1..))
}

/// Whether the answer to the last question is there.
fn is_whole(text: &[u8]) -> bool {
    let start = text.windows(3).position(|three| three == b"\x1b[?");
    start.is_some_and(|start| text[start..].contains(&b'c'))
}

/// What the bytes of an answer say.
fn understood(text: &[u8]) -> Answer {
    let text = String::from_utf8_lossy(text);
    let mut answer = Answer::default();
    for part in text.split("\x1b[").skip(1) {
        let end = part.find(|c: char| c.is_ascii_alphabetic());
        let Some((inside, kind)) = end.map(|end| part.split_at(end)) else { continue };
        let numbers: Vec<usize> =
            inside.trim_start_matches('?').split(';').filter_map(|n| n.parse().ok()).collect();
        if kind.starts_with('c') && inside.starts_with('?') {
            // The first says of which class it is, the others what it has besides.
            answer.has_sixel = numbers.iter().skip(1).any(|n| *n == 4);
        } else if let (true, &[6, high @ 1..=200, wide @ 1..=200]) =
            (kind.starts_with('t'), &numbers[..])
        {
            answer.cell = Some([wide, high]);
        }
    }
    answer
}

/// What is typed, an answer too, is neither shown nor held back until the end of a line.
struct Silence<'a> {
    input: BorrowedFd<'a>,
    before: Termios,
}

impl<'a> Silence<'a> {
    fn begin(input: BorrowedFd<'a>) -> Option<Self> {
        let before = tcgetattr(input).ok()?;
        let mut silent = before.clone();
        silent.local_flags.remove(LocalFlags::ICANON | LocalFlags::ECHO);
        tcsetattr(input, SetArg::TCSANOW, &silent).ok()?;
        Some(Self { input, before })
    }
}

impl Drop for Silence<'_> {
    fn drop(&mut self) {
        // Where that fails there is no terminal any more.
        let _ = tcsetattr(self.input, SetArg::TCSANOW, &self.before);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn answers_are_understood() {
        let check = |text: &str, has_sixel, cell| {
            assert_eq!(understood(text.as_bytes()), Answer { has_sixel, cell }, "{text:?}");
        };
        check("\x1b[6;20;10t\x1b[?62;4;22c", true, Some([10, 20]));
        check("\x1b[?62;22c", false, None);
        // A class of 4 is no sixel.
        check("\x1b[?4c", false, None);
        check("\x1b[6;0;10t\x1b[?1;2c", false, None);
        check("", false, None);
        assert!(is_whole(b"\x1b[6;20;10t\x1b[?62;4;22c") && !is_whole(b"\x1b[6;20;10t\x1b[?62;4"));
    }
}
