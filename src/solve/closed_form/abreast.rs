//! Frames found side by side: for each number of a frame as many as there are frames.
//!
//! A step is a function of plain numbers. It is called for each frame in a loop without branches, which
//! the compiler turns into vector instructions; a frame by itself is the same loop over one. Nothing is
//! fused and no sum is taken in another order, so the width never shows in the bits.

use super::found::{Found, larger};
use super::length::{Length, Timed};
use crate::constraint::{Counts, Point, PointIdx, Vector};

/// How many frames pass side by side, where they do.
pub(crate) const WIDE: usize = 8;

/// Where a point is in each frame. What is aligned is read and written whole.
#[derive(Clone, Copy)]
#[repr(align(64))]
pub(super) struct Places<const N: usize> {
    pub x: [f64; N],
    pub y: [f64; N],
}

impl<const N: usize> Places<N> {
    /// The same in all frames.
    pub fn all(at: Point) -> Self {
        Self { x: [at.x; N], y: [at.y; N] }
    }

    /// Where it is in one of them.
    #[inline(always)]
    pub fn at(&self, l: usize) -> Point {
        Point::new(self.x[l], self.y[l])
    }

    /// Puts it elsewhere in one of them.
    #[inline(always)]
    pub fn set(&mut self, l: usize, at: Point) {
        (self.x[l], self.y[l]) = (at.x, at.y);
    }
}

/// Where all points of an island are in each frame.
pub(super) trait Poses<const N: usize> {
    /// Where a point is.
    fn get(&self, p: PointIdx) -> Places<N>;
    /// Puts a point elsewhere.
    fn put(&mut self, p: PointIdx, at: Places<N>);
    /// The pose of a frame by itself; none where there are several.
    fn one(&mut self) -> Option<&mut [Point]>;
}

impl Poses<1> for [Point] {
    #[inline(always)]
    fn get(&self, p: PointIdx) -> Places<1> {
        Places::all(self[p as usize])
    }

    #[inline(always)]
    fn put(&mut self, p: PointIdx, at: Places<1>) {
        self[p as usize] = at.at(0);
    }

    #[inline(always)]
    fn one(&mut self) -> Option<&mut [Point]> {
        Some(self)
    }
}

impl<const N: usize> Poses<N> for [Places<N>] {
    #[inline(always)]
    fn get(&self, p: PointIdx) -> Places<N> {
        self[p as usize]
    }

    #[inline(always)]
    fn put(&mut self, p: PointIdx, at: Places<N>) {
        self[p as usize] = at;
    }

    #[inline(always)]
    fn one(&mut self) -> Option<&mut [Point]> {
        None
    }
}

/// Where a crank points in each frame, or a place is.
#[derive(Clone, Copy)]
#[repr(align(64))]
pub(super) struct Turned<const N: usize> {
    /// Where its end is, from the centre; or where the place is.
    pub x: [f64; N],
    pub y: [f64; N],
    /// How far that went in the frame, around the centre.
    pub way: [f64; N],
}

impl<const N: usize> Turned<N> {
    const NOT: Self = Self { x: [0.0; N], y: [0.0; N], way: [0.0; N] };

    /// Where it points in one of them, and how far it went.
    #[inline(always)]
    pub fn at(&self, l: usize) -> (Vector, f64) {
        (Vector::new(self.x[l], self.y[l]), self.way[l])
    }

    /// In one of them it points there, and went so far.
    #[inline(always)]
    pub fn set(&mut self, l: usize, target: Vector, way: f64) {
        (self.x[l], self.y[l], self.way[l]) = (target.x, target.y, way);
    }
}

/// What drives frames, and what they came to.
pub(super) struct Abreast<const N: usize> {
    /// How far each point went in each frame at most, along its way.
    pub ways: Vec<[f64; N]>,
    /// Where each crank points.
    pub turned: Vec<Turned<N>>,
    /// The lengths that follow time.
    pub lengths: Vec<Timed<N>>,
    /// How far each wheel has turned after each frame, where there are several.
    pub counts: Vec<[Counts; N]>,
    /// The largest distance to satisfaction of each frame; not a number where a step could not say
    /// where its point is.
    worst: [f64; N],
    /// How near each pose is to a singular one, as the square of the sine of an angle.
    least_side_squared: [f64; N],
}

impl<const N: usize> Abreast<N> {
    /// For so many points and cranks, none of which moves.
    pub fn new(n_points: usize, n_cranks: usize) -> Self {
        Self {
            ways: vec![[0.0; N]; n_points],
            turned: vec![Turned::NOT; n_cranks],
            lengths: Vec::new(),
            counts: Vec::new(),
            worst: [0.0; N],
            least_side_squared: [1.0; N],
        }
    }

    /// No step was made yet.
    #[inline(always)]
    pub fn begin(&mut self) {
        (self.worst, self.least_side_squared) = ([0.0; N], [1.0; N]);
    }

    /// From the frame of this number on they are to be found in another way.
    #[inline(always)]
    pub fn end_at(&mut self, l: usize) {
        self.worst[l..].fill(f64::NAN);
    }

    /// What a frame came to.
    #[inline(always)]
    pub fn found(&self, l: usize) -> Found {
        Found { worst: self.worst[l], least_side_squared: self.least_side_squared[l] }
    }

    /// The worst of what all frames came to.
    #[inline(always)]
    pub fn found_in_all(&self) -> Found {
        let (mut worst, mut least) = (self.worst, self.least_side_squared);
        let mut n = N;
        while n > 1 {
            n /= 2;
            for l in 0..n {
                worst[l] = larger(worst[l], worst[l + n]);
                least[l] = if least[l + n] < least[l] { least[l + n] } else { least[l] };
            }
        }
        Found { worst: worst[0], least_side_squared: least[0] }
    }

