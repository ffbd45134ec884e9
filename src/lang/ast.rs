//! What a script says, as data: statements, and what they are made of.
//!
//! Two trees are equal if they say the same: spans, parentheses and layout do not count.

use std::sync::Arc;

use crate::diag::Span;
pub use crate::terms::{Function, Operator};

pub use super::catalogue::ConstraintWord;
pub use super::constraint::{Constraint, ConstraintDecl, Pair, Part, Range, Relation, Role};
pub use super::expr::{Axis, Expr, Ident, Name, NamePart, Node, Number, PartKind, Unit};

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
        /// The number of frames it takes.
        over: Option<Expr>,
    },
    /// `coupler: length B C = 3.5`
    Constrain(Box<ConstraintDecl>),

    /// `delete coupler`, `delete C cascade`
    Delete {
        /// What goes.
        names: Vec<Name>,
        /// Does all that uses it go too?
        cascade: bool,
    },
    /// `off crank`: out of the active list.
    Off(Vec<Name>),
    /// `on crank`: back into the active list.
    On(Vec<Name>),
    /// `change crank speed 2rev`
    Change {
        /// What changes.
        name: Name,
        /// The trailing parts of the statement that made it; at least one.
        parts: Vec<Part>,
    },
    /// `set`: all settings are printed. `set dt`: this one.
    Settings(Option<Ident>),
    /// `set dt 1/360`, `set method newton`, `set rho 0.25 for coupler`
    Set {
        /// Which setting.
        setting: Ident,
        /// Its value; a word is a [`Node::Name`], see [`Expr::as_word`].
        value: Expr,
        /// What it is set for; empty: for the whole session.
        targets: Vec<Name>,
    },
    /// `undo`, `undo 3`
    Undo(Option<Expr>),
    /// `redo`, `redo 3`
    Redo(Option<Expr>),
    /// `reset`
    Reset,
    /// `clear`
    Clear,

    /// `step`, `step 360 within 1e-9 in 2ms`
    Step {
        /// The number of frames.
        frames: Option<Expr>,
        /// What must hold for each frame.
        promise: Promise,
    },
    /// `run 2.5`
    Run {
        /// The simulated time.
        time: Expr,
        /// What must hold for each frame.
        promise: Promise,
    },
    /// `relax`, `relax 100`
    Relax(Option<Expr>),
    /// `solve`
    Solve(Promise),

    /// `list`, `list points`
    List(Option<ListWhat>),
    /// `show C`
    Show(Name),
    /// `print C, distance(A, C), "text"`
    Print(Vec<PrintItem>),
    /// `check`
    Check,
    /// `why C`
    Why(Name),
    /// `limits crank`
    Limits(Name),
    /// `effects`
    Effects,
    /// `accuracy`, `accuracy within 1e-9 in 2ms`
    Accuracy(Promise),
    /// `assert distance(u, t, p) = 0 within 1e-9`
    Assert {
        /// The left-hand side.
        left: Expr,
        /// How it compares, and to what.
        relation: Relation,
        /// The tolerance.
        within: Option<Expr>,
    },
    /// `help`, `help motor`
    Help(Option<Ident>),

    /// `trace C every 5`
    Trace {
        /// The points.
        names: Vec<Name>,
        /// Only each so many frames.
        every: Option<Expr>,
    },
    /// `untrace C`, `untrace all`
    Untrace(Selection),
    /// `expose`, `expose every 30`, `expose off`
    Expose(Expose),
    /// `svg "now.svg"`
    Svg(Text),
    /// `record "frames/" every 10`
    Record {
        /// The file or folder.
        path: Text,
        /// Only each so many frames.
        every: Option<Expr>,
    },
    /// `record stop`
    RecordStop,
    /// `sample "relaxation" = e`: the next values of a series.
    Sample {
        /// Which series.
        series: Text,
        /// Its next values, at least one.
        values: Vec<Expr>,
    },
    /// `plot "errors.svg" log title "..." x "..." y "..."`: all series as a chart.
    Plot {
        /// The file.
        path: Text,
        /// How it looks.
        parts: Vec<PlotPart>,
    },

    /// `for i in 1..10 { ... }`, both ends included
    For {
        /// The loop variable.
        variable: Ident,
        /// Its first and last value.
        range: Range,
        /// What is repeated.
        body: Body,
    },
    /// `define dyad(A, B, a, b) { ... }`
    Define(Arc<Definition>),
    /// `use dyad(A, D, 3, 3.5) as left`
    Use {
        /// Which definition.
        definition: Ident,
        /// What stands for its parameters.
        arguments: Vec<Expr>,
        /// The instance's name.
        instance: Option<Name>,
    },
    /// `include "leg.link"`
    Include(Text),
    /// `save "session.link"`
    Save(Text),
    /// `load "session.link"`
    Load(Text),
    /// `restore turns crank = 0.25, 3`: state that no other statement can bring back.
    Restore {
        /// What sort of state.
        what: Ident,
        /// Whose.
        name: Option<Name>,
        /// Its values, constant expressions.
        values: Vec<Expr>,
    },
    /// `quit`, `exit`
    Quit,
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

