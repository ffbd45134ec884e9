//! Equal distances: the same number of ticks across each.

use super::bar::Segment;
use super::draw::Draw;
use crate::constraint::{Point, PointIdx};
use crate::render::canvas::Canvas;
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

    fn draw(&self, canvas: &mut Canvas) {
        let (half, gap) = (canvas.size(8.0), canvas.size(4.5));
        let [a, b, c, d] = self.points;
        for (p, q) in [(a, b), (c, d)] {
            let middle = Segment::between(canvas, p, q).middle();
            let mut ticks = Path::default();
            for k in 0..self.n_ticks {
                let x = gap * (f64::from(k) - 0.5 * f64::from(self.n_ticks - 1));
                ticks.move_to(Point::new(x, -half)).line_to(Point::new(x, half));
            }
            canvas.figure(Layer::Mark, middle).path(Class::Mark, ticks);
        }
    }
}
