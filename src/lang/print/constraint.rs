//! The canonical form of the constraints.

use std::fmt::{self, Display, Formatter};

use super::{Clause, Names};
use crate::lang::ast::{Constraint, Pair};

impl Display for Pair {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        write!(f, "{} {}", self.from, self.to)
    }
}

impl Display for Constraint {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        match self {
            Self::Coordinate { point, at } => write!(f, "coordinate {point} at {at}"),
            Self::Coincidence(points) => write!(f, "coincidence {points}"),
            Self::Equivalence(a, b) => write!(f, "equivalence {a}, {b}"),
            Self::Equal(a, b, relation) => {
                write!(f, "equal {a}, {b}{}", Clause(" ", relation))
            }
            Self::Length(points, relation) => {
                write!(f, "length {points}{}", Clause(" ", relation))
            }
            Self::Orientation(a, b, relation) => {
                write!(f, "orientation {a}, {b}{}", Clause(" ", relation))
            }
            Self::Motor { arm, radius, speed, phase } => {
                write!(f, "motor {arm}{}", Clause(" radius ", radius))?;
                write!(f, "{}{}", Clause(" speed ", speed), Clause(" phase ", phase))
            }
            Self::Glider { point, on, unbounded } => {
                write!(f, "glider {point} on {on}{}", if *unbounded { " unbounded" } else { "" })
            }
            Self::Hinge { point, on, at } => write!(f, "hinge {point} on {on} at {at}"),
            Self::Cog { first, second, ratio, inside } => {
                let inside = if *inside { " inside" } else { "" };
                write!(f, "cog {first}, {second} ratio {ratio}{inside}")
            }
            Self::Distance { point, line, relation } => {
                write!(f, "distance {point} to {line}{}", Clause(" ", relation))
            }
            Self::Parallel(a, b) => write!(f, "parallel {a}, {b}"),
            Self::Perpendicular(a, b) => write!(f, "perpendicular {a}, {b}"),
            Self::Rigid(names) => write!(f, "rigid {}", Names { names, stop: "" }),
            Self::Rack { wheel, on } => write!(f, "rack {wheel} on {on}"),
        }
    }
}
