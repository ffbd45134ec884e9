//! On which side everything in an island was, for bringing it back.

use crate::solve::frame::branch::PartSide;
use crate::solve::frame::decomposition::Side;

/// On which side everything was when last looked at, as far as that is known.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct KnownSides {
    /// None where it has to be worked out again.
    pub blocks: Box<[Side]>,
    /// Whether it has to be, see [`leave_closed_form`](super::Island::leave_closed_form).
    pub are_old: bool,
    /// Of what is watched in parts that are solved as a whole; none if nothing is.
    pub watched: Option<Box<WatchedSides>>,
}

/// The same of what is watched.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct WatchedSides {
    pub triangles: Vec<f64>,
    pub parts: Vec<Option<PartSide>>,
    pub knows_parts: bool,
}

impl KnownSides {
    /// Roughly how many bytes it holds, but for itself.
    pub fn n_bytes(&self) -> usize {
        let watched = self.watched.as_ref().map_or(0, |watched| {
            size_of_val(&*watched.triangles) + size_of_val(&*watched.parts) + 64
        });
        size_of_val(&*self.blocks) + watched
    }
}
