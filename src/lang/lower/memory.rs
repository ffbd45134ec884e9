//! Statements that differ in their digits alone, of which pest has to read the first two.
//!
//! The grammar asks of a digit no more than whether it is one, and takes all that stand in a row. So
//! `point p[9] = (0.5, 12)` has the same parts as `point p[10] = (0.25, 3)`, each where its digits have
//! moved it. What the parts are worth is seen in each statement anew.

use std::hash::{DefaultHasher, Hasher};
use std::ops::Range;

use super::parsed::Thing;
use crate::lang::grammar::Rule;

/// As many shapes of statements are kept; a further one takes the place of the oldest.
const MOST_SHAPES: usize = 64;

/// As many shapes that were read once are known, of which the next one is kept.
const MOST_READ_ONCE: usize = 32;

/// Statements of a longer shape are all read by pest.
const LONGEST_SHAPE: usize = 160;

/// What was read of a statement, and what its text is apart from its digits.
#[derive(Debug, Clone)]
struct Shape {
    hash: u64,
    /// The text with a single `0` for all digits that stand in a row.
    text: Box<[u8]>,
    /// The places of the things are those in that text.
    row: Box<[Thing]>,
    n_prefix: usize,
    rule: Rule,
}

/// The statements of a text that were read last, by their shapes, and where the parts of one are.
#[derive(Debug, Clone, Default)]
pub(super) struct Memory {
    shapes: Vec<Shape>,
    /// How many were kept.
    n_kept: usize,
    /// The hashes of those that were read once: a text may have no two of a shape.
    read_once: Vec<u64>,
    /// How many were read.
    n_read: usize,
    /// The text of the present statement with a single `0` for digits in a row; empty if it is too long.
    text: Vec<u8>,
    /// Of that text.
    hash: u64,
    /// Where in the whole text each byte of that text stands, and its end.
    places: Vec<u32>,
    /// What was read of the present statement: its prefix, then all from its verb on.
    pub row: Vec<Thing>,
    /// How many things of the row are those of the prefix.
    pub n_prefix: usize,
}

impl Memory {
    /// The rule of the statement at `head`, if one of its shape was read before; its parts are then in
    /// the row. The row is empty otherwise.
    pub fn recall(&mut self, text: &str, head: &Range<usize>) -> Option<Rule> {
        self.row.clear();
        self.n_prefix = 0;
        self.look_at(text, head);
        let is_it = |shape: &&Shape| shape.hash == self.hash && *shape.text == *self.text;
        let shape = self.shapes.iter().find(is_it)?;
        let place = |at: u32| self.places[at as usize];
        let moved = |it: &Thing| Thing { start: place(it.start), end: place(it.end), ..*it };
        self.row.extend(shape.row.iter().map(moved));
        self.n_prefix = shape.n_prefix;
        Some(shape.rule)
    }

    /// Keeps what is in the row, that of the statement that was last looked for, which `rule` has read;
    /// if it is the second of its shape.
    pub fn keep(&mut self, rule: Rule) {
        // Whether values stand alone is found by what their first word resembles, its digits too.
        if self.text.is_empty() || rule == Rule::bare {
            return;
        }
        if !self.read_once.contains(&self.hash) {
            put(&mut self.read_once, MOST_READ_ONCE, &mut self.n_read, self.hash);
            return;
        }
        let place = |at: u32| self.places.partition_point(|place| *place < at) as u32;
        let moved = |it: &Thing| Thing { start: place(it.start), end: place(it.end), ..*it };
        let row = self.row.iter().map(moved).collect();
        let (text, n_prefix) = ((*self.text).into(), self.n_prefix);
        let shape = Shape { hash: self.hash, text, row, n_prefix, rule };
        put(&mut self.shapes, MOST_SHAPES, &mut self.n_kept, shape);
    }

    /// Takes the text of a statement down to its shape.
    fn look_at(&mut self, text: &str, head: &Range<usize>) {
        self.text.clear();
        self.places.clear();
        let bytes = &text.as_bytes()[..head.end];
        let mut at = head.start;
        while at < head.end {
            let is_digit = |byte: &u8| byte.is_ascii_digit();
            let n = bytes[at..].iter().position(is_digit).unwrap_or(head.end - at);
            let n_more = n + usize::from(at + n < head.end);
            if self.text.len() + n_more > LONGEST_SHAPE {
                self.text.clear();
                return;
            }
            self.text.extend_from_slice(&bytes[at..at + n]);
            self.places.extend(at as u32..(at + n) as u32);
            at += n;
            if at < head.end {
                self.text.push(b'0');
                self.places.push(at as u32);
                at += bytes[at..].iter().take_while(|byte| is_digit(byte)).count();
            }
        }
        self.places.push(head.end as u32);
        let mut hasher = DefaultHasher::new();
        hasher.write(&self.text);
        self.hash = hasher.finish();
    }
}

/// Puts a thing behind others, or in the place of the oldest where there are as many as there may be.
fn put<T>(things: &mut Vec<T>, most: usize, n_put: &mut usize, thing: T) {
    if things.len() < most {
        things.push(thing);
    } else {
        things[*n_put % most] = thing;
    }
    *n_put += 1;
}
