//! Where a circle around a known point meets a line that stands still.

use super::abreast::{Meeting, Met};
use super::found::{larger, over_sine};
use super::length::{Length, Values};
use crate::constraint::{Point, PointIdx, Vector};
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
    /// The radius, and what follows from it.
    radius: Length,
    of_radius: Numbers,
    /// The signed distance of the centre from the line at the last pose.
    height: f64,
    /// On which side of the foot of the centre the point is, along the line: 1 or -1.
    side: f64,
}

/// What follows from a radius, and from how much longer or shorter it was on its way.
#[derive(Clone, Copy)]
pub(super) struct Numbers {
    /// Its square, and half of one over it.
    square: f64,
    half_inverse: f64,
    /// The squares of what it was at least and at most on its way.
    least_square: f64,
    most_square: f64,
    /// One over the last.
    over_most_square: f64,
    /// How far it changed.
    changed: f64,
}

impl Numbers {
    #[inline(always)]
    fn new(Length { now, changed, .. }: Length) -> Self {
        let least = if now > changed { now - changed } else { 0.0 };
        let most_square = (now + changed) * (now + changed);
        Self {
            square: now * now,
            half_inverse: 0.5 / now,
            least_square: least * least,
            most_square,
            over_most_square: 1.0 / most_square,
            changed,
        }
    }
}

impl CircleLine {
    /// A point at the distance `radius` from another, on a line; none where that is no distance.
    pub fn new(
        to: PointIdx,
        from: PointIdx,
        line: [PointIdx; 2],
        radius: Length,
        is_bounded: bool,
    ) -> Option<Self> {
        let of_radius = Numbers::new(radius);
        let meeting =
            Self { to, from, line, is_bounded, radius, of_radius, height: 0.0, side: 1.0 };
        radius.is_sound().then_some(meeting)
    }

    /// Takes in how long the radius is in this frame.
    pub fn drive(&mut self, values: &Values) {
        self.radius.drive(values);
        self.of_radius = Numbers::new(self.radius);
    }

    /// The radius.
    pub fn radius_mut(&mut self) -> &mut Length {
        &mut self.radius
    }

    /// Looks at a pose that counts.
    pub fn look(&mut self, x: &[Point]) {
        let [a, b] = self.line.map(|p| x[p as usize]);
        let c = x[self.from as usize];
        let e = b - a;
        self.height = e.cross(c - a) / e.norm_squared().sqrt();
        self.side = if e.dot(x[self.to as usize] - c) < 0.0 { -1.0 } else { 1.0 };
    }
}

impl Meeting<3> for CircleLine {
    type Sizes = Numbers;

    fn lengths(&self) -> [Length; 2] {
        [self.radius; 2]
    }

    #[inline(always)]
    fn sizes(&self) -> Numbers {
        self.of_radius
    }

    #[inline(always)]
    fn sizes_of([radius, _]: [Length; 2]) -> Numbers {
        Numbers::new(radius)
    }

    fn to(&self) -> PointIdx {
        self.to
    }

    fn from(&self) -> [PointIdx; 3] {
        [self.line[0], self.line[1], self.from]
    }

    /// The signed distance of the centre from the line.
    #[inline(always)]
    fn gauge(&self, [a, b, c]: [Point; 3]) -> f64 {
        let e = b - a;
        e.cross(c - a) / e.norm_squared().sqrt()
    }

    fn last(&mut self) -> &mut f64 {
        &mut self.height
    }

    /// Where the circle meets the line, on the side where the point was, if the line stands still and
    /// no pose on the way is nearly singular.
    #[inline(always)]
    fn meet(
        &self,
        of: &Numbers,
        [a, b, c]: [Point; 3],
        [before, height]: [f64; 2],
        ways: [f64; 3],
        _: (Vector, f64),
    ) -> Met {
        let (e, u) = (b - a, c - a);
        let length_squared = e.norm_squared();
        let length = length_squared.sqrt();
        let way = ways[2];
        let middle = height + before;
        let farthest = 0.5 * (middle.abs() + way);
        let least = of.least_square - farthest * farthest;
        let squared = of.square - height * height;
        let floor = NEARLY_SINGULAR * NEARLY_SINGULAR * of.most_square;
        let along = e.dot(u) / length_squared + self.side * squared.sqrt() / length;
        let is_between = !self.is_bounded | (along >= 0.0) & (along <= 1.0);
        // False for what is not a number.
        let is_proved =
            (ways[0] + ways[1] == 0.0) & (least > floor) & (squared > floor) & is_between;
        let at = a + e * along;
        let off = larger(
            (((at - c).norm_squared() - of.square) * of.half_inverse).abs(),
            e.cross(at - a) / length,
        );
        Met {
            at,
            // Its velocity is that of centre and radius over the cosine of the angle of the bar, at most.
            way: (way + of.changed) * over_sine(least * of.over_most_square),
            off: if is_proved { off } else { f64::NAN },
            side_squared: squared / of.square,
        }
    }
}
