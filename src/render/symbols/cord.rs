//! A cord: a length that must not be exceeded.

use super::bar::Segment;
use super::draw::Draw;
use crate::constraint::{Point, PointIdx};
use crate::render::canvas::Canvas;
use crate::render::figure::{Layer, Placement};
use crate::render::path::Path;
use crate::render::style::Class;

/// A thin line between two joints, straight when taut, hanging when slack.
#[derive(Debug, Clone, PartialEq)]
pub struct Cord {
    /// Its ends.
    pub points: [PointIdx; 2],
    /// How long it is, world units.
    pub length: f64,
}

impl Draw for Cord {
    fn points(&self) -> Vec<PointIdx> {
        self.points.to_vec()
    }

    fn draw(&self, canvas: &mut Canvas) {
        let [a, b] = self.points.map(|p| canvas.px(p));
        let segment = Segment::new(a, b).length;
        let slack = (canvas.page.length(self.length) - segment).max(0.0);
        // A shallow parabola over a segment l is longer by 8/3 sag^2 / l. A cord much longer than
        // its segment would hang off the page: what is drawn says that it is slack, no more.
        let sag = (0.375 * slack * segment).sqrt().min(0.22 * segment);
        let middle = Point::new(0.5 * (a.x + b.x), 0.5 * (a.y + b.y) + 2.0 * sag);
        let mut path = Path::default();
        path.move_to(a).bend_to(middle, b);
        canvas.figure(Layer::Bar, Placement::default()).path(Class::Cord, path);
    }
}
