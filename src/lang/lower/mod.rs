//! Text to trees: the only folder that names what pest has read.
//!
//! [`parse`] cuts the text into statements (see `layout`), looks at the first word of each,
//! lets pest read it with the rule of that verb (see `memory` for when it need not), and turns what
//! pest has read into the tree. Each statement is read when it is asked for, so those before a mistake
//! can run first.

mod constraint;
mod cursor;
mod errors;
mod expr;
mod highlight;
mod memory;
mod next;
mod parsed;
mod prefix;
mod signs;

#[cfg(test)]
mod tests;

use std::ops::Range;

use pest::Parser;

use crate::diag::{Diagnostic, SourceId, Span};
use crate::interrupt::tick;

use super::ast::{Body, Command, Statement};
use super::grammar::{LinkworkParser, Rule};
use super::layout::{Flaw, Layout, Piece};
pub(super) use constraint::{lower as constraint, parts};
pub(super) use cursor::Cursor;
pub(super) use errors::refusal;
pub use highlight::{Class, Token, Tokens, tokens};
use memory::Memory;
pub(super) use next::split_prefix;
pub use next::{NameOf, Next, next};
use parsed::{Parsed, Thing, lay_out};
use prefix::Prefix;
pub use prefix::nearest_command;
pub(super) use prefix::{is_bare, is_word_char};
pub(super) use signs::Signs;

/// Reads the statements of `text`, which diagnostics know as `source`.
///
/// A statement that cannot be read gives one diagnostic, and the next one follows: where it is not
/// told where the statement ends, as a bracket is never closed, the next line that begins with a
/// command. Within a block nothing follows then.
///
/// ```
/// use linkwork::diag::SourceId;
/// use linkwork::lang::parse;
///
/// let mut statements = parse(SourceId(0), "point A = (0, 0)\nlenght A B; step");
/// assert!(statements.next().unwrap().is_ok());
/// assert!(statements.next().unwrap().is_err());
/// assert!(statements.next().unwrap().is_ok());
/// assert!(statements.next().is_none());
///
/// let mut statements = parse(SourceId(0), "point A = (0,\n  0\npoint B = (1, 1)");
/// assert!(statements.next().unwrap().is_err());
/// assert!(statements.next().unwrap().is_ok());
/// ```
pub fn parse(source: SourceId, text: &str) -> Statements<'_> {
    // A byte order mark is no part of the text.
    let start = if text.starts_with('\u{feff}') { '\u{feff}'.len_utf8() } else { 0 };
    Statements {
        reader: Reader { source, text },
        layout: Layout::new(text, start..text.len()),
        memory: Memory::default(),
        n_broken: 0,
    }
}

/// The statements of a text, read one by one; made by [`parse`].
#[derive(Debug, Clone)]
pub struct Statements<'a> {
    reader: Reader<'a>,
    layout: Layout<'a>,
    memory: Memory,
    /// How many statements were broken off.
    n_broken: usize,
}

/// After so many statements that are broken off nothing follows: each was looked for an end up to the end
/// of the text.
const MOST_BROKEN: usize = 64;

impl Iterator for Statements<'_> {
    type Item = Result<Statement, Diagnostic>;

    fn next(&mut self) -> Option<Self::Item> {
        Some(match self.layout.next_piece()? {
            Ok(piece) => self.reader.statement(&piece, &mut self.memory),
            Err(flaw) => {
                self.n_broken += 1;
                if let Some(broken) = self.layout.broken_off(flaw)
                    && self.n_broken < MOST_BROKEN
                {
                    self.layout.go_on(self.reader.next_command(broken));
                }
                Err(self.reader.flaw(flaw))
            }
        })
    }
}

/// Would more lines make a whole of this text? So a session knows to ask for another one.
///
/// True if a bracket is open, or the last line ends in a comma or a `\`, and what stands
/// there so far has no mistake that more text could not mend.
///
/// ```
/// use linkwork::lang::is_incomplete;
///
/// assert!(is_incomplete("for i in 1..3 {"));
/// assert!(is_incomplete("point A = (0, 0),"));
/// assert!(!is_incomplete("step 10"));
/// assert!(!is_incomplete("print )("));
/// ```
pub fn is_incomplete(text: &str) -> bool {
    let Statements { reader, layout, memory, .. } = parse(SourceId(0), text);
    matches!(reader.state(layout, memory), State::Open)
}

/// Does a block in braces belong to the statement?
fn has_block(rule: Rule) -> bool {
    matches!(rule, Rule::for_ | Rule::define)
}

/// How far a text is from being one that can run.
enum State {
    Whole,
    /// More text can make it whole.
    Open,
    /// No text behind it can.
    Broken,
}

/// What reading a letter takes, in ticks.
const LETTER: usize = 40;

/// A text and the name under which diagnostics know it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Reader<'a> {
    pub source: SourceId,
    pub text: &'a str,
}

