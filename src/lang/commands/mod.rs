//! What a statement asks for: a file for each family of commands, which says all of them.

mod building;
mod changing;
mod drawing;
mod looking;
mod making;
mod measuring;
mod running;

use std::fmt::{self, Formatter};
use std::sync::Arc;

use crate::diag::{Diagnostic, Span};

use super::catalogue::Entry;
use super::constraint::ConstraintDecl;
use super::expr::Name;
use super::grammar::Rule;
use super::lower::{self, Cursor};
pub use building::{Building, Definition};
pub use changing::Changing;
pub use drawing::{Column, Curves, Drawing, ExportPart, Expose, PicturePart, PlotPart};
pub use looking::{ListWhat, Looking, PrintItem};
pub use making::{Binding, DragTarget, Making, PointDecl};
pub use measuring::{FitRange, Goal, Label, Measuring, ResultItem};
pub use running::Running;

/// One command and its place in the text.
#[derive(Debug, Clone)]
pub struct Statement {
    /// What is to be done.
    pub command: Command,
    /// From its first character to its last.
    pub span: Span,
}

impl PartialEq for Statement {
    fn eq(&self, other: &Self) -> bool {
        self.command == other.command
    }
}

/// The statements between braces, parsed once however often they run.
pub type Body = Arc<[Statement]>;

/// What a statement asks for.
#[derive(Debug, Clone, PartialEq)]
pub enum Command {
    /// To make points and parameters, and to move them.
    Making(Making),
    /// To make a constraint: `coupler: length B C = 3.5`
    Constrain(Box<ConstraintDecl>),
    /// To change what is there.
    Changing(Changing),
    /// To let time pass, or the solver work.
    Running(Running),
    /// To answer a question.
    Looking(Looking),
    /// To measure, and to say what came of it.
    Measuring(Measuring),
    /// To draw and to record.
    Drawing(Drawing),
    /// To build big things from small ones.
    Building(Building),
}

/// How a command begins: the rule that reads its statement, and its help.
pub(super) struct Verb {
    pub rule: Rule,
    pub entry: Entry,
}

/// The families in the order of the reference, in which constraints come second.
pub(super) const FAMILIES: [&[Verb]; 7] = [
    making::VERBS,
    changing::VERBS,
    running::VERBS,
    looking::VERBS,
    measuring::VERBS,
    drawing::VERBS,
    building::VERBS,
];

impl Command {
    /// Whether it makes or changes things by itself, without letting time pass.
    pub fn is_edit(&self) -> bool {
        match self {
            Self::Constrain(_) => true,
            Self::Making(it) => it.is_edit(),
            Self::Changing(it) => it.is_edit(),
            Self::Building(it) => it.is_edit(),
            Self::Measuring(it) => it.is_edit(),
            Self::Running(_) | Self::Looking(_) | Self::Drawing(_) => false,
        }
    }

    /// Whether it does no more than to give something that is there another value.
    pub const fn is_adjustment(&self) -> bool {
        match self {
            Self::Making(it) => it.is_adjustment(),
            Self::Changing(it) => it.is_adjustment(),
            _ => false,
        }
    }

    /// The command whose statement `rule` has read.
    pub(super) fn read(
        rule: Rule,
        c: &mut Cursor,
        label: Option<Name>,
        block: Body,
    ) -> Result<Self, Diagnostic> {
        if let Some(constraint) = lower::constraint(rule, c) {
            let constraint = constraint?;
            return Ok(Self::Constrain(Box::new(ConstraintDecl { label, constraint })));
        }
        if let Some(it) = Making::read(rule, c)? {
            return Ok(Self::Making(it));
        }
        if let Some(it) = Changing::read(rule, c)? {
            return Ok(Self::Changing(it));
        }
        if let Some(it) = Running::read(rule, c)? {
            return Ok(Self::Running(it));
        }
        if let Some(it) = Looking::read(rule, c)? {
            return Ok(Self::Looking(it));
        }
        if let Some(it) = Measuring::read(rule, c)? {
            return Ok(Self::Measuring(it));
        }
        if let Some(it) = Drawing::read(rule, c)? {
            return Ok(Self::Drawing(it));
        }
        match Building::read(rule, c, block)? {
            Some(it) => Ok(Self::Building(it)),
            None => panic!("{rule:?} is no verb's rule"),
        }
    }

    /// Writes its canonical form, blocks in it so far from the margin.
    pub(super) fn write(&self, f: &mut Formatter, level: usize) -> fmt::Result {
        match self {
            Self::Making(it) => it.write(f),
            Self::Constrain(it) => write!(f, "{it}"),
            Self::Changing(it) => it.write(f),
            Self::Running(it) => it.write(f),
            Self::Looking(it) => it.write(f),
            Self::Measuring(it) => it.write(f),
            Self::Drawing(it) => it.write(f),
            Self::Building(it) => it.write(f, level),
        }
    }
}

macro_rules! from_family {
    ($($Family:ident)*) => {
        $(
            impl From<$Family> for Command {
                fn from(it: $Family) -> Self {
                    Self::$Family(it)
                }
            }
        )*
    };
}

from_family! { Making Changing Running Looking Measuring Drawing Building }

/// The items `item` of all the `rule`s that follow.
fn each<'a, T>(
    c: &mut Cursor<'a>,
    rule: Rule,
    item: impl Fn(&mut Cursor<'a>) -> Result<T, Diagnostic>,
) -> Result<Vec<T>, Diagnostic> {
    let mut items = Vec::new();
    while let Some(pair) = c.take(rule) {
        items.push(item(&mut c.within(pair))?);
    }
    Ok(items)
}
