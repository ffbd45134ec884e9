//! What pest has read of a statement, laid out in a row: to walk over it takes no counting and no copies.

use pest::Token;
use pest::iterators::Pairs;

use crate::lang::grammar::Rule;

/// What a rule has read; the things that it consists of follow it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Thing {
    pub rule: Rule,
    /// Where in the text it begins.
    pub start: u32,
    /// Where in the text it ends.
    pub end: u32,
    /// The place in the row behind it and all that it consists of.
    pub behind: u32,
}

/// Lays out what pest has read of the text from `base` on, behind what is there.
pub(super) fn lay_out(pairs: Pairs<'_, Rule>, base: usize, row: &mut Vec<Thing>) {
    let tokens = pairs.tokens();
    row.reserve(tokens.len() / 2);
    // The thing that began last of those that have not ended.
    let mut open = usize::MAX;
    for token in tokens {
        match token {
            Token::Start { rule, pos } => {
                let start = (base + pos.pos()) as u32;
                // Until it ends it says here which one it is in.
                row.push(Thing { rule, start, end: start, behind: open as u32 });
                open = row.len() - 1;
            }
            Token::End { pos, .. } => {
                let behind = row.len() as u32;
                let thing = &mut row[open];
                open = thing.behind as usize;
                thing.end = (base + pos.pos()) as u32;
                thing.behind = behind;
            }
        }
    }
}

/// A thing that a rule has read, and what it consists of.
#[derive(Clone, Copy)]
pub(in crate::lang) struct Parsed<'a> {
    text: &'a str,
    row: &'a [Thing],
    at: usize,
}

impl<'a> Parsed<'a> {
    /// The thing at a place in a row.
    pub(super) fn new(text: &'a str, row: &'a [Thing], at: usize) -> Self {
        Self { text, row, at }
    }

    pub fn rule(self) -> Rule {
        self.row[self.at].rule
    }

    pub fn start(self) -> usize {
        self.row[self.at].start as usize
    }

    pub fn end(self) -> usize {
        self.row[self.at].end as usize
    }

    /// What stands there.
    pub fn as_str(self) -> &'a str {
        &self.text[self.start()..self.end()]
    }

    /// What it consists of.
    pub fn inner(self) -> Things<'a> {
        let behind = self.row[self.at].behind as usize;
        Things { text: self.text, row: self.row, at: self.at + 1, behind }
    }
}

/// Things in a row, one after the other.
#[derive(Clone)]
pub(in crate::lang) struct Things<'a> {
    text: &'a str,
    row: &'a [Thing],
    at: usize,
    behind: usize,
}

impl<'a> Things<'a> {
    /// The next one.
    pub fn peek(&self) -> Option<Parsed<'a>> {
        (self.at < self.behind).then(|| Parsed::new(self.text, self.row, self.at))
    }
}

impl<'a> Iterator for Things<'a> {
    type Item = Parsed<'a>;

    fn next(&mut self) -> Option<Parsed<'a>> {
        let thing = self.peek()?;
        self.at = self.row[self.at].behind as usize;
        Some(thing)
    }
}
