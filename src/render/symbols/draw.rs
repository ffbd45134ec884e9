//! What every form of a symbol answers.

use crate::constraint::{Point, PointIdx};
use crate::render::canvas::Canvas;
use crate::render::page::BoundingBox;

/// The points a form hangs on, the room it takes, how it is drawn.
pub trait Draw {
    /// The points it hangs on.
    fn points(&self) -> Vec<PointIdx>;

    /// Grows the box by what it needs beyond its points.
    fn extend(&self, _at: &[Point], _extent: &mut BoundingBox) {}

    /// Draws it.
    fn draw(&self, canvas: &mut Canvas);
}
