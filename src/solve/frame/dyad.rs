//! One point found from constraints to known points.

use super::decomposition::{Block, Form, Side};
use crate::constraint::{Constraint, ConstraintKind, Point, PointIdx, Row, Vector};
use crate::solve::method::Limits;
use crate::solve::report::Counters;

/// A point that takes more steps than this is not near its solution.
const MOST_STEPS: u32 = 8;
/// Each step has to leave less than this part of the distance to satisfaction: convergence
/// near a solution is much faster, and far from one the whole island is a better judge.
const SLOWEST: f64 = 0.25;
/// See `newton`: damping relative to the distance to satisfaction, and its floor.
const DAMPING: f64 = 1e-2;
const FLOOR: f64 = 1e-11;
/// A step longer than this part of the size is no longer a small change.
const LONGEST_STEP: f64 = 0.5;

/// Bars closer to one line than this, as the sine of the angle between them, are left to
/// damped steps.
const IN_LINE: f64 = 1e-3;
/// Steps of a dyad before it counts as not near its solution.
const MOST_BLIND_STEPS: u32 = 3;

/// How a point was found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Found {
    /// The largest distance to satisfaction left, length units.
    pub worst: f64,
    /// How many steps it took.
    pub n_steps: u32,
    /// How far the point is from where it started, or from where the first step led if the
    /// start was no prediction.
    pub correction: f64,
    /// On which side of the singular pose it is, by the rows that told the side before.
    pub sine: f64,
    /// The same by the rows that tell it best now.
    pub side: Side,
    /// How far from here the other place is where its constraints hold, divided by the sine, squared.
    pub apart_squared: f64,
}

/// The rows of a block as they depend on its point, added up.
#[derive(Default)]
struct Sum {
    /// `g g^T` summed, and `g f`.
    xx: f64,
    xy: f64,
    yy: f64,
    fx: f64,
    fy: f64,
    worst: f64,
    n_rows: u32,
    /// The first active gradient, and which other one told the side before.
    first: Vector,
    other: u32,
    /// The cross product of the two, and the largest with any.
    sine: f64,
    side: Side,
    /// The shortest distance to the other end of a bar.
    shortest: f64,
}

impl Sum {
    fn new(other: u32) -> Self {
        Self { other, shortest: f64::INFINITY, ..Self::default() }
    }

    #[inline]
    fn add(&mut self, row: &Row, point: PointIdx) {
        if !row.is_active {
            return;
        }
        let term = row.terms().find(|&(p, _)| p == point);
        let g = term.map_or(Vector::ZERO, |(_, g)| g);
        let norm = g.norm_squared();
        // A row that does not feel its point cannot be met by moving it.
        if norm == 0.0 {
            self.worst = self.worst.max(row.f.abs());
            return;
        }
        let scale = 1.0 / norm.sqrt();
        self.add_unit(row.f * scale, g * scale);
    }

    /// Adds a row whose gradient is of length 1.
    #[inline]
    fn add_unit(&mut self, f: f64, g: Vector) {
        self.xx += g.x * g.x;
        self.xy += g.x * g.y;
        self.yy += g.y * g.y;
        self.fx += g.x * f;
        self.fy += g.y * f;
        self.worst = self.worst.max(f.abs());
        if self.n_rows == 0 {
            self.first = g;
        } else {
            let sine = self.first.cross(g);
            if self.n_rows == self.other {
                self.sine = sine;
            }
            if sine.abs() > self.side.sine.abs() {
                self.side = Side { sine, other: self.n_rows };
            }
        }
        self.n_rows += 1;
    }

    /// The Gauss-Newton step, damped by `mu` where the rows are nearly in line. A single row
    /// of a distance is met exactly by the step along it.
    fn step(&self, mu: f64) -> Vector {
        if self.n_rows == 1 {
            return Vector::new(-self.fx, -self.fy);
        }
        let is_sound = self.xx * self.yy - self.xy * self.xy > IN_LINE * IN_LINE;
        let mu = if is_sound { 0.0 } else { mu };
        let (a, b) = (self.xx + mu, self.yy + mu);
        let k = -1.0 / (a * b - self.xy * self.xy);
        Vector::new(b * self.fx - self.xy * self.fy, a * self.fy - self.xy * self.fx) * k
    }
}

/// Adds up the rows of a block at a pose.
fn evaluate(block: &Block, which: &[u32], all: &[Constraint], x: &[Point]) -> Sum {
    let p = block.point;
    let mut sum = Sum::new(block.side.other);
    for &c in which {
        let constraint = &all[c as usize];
        let felt = match constraint {
            Constraint::Length(bar) => {
                sum.shortest = sum.shortest.min(bar.bounds.lo);
                bar.felt_by(p, x)
            }
            Constraint::Glider(glider) => glider.felt_by(p, x),
            Constraint::Equal(equal) => equal.felt_by(p, x),
            _ => None,
        };
        match felt {
            Some((f, g)) => sum.add_unit(f, g),
            None => constraint.jacobian(x, &mut |row| sum.add(&row, p)),
        }
    }
    sum
}

/// The side of the singular pose a block is on, at a pose.
pub(crate) fn side(block: &Block, which: &[u32], all: &[Constraint], x: &[Point]) -> Side {
    if block.form == Form::Assignment {
        Side::default()
    } else {
        evaluate(block, which, all, x).side
    }
}

