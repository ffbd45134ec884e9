//! Asks the terminal what it can, and waits no longer than an answer takes. What is typed meanwhile is kept
//! for the next line, and an answer that comes too late is no part of it.

use std::io::{self, IsTerminal, Write};
use std::mem;
use std::os::fd::{AsFd, BorrowedFd};
use std::sync::{Mutex, PoisonError};
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

/// How asking went.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Asked {
    /// There is an answer.
    Answered(Answer),
    /// None came in time.
    Silent,
    /// There is nobody to ask, or somebody types.
    NotNow,
}

/// How long an answer may take. All terminals answer the second question, most at once; those that are
/// far away take their time.
const PATIENCE: Duration = Duration::from_secs(2);

/// The size of a letter (xterm's `CSI 16 t`), and what it is (`CSI c`, ECMA-48 8.3.24).
const QUESTIONS: &[u8] = b"\x1b[16t\x1b[c";

/// When the question was asked that has no answer yet.
static OPEN_SINCE: Mutex<Option<Instant>> = Mutex::new(None);

/// An answer that took longer comes no more: what looks like one is something else.
const LATEST: Duration = Duration::from_secs(30);

/// What was typed while nobody but the question looked.
static TYPED: Mutex<String> = Mutex::new(String::new());

/// The beginning of something that came last, while nobody looked further.
static BEGUN: Mutex<Vec<u8>> = Mutex::new(Vec::new());

/// Asks, or takes the answer to what was asked before.
pub fn ask() -> Asked {
    let stdin = io::stdin();
    let input = stdin.as_fd();
    // Who works behind another program would be stopped for changing the terminal.
    if !stdin.is_terminal() || tcgetpgrp(input) != Ok(getpgrp()) {
        return Asked::NotNow;
    }
    let Some(_silence) = Silence::begin(input) else { return Asked::NotNow };
    let mut heard = Heard::go_on();
    if is_due() {
        heard.listen(input, Duration::ZERO);
    } else if is_ready(input, Duration::ZERO) {
        return Asked::NotNow;
    }
    if !heard.is_whole {
        let mut out = io::stdout();
        if out.write_all(QUESTIONS).and_then(|()| out.flush()).is_err() {
            return Asked::NotNow;
        }
        set_open(Some(Instant::now()));
        heard.listen(input, PATIENCE);
    }
    heard.end()
}

/// Whether an answer is yet to come: it may come into a line that is being typed.
pub fn is_due() -> bool {
    OPEN_SINCE.lock().is_ok_and(|since| since.is_some_and(|since| since.elapsed() < LATEST))
}

/// The answer came, and nobody wants it any more.
pub fn forget() {
    set_open(None);
}

fn set_open(since: Option<Instant>) {
    *OPEN_SINCE.lock().unwrap_or_else(PoisonError::into_inner) = since;
}

/// What was typed while a question was open, as far as there is any.
pub fn take_typed() -> String {
    let stdin = io::stdin();
    if is_due()
        && let Some(_silence) = Silence::begin(stdin.as_fd())
    {
        let mut heard = Heard::go_on();
        heard.listen(stdin.as_fd(), Duration::ZERO);
        heard.end();
    }
    mem::take(&mut *TYPED.lock().unwrap_or_else(PoisonError::into_inner))
}

fn is_ready(input: BorrowedFd, patience: Duration) -> bool {
    let mut asked = [PollFd::new(input, PollFlags::POLLIN)];
    let timeout = PollTimeout::try_from(patience).unwrap_or(PollTimeout::ZERO);
    matches!(poll(&mut asked, timeout), Ok(1..))
}

/// What came from the terminal: answers, and keys.
#[derive(Debug, Default, PartialEq, Eq)]
struct Heard {
    answer: Answer,
    /// Whether the answer to the last question is there.
    is_whole: bool,
    typed: String,
    /// What is not told from anything else yet.
    begun: Vec<u8>,
}

impl Heard {
    /// What came before may have been half of something.
    fn go_on() -> Self {
        let begun = mem::take(&mut *BEGUN.lock().unwrap_or_else(PoisonError::into_inner));
        Self { begun, ..Self::default() }
    }

    /// Listens until the answer is whole, or so long.
    fn listen(&mut self, input: BorrowedFd, patience: Duration) {
        let begun = Instant::now();
        while !self.is_whole {
            let left = patience.saturating_sub(begun.elapsed());
            let mut piece = [0; 256];
            match is_ready(input, left).then(|| read(input, &mut piece)) {
                Some(Ok(n @ 1..)) => self.take(&piece[..n]),
                _ => return,
            }
        }
    }

    /// Takes in what came next.
    fn take(&mut self, bytes: &[u8]) {
        self.begun.extend(bytes);
        let all = mem::take(&mut self.begun);
        let mut left = &all[..];
        while let Some((piece, behind)) = first_piece(left) {
            left = behind;
            match piece {
                Piece::Order(inside, kind) => self.take_order(inside, kind),
                Piece::Letter(letter) => self.type_in(letter),
            }
        }
        self.begun = left.to_vec();
    }

