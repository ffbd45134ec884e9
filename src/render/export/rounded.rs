//! Outlines of parts: convex polygons with round corners, as lines and arcs.

use std::f64::consts::{PI, TAU};

use crate::constraint::{Point, Vector};

/// The longest arc of an outline, radians: of half a circle the ends hardly tell the centre.
const LONGEST: f64 = 2.0;

/// The outline of all that is no farther than `radius` from a convex polygon: of one corner a circle,
/// of two a bar with round ends.
#[derive(Debug, Clone, PartialEq)]
pub struct Rounded {
    /// The corners, counter-clockwise.
    pub corners: Vec<Point>,
    /// The radius of the outline at each corner, mm.
    pub radius: f64,
}

/// A stretch of an outline, run through counter-clockwise.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Stretch {
    /// A straight line.
    Line {
        /// Where it begins.
        from: Point,
        /// Where it ends.
        to: Point,
    },
    /// An arc, to the left.
    Arc {
        /// Its centre.
        centre: Point,
        /// Where it begins and ends, radians; the second is the larger one.
        angles: [f64; 2],
    },
}

impl Rounded {
    /// The stretches in their order, each where the last one ended. A circle is one arc.
    pub fn stretches(&self) -> Vec<Stretch> {
        let n = self.corners.len();
        if n == 1 {
            return vec![Stretch::Arc { centre: self.corners[0], angles: [0.0, TAU] }];
        }
        let edge = |k: usize| self.corners[(k + 1) % n] - self.corners[k % n];
        // The outline lies to the right of each edge.
        let outwards = |k: usize| edge(k).angle() - 0.5 * PI;
        let mut stretches = Vec::with_capacity(2 * n);
        for k in 0..n {
            let from = outwards(k + n - 1);
            let by = (outwards(k) - from).rem_euclid(TAU);
            let centre = self.corners[k];
            let n_arcs = (by / LONGEST).ceil().max(1.0);
            let angle = |step: f64| from + by * step / n_arcs;
            for step in 0..n_arcs as u32 {
                let angles = [angle(f64::from(step)), angle(f64::from(step + 1))];
                stretches.push(Stretch::Arc { centre, angles });
            }
            let aside = Vector::polar(self.radius, outwards(k));
            stretches.push(Stretch::Line {
                from: centre + aside,
                to: self.corners[(k + 1) % n] + aside,
            });
        }
        stretches
    }

    /// The corners of the least upright rectangle around it.
    pub fn bounds(&self) -> [Point; 2] {
        let r = Vector::new(self.radius, self.radius);
        let least = |lo: Point, p: &Point| Point::new(lo.x.min(p.x), lo.y.min(p.y));
        let most = |hi: Point, p: &Point| Point::new(hi.x.max(p.x), hi.y.max(p.y));
        let lo = self.corners.iter().fold(self.corners[0], least);
        let hi = self.corners.iter().fold(self.corners[0], most);
        [lo - r, hi + r]
    }

    /// The same elsewhere.
    #[must_use]
    pub fn shifted(&self, by: Vector) -> Self {
        Self { corners: self.corners.iter().map(|&p| p + by).collect(), radius: self.radius }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stretches_join() {
        let triangle = [(0.0, 0.0), (40.0, 0.0), (10.0, 30.0)].map(|(x, y)| Point::new(x, y));
        for corners in [triangle[..2].to_vec(), triangle.to_vec()] {
            let outline = Rounded { corners, radius: 5.0 };
            let ends = |stretch: &Stretch| match *stretch {
                Stretch::Line { from, to } => [from, to],
                Stretch::Arc { centre, angles } => {
                    angles.map(|angle| centre + Vector::polar(5.0, angle))
                }
            };
            let all = outline.stretches();
            let sweep: f64 = all
                .iter()
                .map(|stretch| match stretch {
                    Stretch::Arc { angles, .. } => angles[1] - angles[0],
                    Stretch::Line { .. } => 0.0,
                })
                .sum();
            assert!((sweep - TAU).abs() < 1e-12, "once around");
            for (k, stretch) in all.iter().enumerate() {
                let next = &all[(k + 1) % all.len()];
                assert!(ends(stretch)[1].distance(ends(next)[0]) < 1e-12);
            }
        }
    }
}