/// `A to (3, 4)` in a `drag`.
#[derive(Debug, Clone, PartialEq)]
pub struct DragTarget {
    /// The point.
    pub point: Name,
    /// Where it ends.
    pub to: Expr,
}

/// Some names, or every one there is.
#[derive(Debug, Clone, PartialEq)]
pub enum Selection {
    /// `all`
    All,
    /// At least one name.
    Names(Vec<Name>),
}

/// What a run promises for each of its frames: a broken one is a failure.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Promise {
    /// `within e`: the tolerance that each frame reaches.
    pub within: Option<Expr>,
    /// `in e`: the wall time that no frame exceeds.
    pub in_time: Option<Expr>,
}

/// What a `list` lists.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum ListWhat {
    /// `list points`
    Points,
    /// `list constraints`
    Constraints,
    /// `list traces`
    Traces,
    /// `list parameters`
    Parameters,
    /// `list definitions`
    Definitions,
}

impl ListWhat {
    /// Every list, in the order of the reference.
    pub const ALL: [Self; 5] =
        [Self::Points, Self::Constraints, Self::Traces, Self::Parameters, Self::Definitions];

    /// How it is asked for.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Points => "points",
            Self::Constraints => "constraints",
            Self::Traces => "traces",
            Self::Parameters => "parameters",
            Self::Definitions => "definitions",
        }
    }
}

/// One item of a `print`.
#[derive(Debug, Clone, PartialEq)]
pub enum PrintItem {
    /// A number or a vector.
    Value(Expr),
    /// A text, as it is.
    Text(Text),
}

/// What an `expose` asks for.
#[derive(Debug, Clone, PartialEq)]
pub enum Expose {
    /// `expose`: one ghost of what is now.
    Now,
    /// `expose every 30`: a ghost each so many frames.
    Every(Expr),
    /// `expose off`
    Off,
}

/// One part of a `plot`, each at most once.
#[derive(Debug, Clone, PartialEq)]
pub enum PlotPart {
    /// `log`: equal ratios are equally high.
    Log,
    /// `title "..."`
    Title(Text),
    /// `x "..."`: what the numbers to the right count.
    X(Text),
    /// `y "..."`: what the values are.
    Y(Text),
}

/// A named group of statements with parameters.
#[derive(Debug, Clone, PartialEq)]
pub struct Definition {
    /// Its name.
    pub name: Ident,
    /// What its body may name of the outside.
    pub parameters: Vec<Ident>,
    /// What an instance consists of.
    pub body: Body,
}

/// A string literal.
#[derive(Debug, Clone)]
pub struct Text {
    /// What it says, escapes resolved.
    pub value: Arc<str>,
    /// With its quotes.
    pub span: Span,
}

impl PartialEq for Text {
    fn eq(&self, other: &Self) -> bool {
        self.value == other.value
    }
}
