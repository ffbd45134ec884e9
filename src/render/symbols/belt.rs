//! A belt around two wheels, open or crossed.

use super::bar::Segment;
use super::draw::Draw;
use crate::constraint::{Point, PointIdx, Vector};
use crate::render::canvas::Canvas;
use crate::render::figure::{Layer, Placement};
use crate::render::page::BoundingBox;
use crate::render::path::Path;
use crate::render::style::Class;
use std::f64::consts::{PI, TAU};

/// Two wheels and the belt around them.
#[derive(Debug, Clone, PartialEq)]
pub struct Belt {
    /// Centre and marker of the one wheel, centre and marker of the other.
    pub points: [PointIdx; 4],
    /// The second radius over the first.
    pub ratio: f64,
    /// Whether its runs cross between the wheels.
    pub is_crossed: bool,
}

/// Wheels take up no more than this part of the distance of their centres.
const WIDEST: f64 = 0.9;
/// Straight pieces of an arc around a wheel.
const N_PIECES: u32 = 32;

impl Belt {
    /// The radii, world units: the first marker lies on the rim where there is room for that.
    fn radii(&self, at: &[Point]) -> [f64; 2] {
        let [o1, a, o2, _] = self.points.map(|p| at[p as usize]);
        let ratio = self.ratio.abs();
        let most = WIDEST * o1.distance(o2) / (1.0 + ratio);
        let first = o1.distance(a).min(most);
        [first, first * ratio]
    }

    /// The belt, the first centre being the origin and the second at this distance along x.
    fn outline(&self, distance: f64, [r1, r2]: [f64; 2]) -> Path {
        // Seen from the first centre, where the upper run leaves that wheel; on the second it
        // arrives on the same side, or the opposite one.
        let reach = if self.is_crossed { r1 + r2 } else { r1 - r2 };
        let leave = libm::acos((reach / distance).clamp(-1.0, 1.0));
        let arrive = if self.is_crossed { leave - PI } else { leave };
        // Round the far side of each wheel: the other run is the mirror image.
        let far = if self.is_crossed { -2.0 * arrive } else { -2.0 * leave };
        let place =
            |x: f64, r: f64, phi: f64| Vector::polar(r, phi).to_point() + Vector::new(x, 0.0);
        let arc = |x: f64, r: f64, from: f64, by: f64| {
            (0..=N_PIECES).map(move |k| place(x, r, from + by * f64::from(k) / f64::from(N_PIECES)))
        };
        let second = arc(distance, r2, arrive, far);
        let first = arc(0.0, r1, -leave, 2.0 * leave - TAU);
        Path::polygon(second.chain(first))
    }
}

impl Draw for Belt {
    fn points(&self) -> Vec<PointIdx> {
        self.points.to_vec()
    }

    fn extend(&self, at: &[Point], bounds: &mut BoundingBox) {
        for (centre, radius) in [self.points[0], self.points[2]].into_iter().zip(self.radii(at)) {
            bounds.include_circle(at[centre as usize], 1.04 * radius);
        }
    }

    fn draw(&self, canvas: &mut Canvas) {
        let radii = self.radii(canvas.at).map(|radius| canvas.page.length(radius));
        let [o1, a, o2, b] = self.points;
        for (centre, radius) in [o1, o2].into_iter().zip(radii) {
            let at = Placement::at(canvas.px(centre));
            canvas.figure(Layer::Wheel, at).circle(Class::Wheel, Point::ORIGIN, radius);
        }
        for (centre, marker) in [(o1, a), (o2, b)] {
            let spoke = Segment::between(canvas, centre, marker);
            canvas
                .figure(Layer::Wheel, spoke.placement)
                .path(Class::Spoke, Path::along_x(0.0, spoke.length));
        }
        let centres = Segment::between(canvas, o1, o2);
        // Wheels on one centre have no runs between them.
        if centres.length > 0.0 {
            canvas
                .figure(Layer::Wheel, centres.placement)
                .path(Class::Belt, self.outline(centres.length, radii));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The corners of the outline for centres 10 apart.
    fn corners(is_crossed: bool, radii: [f64; 2]) -> Vec<Point> {
        let belt = Belt { points: [0, 1, 2, 3], ratio: radii[1] / radii[0], is_crossed };
        let numbers = belt.outline(10.0, radii);
        numbers.numbers().chunks(2).map(|c| Point::new(c[0], c[1])).collect()
    }

    #[test]
    fn runs_touch_both_wheels() {
        for (is_crossed, radii) in
            [(false, [2.0, 5.0]), (false, [4.0, 1.0]), (false, [3.0, 3.0]), (true, [2.0, 5.0])]
        {
            let corners = corners(is_crossed, radii);
            let n = N_PIECES as usize + 1;
            let (second, first) = corners.split_at(n);
            let centres = [Point::ORIGIN, Point::new(10.0, 0.0)];
            assert!(first.iter().all(|p| (p.distance(centres[0]) - radii[0]).abs() < 1e-12));
            assert!(second.iter().all(|p| (p.distance(centres[1]) - radii[1]).abs() < 1e-12));
            // A run is at right angles to the radii at both of its ends.
            for (p, q) in [(second[n - 1], first[0]), (first[n - 1], second[0])] {
                assert!(
                    (q - p).dot(p - centres[1]).abs() < 1e-9
                        || (q - p).dot(p - centres[0]).abs() < 1e-9
                );
                assert!(
                    (q - p).dot(q - centres[0]).abs() < 1e-9
                        || (q - p).dot(q - centres[1]).abs() < 1e-9
                );
            }
            // Each wheel is on one side of it: the far side of the second is beyond its centre.
            assert!(second[n / 2].x > 10.0 && first[n / 2].x < 0.0);
        }
    }
}
