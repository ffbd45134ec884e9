//! Where two circles around known points meet.

use super::abreast::{Meeting, Met};
use super::found::{larger, over_sine};
use super::length::{Length, Values};
use crate::constraint::{Point, PointIdx, Vector};
use crate::solve::frame::branch::NEARLY_SINGULAR;

/// A point at given distances from two others.
pub(super) struct Circles {
    /// The point that is found.
    pub to: PointIdx,
    /// The centres.
    from: [PointIdx; 2],
    /// What the radii are.
    radii: [Length; 2],
    /// The numbers that follow from them.
    of_radii: Numbers,
    /// The distance of the centres at the last pose.
    apart: f64,
    /// On which side of the line from the first centre to the second the point is: 1 or -1.
    side: f64,
}

/// What follows from two radii, and from how much longer or shorter each was on its way.
#[derive(Clone, Copy)]
pub(super) struct Numbers {
    /// Their squares.
    squares: [f64; 2],
    /// Half of one over each.
    half_inverses: [f64; 2],
    /// The squares of the distances of the centres at which the circles touch, from outside and from inside.
    reach_squares: [f64; 2],
    /// The distances at which they touched nowhere on the way.
    clear: [f64; 2],
    /// Their squares.
    clear_squares: [f64; 2],
    /// One over the square of twice the product of the radii at the end: [`area_squared`] times that is the
    /// square of the sine of the angle between them.
    inverse_square: f64,
    /// The same on the way, at least.
    least_inverse_square: f64,
    /// [`area_squared`] below which the pose is nearly singular.
    least: f64,
    /// How far the radii changed.
    changed: f64,
}

impl Numbers {
    #[inline(always)]
    fn new(radii: [Length; 2]) -> Self {
        let [l, m] = radii.map(|radius| radius.now);
        let changed = radii[0].changed + radii[1].changed;
        let (reach, scale) = ([l + m, (l - m).abs()], 2.0 * l * m);
        let clear = [reach[0] - changed, reach[1] + changed];
        let longest = 2.0 * (l + radii[0].changed) * (m + radii[1].changed);
        Self {
            squares: [l * l, m * m],
            half_inverses: [0.5 / l, 0.5 / m],
            reach_squares: reach.map(|r| r * r),
            clear,
            clear_squares: clear.map(|r| r * r),
            inverse_square: 1.0 / (scale * scale),
            least_inverse_square: 1.0 / (longest * longest),
            least: (NEARLY_SINGULAR * longest) * (NEARLY_SINGULAR * longest),
            changed,
        }
    }
}

/// Sixteen times the square of the area between the centres and the point.
#[inline(always)]
fn area_squared([outer, inner]: [f64; 2], apart_squared: f64) -> f64 {
    (outer - apart_squared) * (apart_squared - inner)
}

impl Circles {
    /// A point at the distances `radii` from two others; none where one is no distance.
    pub fn new(to: PointIdx, from: [PointIdx; 2], radii: [Length; 2]) -> Option<Self> {
        let of_radii = Numbers::new(radii);
        let is_sound = radii.iter().all(Length::is_sound)
            && of_radii.inverse_square > 0.0
            && of_radii.inverse_square.is_finite();
        is_sound.then_some(Self { to, from, radii, of_radii, apart: 0.0, side: 1.0 })
    }

    /// Takes in how long its radii are in this frame.
    pub fn drive(&mut self, values: &Values) {
        for radius in &mut self.radii {
            radius.drive(values);
        }
        self.of_radii = Numbers::new(self.radii);
    }

    /// The radii.
    pub fn radii_mut(&mut self) -> &mut [Length; 2] {
        &mut self.radii
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
    type Sizes = Numbers;

    fn lengths(&self) -> [Length; 2] {
        self.radii
    }

    #[inline(always)]
    fn sizes(&self) -> Numbers {
        self.of_radii
    }

    #[inline(always)]
    fn sizes_of(radii: [Length; 2]) -> Numbers {
        Numbers::new(radii)
    }

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
        of: &Numbers,
        [a, b]: [Point; 2],
        [before, apart]: [f64; 2],
        ways: [f64; 2],
        _: (Vector, f64),
    ) -> Met {
        let e = b - a;
        let apart_squared = e.norm_squared();
        let squared = area_squared(of.reach_squares, apart_squared);
        let way = ways[0] + ways[1];
        // The distance changes by no more than the ways of both centres, there and back included.
        let middle = apart + before;
        let (near, far) = (0.5 * (middle - way), 0.5 * (middle + way));
        let at_near = area_squared(of.clear_squares, near * near);
        let at_far = area_squared(of.clear_squares, far * far);
        let least = if at_near < at_far { at_near } else { at_far };
        let [outer, inner] = of.clear;
        // False for what is not a number.
        let is_proved = (near > inner) & (far < outer) & (least > of.least) & (squared > of.least);
        let half = 0.5 / apart_squared;
        let along = 0.5 + (of.squares[0] - of.squares[1]) * half;
        let across = self.side * squared.sqrt() * half;
        let v = e * along + e.perp() * across;
        let at = a + v;
        let w = at - b;
        let off = larger(
            (((at - a).norm_squared() - of.squares[0]) * of.half_inverses[0]).abs(),
            (w.norm_squared() - of.squares[1]) * of.half_inverses[1],
        );
        Met {
            at,
            // Its velocity is that of the centres and radii over the sine, at most.
            way: (way + of.changed) * over_sine(least * of.least_inverse_square),
            off: if is_proved { off } else { f64::NAN },
            side_squared: squared * of.inverse_square,
        }
    }
}
