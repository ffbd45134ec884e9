//! How many handles were given out: those that a command gave out and that nothing knows any more, as it
//! failed or was taken back, are given out again.

use super::World;
use crate::constraint::Point;

/// How many of each kind, living or not.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Handles {
    /// Of points.
    pub n_points: usize,
    /// Of constraints.
    pub n_constraints: usize,
    /// Of parameters.
    pub n_parameters: usize,
    /// Of measures.
    pub n_measures: usize,
}

impl Handles {
    /// The larger of each.
    #[must_use]
    pub fn max(self, other: Self) -> Self {
        Self {
            n_points: self.n_points.max(other.n_points),
            n_constraints: self.n_constraints.max(other.n_constraints),
            n_parameters: self.n_parameters.max(other.n_parameters),
            n_measures: self.n_measures.max(other.n_measures),
        }
    }
}

impl World {
    /// How many were given out.
    pub fn handles(&self) -> Handles {
        Handles {
            n_points: self.points.column().len(),
            n_constraints: self.constraints.n_handles(),
            n_parameters: self.parameters.n_handles(),
            n_measures: self.measures.n_handles(),
        }
    }

    /// Gives out so many, or takes back what goes beyond: nothing has one of those any more.
    pub fn set_handles(&mut self, handles: Handles) {
        let Handles { n_points, n_constraints, n_parameters, n_measures } = handles;
        self.points.set_handles(n_points);
        self.constraints.set_handles(n_constraints);
        self.parameters.set_handles(n_parameters);
        self.measures.set_handles(n_measures);
    }
}

impl super::Points {
    fn set_handles(&mut self, n: usize) {
        debug_assert!(self.name.iter().skip(n).all(Option::is_none), "a living point");
        self.at.resize(n, Point::ORIGIN);
        self.start.resize(n, Point::ORIGIN);
        self.is_frozen.resize(n, false);
        self.name.resize(n, None);
        self.cut_weights(n);
    }
}