    /// Takes in a control sequence: an answer; what other keys send does nothing in a line that is not
    /// there yet.
    fn take_order(&mut self, inside: &[u8], kind: u8) {
        let text = String::from_utf8_lossy(inside);
        let (numbers, is_of_device) = match text.strip_prefix('?') {
            Some(numbers) => (numbers, true),
            None => (&*text, false),
        };
        let numbers: Vec<usize> = numbers.split(';').filter_map(|n| n.parse().ok()).collect();
        match (kind, is_of_device, &numbers[..]) {
            // The first says of which class it is, the others what it has besides.
            (b'c', true, [_, others @ ..]) => {
                self.answer.has_sixel = others.contains(&4);
                self.is_whole = true;
            }
            (b't', false, &[6, high @ 1..=200, wide @ 1..=200]) => {
                self.answer.cell = Some([wide, high]);
            }
            _ => {}
        }
    }

    /// Takes in a key, as a line takes it.
    fn type_in(&mut self, letter: char) {
        let line = self.typed.rfind('\n').map_or(0, |at| at + 1);
        match letter {
            '\r' | '\n' => self.typed.push('\n'),
            '\u{8}' | '\u{7f}' if self.typed.len() > line => drop(self.typed.pop()),
            '\u{15}' => self.typed.truncate(line),
            _ if letter.is_control() => {}
            _ => self.typed.push(letter),
        }
    }

    /// Keeps what was typed, and says what was answered.
    fn end(self) -> Asked {
        if self.is_whole {
            forget();
        }
        TYPED.lock().unwrap_or_else(PoisonError::into_inner).push_str(&self.typed);
        *BEGUN.lock().unwrap_or_else(PoisonError::into_inner) = self.begun;
        if self.is_whole { Asked::Answered(self.answer) } else { Asked::Silent }
    }
}

/// Something that came from a terminal.
#[derive(Debug, PartialEq, Eq)]
enum Piece<'a> {
    /// A control sequence: what stands in it, and the letter that ends it.
    Order(&'a [u8], u8),
    Letter(char),
}

/// The first of some bytes, and those behind it; none where it may not be there to its end.
fn first_piece(bytes: &[u8]) -> Option<(Piece<'_>, &[u8])> {
    let (&first, behind) = bytes.split_first()?;
    if first != b'\x1b' {
        let n = match first {
            0xc0..0xe0 => 2,
            0xe0..0xf0 => 3,
            0xf0..0xf8 => 4,
            _ => 1,
        };
        let (letter, behind) = bytes.split_at_checked(n)?;
        let letter = String::from_utf8_lossy(letter).chars().next()?;
        return Some((Piece::Letter(letter), behind));
    }
    let inside = match behind.split_first()? {
        (b'[', inside) => inside,
        // Keys with Alt, and those of a keypad.
        (b'O', inside) => return Some((Piece::Order(&[], *inside.first()?), &inside[1..])),
        (other, inside) => return Some((Piece::Order(&[], *other), inside)),
    };
    let end = inside.iter().position(|byte| (0x40..0x7f).contains(byte))?;
    Some((Piece::Order(&inside[..end], inside[end]), &inside[end + 1..]))
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

    fn heard(bytes: &[u8]) -> Heard {
        let mut heard = Heard::default();
        heard.take(bytes);
        heard
    }

    #[test]
    fn answers_are_understood() {
        let check = |text: &str, is_whole, has_sixel, cell| {
            let heard = heard(text.as_bytes());
            let wanted = Answer { has_sixel, cell };
            assert_eq!((heard.is_whole, heard.answer), (is_whole, wanted), "{text:?}");
            assert_eq!(heard.typed, "", "{text:?}");
        };
        check("\x1b[6;20;10t\x1b[?62;4;22c", true, true, Some([10, 20]));
        check("\x1b[?62;22c", true, false, None);
        // A class of 4 is no sixel.
        check("\x1b[?4c", true, false, None);
        check("\x1b[6;0;10t\x1b[?1;2c", true, false, None);
        check("", false, false, None);
        check("\x1b[6;20;10t\x1b[?62;4", false, false, Some([10, 20]));
        // Keys that send sequences are no answers.
        check("\x1b[A\x1bOA\x1b[3~\x1bf\x1b[1;5C", false, false, None);
    }

    #[test]
    fn what_is_typed_meanwhile_is_kept_as_a_line_keeps_it() {
        let answer = "\x1b[6;20;10t\x1b[?62;4c";
        for (keys, wanted) in [
            ("let r = 3", "let r = 3"),
            ("1 + 2\rx", "1 + 2\nx"),
            ("ab\u{7f}c", "ac"),
            ("a\n\u{7f}b", "a\nb"),
            ("one\ntwo\u{15}three", "one\nthree"),
            ("\u{e9}\u{20ac}\u{1f600}", "\u{e9}\u{20ac}\u{1f600}"),
            ("a\x1b[Ab\tc\u{4}", "abc"),
        ] {
            for at in (0..=keys.len()).filter(|&at| keys.is_char_boundary(at)) {
                // An answer comes whole, though not within a key.
                if keys[at..].starts_with(['[', 'A']) && keys[..at].contains('\x1b') {
                    continue;
                }
                let all = [&keys[..at], answer, &keys[at..]].concat();
                let found = heard(all.as_bytes());
                assert!(found.is_whole && found.answer.has_sixel, "{all:?}");
                assert_eq!(found.typed, wanted, "{all:?}");
                // However it comes.
                let mut slow = Heard::default();
                all.bytes().for_each(|byte| slow.take(&[byte]));
                assert_eq!(slow, found);
            }
        }
    }
}
