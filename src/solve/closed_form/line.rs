//! Lines that are known, and where a circle around a known point meets one.

use super::abreast::{Meeting, Met};
use super::found::{larger, over_sine};
use super::length::{Length, Values};
use crate::constraint::{Aligned, AxisDirection, Point, PointIdx, Vector};
use crate::solve::frame::branch::NEARLY_SINGULAR;

/// A line through two points, parallel to it at a distance, or parallel to an axis through one.
#[derive(Clone, Copy)]
pub(super) struct Line {
    /// The points; that one twice.
    pub ends: [PointIdx; 2],
    /// What is added to the way from the one to the other: the unit vector of an axis, or nothing.
    axis: Vector,
    /// How far the line is to their left, length units.
    offset: f64,
    /// Whether only what is between them counts.
    pub is_bounded: bool,
}

/// A line in a frame, and how it moved.
#[derive(Clone, Copy)]
pub(super) struct Course {
    /// A point of it.
    pub base: Point,
    /// Along it, not of length 1.
    pub e: Vector,
    pub length: f64,
    /// By how much it turned at most, radians; not a number where that cannot be said.
    pub turn: f64,
    /// How far the point of it went at most.
    pub way: f64,
}

impl Line {
    /// The line through two points, or the part of it between them.
    pub fn through(ends: [PointIdx; 2], is_bounded: bool) -> Self {
        Self { ends, axis: Vector::ZERO, offset: 0.0, is_bounded }
    }

    /// The line to the left of two points.
    pub fn beside(ends: [PointIdx; 2], offset: f64) -> Self {
        Self { ends, axis: Vector::ZERO, offset, is_bounded: false }
    }

    /// The line parallel to an axis, through a point.
    pub fn parallel_to_axis(through: PointIdx, aligned: &Aligned) -> Self {
        let axis = match aligned.direction {
            AxisDirection::Horizontal => Vector::new(1.0, 0.0),
            AxisDirection::Vertical => Vector::new(0.0, 1.0),
        };
        Self { ends: [through; 2], axis, offset: 0.0, is_bounded: false }
    }

    /// Whether it is parallel to an axis.
    fn is_parallel_to_axis(&self) -> bool {
        self.axis != Vector::ZERO
    }

    /// Whether nothing but a hand moves it, where the first points are free.
    pub fn is_fixed(&self, n_free: usize) -> bool {
        self.ends.iter().all(|&p| p as usize >= n_free) && self.offset == 0.0
    }

    /// Along it where the points are there, and how long that is.
    #[inline(always)]
    fn along(&self, [a, b]: [Point; 2]) -> (Vector, f64) {
        let e = (b - a) + self.axis;
        (e, e.norm_squared().sqrt())
    }

    /// How far a point is to its left.
    #[inline(always)]
    pub fn height(&self, ends: [Point; 2], of: Point) -> f64 {
        let (e, length) = self.along(ends);
        e.cross(of - ends[0]) / length - self.offset
    }

    /// The line where the points are there, which went so far.
    #[inline(always)]
    pub fn course(&self, ends: [Point; 2], ways: [f64; 2]) -> Course {
        let (e, length) = self.along(ends);
        let base = ends[0] + e.perp() * (self.offset / length);
        // Both ends turn it, and it is no shorter on the way than that.
        let way = if self.is_parallel_to_axis() { 0.0 } else { ways[0] + ways[1] };
        let least = length - way;
        let turn = if least > NEARLY_SINGULAR * length { way / least } else { f64::NAN };
        Course { base, e, length, turn, way: ways[0] + self.offset.abs() * turn }
    }
}

impl Course {
    /// How far its part next to a point at this distance from its base went at most.
    #[inline(always)]
    pub fn way_at(&self, distance: f64) -> f64 {
        self.way + (distance + self.way) * self.turn
    }
}

/// A point at a given distance from another, on a line; `FIXED` if that is through points that nothing but a
/// hand moves.
pub(super) struct CircleLine<const FIXED: bool> {
    /// The point that is found.
    pub to: PointIdx,
    /// The centre.
    from: PointIdx,
    line: Line,
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
    /// The most it was.
    most: f64,
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
        let most = now + changed;
        Self {
            most,
            square: now * now,
            half_inverse: 0.5 / now,
            least_square: least * least,
            most_square: most * most,
            over_most_square: 1.0 / (most * most),
            changed,
        }
    }
}

impl<const FIXED: bool> CircleLine<FIXED> {
    /// A point at the distance `radius` from another, on a line; none where that is no distance.
    pub fn new(to: PointIdx, from: PointIdx, line: Line, radius: Length) -> Option<Self> {
        let of_radius = Numbers::new(radius);
        let meeting = Self { to, from, line, radius, of_radius, height: 0.0, side: 1.0 };
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
        let ends = self.line.ends.map(|p| x[p as usize]);
        let c = x[self.from as usize];
        self.height = self.line.height(ends, c);
        let e = self.line.along(ends).0;
        self.side = if e.dot(x[self.to as usize] - c) < 0.0 { -1.0 } else { 1.0 };
    }
}

