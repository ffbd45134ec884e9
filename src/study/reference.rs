//! The reference: the same motion solved as exactly as doubles allow.

use crate::constraint::Point;
use crate::world::{PointId, World};

/// Places that a run is compared with.
#[derive(Debug, Clone)]
pub(super) struct Reference {
    /// The points that are compared.
    pub points: Vec<PointId>,
    /// Their places, frame after frame.
    pub at: Vec<Point>,
    /// How large the scene is; errors are relative to it.
    pub size: f64,
    /// How well the places are known, relative to the size.
    pub error: f64,
}

impl Reference {
    /// How far the farthest point is from where it should be at the end of frame `k`, relative
    /// to the size.
    pub fn error_of(&self, world: &World, k: usize) -> f64 {
        let n = self.points.len();
        let wanted = self.at[n * k..n * (k + 1)].iter();
        let off = self.points.iter().zip(wanted).map(|(&p, at)| world.points().at(p).distance(*at));
        off.fold(0.0, f64::max) / self.size
    }

    /// Leaves out the points that are not to be compared.
    pub fn keep(&mut self, keep: impl Fn(PointId) -> bool) {
        let n = self.points.len();
        let is_kept: Vec<bool> = self.points.iter().map(|&p| keep(p)).collect();
        let mut k = 0;
        self.at.retain(|_| {
            k += 1;
            is_kept[(k - 1) % n]
        });
        self.points.retain(|&p| keep(p));
    }
}
