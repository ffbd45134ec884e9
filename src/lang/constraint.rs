//! What a constraint's statement says: a word, and parts that say what they are.

use super::catalogue::ConstraintWord;
use super::expr::{Expr, Name};

/// A constraint with the name it is to have.
#[derive(Debug, Clone, PartialEq)]
pub struct ConstraintDecl {
    /// The name in front of the colon.
    pub label: Option<Name>,
    /// The constraint.
    pub constraint: Constraint,
}

/// A constraint as stated; [`ConstraintWord::pattern`] says which parts a word takes.
#[derive(Debug, Clone, PartialEq)]
pub struct Constraint {
    /// The word it begins with.
    pub word: ConstraintWord,
    /// What stands behind it, in canonical order.
    pub parts: Vec<Part>,
}

/// A part of a constraint's statement, or of a `change`.
#[derive(Debug, Clone, PartialEq)]
pub enum Part {
    /// `A`, `A B`, `A B C`
    Points(Vec<Name>),
    /// `c =`: the name of what the statement makes.
    Defined(Name),
    /// `through P`, `from P`, `to P`, `at P`: one point; `on c`: a circle or an arc.
    Point(Role, Name),
    /// What is held: a number, or a vector.
    Measure(Expr),
    /// `on A B`, `to A B`, `about A B`, `from A B`
    Line(Role, Pair),
    /// `= e`, `<= e`, `in a..b`; in a `change` of a point or a parameter `= e`.
    Relation(Relation),
    /// `radius e`, `at e`
    Value(Role, Expr),
    /// `teeth e, e`
    Values(Role, Box<[Expr; 2]>),
    /// `inside`, `crossed`, `unbounded`
    Flag(Role),
}

/// What a part is for, said by the word that it begins with.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Role {
    /// `on A B`: what a point slides on or a wheel rolls along.
    On,
    /// `to A B`: what a distance is measured to.
    To,
    /// `about A B`: the axis of a symmetry.
    About,
    /// `from A B`: the direction that an angle is measured from.
    From,
    /// `radius e`
    Radius,
    /// `speed e`: an angle per time unit.
    Speed,
    /// `phase e`: the angle at the start.
    Phase,
    /// `at e`: a place, or where between two points.
    At,
    /// `ratio e`: the second of two to the first.
    Ratio,
    /// `teeth e, e`: of the first of two wheels, and of the second.
    Teeth,
    /// `inside`
    Inside,
    /// `crossed`
    Crossed,
    /// `unbounded`
    Unbounded,
    /// `through P`: a point of a circle.
    Through,
}

impl Role {
    /// The word.
    pub const fn word(self) -> &'static str {
        match self {
            Self::On => "on",
            Self::To => "to",
            Self::About => "about",
            Self::From => "from",
            Self::Radius => "radius",
            Self::Speed => "speed",
            Self::Phase => "phase",
            Self::At => "at",
            Self::Ratio => "ratio",
            Self::Teeth => "teeth",
            Self::Inside => "inside",
            Self::Crossed => "crossed",
            Self::Unbounded => "unbounded",
            Self::Through => "through",
        }
    }
}

/// Two points, in order: from the first to the second.
#[derive(Debug, Clone, PartialEq)]
pub struct Pair {
    /// The first point.
    pub from: Name,
    /// The second point.
    pub to: Name,
}

/// What must hold for a value.
#[derive(Debug, Clone, PartialEq)]
pub enum Relation {
    /// `= e`
    Equal(Expr),
    /// `< e`
    Less(Expr),
    /// `<= e`
    LessEqual(Expr),
    /// `> e`
    Greater(Expr),
    /// `>= e`
    GreaterEqual(Expr),
    /// `in a..b`
    In(Range),
}

/// `a..b`, both ends included.
#[derive(Debug, Clone, PartialEq)]
pub struct Range {
    /// The lower end.
    pub from: Expr,
    /// The upper end.
    pub to: Expr,
}
