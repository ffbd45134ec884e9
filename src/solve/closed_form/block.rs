//! Bodies and points none of which can be found by itself: a few unknown numbers, found together.
//!
//! A body with a known point, or with one of another body, has one number, its angle; a point by itself, of
//! a body or not, has two. As many bars and [equations of constraints](Equation) as there are numbers say what they
//! are. They are found by Newton's method from where the last poses let the points be expected, and count by the
//! same rules as the parts of islands that are [solved as a whole](crate::solve::frame::predict): the pose is near
//! to where it was expected, and far from the other places where all of them hold.

use std::f64::consts::PI;

use super::abreast::{Abreast, Poses};
use super::equation::{End, Equation};
use super::found::larger;
use super::length::{Length, Values};
use crate::constraint::{Constraint, Point, PointIdx, Vector};
use crate::linalg::Square;
use crate::solve::frame::expected::{NO_MOTION, SURPRISE, is_clear};
use crate::solve::island::history::History;

/// No more numbers are found together.
pub(super) const MOST: usize = 4;
/// A pose whose least pivot is below this is left to others.
const NEAR: f64 = 1e-2;
/// A step that is so much shorter than the shortest bar or segment ends it: what is left is the square of that.
const SHORT: f64 = 1e-8;
const MOST_STEPS: u32 = 6;
/// How what is known moves with each number.
const NONE: [Vector; MOST] = [Vector::ZERO; MOST];

/// A body that turns about one of its points.
pub(super) struct Turning {
    pub pivot: End,
    /// Another point of it, which is found.
    pub to: PointIdx,
    /// How far that is from the pivot.
    pub arm: f64,
}

/// A bar that says what numbers are.
pub(super) struct Leg {
    pub ends: [End; 2],
    pub length: Length,
}

/// Points and bodies that are found together.
pub(super) struct Block {
    /// The points that have two numbers.
    pub bases: Vec<PointIdx>,
    /// The bodies, each after the one that it hangs on.
    pub bodies: Vec<Turning>,
    /// The bars that say what the numbers are, fewer than these where there are equations.
    pub legs: Vec<Leg>,
    /// The constraints that say the others.
    pub equations: Vec<Equation>,
    /// Where its points are expected; none while nothing is known.
    expected: Option<Pose>,
    /// From how many poses before the last.
    n_past: usize,
    /// How far each point that it finds went in the last frame.
    last_ways: [f64; MOST],
    /// The least pivot of its bars at the last pose, with the sign of their determinant.
    side: f64,
}

/// Where the points of a block are.
#[derive(Clone, Copy)]
struct Pose {
    bases: [Point; MOST / 2],
    /// The way from the pivot of each body to the point of it that is found.
    arms: [Vector; MOST],
}

/// A point, and how it moves with each number.
#[derive(Clone, Copy)]
struct Moving {
    at: Point,
    by: [Vector; MOST],
}

impl Block {
    /// One of these points and bodies.
    pub fn new(
        bases: Vec<PointIdx>,
        bodies: Vec<Turning>,
        legs: Vec<Leg>,
        equations: Vec<Equation>,
    ) -> Self {
        let last_ways = [0.0; MOST];
        Self { bases, bodies, legs, equations, expected: None, n_past: 0, last_ways, side: 0.0 }
    }

    /// How many numbers it finds.
    pub fn n_numbers(&self) -> usize {
        2 * self.bases.len() + self.bodies.len()
    }

