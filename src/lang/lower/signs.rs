//! Which signs of a statement compute: for who sets the blanks around them.

use std::collections::HashSet;
use std::ops::Range;

use pest::Parser;
use pest::iterators::Pairs;

use super::Reader;
use crate::diag::Diagnostic;
use crate::lang::grammar::{LinkworkParser, Rule};

/// Where the operators and numbers of a statement stand, as offsets in its text.
#[derive(Debug, Default)]
pub struct Signs {
    /// Operators between two operands.
    binary: HashSet<usize>,
    /// Signs in front of one.
    unary: HashSet<usize>,
    /// Where numbers begin.
    numbers: HashSet<usize>,
}

impl Signs {
    /// Does the operator at `at` stand between two operands?
    pub fn is_binary(&self, at: usize) -> bool {
        self.binary.contains(&at)
    }

    /// Does the sign at `at` belong to what follows it?
    pub fn is_unary(&self, at: usize) -> bool {
        self.unary.contains(&at)
    }

    /// Does a number begin at `at`?
    pub fn is_number(&self, at: usize) -> bool {
        self.numbers.contains(&at)
    }

    fn note(&mut self, pairs: Pairs<'_, Rule>, start: usize) {
        for pair in pairs.flatten() {
            let at = start + pair.as_span().start();
            match pair.as_rule() {
                Rule::operator => drop(self.binary.insert(at)),
                Rule::minus => drop(self.unary.insert(at)),
                Rule::number => drop(self.numbers.insert(at)),
                _ => {}
            }
        }
    }
}

impl Reader<'_> {
    /// The signs of the statement at `head`, its block left out.
    pub fn signs(&self, head: &Range<usize>) -> Result<Signs, Diagnostic> {
        let mut signs = Signs::default();
        let (prefix, at) = self.prefix(head)?;
        let range = at..head.end;
        let (_, rule) = self.verb(&prefix, &range)?;
        for (rule, range) in [(Rule::prefix, head.clone()), (rule, range)] {
            if let Ok(pairs) = LinkworkParser::parse(rule, &self.text[range.clone()]) {
                signs.note(pairs, range.start);
            }
        }
        Ok(signs)
    }
}
