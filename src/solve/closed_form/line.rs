//! Where a circle around a known point meets a line that stands still.

use super::found::Found;
use crate::constraint::{Point, PointIdx};
use crate::solve::frame::branch::NEARLY_SINGULAR;

/// A point at a given distance from another, on the line through two more.
pub(super) struct CircleLine {
    /// The point that is found.
    pub to: PointIdx,
    /// The centre.
    from: PointIdx,
    /// The points that span the line.
    line: [PointIdx; 2],
    /// Whether the point stays between them.
    is_bounded: bool,
    /// The square of the radius, and half of one over the radius.
    square: f64,
    half_inverse: f64,
    /// The signed distance of the centre from the line at the last pose.
    height: f64,
    /// On which side of the foot of the centre the point is, along the line: 1 or -1.
    side: f64,
}

impl CircleLine {
    /// A point at the distance `radius` from another, on a line; none where that is no distance.
    pub fn new(
        to: PointIdx,
        from: PointIdx,
        line: [PointIdx; 2],
        radius: f64,
        is_bounded: bool,
    ) -> Option<Self> {
        let (square, half_inverse) = (radius * radius, 0.5 / radius);
        let is_sound = radius > 0.0 && square > 0.0 && square.is_finite();
        is_sound.then_some(Self {
            to,
            from,
            line,
            is_bounded,
            square,
            half_inverse,
            height: 0.0,
            side: 1.0,
        })
    }

    /// Looks at a pose that counts.
    pub fn look(&mut self, x: &[Point]) {
        let [a, b] = self.line.map(|p| x[p as usize]);
        let c = x[self.from as usize];
        let e = b - a;
        self.height = e.cross(c - a) / e.norm_squared().sqrt();
        self.side = if e.dot(x[self.to as usize] - c) < 0.0 { -1.0 } else { 1.0 };
    }

    /// Puts the point where the circle meets the line, on the side where it was, if no pose on the
    /// way is nearly singular.
    #[inline]
    pub fn run(&mut self, x: &mut [Point], ways: &mut [f64], found: &mut Found) -> Option<()> {
        if ways[self.line[0] as usize] + ways[self.line[1] as usize] != 0.0 {
            return None;
        }
        let [a, b] = self.line.map(|p| x[p as usize]);
        let c = x[self.from as usize];
        let (e, u) = (b - a, c - a);
        let length_squared = e.norm_squared();
        let length = length_squared.sqrt();
        let height = e.cross(u) / length;
        let way = ways[self.from as usize];
        let middle = height + self.height;
        let farthest = 0.5 * (middle.abs() + way);
        let least = self.square - farthest * farthest;
        let squared = self.square - height * height;
        let floor = NEARLY_SINGULAR * NEARLY_SINGULAR * self.square;
        // False for what is not a number.
        let is_proved = least > floor && squared > floor;
        if !is_proved {
            return None;
        }
        // Its velocity is that of the centre over the cosine of the angle of the bar, at most.
        ways[self.to as usize] = way * (self.square / least).sqrt();
        let along = e.dot(u) / length_squared + self.side * squared.sqrt() / length;
        if self.is_bounded && !(0.0..=1.0).contains(&along) {
            return None;
        }
        let p = a + e * along;
        x[self.to as usize] = p;
        found.add(((p - c).norm_squared() - self.square) * self.half_inverse);
        found.add(e.cross(p - a) / length);
        found.add_side(squared / self.square);
        self.height = height;
        Some(())
    }
}
