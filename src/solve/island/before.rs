//! An island as it was before a frame that could not be solved.

use crate::constraint::{Constraint, Point};

/// An island as it was before the frame that it could not be solved in, kept until the next.
pub struct Before {
    /// Where its points were.
    pub x: Vec<Point>,
    /// The constraints that changed in the frame, as they were.
    pub constraints: Vec<(u32, Constraint)>,
    /// Whether it was its first frame.
    pub is_first: bool,
}
