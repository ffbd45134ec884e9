//! Where the end of a slotted link is, whose other end and slider are known.

use super::abreast::{Meeting, Met};
use super::found::larger;
use super::length::{Length, Values};
use crate::constraint::{Point, PointIdx, Vector};
use crate::solve::frame::branch::NEARLY_SINGULAR;

/// A point at a given distance from another, on the line from there through a third.
pub(super) struct Ray {
    /// The point that is found.
    pub to: PointIdx,
    /// Where the line begins.
    from: PointIdx,
    /// The slider on it.
    through: PointIdx,
    /// Whether the slider stays between the ends.
    is_bounded: bool,
    /// The distance of the ends, and what follows from it.
    bar: Length,
    of_bar: Numbers,
    /// The distance of the slider from the known end at the last pose.
    apart: f64,
    /// Whether the point is on the side of the slider, 1, or on the other, -1.
    side: f64,
}

/// What follows from a length.
#[derive(Clone, Copy)]
pub(super) struct Numbers {
    /// It, its square, and half of one over it.
    length: f64,
    square: f64,
    half_inverse: f64,
    /// How far it changed.
    changed: f64,
}

impl Numbers {
    #[inline(always)]
    fn new(Length { now, changed, .. }: Length) -> Self {
        Self { length: now, square: now * now, half_inverse: 0.5 / now, changed }
    }
}

impl Ray {
    /// A point at the distance of a bar's length from another, in line with a slider; none where that is no
    /// distance.
    pub fn new(
        to: PointIdx,
        from: PointIdx,
        through: PointIdx,
        bar: Length,
        is_bounded: bool,
    ) -> Option<Self> {
        let of_bar = Numbers::new(bar);
        let ray = Self { to, from, through, is_bounded, bar, of_bar, apart: 0.0, side: 1.0 };
        (bar.is_sound() && through != from).then_some(ray)
    }

    /// Takes in how long the link is in this frame.
    pub fn drive(&mut self, values: &Values) {
        self.bar.drive(values);
        self.of_bar = Numbers::new(self.bar);
    }

    /// The length of the link.
    pub fn length_mut(&mut self) -> &mut Length {
        &mut self.bar
    }

    /// Looks at a pose that counts.
    pub fn look(&mut self, x: &[Point]) {
        let from = x[self.from as usize];
        let e = x[self.through as usize] - from;
        self.apart = e.norm_squared().sqrt();
        self.side = if e.dot(x[self.to as usize] - from) < 0.0 { -1.0 } else { 1.0 };
    }
}

impl Meeting<2> for Ray {
    type Sizes = Numbers;

    fn lengths(&self) -> [Length; 2] {
        [self.bar; 2]
    }

    #[inline(always)]
    fn sizes(&self) -> Numbers {
        self.of_bar
    }

    #[inline(always)]
    fn sizes_of([bar, _]: [Length; 2]) -> Numbers {
        Numbers::new(bar)
    }

    fn to(&self) -> PointIdx {
        self.to
    }

    fn from(&self) -> [PointIdx; 2] {
        [self.from, self.through]
    }

    /// The distance of the slider from the known end.
    #[inline(always)]
    fn gauge(&self, [from, slider]: [Point; 2]) -> f64 {
        (slider - from).norm_squared().sqrt()
    }

    fn last(&mut self) -> &mut f64 {
        &mut self.apart
    }

    /// In line with the slider, on the side where the point was, if the slider is nowhere on its way
    /// nearly at the known end.
    #[inline(always)]
    fn meet(
        &self,
        of: &Numbers,
        [from, slider]: [Point; 2],
        [before, apart]: [f64; 2],
        ways: [f64; 2],
        _: (Vector, f64),
    ) -> Met {
        let e = slider - from;
        let way = ways[0] + ways[1];
        let least = 0.5 * (apart + before - way);
        let is_between = (self.side > 0.0) & (apart <= of.length);
        // False for what is not a number.
        let is_proved = (least > NEARLY_SINGULAR * of.length) & (!self.is_bounded | is_between);
        let at = from + e * (self.side * of.length / apart);
        let arm = at - from;
        let off = larger(
            ((arm.norm_squared() - of.square) * of.half_inverse).abs(),
            arm.cross(e) / of.length,
        );
        Met {
            at,
            // The line turns by the ways of both over their distance, at most.
            way: ways[0] + of.changed + way * (of.length + of.changed) / least,
            off: if is_proved { off } else { f64::NAN },
            side_squared: (apart / of.length) * (apart / of.length),
        }
    }
}
