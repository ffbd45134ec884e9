//! Where a statement ends: at a newline or `;`, unless a bracket, a comma or a `\` holds it open.
//!
//! One pass over the bytes, without a copy. It alone decides this; the grammar, which sees
//! one statement at a time, takes the line ends and comments left in it for blanks.

use std::ops::Range;

/// Brackets within brackets, of all sorts together. Deeper, an error: what reads, computes
/// or drops nested things calls itself, and must not run out of stack.
pub(super) const MAX_NESTING: usize = 64;

/// One statement as cut out of its text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Piece {
    /// From its first character to the last that is neither blank nor comment; with a
    /// block, to the last before the `{`.
    pub head: Range<usize>,
    /// What stands between its braces, if it has a block.
    pub block: Option<Range<usize>>,
    /// All of it.
    pub whole: Range<usize>,
}

/// Why no statement could be cut out.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Flaw {
    /// The text ends before the bracket at `opener` is closed, the last of those open;
    /// the first of them, at `outermost`, belongs to the statement that begins at `start`.
    Unclosed { opener: usize, outermost: usize, start: usize },
    /// A `;` ends the statement before the bracket at `opener` is closed.
    CutOff { opener: usize, semicolon: usize },
    /// A closing bracket with nothing to close.
    Unopened { closer: usize },
    /// A closing bracket of another sort than the one at `opener`.
    Mismatched { opener: usize, closer: usize },
    /// The line ends before the string that begins at `quote`.
    OpenString { quote: usize, end: usize },
    /// One bracket too many within another.
    TooDeep { opener: usize },
    /// Something stands between the `}` of a block and the end of the line.
    AfterBlock { at: usize },
}

/// Cuts a text, or the inside of a block, into statements.
#[derive(Debug, Clone)]
pub(super) struct Layout<'a> {
    text: &'a str,
    at: usize,
    end: usize,
    /// The brackets open at the moment and their offsets.
    open: Vec<(u8, usize)>,
    /// Is the last statement held open by a trailing comma or `\`?
    expects_more: bool,
}

impl<'a> Layout<'a> {
    /// Of the bytes `range` of `text`.
    pub fn new(text: &'a str, range: Range<usize>) -> Self {
        Self { text, at: range.start, end: range.end, open: Vec::new(), expects_more: false }
    }

    /// Did the text end while the last statement was held open by a trailing comma or `\`?
    pub fn expects_more(&self) -> bool {
        self.expects_more
    }

    /// Where the statement with a flaw, the last one, is broken off: what is behind the end of this line
    /// may be another one. None where that would be within a block.
    pub fn broken_off(&self, flaw: Flaw) -> Option<usize> {
        let is_block = |at: usize| self.text.as_bytes()[at] == b'{';
        let (opener, at) = match flaw {
            Flaw::Unclosed { outermost, .. } => (Some(outermost), outermost),
            Flaw::CutOff { opener, semicolon: at } | Flaw::Mismatched { opener, closer: at } => {
                (Some(opener), at)
            }
            Flaw::Unopened { closer: at }
            | Flaw::OpenString { quote: at, .. }
            | Flaw::TooDeep { opener: at }
            | Flaw::AfterBlock { at } => (None, at),
        };
        let mut openers = self.open.iter().map(|(_, at)| *at).chain(opener);
        (!openers.any(is_block)).then_some(at)
    }

    /// Goes on from there after a flaw.
    pub fn go_on(&mut self, at: usize) {
        self.at = at.min(self.end);
    }

    /// The next statement. After a flaw no more come, unless it is told where to go on.
    pub fn next_piece(&mut self) -> Option<Result<Piece, Flaw>> {
        self.skip_to_statement();
        if self.at >= self.end {
            return None;
        }
        let piece = self.cut();
        if piece.is_err() {
            self.at = self.end;
        }
        Some(piece)
    }

    fn skip_to_statement(&mut self) {
        let bytes = &self.text.as_bytes()[..self.end];
        while let Some(byte) = bytes.get(self.at) {
            match byte {
                b' ' | b'\t'..=b'\r' | b';' => self.at += 1,
                b'#' => self.at = line_end(bytes, self.at),
                b'\\' => match continuation(bytes, self.at) {
                    Some(next) => self.at = next,
                    None => return,
                },
                _ => return,
            }
        }
    }

