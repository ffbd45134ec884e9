//! The commands that measure and say what came of it: what each says, how it is read and written, and its help.

use std::fmt::{self, Display, Formatter};

use super::{Verb, each};
use crate::diag::{Diagnostic, Span};
use crate::lang::catalogue::{Entry, Section};
use crate::lang::expr::{Expr, Name, Unit};
use crate::lang::grammar::Rule;
use crate::lang::lower::Cursor;
use crate::lang::parts::Text;
use crate::lang::print::commas;

/// A command of this family.
#[derive(Debug, Clone, PartialEq)]
pub enum Measuring {
    /// `measure d = distance(C, A, B) in deg`
    Measure {
        /// The measure.
        name: Name,
        /// What it measures.
        value: Expr,
        /// What its values are counted in.
        unit: Unit,
    },
    /// `result span = d.span, "dead point" = x in deg`
    Result(Vec<ResultItem>),
}

/// One result.
#[derive(Debug, Clone, PartialEq)]
pub struct ResultItem {
    /// What it is called.
    pub label: Label,
    /// What it is.
    pub value: Expr,
    /// What it is counted in.
    pub unit: Unit,
}

/// What a result is called.
#[derive(Debug, Clone, PartialEq)]
pub enum Label {
    /// By a name, indices evaluated.
    Name(Name),
    /// By any text.
    Text(Text),
}

impl Label {
    /// Its place.
    pub const fn span(&self) -> Span {
        match self {
            Self::Name(name) => name.span,
            Self::Text(text) => text.span,
        }
    }
}

/// Each with the rule that reads it.
pub(in crate::lang) const VERBS: &[Verb] = &[
    Verb {
        rule: Rule::measure,
        entry: Entry {
            keyword: "measure",
            section: Section::Measuring,
            usage: "measure NAME = EXPRESSION [in UNIT]",
            summary: "follow a number from here on: one value a frame",
            help: "It takes the pose of now if that is solved, then a value each frame. It has `.min`, `.max`,\n\
                 `.span`, `.mean` (over time), `.first`, `.last`, `.at_min` and `.at_max` (the times) and\n\
                 `.count`, in any expression but those of constraints. Extremes between frames are found\n\
                 from the velocities; `set measures sampled` leaves it at the values of frames. `reset`\n\
                 empties it; declared again it begins anew. Its lone name shows it.",
            example: "measure d = distance(C, L, R)\n\
                 measure mu = angle(B, C, D, C) in deg\n\
                 print d.span, mu.min, mu.at_min",
        },
    },
    Verb {
        rule: Rule::result,
        entry: Entry {
            keyword: "result",
            section: Section::Measuring,
            usage: "result NAME|TEXT = VALUE [in UNIT], ...",
            summary: "say what a run is for: a line each, and a column of `sweep`",
            help: "Said twice, the last one counts. A vector gives two, `NAME.x` and `NAME.y`.",
            example: "result span = d.span, \"at the top\" = d.at_max\n\
                 result turned = angle(A, B) in deg",
        },
    },
];

impl Measuring {
    /// Whether it changes what there is, and does not only say it.
    pub const fn is_edit(&self) -> bool {
        matches!(self, Self::Measure { .. })
    }

    /// The command whose statement `rule` has read; none if it is of another family.
    pub(in crate::lang) fn read(rule: Rule, c: &mut Cursor) -> Result<Option<Self>, Diagnostic> {
        Ok(Some(match rule {
            Rule::measure => {
                let (name, value) = (c.name()?, c.expr()?);
                Self::Measure { name, value, unit: unit(c)? }
            }
            Rule::result => Self::Result(each(c, Rule::result_item, result_item)?),
            _ => return Ok(None),
        }))
    }

    /// Writes its canonical form.
    pub(in crate::lang) fn write(&self, f: &mut Formatter) -> fmt::Result {
        match self {
            Self::Measure { name, value, unit } => {
                write!(f, "measure {name} = {value}{}", InUnit(*unit))
            }
            Self::Result(items) => write!(f, "result {}", commas(items)),
        }
    }
}

fn unit(c: &mut Cursor) -> Result<Unit, Diagnostic> {
    Ok(c.unit_if_any()?.unwrap_or(Unit::None))
}

fn result_item(c: &mut Cursor) -> Result<ResultItem, Diagnostic> {
    let label = match c.text_if_any()? {
        Some(text) => Label::Text(text),
        None => Label::Name(c.name()?),
    };
    Ok(ResultItem { label, value: c.expr()?, unit: unit(c)? })
}

/// The unit of a value behind it, if it has one.
struct InUnit(Unit);

impl Display for InUnit {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        match self.0 {
            Unit::None => Ok(()),
            unit => write!(f, " in {}", unit.suffix()),
        }
    }
}

impl Display for ResultItem {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        let Self { label, value, unit } = self;
        write!(f, "{label} = {value}{}", InUnit(*unit))
    }
}

impl Display for Label {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        match self {
            Self::Name(name) => write!(f, "{name}"),
            Self::Text(text) => write!(f, "{text}"),
        }
    }
}