/// Puts the point of a block where its constraints `which` say; none if it is not near.
pub(crate) fn find(
    block: &Block,
    which: &[u32],
    all: &[Constraint],
    x: &mut [Point],
    is_predicted: bool,
    limits: &Limits,
    work: &mut Counters,
) -> Option<Found> {
    let p = block.point;
    work.evaluations += which.len() as u64;
    work.wheel_evaluations += u64::from(block.n_wheels);
    let mut reference = x[p as usize];
    match block.form {
        Form::Assignment => {
            // One linear equation: where the step leads is where the point belongs.
            x[p as usize] = assign(p, &all[which[0] as usize], x).filter(|at| at.is_finite())?;
            let d = x[p as usize] - reference;
            let correction = if is_predicted { d.x.abs().max(d.y.abs()) } else { 0.0 };
            let (side, apart_squared) = (Side::default(), f64::INFINITY);
            let (worst, n_steps, sine) = (0.0, 0, 0.0);
            return Some(Found { worst, n_steps, correction, sine, side, apart_squared });
        }
        Form::Dyad(others) if is_predicted => {
            let lengths = [which[0], which[1]].map(|c| length(&all[c as usize]));
            if let Some((at, found)) =
                meet(reference, others.map(|q| x[q as usize]), lengths, limits)
            {
                x[p as usize] = at;
                return Some(found);
            }
        }
        Form::Dyad(_) | Form::Any => {}
    }
    let mut sum = evaluate(block, which, all, x);
    let mut n_steps = 0;
    while sum.worst > limits.tolerance || sum.worst.is_nan() {
        let d = sum.step(DAMPING * (sum.worst / limits.size).min(1.0) + FLOOR);
        let longest = LONGEST_STEP * limits.size;
        let is_short = d.x.abs() <= longest && d.y.abs() <= longest;
        if !is_short || n_steps == MOST_STEPS {
            return None;
        }
        x[p as usize] += d;
        n_steps += 1;
        if n_steps == 1 && !is_predicted {
            reference = x[p as usize];
        }
        let before = sum.worst;
        sum = evaluate(block, which, all, x);
        work.evaluations += which.len() as u64;
        work.wheel_evaluations += u64::from(block.n_wheels);
        if sum.worst > (SLOWEST * before).max(limits.tolerance) {
            return None;
        }
    }
    let d = x[p as usize] - reference;
    let correction = d.x.abs().max(d.y.abs());
    let apart = 2.0 * sum.shortest.min(limits.size);
    let Sum { worst, sine, side, .. } = sum;
    Some(Found { worst, n_steps, correction, sine, side, apart_squared: apart * apart })
}

/// The place of `p` that satisfies a linear vector equation.
fn assign(p: PointIdx, constraint: &Constraint, x: &[Point]) -> Option<Point> {
    if let Constraint::Motor(motor) = constraint
        && let [o, driven] = motor.crank()
        && driven == p
    {
        return Some(x[o as usize] + motor.target());
    }
    let mut rows = [(0.0, Vector::ZERO); 2];
    let mut n = 0;
    constraint.jacobian(x, &mut |row| {
        let term = row.terms().find(|&(q, _)| q == p);
        rows[n.min(1)] = (row.f, term.map_or(Vector::ZERO, |(_, g)| g));
        n += 1;
    });
    let [(f, g), (h, k)] = rows;
    // The coefficient of the point as a complex number, squared; 0 for a point that is held
    // against itself.
    let det = g.cross(k);
    let d = Vector::new(h * g.y - f * k.y, f * k.x - h * g.x);
    (det > 0.0).then(|| x[p as usize] + d / det)
}

/// The length of a bar.
fn length(constraint: &Constraint) -> f64 {
    match constraint {
        Constraint::Length(bar) => bar.bounds.lo,
        _ => f64::NAN,
    }
}

/// Where bars of two lengths from two places meet, near `start`; none if they are nearly in
/// line, or the start is too far for the error to be told from the steps.
///
/// A step d that meets both linearised equations leaves of a length l no more than
/// d^2 / 2 (l - d). Once that is below the tolerance nothing needs to be evaluated again. By how much
/// the length is too long in the end follows from the part of d across it, c: by c^2 / 2 l at most.
fn meet(
    start: Point,
    others: [Point; 2],
    lengths: [f64; 2],
    limits: &Limits,
) -> Option<(Point, Found)> {
    let mut at = start;
    for n_steps in 1..=MOST_BLIND_STEPS {
        let [v, w] = others.map(|other| at - other);
        let (l, m) = (v.norm(), w.norm());
        let (f, h) = (l - lengths[0], m - lengths[1]);
        let side = v.cross(w);
        // All that follows is false for values that are not numbers.
        if side.abs() <= IN_LINE * l * m {
            return None;
        }
        let d = (w * (f * l) - v * (h * m)).perp() / side;
        at += d;
        let squared = d.norm_squared();
        let shortest = if l < m { l } else { m } - squared.sqrt();
        let left = 0.5 * squared / shortest;
        if shortest > 0.0 && left <= limits.tolerance {
            let moved = at - start;
            let (x, y) = (moved.x.abs(), moved.y.abs());
            let correction = if x > y { x } else { y };
            let sine = side / (l * m);
            let apart_squared = 4.0 * (l * m) * (l * m) / (v - w).norm_squared();
            let over = |across: f64, now: f64, length: f64| {
                let across = across / now;
                0.5 * across * across / length
            };
            let (over_l, over_m) =
                (over(d.cross(v), l, lengths[0]), over(d.cross(w), m, lengths[1]));
            let worst = if over_l > over_m { over_l } else { over_m };
            let side = Side { sine, other: 1 };
            let found = Found { worst, n_steps, correction, sine, side, apart_squared };
            return Some((at, found));
        }
    }
    None
}
