//! A hinge: a point that divides a bar which may stretch.

use super::bar::Segment;
use super::draw::Draw;
use crate::constraint::{Point, PointIdx};
use crate::render::canvas::Canvas;
use crate::render::figure::{Layer, Placement};
use crate::render::path::Path;
use crate::render::style::{Class, JOINT};

/// A thin bar through two points with a pin on it.
#[derive(Debug, Clone, PartialEq)]
pub struct Link {
    /// The pin.
    pub pin: PointIdx,
    /// The two points of the bar.
    pub ends: [PointIdx; 2],
    /// Where on the bar the pin sits: 0 at the first end, 1 at the second.
    pub ratio: f64,
}

impl Draw for Link {
    fn points(&self) -> Vec<PointIdx> {
        vec![self.pin, self.ends[0], self.ends[1]]
    }

    fn draw(&self, canvas: &mut Canvas) {
        let [a, b] = self.ends;
        let segment = Segment::between(canvas, a, b);
        let (from, to) =
            (segment.length * self.ratio.min(0.0), segment.length * self.ratio.max(1.0));
        let radius = canvas.size(1.5 * JOINT);
        let pin = canvas.px(self.pin);
        canvas.figure(Layer::Bar, segment.placement).path(Class::Link, Path::along_x(from, to));
        canvas.figure(Layer::Slider, Placement::at(pin)).circle(Class::Pin, Point::ORIGIN, radius);
    }
}
