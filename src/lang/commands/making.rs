//! The commands that make points and parameters and move them: what each says, how it is read and written, and its help.

use std::fmt::{self, Display, Formatter};

use super::{Verb, each};
use crate::diag::Diagnostic;
use crate::lang::catalogue::{Entry, Section};
use crate::lang::expr::{Expr, Name};
use crate::lang::grammar::Rule;
use crate::lang::lower::Cursor;
use crate::lang::parts::Selection;
use crate::lang::print::{Clause, commas};

/// A command of this family.
#[derive(Debug, Clone, PartialEq)]
pub enum Making {
    /// `let r = 3, s = 2 * r`
    Let(Vec<Binding>),
    /// `point A = (0, 0) frozen, B = (1, 0)`
    Point(Vec<PointDecl>),
    /// `freeze A B`, `freeze all`
    Freeze(Selection),
    /// `thaw A B`, `thaw all`
    Thaw(Selection),
    /// `move B to (2, 3)`
    Move {
        /// The point.
        point: Name,
        /// Where it goes, at once.
        to: Expr,
    },
    /// `drag A to (3, 4), B to (0, 1) over 60`
    Drag {
        /// The points and where each goes.
        targets: Vec<DragTarget>,
        /// The number of frames it takes; none but 0 where the clock stands still.
        over: Option<Expr>,
    },
    /// `pull A to (8, 0) over 40`: as near as the constraints allow.
    Pull {
        /// The points and where each is pulled.
        targets: Vec<DragTarget>,
        /// The number of frames it takes; none but 0 where the clock stands still.
        over: Option<Expr>,
    },
}

/// `r = 3` in a `let`.
#[derive(Debug, Clone, PartialEq)]
pub struct Binding {
    /// The parameter.
    pub name: Name,
    /// Stays an expression.
    pub value: Expr,
}

/// `A = (0, 0) frozen` in a `point`.
#[derive(Debug, Clone, PartialEq)]
pub struct PointDecl {
    /// The new point.
    pub name: Name,
    /// Where it starts.
    pub at: Expr,
    /// Is it immovable?
    pub frozen: bool,
}

/// `A to (3, 4)` or `A through (1, 0), (2, 2)` in a `drag`.
#[derive(Debug, Clone, PartialEq)]
pub struct DragTarget {
    /// The point.
    pub point: Name,
    /// Where its way leads through, the end last; at least one.
    pub places: Vec<Expr>,
}

/// Each with the rule that reads it.
pub(in crate::lang) const VERBS: &[Verb] = &[
    Verb {
        rule: Rule::point,
        entry: Entry {
            keyword: "point",
            section: Section::Points,
            usage: "point NAME = POSITION [frozen], ...",
            summary: "declare points where they start",
            help: "The position is a starting value: constraints move a point that is not frozen.\n\
                 A frozen point stays where it is until it is moved, dragged or thawed.",
            example: "point A = (0, 0) frozen, B = A + (1, 0)",
        },
    },
    Verb {
        rule: Rule::let_,
        entry: Entry {
            keyword: "let",
            section: Section::Points,
            usage: "let NAME = EXPRESSION, ...",
            summary: "define a parameter, or change one",
            help: "The expression stays an expression: when a parameter in it changes, or it mentions\n\
                 `time`, all that depends on it follows at once.",
            example: "let r = 3\n\
                 let s = 2 * r + sin(time)",
        },
    },
    Verb {
        rule: Rule::freeze,
        entry: Entry {
            keyword: "freeze",
            section: Section::Points,
            usage: "freeze NAMES | all",
            summary: "make points immovable",
            help: "",
            example: "freeze A B\n\
                 freeze all",
        },
    },
    Verb {
        rule: Rule::thaw,
        entry: Entry {
            keyword: "thaw",
            section: Section::Points,
            usage: "thaw NAMES | all",
            summary: "let frozen points move again",
            help: "",
            example: "thaw A\n\
                 thaw all",
        },
    },
    Verb {
        rule: Rule::move_,
        entry: Entry {
            keyword: "move",
            section: Section::Points,
            usage: "move NAME to POSITION",
            summary: "put a point somewhere else, at once",
            help: "The constraints then act.",
            example: "move B to (2, 3)",
        },
    },
    Verb {
        rule: Rule::drag,
        entry: Entry {
            keyword: "drag",
            section: Section::Points,
            usage: "drag NAME to POSITION | through POSITIONS, ... [over FRAMES]",
            summary: "draw points along straight lines, simulating",
            help: "A point that is not frozen is frozen for the drag and thawed after it. The pieces of a path\n\
                 get frames by their length. `over 0` lets the clock stand still.",
            example: "drag A to (3, 4) over 60\n\
                 drag A to (3, 4), B to (0, 1) over 60\n\
                 drag A through (1, 0), (1, 2), (2, 2) over 40\n\
                 drag A to (3, 4) over 0",
        },
    },
    Verb {
        rule: Rule::pull,
        entry: Entry {
            keyword: "pull",
            section: Section::Points,
            usage: "pull NAME to POSITION | through POSITIONS, ... [over FRAMES]",
            summary: "draw points as near to places as the constraints allow",
            help: "Nothing is torn: each frame ends on the pose nearest to the hand among those that meet all\n\
                 constraints. Let go, a point stays where it is. Motors turn on; `over 0` lets the clock\n\
                 stand still.",
            example: "pull A to (8, 0) over 40\n\
                 pull A through (1, 0), (1, 2), B to (0, 1) over 40\n\
                 pull A to (8, 0) over 0",
        },
    },
];