    /// Takes in what a check came to in each frame.
    #[inline(always)]
    pub fn check_each(&mut self, off: impl Fn(usize) -> f64) {
        (0..N).for_each(|l| self.add(l, off(l), 1.0));
    }

    /// Takes in how near each pose is to a singular one.
    #[inline(always)]
    pub fn note_side(&mut self, side_squared: f64) {
        (0..N).for_each(|l| self.add(l, 0.0, side_squared));
    }

    /// Takes in what a step came to in a frame.
    #[inline(always)]
    fn add(&mut self, l: usize, off: f64, side_squared: f64) {
        self.worst[l] = larger(self.worst[l], off);
        let least = self.least_side_squared[l];
        self.least_side_squared[l] = if side_squared < least { side_squared } else { least };
    }
}

/// Where a step puts its point.
pub(super) struct Met {
    /// There.
    pub at: Point,
    /// How far it went in the frame at most, along its way.
    pub way: f64,
    /// The distance to satisfaction there; not a number where it is not proved that it stayed on its
    /// side.
    pub off: f64,
    /// How near that is to a singular pose, as the square of the sine of an angle.
    pub side_squared: f64,
}

/// A step that finds a point from `K` that are known, and a number of the last pose.
pub(super) trait Meeting<const K: usize> {
    /// The numbers that follow from its lengths.
    type Sizes: Copy;
    /// Its lengths; of a step that has but one, that twice.
    fn lengths(&self) -> [Length; 2];
    /// What follows from them.
    fn sizes(&self) -> Self::Sizes;
    /// What follows from others.
    fn sizes_of(lengths: [Length; 2]) -> Self::Sizes;
    /// The point that is found.
    fn to(&self) -> PointIdx;
    /// The points it follows from.
    fn from(&self) -> [PointIdx; K];
    /// What of a pose tells how near a singular one is.
    fn gauge(&self, from: [Point; K]) -> f64;
    /// That of the last pose.
    fn last(&mut self) -> &mut f64;
    /// Where the point is, with that number before and now, how far the others went, and what drives it.
    fn meet(
        &self,
        of: &Self::Sizes,
        from: [Point; K],
        gauges: [f64; 2],
        ways: [f64; K],
        drive: (Vector, f64),
    ) -> Met;

    /// Which of the numbers that drive frames it is given, if any.
    fn drive(&self) -> Option<u32> {
        None
    }

    /// Finds the point in each frame.
    #[inline(always)]
    fn run<const N: usize>(&mut self, x: &mut (impl Poses<N> + ?Sized), abreast: &mut Abreast<N>) {
        let lengths = self.lengths();
        if N > 1 && lengths.iter().any(Length::is_timed) {
            let each = lengths.each_ref().map(|length| length.each(&abreast.lengths));
            let in_lane = |l: usize| [0, 1].map(|k| lengths[k].in_lane(&each[k], l));
            self.meet_each(x, abreast, |l| Self::sizes_of(in_lane(l)));
        } else {
            let of = self.sizes();
            self.meet_each(x, abreast, |_| of);
        }
    }

    /// The same, with what follows from the lengths in each frame.
    #[inline(always)]
    #[allow(clippy::needless_range_loop, reason = "one loop over all, that vectors are made of")]
    fn meet_each<const N: usize>(
        &mut self,
        x: &mut (impl Poses<N> + ?Sized),
        abreast: &mut Abreast<N>,
        of: impl Fn(usize) -> Self::Sizes,
    ) {
        let from = self.from();
        let places = from.map(|p| x.get(p));
        let ways = from.map(|p| abreast.ways[p as usize]);
        let mut gauges = [0.0; N];
        for l in 0..N {
            gauges[l] = self.gauge(places.each_ref().map(|p| p.at(l)));
        }
        let last = std::mem::replace(self.last(), gauges[N - 1]);
        let before: [f64; N] = std::array::from_fn(|l| if l == 0 { last } else { gauges[l - 1] });
        let turned = self.drive().map_or(Turned::NOT, |k| abreast.turned[k as usize]);
        let (mut at, mut way) = (Places::all(Point::ORIGIN), [0.0; N]);
        for l in 0..N {
            let now = places.each_ref().map(|p| p.at(l));
            let ways = ways.each_ref().map(|way| way[l]);
            let met = self.meet(&of(l), now, [before[l], gauges[l]], ways, turned.at(l));
            at.set(l, met.at);
            way[l] = met.way;
            abreast.add(l, met.off, met.side_squared);
        }
        x.put(self.to(), at);
        abreast.ways[self.to() as usize] = way;
    }
}

/// Finds a point in each frame that a number of the last pose is not asked for: where it is, how far
/// it went, and how far that is off.
#[inline(always)]
pub(super) fn put_each<const N: usize>(
    to: PointIdx,
    x: &mut (impl Poses<N> + ?Sized),
    abreast: &mut Abreast<N>,
    each: impl Fn(usize) -> (Point, f64, f64),
) {
    let (mut at, mut way) = (Places::all(Point::ORIGIN), [0.0; N]);
    #[allow(clippy::needless_range_loop, reason = "one loop over all, that vectors are made of")]
    for l in 0..N {
        let (there, went, off) = each(l);
        at.set(l, there);
        way[l] = went;
        abreast.add(l, off, 1.0);
    }
    x.put(to, at);
    abreast.ways[to as usize] = way;
}
