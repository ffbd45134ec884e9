//! Trees to text: the canonical form, which reads back to an equal tree.

use std::fmt::{self, Display, Formatter};

mod constraint;
mod expr;

use super::ast::{
    Command, ConstraintDecl, Expr, Ident, Name, Promise, Range, Relation, Selection, Statement,
    Text,
};
use super::expr::{Node, Unit};

impl Display for Statement {
    /// On one line, or with its block on several, without a newline at the end.
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        write_indented(f, self, 0)
    }
}

impl Display for Command {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        self.write(f, 0)
    }
}

fn write_indented(f: &mut Formatter, statement: &Statement, level: usize) -> fmt::Result {
    write!(f, "{:1$}", "", 2 * level)?;
    statement.command.write(f, level)
}

/// Writes statements between braces.
pub(super) fn write_block(f: &mut Formatter, body: &[Statement], level: usize) -> fmt::Result {
    if body.is_empty() {
        return f.write_str("{}");
    }
    f.write_str("{\n")?;
    for statement in body {
        write_indented(f, statement, level + 1)?;
        f.write_str("\n")?;
    }
    write!(f, "{:1$}}}", "", 2 * level)
}

/// Items with `, ` between them.
pub(super) struct Commas<'a, T>(&'a [T]);

/// Puts `, ` between items.
pub(super) fn commas<T>(items: &[T]) -> Commas<'_, T> {
    Commas(items)
}

impl<T: Display> Display for Commas<'_, T> {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        for (position, item) in self.0.iter().enumerate() {
            write!(f, "{}{item}", if position == 0 { "" } else { ", " })?;
        }
        Ok(())
    }
}

/// A word and what follows it, if anything does.
pub(super) struct Clause<'a, T>(pub &'a str, pub &'a Option<T>);

impl<T: Display> Display for Clause<'_, T> {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        match self.1 {
            Some(value) => write!(f, "{}{value}", self.0),
            None => Ok(()),
        }
    }
}

/// Names in a row; a name that reads like a word that ends the row gets a comma before it.
pub(super) struct Names<'a> {
    pub names: &'a [Name],
    pub stops: &'a [&'a str],
}

impl Display for Names<'_> {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        for (position, name) in self.names.iter().enumerate() {
            let gap = match position {
                0 => "",
                _ if self.stops.contains(&&*name.head.text) => ", ",
                _ => " ",
            };
            write!(f, "{gap}{name}")?;
        }
        Ok(())
    }
}

/// The unit of a value behind it, if it has one.
pub(super) struct InUnit(pub Unit);

impl Display for InUnit {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        match self.0 {
            Unit::None => Ok(()),
            unit => write!(f, " in {}", unit.suffix()),
        }
    }
}

/// An expression, in parentheses if it begins with a word that would end it before it begins.
pub(super) struct Guarded<'a> {
    pub expr: &'a Expr,
    pub stops: &'a [&'a str],
}

impl Display for Guarded<'_> {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        let mut first = self.expr;
        while let Node::Binary(_, operands) = &first.node {
            first = &operands[0];
        }
        let word = first.as_name().map_or("", |name| &*name.head.text);
        if self.stops.contains(&word) {
            write!(f, "({})", self.expr)
        } else {
            write!(f, "{}", self.expr)
        }
    }
}

impl Display for ConstraintDecl {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        if let Some(label) = &self.label {
            write!(f, "{label}: ")?;
        }
        write!(f, "{}", self.constraint)
    }
}

impl Display for Relation {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        match self {
            Self::Equal(value) => write!(f, "= {value}"),
            Self::Less(value) => write!(f, "< {value}"),
            Self::LessEqual(value) => write!(f, "<= {value}"),
            Self::Greater(value) => write!(f, "> {value}"),
            Self::GreaterEqual(value) => write!(f, ">= {value}"),
            Self::In(range) => write!(f, "in {range}"),
        }
    }
}

impl Display for Range {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        write!(f, "{}..{}", self.from, self.to)
    }
}

impl Display for Promise {
    /// With a blank before each part.
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        write!(f, "{}{}", Clause(" within ", &self.within), Clause(" in ", &self.in_time))
    }
}

impl Display for Selection {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        match self {
            Self::All => f.write_str("all"),
            Self::Names(names) => write!(f, "{}", Names { names, stops: &[] }),
        }
    }
}

impl Display for Text {
    /// In quotes.
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        f.write_str("\"")?;
        for char in self.value.chars() {
            match char {
                '"' => f.write_str("\\\"")?,
                '\\' => f.write_str("\\\\")?,
                '\n' => f.write_str("\\n")?,
                char => write!(f, "{char}")?,
            }
        }
        f.write_str("\"")
    }
}

impl Display for Ident {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        f.write_str(&self.text)
    }
}
