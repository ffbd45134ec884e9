//! A text that comes line by line: when it is a whole, without reading all of it at each line.

use super::is_incomplete;
use super::layout::{MAX_NESTING, closing, string_end};

/// A text this short is read anew with each line: what is wrong in it is said at once.
const LINES_WATCHED: usize = 64;

/// Lines that may yet be part of a statement.
///
/// ```
/// use linkwork::lang::Growing;
///
/// let mut text = Growing::default();
/// assert!(!text.add("for i in 1..3 {\n"));
/// assert!(!text.add("  step\n"));
/// assert!(text.add("}\n"));
/// assert_eq!(text.take(), "for i in 1..3 {\n  step\n}\n");
/// ```
#[derive(Debug, Default)]
pub struct Growing {
    text: String,
    n_lines: usize,
    /// The brackets that are open.
    open: Vec<u8>,
    /// How long the text was when all of it was read last.
    n_read: usize,
    /// The bytes that were read anew since the text began, however often.
    n_read_anew: usize,
}

/// What a line does to the text before it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Line {
    /// The text may be whole with it, or has a mistake.
    MayEnd,
    /// It opens the first bracket.
    Opens,
    /// The statement goes on: a bracket is open, or the line ends in a comma or a `\`.
    GoesOn,
}

impl Growing {
    /// Adds a line; whether the text is a whole with it, or so wrong that no more can mend it.
    pub fn add(&mut self, line: &str) -> bool {
        let kind = self.look_at(line);
        self.text.push_str(line);
        self.n_lines += 1;
        let is_due = self.n_lines < LINES_WATCHED
            || kind != Line::GoesOn
            || self.text.len() >= 2 * self.n_read;
        if !is_due {
            return false;
        }
        self.n_read = self.text.len();
        self.n_read_anew += self.text.len();
        !is_incomplete(&self.text)
    }

    /// How long it is so far.
    pub const fn n_bytes(&self) -> usize {
        self.text.len()
    }

    /// The text, which is empty from here on.
    pub fn take(&mut self) -> String {
        std::mem::take(self).text
    }

    /// Looks at the brackets of a line, as `Layout` does.
    fn look_at(&mut self, line: &str) -> Line {
        let was_open = !self.open.is_empty();
        let bytes = line.as_bytes();
        let mut last = 0;
        let mut at = 0;
        while let Some(&byte) = bytes.get(at) {
            at += 1;
            match byte {
                b' ' | b'\t'..=b'\r' => continue,
                b'#' => break,
                b'"' => match string_end(bytes, at - 1) {
                    Ok(behind) => at = behind,
                    Err(_) => return Line::MayEnd,
                },
                b'(' | b'[' | b'{' if self.open.len() < MAX_NESTING => self.open.push(byte),
                b'(' | b'[' | b'{' => return Line::MayEnd,
                b')' | b']' | b'}' => {
                    let opened = self.open.pop();
                    if opened.map(closing) != Some(byte) {
                        return Line::MayEnd;
                    }
                }
                b';' if matches!(self.open.last(), Some(b'(' | b'[')) => return Line::MayEnd,
                _ => {}
            }
            last = byte;
        }
        match (self.open.is_empty(), last) {
            (false, _) if was_open => Line::GoesOn,
            (false, _) => Line::Opens,
            (true, b',' | b'\\') => Line::GoesOn,
            (true, _) => Line::MayEnd,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Adds lines; gives how many it took to be whole, and the bytes read for that.
    fn grown(lines: impl IntoIterator<Item = String>) -> (usize, usize, usize) {
        let mut text = Growing::default();
        let mut n_lines = 0;
        for line in lines {
            n_lines += 1;
            if text.add(&line) {
                break;
            }
        }
        (n_lines, text.text.len(), text.n_read_anew)
    }

    #[test]
    fn a_long_statement_is_read_a_few_times_however_it_is_laid_out() {
        const N: usize = 20_000;
        let within = |first: &str, line: &str, last: &str| {
            let lines = std::iter::repeat_n(line.to_owned(), N);
            let lines = std::iter::once(first.to_owned()).chain(lines);
            let (n_lines, n_bytes, n_read) = grown(lines.chain([last.to_owned()]));
            assert_eq!(n_lines, N + 2, "{line:?}");
            assert!(n_read < 6 * n_bytes, "{line:?}: {n_read} of {n_bytes}");
        };
        within("for i in 1..3 {\n", "step\n", "}\n");
        within("for i in 1..3 {\n", "for j in 1..2 {\n step\n}\n", "}\n");
        within("for i in 1..3 {\n", "step # }\n", "}\n");
        within("for i in 1..3 {\n", "print \"}\"\n", "}\n");
        within("freeze A,\n", "A,\n", "A\n");
        within("freeze \\\n", "A \\\n", "A\n");
        within("restore memory = (\n", "1 +\n", "1)\n");
    }

    #[test]
    fn what_is_wrong_is_said_at_once() {
        for wrong in ["print )\n", "print (1 ]\n", "print \"a\n", "lenght {\n", "print (1; 2)\n"] {
            assert_eq!(grown([wrong.to_owned()]).0, 1, "{wrong:?}");
            let mut text = Growing::default();
            assert!(text.add(wrong), "{wrong:?}");
        }
    }
}
