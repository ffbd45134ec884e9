//! What a constraint's statement says: its points and what must hold between them.

use super::expr::{Expr, Name};

/// A constraint with the name it is to have.
#[derive(Debug, Clone, PartialEq)]
pub struct ConstraintDecl {
    /// The name in front of the colon.
    pub label: Option<Name>,
    /// The constraint.
    pub constraint: Constraint,
}

/// Two points, in order: from the first to the second.
#[derive(Debug, Clone, PartialEq)]
pub struct Pair {
    /// The first point.
    pub from: Name,
    /// The second point.
    pub to: Name,
}

/// The constraints, each by its keyword.
#[derive(Debug, Clone, PartialEq)]
pub enum Constraint {
    /// `coordinate A at (3, 4)`
    Coordinate {
        /// The point.
        point: Name,
        /// Where it must be.
        at: Expr,
    },
    /// `coincidence A B`
    Coincidence(Pair),
    /// `equivalence A B, C D`
    Equivalence(Pair, Pair),
    /// `equal A B, C D`, `equal A B, C D in -1..1`
    Equal(Pair, Pair, Option<Relation>),
    /// `length A B = 3.5`, `length A B <= 5`
    Length(Pair, Option<Relation>),
    /// `orientation A B, C D = 90deg`
    Orientation(Pair, Pair, Option<Relation>),
    /// `motor O P radius 1 speed 1rev phase 90deg`
    Motor {
        /// From the centre to the rim.
        arm: Pair,
        /// The distance from the centre to the rim.
        radius: Option<Expr>,
        /// The angle per time unit.
        speed: Option<Expr>,
        /// The angle at the start.
        phase: Option<Expr>,
    },
    /// `glider P on A B`, `glider P on A B unbounded`
    Glider {
        /// The point that slides.
        point: Name,
        /// What it slides on.
        on: Pair,
        /// The whole line, not the segment alone?
        unbounded: bool,
    },
    /// `hinge P on A B at 1/3`
    Hinge {
        /// The point that is held.
        point: Name,
        /// The bar that holds it.
        on: Pair,
        /// Where on the bar: 0 at its first point, 1 at its second.
        at: Expr,
    },
    /// `cog O1 A, O2 B ratio 4`
    Cog {
        /// Centre and rim of the first wheel.
        first: Pair,
        /// Centre and rim of the second wheel.
        second: Pair,
        /// Radius of the second by radius of the first.
        ratio: Expr,
        /// Does one run inside of the other?
        inside: bool,
    },
    /// `distance P to A B = d`
    Distance {
        /// The point.
        point: Name,
        /// Two points of the line.
        line: Pair,
        /// What holds for the signed distance.
        relation: Option<Relation>,
    },
    /// `parallel A B, C D`
    Parallel(Pair, Pair),
    /// `perpendicular A B, C D`
    Perpendicular(Pair, Pair),
    /// `rigid A B C`: at least two points.
    Rigid(Vec<Name>),
    /// `rack O A on P Q`
    Rack {
        /// Centre and rim of the wheel.
        wheel: Pair,
        /// The line it rolls along.
        on: Pair,
    },
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
