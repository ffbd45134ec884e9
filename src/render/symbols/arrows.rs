//! Equal vectors and parallels: the same number of chevrons on each.

use super::bar::Segment;
use super::draw::Draw;
use crate::constraint::{Point, PointIdx};
use crate::render::canvas::Canvas;
use crate::render::figure::Layer;
use crate::render::path::Path;
use crate::render::style::Class;

/// Two segments of one direction.
#[derive(Debug, Clone, PartialEq)]
pub struct Arrows {
    /// Start and end of the one, start and end of the other.
    pub points: [PointIdx; 4],
    /// How many chevrons each gets.
    pub n_chevrons: u8,
}

impl Draw for Arrows {
    fn points(&self) -> Vec<PointIdx> {
        self.points.to_vec()
    }

    fn draw(&self, canvas: &mut Canvas) {
        let (length, half, gap) = (canvas.size(6.5), canvas.size(7.5), canvas.size(6.0));
        let [a, b, c, d] = self.points;
        for (p, q) in [(a, b), (c, d)] {
            let middle = Segment::between(canvas, p, q).middle();
            let mut chevrons = Path::default();
            for k in 0..self.n_chevrons {
                let tip =
                    0.5 * length + gap * (f64::from(k) - 0.5 * f64::from(self.n_chevrons - 1));
                chevrons
                    .move_to(Point::new(tip - length, -half))
                    .line_to(Point::new(tip, 0.0))
                    .line_to(Point::new(tip - length, half));
            }
            canvas.figure(Layer::Mark, middle).path(Class::Mark, chevrons);
        }
    }
}