    /// The points that it finds.
    pub fn finds(&self) -> impl Iterator<Item = PointIdx> + '_ {
        self.bases.iter().copied().chain(self.bodies.iter().map(|body| body.to))
    }

    /// Takes in how long its bars are in this frame.
    pub fn drive(&mut self, values: &Values) {
        self.legs.iter_mut().for_each(|leg| leg.length.drive(values));
    }

    /// Looks at a pose that counts.
    pub fn look(&mut self, x: &[Point], constraints: &[Constraint]) {
        let pose = self.pose(&|p| x[p as usize]);
        let found = self.square(&pose, &mut x.to_vec(), constraints);
        self.side = found.map_or(0.0, |(_, mut square)| square.eliminate());
    }

    /// Takes in where the frames before let its points be expected.
    pub fn expect(&mut self, history: &History, x: &[Point]) {
        self.n_past = history.n_past();
        // What stands still, and what is found before, is looked up when it is found.
        let there = |p: PointIdx| history.expect(p as usize).unwrap_or(x[p as usize]);
        self.expected = (self.n_past > 0).then(|| self.pose(&there));
        let mut last_ways = [0.0; MOST];
        for (to, p) in last_ways.iter_mut().zip(self.finds()) {
            *to = history.last_way(p as usize);
        }
        self.last_ways = last_ways;
    }

    /// Its points where these are.
    fn pose(&self, at: &impl Fn(PointIdx) -> Point) -> Pose {
        let mut pose = Pose { bases: [Point::ORIGIN; MOST / 2], arms: [Vector::ZERO; MOST] };
        for (to, p) in pose.bases.iter_mut().zip(&self.bases) {
            *to = at(*p);
        }
        for (j, body) in self.bodies.iter().enumerate() {
            let pivot = self.moving(body.pivot, &pose, at).at;
            let way = at(body.to) - pivot;
            pose.arms[j] = way * (body.arm / way.norm());
        }
        pose
    }

    /// Where a point is and how it moves.
    fn moving(&self, end: End, pose: &Pose, known: &impl Fn(PointIdx) -> Point) -> Moving {
        let mut by = [Vector::ZERO; MOST];
        let at = match end {
            End::Known(p) => known(p),
            End::Base(k) => {
                by[2 * k] = Vector::new(1.0, 0.0);
                by[2 * k + 1] = Vector::new(0.0, 1.0);
                pose.bases[k]
            }
            End::On(j, multiple) => {
                let pivot = self.moving(self.bodies[j].pivot, pose, known);
                let way = pose.arms[j].times(multiple);
                by = pivot.by;
                by[2 * self.bases.len() + j] += way.perp() / self.bodies[j].arm;
                pivot.at + way
            }
        };
        Moving { at, by }
    }

    /// How far each bar is from its length at most, and the rows of all, of length 1, with what they are to be; none
    /// where a constraint asks for more or less than its equations.
    fn square(
        &self,
        pose: &Pose,
        x: &mut [Point],
        constraints: &[Constraint],
    ) -> Option<(f64, Square<MOST>)> {
        let mut square = Square::new(self.n_numbers());
        let mut worst = 0.0;
        let known = |p: PointIdx| x[p as usize];
        for (r, leg) in self.legs.iter().enumerate() {
            let [a, b] = leg.ends.map(|end| self.moving(end, pose, &known));
            let (d, length) = (b.at - a.at, leg.length.now);
            let off = (d.norm_squared() - length * length) * (0.5 / length);
            worst = larger(worst, off);
            for (k, to) in square.row(r).iter_mut().enumerate() {
                *to = d.dot(b.by[k] - a.by[k]) / length;
            }
            let alone = (b.by[0] - a.by[0]).norm_squared();
            scale(&mut square, r, off, alone);
        }
        let mut r = self.legs.len();
        for equation in &self.equations {
            let mut moving = [(PointIdx::MAX, NONE); MOST];
            for (to, &(p, end)) in moving.iter_mut().zip(&equation.ends) {
                let Moving { at, by } = self.moving(end, pose, &|p| x[p as usize]);
                x[p as usize] = at;
                *to = (p, by);
            }
            equation.firm.rows(x, constraints, |of| {
                worst = larger(worst, of.f);
                let row = square.row(r);
                let mut alone = 0.0;
                for (p, gradient) in of.terms() {
                    let by = moving.iter().find(|(q, _)| *q == p).map_or(&NONE, |(_, by)| by);
                    row.iter_mut().zip(by).for_each(|(to, by)| *to += gradient.dot(*by));
                    alone += gradient.norm_squared() * by[0].norm_squared();
                }
                scale(&mut square, r, of.f, alone);
                r += 1;
            })?;
        }
        Some((worst, square))
    }

    /// Finds its points. Frames side by side, each of which is expected from the one before, it does not find.
    pub fn run<const N: usize>(
        &mut self,
        x: &mut (impl Poses<N> + ?Sized),
        constraints: &[Constraint],
        abreast: &mut Abreast<N>,
    ) {
        let side = x.one().and_then(|x| self.find(x, constraints, abreast));
        match side {
            Some(side) => {
                self.side = side;
                abreast.note_side(side * side);
            }
            None => abreast.check_each(|_| f64::NAN),
        }
    }

    /// The same in one frame by itself; gives on which side of a singular pose that is, none if its points are not
    /// where they were expected.
    fn find<const N: usize>(
        &self,
        x: &mut [Point],
        constraints: &[Constraint],
        abreast: &mut Abreast<N>,
    ) -> Option<f64> {
        let mut before = [Point::ORIGIN; MOST];
        for (to, p) in before.iter_mut().zip(self.finds()) {
            *to = x[p as usize];
        }
        // What goes around more than half a turn shows in no place.
        let is_far = abreast.turned.iter().any(|it| {
            let radius_squared = it.x[0] * it.x[0] + it.y[0] * it.y[0];
            it.way[0] * it.way[0] > PI * PI * radius_squared
        });
        if is_far {
            return None;
        }
        let (places, side) = self.solve(&before, x, constraints)?;
        for (k, p) in self.finds().enumerate() {
            x[p as usize] = places[k];
            // Where it turned back on the way it is taken to have gone no farther than in the frame before.
            abreast.ways[p as usize] = [places[k].distance(before[k]) + self.last_ways[k]; N];
        }
        Some(side)
    }

    /// Where its points are, and on which side of a singular pose that is; none if they are not where
    /// they were expected.
    fn solve(
        &self,
        before: &[Point; MOST],
        x: &mut [Point],
        constraints: &[Constraint],
    ) -> Option<([Point; MOST], f64)> {
        let mut pose = self.expected?;
        let expected = self.places(&pose, x);
        let lengths = self.legs.iter().map(|leg| leg.length.now);
        let spans = self.equations.iter().flat_map(|equation| equation.firm.spans(x));
        let shortest = lengths.chain(spans).fold(f64::INFINITY, f64::min);
        let mut n_steps = 0;
        let side = loop {
            let (worst, mut square) = self.square(&pose, x, constraints)?;
            let side = square.eliminate();
            let is_regular = side.abs() >= NEAR && worst.is_finite();
            if !is_regular || n_steps == MOST_STEPS {
                return None;
            }
            n_steps += 1;
            let step = square.solution();
            self.turn(&mut pose, &step);
            if step.iter().all(|part| part.abs() <= SHORT * shortest) {
                break side;
            }
        };
        let places = self.places(&pose, x);
        let farthest = |from: &[Point; MOST]| {
            let ways = places.iter().zip(from).map(|(to, from)| (*to - *from).norm());
            ways.take(self.bases.len() + self.bodies.len()).fold(0.0, f64::max)
        };
        let (correction, motion) = (farthest(&expected), farthest(before));
        let apart = 2.0 * shortest * side.abs();
        let doubt = correction / apart;
        let is_expected = correction <= SURPRISE * motion || motion <= NO_MOTION * shortest;
        let counts = self.side * side > 0.0
            && is_expected
            && is_clear(correction, motion, doubt * doubt, apart * apart, self.n_past);
        counts.then_some((places, side))
    }

    /// Where the points that it finds are.
    fn places(&self, pose: &Pose, x: &[Point]) -> [Point; MOST] {
        let known = |p: PointIdx| x[p as usize];
        let mut places = [Point::ORIGIN; MOST];
        let (of_bases, of_bodies) = places.split_at_mut(self.bases.len());
        of_bases.copy_from_slice(&pose.bases[..self.bases.len()]);
        for (j, to) in of_bodies.iter_mut().take(self.bodies.len()).enumerate() {
            *to = self.moving(End::On(j, Vector::new(1.0, 0.0)), pose, &known).at;
        }
        places
    }

    /// Takes a step.
    fn turn(&self, pose: &mut Pose, step: &[f64; MOST]) {
        let (of_bases, of_bodies) = step.split_at(2 * self.bases.len());
        for (at, d) in pose.bases.iter_mut().zip(of_bases.as_chunks::<2>().0) {
            *at += Vector::new(d[0], d[1]);
        }
        for ((arm, d), body) in pose.arms.iter_mut().zip(of_bodies).zip(&self.bodies) {
            // Turned by the angle to first order, and as long as it was.
            let turned = *arm + arm.perp() * (d / body.arm);
            *arm = turned * (body.arm / turned.norm());
        }
    }
}

/// Makes a row of length 1, and sets what it is to be, of a constraint that is off by so much. Where there is but
/// one number, the square of what the row could be at most, `alone`, takes the place of its length: it is shorter
/// the nearer the pose is to a singular one.
fn scale(square: &mut Square<MOST>, r: usize, off: f64, alone: f64) {
    let row = square.row(r);
    let squared = if row.len() == 1 { alone } else { row.iter().fold(0.0, |sum, g| sum + g * g) };
    let scale = 1.0 / squared.sqrt();
    row.iter_mut().for_each(|g| *g *= scale);
    square.set_right_side(r, -off * scale);
}
