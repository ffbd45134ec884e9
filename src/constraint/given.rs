//! What a statement says of a constraint, and how a kind is made from it.

use crate::constraint::{Bounds, Field, Flag, Point, PointIdx};

/// What a statement says of a constraint, its names looked up and its expressions evaluated.
#[derive(Debug, Clone)]
pub struct Given<'a> {
    /// The word it begins with.
    pub word: &'a str,
    /// Its points, in the groups in which they stand.
    pub groups: &'a [Vec<PointIdx>],
    /// The interval that is asked for, if one is; infinite where it is open.
    pub bounds: Option<Bounds>,
    /// The values that are given.
    pub values: &'a [(Field, f64)],
    /// The words that stand for no value.
    pub flags: &'a [Flag],
    /// The circles and arcs that it names, by their handles.
    pub curves: &'a [u32],
    /// Where all points are.
    pub x: &'a [Point],
    /// Whether it was there before and is made again: whatever pose it has come to since, what it
    /// took from the pose is put back after.
    pub is_restored: bool,
}

/// A kind that a statement can make.
pub trait Declared: Sized {
    /// The words of the command language that state it. None for one that is made in the place
    /// of another.
    const WORDS: &'static [&'static str];

    /// Makes one. What is not given is as it is now.
    ///
    /// # Errors
    /// Points or a pose that allow none.
    fn declare(given: &Given) -> Result<Self, Refusal>;
}

/// Why a statement makes no constraint.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Refusal {
    /// What is wrong.
    pub message: &'static str,
    /// Where in the statement.
    pub at: Culprit,
    /// What is to be said of that place.
    pub label: &'static str,
    /// What to type instead, if it can be said.
    pub help: Option<&'static str>,
}

/// The part of a statement that is refused.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Culprit {
    /// All of it.
    Statement,
    /// A group of points.
    Group(usize),
    /// A point of a group.
    Point(usize, usize),
}

impl Given<'_> {
    /// The first point of a group.
    pub fn point(&self, group: usize) -> PointIdx {
        self.groups[group][0]
    }

    /// The ends of a segment.
    ///
    /// # Errors
    /// The same point twice.
    pub fn pair(&self, group: usize) -> Result<[PointIdx; 2], Refusal> {
        self.two(group, "a segment needs two different points")
    }

    /// The ends of the first two segments.
    ///
    /// # Errors
    /// The same point twice in one of them.
    pub fn pairs(&self) -> Result<[PointIdx; 4], Refusal> {
        let ([a, b], [c, d]) = (self.pair(0)?, self.pair(1)?);
        Ok([a, b, c, d])
    }

    /// The ends of the first two segments, which are not one and the same.
    ///
    /// # Errors
    /// The same point twice in one of them, or the same two points in both.
    pub fn different_pairs(&self) -> Result<[PointIdx; 4], Refusal> {
        let [a, b, c, d] = self.pairs()?;
        if [a, b] == [c, d] || [a, b] == [d, c] {
            return Err(Refusal {
                message: "a segment compared with itself asks for nothing that could be held",
                at: Culprit::Group(1),
                label: "the same two points again",
                help: Some("name two different segments"),
            });
        }
        Ok([a, b, c, d])
    }

    /// The first point, then the ends of the segment behind it, of which it is none.
    ///
    /// # Errors
    /// The same point twice.
    pub fn point_and_pair(&self) -> Result<[PointIdx; 3], Refusal> {
        let ([a, b], p) = (self.pair(1)?, self.point(0));
        if p == a || p == b {
            return Err(Refusal {
                message: "an end of a line lies on it anyway, and nowhere else",
                at: Culprit::Point(0, 0),
                label: "this is an end of that line",
                help: Some("name a third point, or another line"),
            });
        }
        Ok([p, a, b])
    }

    /// The points of a group of two, which are not the same because of `why`.
    ///
    /// # Errors
    /// They are.
    pub fn two(&self, group: usize, why: &'static str) -> Result<[PointIdx; 2], Refusal> {
        let ends = [self.groups[group][0], self.groups[group][1]];
        if ends[0] == ends[1] {
            return Err(Refusal {
                message: why,
                at: Culprit::Group(group),
                label: "the same point twice",
                help: None,
            });
        }
        Ok(ends)
    }

    /// Where a point is.
    pub fn at(&self, p: PointIdx) -> Point {
        self.x[p as usize]
    }

    /// A value, if it is given.
    pub fn value(&self, field: Field) -> Option<f64> {
        self.values.iter().find(|(given, _)| *given == field).map(|(_, value)| *value)
    }

    /// Whether a word stands in it.
    pub fn has(&self, flag: Flag) -> bool {
        self.flags.contains(&flag)
    }
}
