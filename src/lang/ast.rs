//! What a script says, as data: statements, and what they are made of.
//!
//! Two trees are equal if they say the same: spans, parentheses and layout do not count.

pub use crate::terms::{Function, Operator};

pub use super::catalogue::ConstraintWord;
pub use super::commands::{
    Binding, Body, Building, Changing, Column, Command, Curves, Definition, DragTarget, Drawing,
    ExportPart, Expose, FitRange, Goal, Label, ListWhat, Looking, Making, Measuring, PicturePart,
    PlotPart, PointDecl, PrintItem, ResultItem, Running, Statement,
};
pub use super::constraint::{Constraint, ConstraintDecl, Pair, Part, Range, Relation, Role};
pub use super::expr::{Axis, Expr, Ident, Name, NamePart, Node, Number, PartKind, Unit};
pub use super::parts::{Promise, Selection, Text};