impl Reader<'_> {
    fn span(&self, range: Range<usize>) -> Span {
        Span::new(self.source, range)
    }

    fn statement(&self, piece: &Piece, memory: &mut Memory) -> Result<Statement, Diagnostic> {
        tick(LETTER * piece.head.len());
        let (prefix, rule) = match memory.recall(self.text, &piece.head) {
            Some(rule) if memory.n_prefix == 0 => (Prefix::default(), rule),
            Some(rule) => (self.prefix_in(&memory.row)?.0, rule),
            None => self.read_anew(&piece.head, memory)?,
        };
        let whole = Parsed::new(self.text, &memory.row, memory.n_prefix);
        let word = || prefix::first_word(whole.as_str());
        let block = match (&piece.block, has_block(rule)) {
            (Some(block), true) => self.block(block)?,
            (None, false) => Body::default(),
            (Some(block), false) => return Err(self.needless_block(word(), block.start - 1)),
            (None, true) => return Err(self.missing_block(word(), piece.head.end)),
        };
        let mut cursor = Cursor::new(*self, whole.inner());
        if rule != Rule::bare {
            cursor.pass_verb();
        }
        let command = Command::read(rule, &mut cursor, prefix.label, block)?;
        Ok(Statement { command, span: self.span(piece.whole.clone()) })
    }

    /// Has pest read the statement at `head`; what it has read is in the row then, and kept.
    fn read_anew(
        &self,
        head: &Range<usize>,
        memory: &mut Memory,
    ) -> Result<(Prefix, Rule), Diagnostic> {
        let (prefix, at) = self.prefix_into(head, &mut memory.row)?;
        memory.n_prefix = memory.row.len();
        let (_, rule) = self.verb(&prefix, &(at..head.end))?;
        self.read(rule, at..head.end, &mut memory.row)?;
        memory.keep(rule);
        Ok((prefix, rule))
    }

    /// Where the first line behind a place begins that begins with a command; the end, if none does.
    fn next_command(&self, behind: usize) -> usize {
        let mut ends = self.text[behind..].match_indices('\n').map(|(end, _)| behind + end + 1);
        let begins_with_command = |at: &usize| {
            let line = self.text[*at..].lines().next().unwrap_or_default();
            let head = at + line.len() - line.trim_start().len()..at + line.len();
            let has_word = !prefix::first_word(&self.text[head.clone()]).is_empty();
            has_word
                && self.prefix(&head).is_ok_and(|(prefix, verb)| {
                    let rule = self.verb(&prefix, &(verb..head.end));
                    rule.is_ok_and(|(_, rule)| rule != Rule::bare)
                })
        };
        ends.find(begins_with_command).unwrap_or(self.text.len())
    }

    fn block(&self, inside: &Range<usize>) -> Result<Body, Diagnostic> {
        let layout = Layout::new(self.text, inside.clone());
        let statements: Result<Vec<_>, _> =
            Statements { reader: *self, layout, memory: Memory::default(), n_broken: 0 }.collect();
        statements.map(Body::from)
    }

    /// Has pest read the bytes `range` of the text as a `rule`, and lays out what it has read.
    fn read(
        &self,
        rule: Rule,
        range: Range<usize>,
        row: &mut Vec<Thing>,
    ) -> Result<(), Diagnostic> {
        match LinkworkParser::parse(rule, &self.text[range.clone()]) {
            Ok(pairs) => {
                lay_out(pairs, range.start, row);
                Ok(())
            }
            Err(error) => Err(self.syntax_error(&error, rule, &range)),
        }
    }

    /// What is in `layout` so far, seen by who may add to it.
    fn state(&self, mut layout: Layout, mut memory: Memory) -> State {
        while let Some(piece) = layout.next_piece() {
            match piece {
                Ok(piece) => match self.statement(&piece, &mut memory) {
                    Ok(_) if layout.expects_more() => return State::Open,
                    Ok(_) => {}
                    Err(problem) if layout.expects_more() => {
                        return self.state_of(&problem, piece.head.end);
                    }
                    Err(_) => return State::Broken,
                },
                Err(Flaw::Unclosed { outermost, start, .. }) => {
                    return self.state_of_unclosed(start, outermost);
                }
                Err(_) => return State::Broken,
            }
        }
        State::Whole
    }

    /// A problem at the very end can be mended by more text.
    fn state_of(&self, problem: &Diagnostic, end: usize) -> State {
        let end = self.text[..end].trim_end().len();
        let at_end = problem.place().is_some_and(|span| span.start as usize >= end);
        if at_end { State::Open } else { State::Broken }
    }

    fn state_of_unclosed(&self, start: usize, outermost: usize) -> State {
        let end = self.text.len();
        if self.text.as_bytes()[outermost] == b'{' {
            let head = start..self.text[..outermost].trim_end().len().max(start);
            let piece = Piece { head, block: Some(end..end), whole: start..end };
            // A mistake within the block is told when it is closed: told at once, the rest of the
            // block would be taken for statements of their own.
            let read = self.statement(&piece, &mut Memory::default());
            return if read.is_ok() { State::Open } else { State::Broken };
        }
        let piece = Piece { head: start..end, block: None, whole: start..end };
        match self.statement(&piece, &mut Memory::default()) {
            // What seems whole is not: a bracket hides in a comment.
            Ok(_) => State::Open,
            Err(problem) => self.state_of(&problem, end),
        }
    }
}
