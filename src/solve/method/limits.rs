//! How far a method is to go, and how it ended.

use crate::solve::report::{Budget, Status};

/// How far a method is to go.
#[derive(Clone, Copy)]
pub(crate) struct Limits<'a> {
    /// The size of what is solved, length units; never 0.
    pub size: f64,
    /// Solved means no distance to satisfaction above this, length units.
    pub tolerance: f64,
    /// The most iterations.
    pub n_iterations: u32,
    /// Asked between iterations.
    pub budget: &'a Budget<'a>,
}

/// How a method ended.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Outcome {
    /// What was reached.
    pub status: Status,
    /// The largest distance to satisfaction, length units.
    pub worst: f64,
    /// Half the sum of squares of the distances.
    pub energy: f64,
    /// The iterations it took.
    pub n_iterations: u32,
}

impl Outcome {
    /// Whether all constraints hold.
    pub fn is_converged(&self) -> bool {
        self.status == Status::Converged
    }
}