impl Making {
    /// Whether it makes or changes things, without letting time pass.
    pub(super) fn is_edit(&self) -> bool {
        !matches!(self, Self::Drag { .. } | Self::Pull { .. })
    }

    /// Whether it gives something that is there another value.
    pub(super) const fn is_adjustment(&self) -> bool {
        matches!(self, Self::Let(_) | Self::Move { .. })
    }

    /// The command whose statement `rule` has read; none if it is of another family.
    pub(in crate::lang) fn read(rule: Rule, c: &mut Cursor) -> Result<Option<Self>, Diagnostic> {
        Ok(Some(match rule {
            Rule::let_ => Self::Let(each(c, Rule::binding, binding)?),
            Rule::point => Self::Point(each(c, Rule::point_decl, point_decl)?),
            Rule::freeze => Self::Freeze(c.selection()?),
            Rule::thaw => Self::Thaw(c.selection()?),
            Rule::move_ => Self::Move { point: c.name()?, to: c.expr()? },
            Rule::drag => {
                let targets = each(c, Rule::drag_target, drag_target)?;
                Self::Drag { targets, over: c.expr_if_any()? }
            }
            Rule::pull => {
                let targets = each(c, Rule::drag_target, drag_target)?;
                Self::Pull { targets, over: c.expr_if_any()? }
            }
            _ => return Ok(None),
        }))
    }

    /// Writes its canonical form.
    pub(in crate::lang) fn write(&self, f: &mut Formatter) -> fmt::Result {
        match self {
            Self::Let(bindings) => write!(f, "let {}", commas(bindings)),
            Self::Point(points) => write!(f, "point {}", commas(points)),
            Self::Freeze(what) => write!(f, "freeze {what}"),
            Self::Thaw(what) => write!(f, "thaw {what}"),
            Self::Move { point, to } => write!(f, "move {point} to {to}"),
            Self::Drag { targets, over } => {
                write!(f, "drag {}{}", commas(targets), Clause(" over ", over))
            }
            Self::Pull { targets, over } => {
                write!(f, "pull {}{}", commas(targets), Clause(" over ", over))
            }
        }
    }
}

fn binding(c: &mut Cursor) -> Result<Binding, Diagnostic> {
    Ok(Binding { name: c.name()?, value: c.expr()? })
}

fn point_decl(c: &mut Cursor) -> Result<PointDecl, Diagnostic> {
    let (name, at) = (c.name()?, c.expr()?);
    Ok(PointDecl { name, at, frozen: c.flag(Rule::kw_frozen) })
}

fn drag_target(c: &mut Cursor) -> Result<DragTarget, Diagnostic> {
    Ok(DragTarget { point: c.name()?, places: c.exprs()? })
}

impl Display for Binding {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        write!(f, "{} = {}", self.name, self.value)
    }
}

impl Display for PointDecl {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        let frozen = if self.frozen { " frozen" } else { "" };
        write!(f, "{} = {}{frozen}", self.name, self.at)
    }
}

impl Display for DragTarget {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        let word = if self.places.len() == 1 { "to" } else { "through" };
        write!(f, "{} {word} {}", self.point, commas(&self.places))
    }
}