    /// Cuts out the statement that begins here.
    fn cut(&mut self) -> Result<Piece, Flaw> {
        let bytes = &self.text.as_bytes()[..self.end];
        let start = self.at;
        let mut significant_end = start;
        let mut head_end = None;
        let mut block: Option<Range<usize>> = None;
        let mut block_is_closed = false;
        self.expects_more = false;
        self.open.clear();
        while let Some(&byte) = bytes.get(self.at) {
            let at = self.at;
            self.at += 1;
            match byte {
                b' ' | b'\t' | 0x0b..=b'\r' => continue,
                b'#' => {
                    self.at = line_end(bytes, at);
                    continue;
                }
                b'\\' => {
                    if let Some(next) = continuation(bytes, at) {
                        self.expects_more = true;
                        self.at = next;
                        continue;
                    }
                }
                b'\n' | b';' => match self.open.last() {
                    None if byte == b'\n' && bytes[significant_end - 1] == b',' => continue,
                    None => break,
                    Some(&(b'(' | b'[', opener)) if byte == b';' => {
                        return Err(Flaw::CutOff { opener, semicolon: at });
                    }
                    Some(_) => continue,
                },
                b')' | b']' | b'}' if block_is_closed => {
                    return Err(Flaw::Unopened { closer: at });
                }
                _ if block_is_closed => return Err(Flaw::AfterBlock { at }),
                b'"' => match string_end(bytes, at) {
                    Ok(behind) => self.at = behind,
                    Err(end) => return Err(Flaw::OpenString { quote: at, end }),
                },
                b'(' | b'[' | b'{' => {
                    if self.open.len() == MAX_NESTING {
                        return Err(Flaw::TooDeep { opener: at });
                    }
                    if byte == b'{' && self.open.is_empty() {
                        head_end = Some(significant_end);
                        block = Some(at + 1..at + 1);
                    }
                    self.open.push((byte, at));
                }
                b')' | b']' | b'}' => {
                    let (opening, opener) = self.open.pop().ok_or(Flaw::Unopened { closer: at })?;
                    if closing(opening) != byte {
                        return Err(Flaw::Mismatched { opener, closer: at });
                    }
                    if let Some(inside) = block.as_mut().filter(|_| self.open.is_empty()) {
                        inside.end = at;
                        block_is_closed = true;
                    }
                }
                _ => self.at += plain(&bytes[self.at..]),
            }
            self.expects_more = false;
            significant_end = self.at;
        }
        if let (Some(&(_, outermost)), Some(&(_, opener))) = (self.open.first(), self.open.last()) {
            return Err(Flaw::Unclosed { opener, outermost, start });
        }
        let whole = start..significant_end;
        self.expects_more |= self.at >= self.end && bytes[significant_end - 1] == b',';
        let head = start..head_end.unwrap_or(significant_end);
        Ok(Piece { head, block, whole })
    }
}

pub(super) fn closing(opening: u8) -> u8 {
    match opening {
        b'(' => b')',
        b'[' => b']',
        _ => b'}',
    }
}

fn line_end(bytes: &[u8], from: usize) -> usize {
    bytes[from..].iter().position(|&byte| byte == b'\n').map_or(bytes.len(), |at| from + at)
}

/// Whether a byte is one of those that names and numbers mostly consist of.
const IS_PLAIN: [bool; 256] = {
    let mut is_plain = [false; 256];
    let mut byte = 0_u8;
    while byte < 128 {
        is_plain[byte as usize] = byte.is_ascii_alphanumeric() || byte == b'.';
        byte += 1;
    }
    is_plain
};

/// How many of those there are.
fn plain(bytes: &[u8]) -> usize {
    bytes.iter().take_while(|byte| IS_PLAIN[usize::from(**byte)]).count()
}

/// Where the text goes on, if the `\` at `at` is the last of its line.
fn continuation(bytes: &[u8], at: usize) -> Option<usize> {
    let blanks = bytes[at + 1..].iter().take_while(|byte| matches!(byte, b' ' | b'\t' | b'\r'));
    let next = at + 1 + blanks.count();
    match bytes.get(next) {
        Some(b'\n') => Some(next + 1),
        Some(_) => None,
        None => Some(next),
    }
}

/// The offset behind the closing quote of the string that begins at `quote`; where its line ends, if
/// it is not closed there.
pub(super) fn string_end(bytes: &[u8], quote: usize) -> Result<usize, usize> {
    let mut at = quote + 1;
    loop {
        match bytes.get(at) {
            Some(b'"') => return Ok(at + 1),
            Some(b'\\') if bytes.get(at + 1).is_some_and(|&byte| byte != b'\n') => at += 2,
            Some(b'\n') | None => return Err(at),
            Some(_) => at += 1,
        }
    }
}

/// Where the statement begins that a text ends in; at its end, where the last one is over.
pub fn statement_start(text: &str) -> usize {
    let mut from = 0;
    loop {
        let mut layout = Layout::new(text, from..text.len());
        let flaw = loop {
            match layout.next_piece() {
                None => return text.len(),
                Some(Ok(piece)) => {
                    let is_over = text[piece.whole.end..].contains(['\n', ';']);
                    if !is_over || layout.expects_more() {
                        return piece.whole.start;
                    }
                }
                Some(Err(flaw)) => break flaw,
            }
        };
        match flaw {
            Flaw::Unclosed { outermost, .. } if text.as_bytes()[outermost] == b'{' => {
                from = outermost + 1;
            }
            Flaw::Unclosed { start, .. } => return start,
            Flaw::OpenString { quote, .. } => {
                let before = text[..quote].rfind(['\n', ';', '{', '}']);
                return before.map_or(0, |at| at + 1);
            }
            _ => return text.rfind(['\n', ';', '{', '}']).map_or(0, |at| at + 1),
        }
    }
}

/// How many brackets are open at the end of a text.
pub fn depth(text: &str) -> usize {
    let mut depth = 0;
    let mut from = 0;
    loop {
        let mut layout = Layout::new(text, from..text.len());
        let flaw = std::iter::from_fn(|| layout.next_piece()).find_map(Result::err);
        match flaw {
            Some(Flaw::Unclosed { outermost, .. }) => {
                depth += 1;
                from = outermost + 1;
            }
            _ => return depth,
        }
    }
}
