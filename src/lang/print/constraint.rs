//! The canonical form of the constraints.

use std::fmt::{self, Display, Formatter};

use super::Names;
use crate::lang::ast::{Constraint, ConstraintWord, Pair, Part};

impl Display for Constraint {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        f.write_str(self.word.pattern().entry.keyword)?;
        let mut is_behind_points = false;
        for part in &self.parts {
            // Points behind points are another group of them.
            let is_points = matches!(part, Part::Points(_));
            let is_further = is_behind_points && is_points;
            let gap = match self.word {
                ConstraintWord::Tangent if is_further => " to ",
                _ if is_further => ", ",
                _ => " ",
            };
            is_behind_points = is_points;
            write!(f, "{gap}{part}")?;
        }
        Ok(())
    }
}

impl Display for Part {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        match self {
            Self::Points(names) => write!(f, "{}", Names { names, stops: &[] }),
            Self::Defined(name) => write!(f, "{name} ="),
            Self::Point(role, name) => write!(f, "{} {name}", role.word()),
            Self::Measure(value) => write!(f, "{value}"),
            Self::Line(role, points) => write!(f, "{} {points}", role.word()),
            Self::Relation(relation) => write!(f, "{relation}"),
            Self::Value(role, value) => write!(f, "{} {value}", role.word()),
            Self::Values(role, values) => {
                let [first, second] = &**values;
                write!(f, "{} {first}, {second}", role.word())
            }
            Self::Flag(role) => f.write_str(role.word()),
        }
    }
}

impl Display for Pair {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        write!(f, "{} {}", self.from, self.to)
    }
}