impl<const FIXED: bool> Meeting<3> for CircleLine<FIXED> {
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
        [self.line.ends[0], self.line.ends[1], self.from]
    }

    /// The signed distance of the centre from the line.
    #[inline(always)]
    fn gauge(&self, [a, b, c]: [Point; 3]) -> f64 {
        self.line.height([a, b], c)
    }

    fn last(&mut self) -> &mut f64 {
        &mut self.height
    }

    /// Where the circle meets the line, on the side where the point was, if no pose on the way is nearly
    /// singular.
    #[inline(always)]
    fn meet(
        &self,
        of: &Numbers,
        [a, b, c]: [Point; 3],
        [before, height]: [f64; 2],
        ways: [f64; 3],
        _: (Vector, f64),
    ) -> Met {
        let line = if FIXED {
            let (e, length) = self.line.along([a, b]);
            let turn = if ways[0] + ways[1] == 0.0 { 0.0 } else { f64::NAN };
            Course { base: a, e, length, turn, way: 0.0 }
        } else {
            self.line.course([a, b], [ways[0], ways[1]])
        };
        let Course { base, e, length, turn, .. } = line;
        let u = c - base;
        let length_squared = e.norm_squared();
        // How far the centre and the line next to it went.
        let next = if FIXED { 0.0 } else { line.way_at(u.norm_squared().sqrt() + ways[2]) };
        let way = ways[2] + next;
        let middle = height + before;
        let farthest = 0.5 * (middle.abs() + way);
        let least = of.least_square - farthest * farthest;
        let squared = of.square - height * height;
        let floor = NEARLY_SINGULAR * NEARLY_SINGULAR * of.most_square;
        let along = e.dot(u) / length_squared + self.side * squared.sqrt() / length;
        let is_between = !self.line.is_bounded | (along >= 0.0) & (along <= 1.0);
        // False for what is not a number.
        let is_proved = (turn >= 0.0) & (least > floor) & (squared > floor) & is_between;
        let at = base + e * along;
        let off = larger(
            (((at - c).norm_squared() - of.square) * of.half_inverse).abs(),
            e.cross(at - a) / length - self.line.offset,
        );
        // The velocity of centre and radius along a line that stands still is that over the cosine of the
        // angle of the bar, at most; another line turns the bar besides.
        let over = over_sine(least * of.over_most_square);
        let slid = (way + of.changed) * over;
        let turned = if FIXED { 0.0 } else { of.changed * over + ways[2] + of.most * turn };
        Met {
            at,
            way: slid + turned,
            off: if is_proved { off } else { f64::NAN },
            side_squared: squared / of.square,
        }
    }
}

/// A point on two lines.
pub(super) struct Crossing {
    /// The point that is found.
    to: PointIdx,
    lines: [Line; 2],
    /// Nothing of the last pose is asked for.
    nothing: f64,
}

impl Crossing {
    /// A point on two lines; none where these are parallel whatever the pose. It is on the first to the bit if that
    /// is parallel to an axis: of two lines one that is comes first.
    pub fn new(to: PointIdx, mut lines: [Line; 2]) -> Option<Self> {
        if lines[1].is_parallel_to_axis() {
            lines.swap(0, 1);
        }
        let [one, other] = lines;
        let are_parallel = if one.is_parallel_to_axis() && other.is_parallel_to_axis() {
            one.axis == other.axis
        } else {
            one.ends == other.ends
        };
        (!are_parallel).then_some(Self { to, lines, nothing: 0.0 })
    }
}

impl Meeting<4> for Crossing {
    type Sizes = ();

    fn lengths(&self) -> [Length; 2] {
        [Length::fixed(0.0); 2]
    }

    #[inline(always)]
    fn sizes(&self) {}

    #[inline(always)]
    fn sizes_of(_: [Length; 2]) {}

    fn to(&self) -> PointIdx {
        self.to
    }

    fn from(&self) -> [PointIdx; 4] {
        let [one, other] = self.lines;
        [one.ends[0], one.ends[1], other.ends[0], other.ends[1]]
    }

    #[inline(always)]
    fn gauge(&self, _: [Point; 4]) -> f64 {
        0.0
    }

    fn last(&mut self) -> &mut f64 {
        &mut self.nothing
    }

    /// Where the lines cross, if they are nowhere on their way nearly parallel.
    #[inline(always)]
    fn meet(
        &self,
        (): &(),
        [a, b, c, d]: [Point; 4],
        _: [f64; 2],
        ways: [f64; 4],
        _: (Vector, f64),
    ) -> Met {
        let one = self.lines[0].course([a, b], [ways[0], ways[1]]);
        let other = self.lines[1].course([c, d], [ways[2], ways[3]]);
        let area = one.e.cross(other.e);
        let sine = area.abs() / (one.length * other.length);
        let along = (other.base - one.base).cross(other.e) / area;
        let at = one.base + one.e * along;
        let from = at - other.base;
        let off = larger(
            (one.e.cross(at - a) / one.length - self.lines[0].offset).abs(),
            other.e.cross(at - c) / other.length - self.lines[1].offset,
        );
        let is_between =
            |line: &Line, along: f64| !line.is_bounded | (along >= 0.0) & (along <= 1.0);
        let on_other = from.dot(other.e) / (other.length * other.length);
        let between = is_between(&self.lines[0], along) & is_between(&self.lines[1], on_other);
        // The sine changes by no more than both turn. The lines next to the point go across by what they
        // go by next to where it is now, and by what they turn times its own way: that is on both sides.
        let turn = one.turn + other.turn;
        let least = sine - 2.0 * turn;
        let across =
            one.way_at(along.abs() * one.length) + other.way_at(from.norm_squared().sqrt());
        // False for what is not a number.
        let is_proved = (least > NEARLY_SINGULAR) & between;
        Met {
            at,
            way: across / least,
            off: if is_proved { off } else { f64::NAN },
            side_squared: sine * sine,
        }
    }
}
