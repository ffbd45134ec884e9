//! Equal distances: the same number of ticks across each.

use super::Draw;
use super::bar::Span;
use crate::constraint::{Point, PointIdx};
use crate::render::canvas::Ink;
use crate::render::figure::Layer;
use crate::render::path::Path;
use crate::render::style::Class;

/// Two segments of equal length.
#[derive(Debug, Clone, PartialEq)]
pub struct Ticks {
    /// The ends of the one, the ends of the other.
    pub points: [PointIdx; 4],
    /// How many ticks each gets.
    pub n_ticks: u8,
}

impl Draw for Ticks {
    fn points(&self) -> Vec<PointIdx> {
        self.points.to_vec()
    }

    fn draw(&self, ink: &mut Ink) {
        let (half, gap) = (ink.size(8.0), ink.size(4.5));
        let [a, b, c, d] = self.points;
        for (p, q) in [(a, b), (c, d)] {
            let middle = Span::between(ink, p, q).middle();
            let mut ticks = Path::default();
            for k in 0..self.n_ticks {
                let x = gap * (f64::from(k) - 0.5 * f64::from(self.n_ticks - 1));
                ticks.move_to(Point::new(x, -half)).line_to(Point::new(x, half));
            }
            ink.figure(Layer::Mark, middle).path(Class::Mark, ticks);
        }
    }
}
