//! A hinge: a point that divides a bar which may stretch.

use super::Draw;
use super::bar::Span;
use crate::constraint::{Point, PointIdx};
use crate::render::canvas::Ink;
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

    fn draw(&self, ink: &mut Ink) {
        let [a, b] = self.ends;
        let span = Span::between(ink, a, b);
        let (from, to) = (span.length * self.ratio.min(0.0), span.length * self.ratio.max(1.0));
        let radius = ink.size(1.5 * JOINT);
        let pin = ink.px(self.pin);
        ink.figure(Layer::Bar, span.placement).path(Class::Link, Path::along_x(from, to));
        ink.figure(Layer::Slider, Placement::at(pin)).circle(Class::Pin, Point::ORIGIN, radius);
    }
}
