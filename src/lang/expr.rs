//! Expressions and the names in them, as written: nothing is looked up or computed here.

use std::sync::Arc;

use crate::diag::{Span, format_digits};

pub use crate::terms::Unit;
use crate::terms::{Function, Operator};

/// A value to be computed, and its place in the text.
#[derive(Debug, Clone)]
pub struct Expr {
    /// What it consists of.
    pub node: Node,
    /// With its parentheses, if it has some.
    pub span: Span,
}

impl PartialEq for Expr {
    fn eq(&self, other: &Self) -> bool {
        self.node == other.node
    }
}

impl Expr {
    /// The word, if it is a simple name: `newton` in `set method newton`.
    pub fn as_word(&self) -> Option<&Ident> {
        self.as_name().and_then(Name::as_simple)
    }

    /// The name, if it is one.
    pub fn as_name(&self) -> Option<&Name> {
        match &self.node {
            Node::Name(name) => Some(name),
            _ => None,
        }
    }

    /// The literal `value` in a unit, where that reads back to the same bits; without it
    /// otherwise.
    pub fn literal_in(value: f64, unit: Unit, span: Span) -> Self {
        let exact = value.abs() / unit.scale();
        let rounded = format_digits(exact, 15).parse().unwrap_or(exact);
        let reads_back = |written: &f64| written * unit.scale() == value.abs();
        let written = [rounded, exact].into_iter().find(reads_back).filter(|_| unit != Unit::None);
        let Some(written) = written else { return Self::literal(value, span) };
        let number = Self { node: Node::Number(Number { written, unit }), span };
        if value.is_sign_negative() {
            Self { node: Node::Negate(Box::new(number)), span }
        } else {
            number
        }
    }

    /// The literal `value` as the parser would read it: a negative one is a minus and a number.
    pub fn literal(value: f64, span: Span) -> Self {
        let number = Number { written: value.abs(), unit: Unit::None };
        let positive = Self { node: Node::Number(number), span };
        if value.is_sign_negative() {
            Self { node: Node::Negate(Box::new(positive)), span }
        } else {
            positive
        }
    }
}

/// The sorts of expressions.
#[derive(Debug, Clone, PartialEq)]
pub enum Node {
    /// `3`, `90deg`
    Number(Number),
    /// `pi`
    Pi,
    /// `tau`
    Tau,
    /// `time`
    Time,
    /// `r`, `left.B`, `p[i - 1].x`
    Name(Name),
    /// `-e`
    Negate(Box<Expr>),
    /// `a + b` and its like.
    Binary(Operator, Box<[Expr; 2]>),
    /// `(x, y)`
    Vector(Box<[Expr; 2]>),
    /// `e.x` where `e` is not a name; that of a name is the last part of it.
    Component(Box<Expr>, Axis),
    /// `sin(e)`; the number of arguments is one the function takes.
    Call(Function, Vec<Expr>),
}

/// A literal number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Number {
    /// The digits as they stand; finite and not negative.
    pub written: f64,
    /// The suffix.
    pub unit: Unit,
}

impl Number {
    /// What it is worth: `90deg` is pi/2.
    pub fn value(self) -> f64 {
        self.written * self.unit.scale()
    }
}

/// A component of a vector.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Axis {
    /// `.x`
    X,
    /// `.y`
    Y,
}

/// A single word.
#[derive(Debug, Clone)]
pub struct Ident {
    /// The word.
    pub text: Arc<str>,
    /// Its place.
    pub span: Span,
}

impl PartialEq for Ident {
    fn eq(&self, other: &Self) -> bool {
        self.text == other.text
    }
}

/// The name of a thing: a word, then index and member parts.
#[derive(Debug, Clone)]
pub struct Name {
    /// The word it begins with.
    pub head: Ident,
    /// What follows; empty in a simple name.
    pub parts: Box<[NamePart]>,
    /// All of it.
    pub span: Span,
}

impl PartialEq for Name {
    fn eq(&self, other: &Self) -> bool {
        self.head == other.head && self.parts == other.parts
    }
}

impl Name {
    /// The word, if that is all there is to it.
    pub fn as_simple(&self) -> Option<&Ident> {
        self.parts.is_empty().then_some(&self.head)
    }
}

/// One part of a name behind its first word.
#[derive(Debug, Clone)]
pub struct NamePart {
    /// What sort, and which.
    pub kind: PartKind,
    /// With its dot or brackets.
    pub span: Span,
}

impl PartialEq for NamePart {
    fn eq(&self, other: &Self) -> bool {
        self.kind == other.kind
    }
}

/// The sorts of parts of a name.
#[derive(Debug, Clone, PartialEq)]
pub enum PartKind {
    /// `.name`, or a component `.x` or `.y`: which, is known when the name is looked up.
    Member(Arc<str>),
    /// `[e]`, rounded to an integer when the name is looked up.
    Index(Expr),
}
