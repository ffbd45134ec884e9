//! Where the end of a slotted link is, whose other end and slider are known.

use super::found::Found;
use crate::constraint::{Point, PointIdx};
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
    /// The distance of the ends, its square, and half of one over it.
    length: f64,
    square: f64,
    half_inverse: f64,
    /// The distance of the slider from the known end at the last pose.
    apart: f64,
    /// Whether the point is on the side of the slider, 1, or on the other, -1.
    side: f64,
}

impl Ray {
    /// A point at the distance `length` from another, in line with a slider; none where that is no
    /// distance.
    pub fn new(
        to: PointIdx,
        from: PointIdx,
        through: PointIdx,
        length: f64,
        is_bounded: bool,
    ) -> Option<Self> {
        let (square, half_inverse) = (length * length, 0.5 / length);
        let is_sound = length > 0.0 && square > 0.0 && square.is_finite() && through != from;
        is_sound.then_some(Self {
            to,
            from,
            through,
            is_bounded,
            length,
            square,
            half_inverse,
            apart: 0.0,
            side: 1.0,
        })
    }

    /// Looks at a pose that counts.
    pub fn look(&mut self, x: &[Point]) {
        let from = x[self.from as usize];
        let e = x[self.through as usize] - from;
        self.apart = e.norm_squared().sqrt();
        self.side = if e.dot(x[self.to as usize] - from) < 0.0 { -1.0 } else { 1.0 };
    }

    /// Puts the point in line with the slider, on the side where it was, if the slider is nowhere on
    /// its way nearly at the known end.
    #[inline]
    pub fn run(&mut self, x: &mut [Point], ways: &mut [f64], found: &mut Found) -> Option<()> {
        let [from, slider] = [self.from, self.through].map(|p| x[p as usize]);
        let e = slider - from;
        let apart = e.norm_squared().sqrt();
        let way = ways[self.from as usize] + ways[self.through as usize];
        let least = 0.5 * (apart + self.apart - way);
        // False for what is not a number.
        let is_proved = least > NEARLY_SINGULAR * self.length;
        let is_between = self.side > 0.0 && apart <= self.length;
        if !is_proved || self.is_bounded && !is_between {
            return None;
        }
        let arm = e * (self.side * self.length / apart);
        let p = from + arm;
        x[self.to as usize] = p;
        // The line turns by the ways of both over their distance, at most.
        ways[self.to as usize] = ways[self.from as usize] + way * self.length / least;
        let arm = p - from;
        found.add((arm.norm_squared() - self.square) * self.half_inverse);
        found.add(arm.cross(e) / self.length);
        found.add_side((apart / self.length) * (apart / self.length));
        self.apart = apart;
        Some(())
    }
}
