//! Bars: where a straight part lies and how long it is on the page.

use crate::constraint::{Point, PointIdx, Vector};
use crate::render::canvas::Canvas;
use crate::render::figure::{Figure, Layer, Placement};
use crate::render::path::Path;
use crate::render::style::Class;

/// A straight part between two places of the page.
#[derive(Debug, Clone, Copy)]
pub struct Segment {
    /// At the first place, the x axis towards the second.
    pub placement: Placement,
    /// From the one to the other, px.
    pub length: f64,
}

impl Segment {
    /// Between two places of the page.
    pub fn new(a: Point, b: Point) -> Self {
        Self { placement: Placement::along(a, b - a), length: a.distance(b) }
    }

    /// Between two points.
    pub fn between(canvas: &Canvas, a: PointIdx, b: PointIdx) -> Self {
        Self::new(canvas.px(a), canvas.px(b))
    }

    /// The same, with its origin some px further along.
    pub fn shifted(&self, by: f64) -> Placement {
        Placement { at: self.placement.place(Point::new(by, 0.0)), ..self.placement }
    }

    /// Its origin in the middle.
    pub fn middle(&self) -> Placement {
        self.shifted(0.5 * self.length)
    }
}

/// Draws a bar with an outline; gives its figure.
pub fn outlined<'c>(
    canvas: &'c mut Canvas,
    segment: &Segment,
    [edge, inside]: [Class; 2],
) -> &'c mut Figure {
    canvas
        .figure(Layer::Bar, segment.placement)
        .path(edge, Path::along_x(0.0, segment.length))
        .path(inside, Path::along_x(0.0, segment.length))
}

/// A small arrow head with its point at `tip`, as a polygon.
pub fn arrow_head(tip: Point, direction: Vector, length: f64) -> Path {
    let back = tip - direction * length;
    let side = direction.perp() * (0.36 * length);
    Path::polygon([tip, back + side, back - side])
}
