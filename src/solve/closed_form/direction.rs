//! Where the end of a link is, at an angle to a link that is known.

use super::abreast::{Meeting, Met};
use super::found::larger;
use super::length::{Length, Values};
use crate::constraint::{Bounds, Constraint, Orientation, Period, Point, PointIdx, Vector};
use crate::solve::frame::branch::NEARLY_SINGULAR;

/// A point at a given distance from another, in a direction at a given angle to that of a segment.
pub(super) struct Direction {
    /// The point that is found.
    to: PointIdx,
    /// Where its link begins.
    from: PointIdx,
    /// The segment.
    along: [PointIdx; 2],
    /// The length of the link.
    bar: Length,
    /// The constraint that says the angle.
    pub constraint: u32,
    /// Whether that is the angle from the segment to the link, 1, or back, -1.
    sense: f64,
    /// Whether the link is named from its known end, 1, or towards it, -1.
    end: f64,
    /// Which of the numbers that drive the frame are its own.
    pub drive: u32,
    /// The length of the segment at the last pose.
    apart: f64,
}

impl Direction {
    /// A point at the distance of a bar's length from another, with the angle of an orientation, which is
    /// the constraint of number `c`; none where that does not say its direction.
    pub fn new(
        to: PointIdx,
        from: PointIdx,
        bar: Length,
        (c, orientation): (u32, &Orientation),
        drive: u32,
    ) -> Option<Self> {
        let [a, b, c1, d1] = orientation.points;
        let is_own = |pair: [PointIdx; 2]| pair == [from, to] || pair == [to, from];
        let (own, along, sense) = match (is_own([a, b]), is_own([c1, d1])) {
            (false, true) => ([c1, d1], [a, b], 1.0),
            (true, false) => ([a, b], [c1, d1], -1.0),
            _ => return None,
        };
        let is_sound = orientation.period == Period::Whole
            && orientation.bounds.is_equality()
            && !along.contains(&to)
            && bar.is_sound();
        let end = if own[0] == from { 1.0 } else { -1.0 };
        let (constraint, apart) = (c, 0.0);
        let link = Self { to, from, along, bar, constraint, sense, end, drive, apart };
        is_sound.then_some(link)
    }

    /// Takes in how long the link is in this frame.
    pub fn drive(&mut self, values: &Values) {
        self.bar.drive(values);
    }

    /// The bar that says how long the link is.
    pub fn bar(&self) -> Option<u32> {
        self.bar.bar()
    }

    /// The length of the link.
    pub fn length_mut(&mut self) -> &mut Length {
        &mut self.bar
    }

    /// Looks at a pose that counts.
    pub fn look(&mut self, x: &[Point]) {
        let [a, b] = self.along.map(|p| x[p as usize]);
        self.apart = (b - a).norm_squared().sqrt();
    }

    /// By which factors the link is longer than a unit, and turns by an angle.
    pub fn factors(&self) -> [f64; 2] {
        [self.end * self.bar.now, self.sense]
    }

    /// The link against the segment, as the values of its constraint have it, and how far its end
    /// goes from where other values had it.
    pub fn target<'a>(
        &self,
        now: &Constraint,
        before: impl Iterator<Item = &'a Constraint>,
    ) -> (Vector, f64) {
        let way: f64 = before.map(|before| (angle(now) - angle(before)).abs()).sum();
        let [length, sense] = self.factors();
        let target = Vector::polar(length, sense * angle(now));
        (target, way * (self.bar.now + self.bar.changed) + self.bar.changed)
    }
}

/// The angle that a constraint says.
pub(super) fn angle(constraint: &Constraint) -> f64 {
    match constraint {
        Constraint::Orientation(Orientation { bounds: Bounds { lo, .. }, .. }) => *lo,
        _ => f64::NAN,
    }
}

impl Meeting<3> for Direction {
    /// The length itself.
    type Sizes = Length;

    fn lengths(&self) -> [Length; 2] {
        [self.bar; 2]
    }

    #[inline(always)]
    fn sizes(&self) -> Length {
        self.bar
    }

    #[inline(always)]
    fn sizes_of([bar, _]: [Length; 2]) -> Length {
        bar
    }

    fn to(&self) -> PointIdx {
        self.to
    }

    fn from(&self) -> [PointIdx; 3] {
        [self.along[0], self.along[1], self.from]
    }

    fn drive(&self) -> Option<u32> {
        Some(self.drive)
    }

    /// The length of the segment.
    #[inline(always)]
    fn gauge(&self, [a, b, _]: [Point; 3]) -> f64 {
        (b - a).norm_squared().sqrt()
    }

    fn last(&mut self) -> &mut f64 {
        &mut self.apart
    }

    /// At the angle to the segment, if that is nowhere on its way nearly a point.
    #[inline(always)]
    fn meet(
        &self,
        &Length { now: length, changed, .. }: &Length,
        [a, b, from]: [Point; 3],
        [before, apart]: [f64; 2],
        ways: [f64; 3],
        (target, turned): (Vector, f64),
    ) -> Met {
        let way = ways[0] + ways[1];
        let least = 0.5 * (apart + before - way);
        // False for what is not a number.
        let is_proved = least > NEARLY_SINGULAR * length;
        let e = b - a;
        let v = e.times(target) / apart;
        let at = from + v;
        let arm = at - from;
        let off = larger(
            ((arm.norm_squared() - length * length) * (0.5 / length)).abs(),
            arm.cross(v) / length,
        );
        Met {
            at,
            // The segment turns by the ways of both ends over its length, at most.
            way: ways[2] + turned + way * (length + changed) / least,
            off: if is_proved { off } else { f64::NAN },
            side_squared: 1.0,
        }
    }
}
