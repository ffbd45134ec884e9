//! A rigid body: points that keep their shape.

use super::bar::Segment;
use super::draw::Draw;
use crate::constraint::{Point, PointIdx};
use crate::render::canvas::Canvas;
use crate::render::figure::{Layer, Placement};
use crate::render::path::Path;
use crate::render::style::Class;

/// A plate with round corners over all its points.
#[derive(Debug, Clone, PartialEq)]
pub struct Plate {
    /// Its points.
    points: Vec<PointIdx>,
    /// Those of them on its outline, counter-clockwise, the oldest first.
    hull: Vec<PointIdx>,
}

impl Plate {
    /// A plate over `points` as they stand.
    pub fn new(points: &[PointIdx], at: &[Point]) -> Self {
        Self { points: points.to_vec(), hull: hull(points, at) }
    }

    /// Its points on its outline, counter-clockwise.
    pub fn hull(&self) -> &[PointIdx] {
        &self.hull
    }
}

impl Draw for Plate {
    fn points(&self) -> Vec<PointIdx> {
        self.points.clone()
    }

    fn draw(&self, canvas: &mut Canvas) {
        let [first, .., last] = self.hull[..] else {
            return;
        };
        let placement = Segment::between(canvas, first, last).placement;
        let outline = polygon_from(canvas, &placement, &self.hull);
        canvas
            .figure(Layer::Plate, placement)
            .path(Class::PlateEdge, outline.clone())
            .path(Class::Plate, outline);
    }
}

/// The polygon over some points as seen from a placement.
pub fn polygon_from(canvas: &Canvas, placement: &Placement, points: &[PointIdx]) -> Path {
    let back = -placement.turn.to_radians();
    Path::polygon(points.iter().map(|&p| (canvas.px(p) - placement.at).rotate(back).to_point()))
}

/// The corners of the smallest convex polygon around some points, counter-clockwise, the one
/// with the lowest handle first (Andrew's monotone chain).
pub fn hull(points: &[PointIdx], at: &[Point]) -> Vec<PointIdx> {
    let place = |p: PointIdx| at[p as usize];
    let mut sorted = points.to_vec();
    sorted.sort_by(|&p, &q| {
        let (a, b) = (place(p), place(q));
        a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)).then(p.cmp(&q))
    });
    sorted.dedup_by_key(|p| place(*p));
    let mut chain: Vec<PointIdx> = Vec::new();
    for pass in 0..2 {
        let base = chain.len();
        for &p in &sorted {
            while chain.len() >= base + 2 {
                let (a, b) = (place(chain[chain.len() - 2]), place(chain[chain.len() - 1]));
                if (b - a).cross(place(p) - b) > 0.0 {
                    break;
                }
                chain.pop();
            }
            chain.push(p);
        }
        // The last of a chain is the first of the next one.
        if chain.len() > 1 {
            chain.pop();
        }
        if pass == 0 {
            sorted.reverse();
        }
    }
    let oldest = (0..chain.len()).min_by_key(|&k| chain[k]).unwrap_or(0);
    chain.rotate_left(oldest);
    chain
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hulls_keep_the_corners_only() {
        let check = |at: &[(f64, f64)], wanted: &[PointIdx]| {
            let at: Vec<Point> = at.iter().map(|&(x, y)| Point::new(x, y)).collect();
            let points: Vec<PointIdx> = (0..at.len() as u32).collect();
            assert_eq!(hull(&points, &at), wanted);
        };
        check(&[(1.0, 1.0), (0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)], &[1, 2, 3, 4]);
        check(&[(0.0, 0.0), (1.0, 1.0), (2.0, 2.0)], &[0, 2]);
        check(&[(3.0, 3.0), (3.0, 3.0)], &[0]);
    }
}
