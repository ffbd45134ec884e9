//! Where two circles around known points meet.

use super::abreast::{Meeting, Met};
use super::found::larger;
use crate::constraint::{Point, PointIdx, Vector};
use crate::solve::frame::branch::NEARLY_SINGULAR;

/// A point at given distances from two others.
pub(super) struct Circles {
    /// The point that is found.
    pub to: PointIdx,
    /// The centres.
    from: [PointIdx; 2],
    /// The squares of the radii.
    squares: [f64; 2],
    /// Half of one over each radius.
    half_inverses: [f64; 2],
    /// The distances of the centres at which the circles touch, from outside and from inside.
    reach: [f64; 2],
    /// Their squares.
    reach_squares: [f64; 2],
    /// Twice the product of the radii, which times the sine of the angle between them is [`area`].
    scale: f64,
    /// One over the square of that.
    inverse_square: f64,
    /// The square of [`area`] below which the pose is nearly singular.
    least: f64,
    /// The distance of the centres at the last pose.
    apart: f64,
    /// On which side of the line from the first centre to the second the point is: 1 or -1.
    side: f64,
}

/// Sixteen times the square of the area between the centres and the point.
#[inline(always)]
fn area_squared([outer, inner]: [f64; 2], apart_squared: f64) -> f64 {
    (outer - apart_squared) * (apart_squared - inner)
}

impl Circles {
    /// A point at the distances `radii` from two others; none where one is no distance.
    pub fn new(to: PointIdx, from: [PointIdx; 2], radii: [f64; 2]) -> Option<Self> {
        let [l, m] = radii;
        let scale = 2.0 * l * m;
        let reach = [l + m, (l - m).abs()];
        let is_sound = l > 0.0 && m > 0.0 && scale * scale > 0.0 && (scale * scale).is_finite();
        is_sound.then(|| Self {
            to,
            from,
            squares: radii.map(|r| r * r),
            half_inverses: radii.map(|r| 0.5 / r),
            reach,
            reach_squares: reach.map(|r| r * r),
            scale,
            inverse_square: 1.0 / (scale * scale),
            least: (NEARLY_SINGULAR * scale) * (NEARLY_SINGULAR * scale),
            apart: 0.0,
            side: 1.0,
        })
    }

    /// Looks at a pose that counts.
    pub fn look(&mut self, x: &[Point]) {
        let [a, b] = self.from.map(|p| x[p as usize]);
        let e = b - a;
        self.apart = e.norm_squared().sqrt();
        self.side = if e.cross(x[self.to as usize] - a) < 0.0 { -1.0 } else { 1.0 };
    }
}

impl Meeting<2> for Circles {
    fn to(&self) -> PointIdx {
        self.to
    }

    fn from(&self) -> [PointIdx; 2] {
        self.from
    }

    /// The distance of the centres.
    #[inline(always)]
    fn gauge(&self, [a, b]: [Point; 2]) -> f64 {
        (b - a).norm_squared().sqrt()
    }

    fn last(&mut self) -> &mut f64 {
        &mut self.apart
    }

    /// Where the circles meet, on the side where the point was, if no pose on the way is nearly
    /// singular.
    #[inline(always)]
    fn meet(
        &self,
        [a, b]: [Point; 2],
        [before, apart]: [f64; 2],
        ways: [f64; 2],
        _: (Vector, f64),
    ) -> Met {
        let e = b - a;
        let apart_squared = e.norm_squared();
        let squared = area_squared(self.reach_squares, apart_squared);
        let way = ways[0] + ways[1];
        // The distance changes by no more than the ways of both centres, there and back included.
        let middle = apart + before;
        let (near, far) = (0.5 * (middle - way), 0.5 * (middle + way));
        let at_near = area_squared(self.reach_squares, near * near);
        let at_far = area_squared(self.reach_squares, far * far);
        let least = if at_near < at_far { at_near } else { at_far };
        let [outer, inner] = self.reach;
        // False for what is not a number.
        let is_proved =
            (near > inner) & (far < outer) & (least > self.least) & (squared > self.least);
        let half = 0.5 / apart_squared;
        let along = 0.5 + (self.squares[0] - self.squares[1]) * half;
        let across = self.side * squared.sqrt() * half;
        let v = e * along + e.perp() * across;
        let at = a + v;
        let w = at - b;
        let off = larger(
            (((at - a).norm_squared() - self.squares[0]) * self.half_inverses[0]).abs(),
            (w.norm_squared() - self.squares[1]) * self.half_inverses[1],
        );
        Met {
            at,
            // Its velocity is that of the centres over the sine, at most.
            way: way * self.scale / least.sqrt(),
            off: if is_proved { off } else { f64::NAN },
            side_squared: squared * self.inverse_square,
        }
    }
}
