//! The commands that measure and say what came of it: what each says, how it is read and written, and its help.

use std::fmt::{self, Display, Formatter};

use super::{Verb, each};
use crate::diag::{Diagnostic, Span};
use crate::lang::catalogue::{Entry, Section};
use crate::lang::constraint::Range;
use crate::lang::expr::{Expr, Name, Unit};
use crate::lang::grammar::Rule;
use crate::lang::lower::Cursor;
use crate::lang::parts::Text;
use crate::lang::print::{Clause, InUnit, commas};

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
    /// `fit a in 2..4, b in 1..3 to minimise d.span over 360`
    Fit {
        /// The parameters, each with its least and greatest number.
        ranges: Vec<FitRange>,
        /// What they are to do.
        goal: Goal,
        /// The frames of a run; the clock stands still without.
        over: Option<Expr>,
    },
    /// `result span = d.span, "dead point" = x in deg`
    Result(Vec<ResultItem>),
}

/// `a in 2..4` in a `fit`.
#[derive(Debug, Clone, PartialEq)]
pub struct FitRange {
    /// The parameter.
    pub name: Name,
    /// Its least and greatest number.
    pub range: Range,
}

/// What a `fit` looks for.
#[derive(Debug, Clone, PartialEq)]
pub enum Goal {
    /// The least value of this.
    Minimise(Expr),
    /// The greatest value of this.
    Maximise(Expr),
    /// The path in this table.
    Path(Text),
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
        rule: Rule::fit,
        entry: Entry {
            keyword: "fit",
            section: Section::Measuring,
            usage: "fit NAME in RANGE, ... to minimise|maximise VALUE | FILE [over FRAMES]",
            summary: "find the numbers that do something best",
            help: "Each trial begins with the pose and the clock of now: the parameters get other numbers, the\n\
                 pose is solved, the frames pass, measures anew. A trial that is not solved throughout does not\n\
                 count. FILE is a table as `record` writes it: the point over its columns is to follow that\n\
                 path. The best numbers are those of the parameters then, and the pose is solved; one `undo`\n\
                 takes it back.",
            example: "fit a in 2..4, b in 1..3 to minimise d.span over 360\n\
                 fit h in 0..5 to maximise mu.min over 360\n\
                 fit a in 2..4, b in 1..3 to \"curve.csv\"",
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
        !matches!(self, Self::Result(_))
    }

    /// The command whose statement `rule` has read; none if it is of another family.
    pub(in crate::lang) fn read(rule: Rule, c: &mut Cursor) -> Result<Option<Self>, Diagnostic> {
        Ok(Some(match rule {
            Rule::measure => {
                let (name, value) = (c.name()?, c.expr()?);
                Self::Measure { name, value, unit: c.unit()? }
            }
            Rule::fit => {
                let ranges = each(c, Rule::fit_range, fit_range)?;
                let goal = match (c.clause(Rule::minimise)?, c.clause(Rule::maximise)?) {
                    (Some(value), _) => Goal::Minimise(value),
                    (_, Some(value)) => Goal::Maximise(value),
                    (None, None) => Goal::Path(c.text()?),
                };
                Self::Fit { ranges, goal, over: c.expr_if_any()? }
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
            Self::Fit { ranges, goal, over } => {
                write!(f, "fit {} to {goal}{}", commas(ranges), Clause(" over ", over))
            }
            Self::Result(items) => write!(f, "result {}", commas(items)),
        }
    }
}

fn fit_range(c: &mut Cursor) -> Result<FitRange, Diagnostic> {
    Ok(FitRange { name: c.name()?, range: c.range()? })
}

fn result_item(c: &mut Cursor) -> Result<ResultItem, Diagnostic> {
    let label = match c.text_if_any()? {
        Some(text) => Label::Text(text),
        None => Label::Name(c.name()?),
    };
    Ok(ResultItem { label, value: c.expr()?, unit: c.unit()? })
}

impl Display for FitRange {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        write!(f, "{} in {}", self.name, self.range)
    }
}

impl Display for Goal {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        match self {
            Self::Minimise(value) => write!(f, "minimise {value}"),
            Self::Maximise(value) => write!(f, "maximise {value}"),
            Self::Path(file) => write!(f, "{file}"),
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
