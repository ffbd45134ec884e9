//! One sweep over all constraints: each corrected exactly from the same pose, the corrections
//! added up. The innermost loop of the paper's method.

use std::ops::Range;

use super::coefficient::Coefficient;
use crate::constraint::{Constraint, ConstraintKind, Point, Vector};
use crate::solve::island::Island;
use crate::solve::parallel::{self, SHARE};
use crate::solve::report::Counters;

/// Bars are taken so many at a time, for the vector units: their roots and quotients cost
/// most and do not depend on each other.
const LANES: usize = 8;
/// Squares of lengths outside this range have lost digits or overflowed.
const SAFE_SQUARES: std::ops::Range<f64> = 1e-280..1e280;

/// Sums over shares, by point, beyond which sharing does not pay.
const MOST_SUMS: usize = 3;

/// What a sweep needs to know of the constraints of an island; made once for many sweeps.
pub(crate) struct Sweep {
    bars: Vec<Bar>,
    /// The constraints that are no bars, and the coefficient of each.
    others: Vec<(u32, f64)>,
    n_wheels: u64,
    /// The bars in shares for all cores, where there are enough of them.
    shares: Vec<Share>,
}

/// Bars that follow each other, and what they ask of the points between the first and the last
/// that they hold. The shares depend on the scene alone and their sums are added up in order, so
/// that the bits of a result do not depend on how many cores there are.
struct Share {
    bars: Range<usize>,
    first_point: usize,
    d: Vec<Vector>,
}

/// A length constraint, with the parts of its correction that do not depend on the pose.
struct Bar {
    /// Which constraint it is.
    c: u32,
    a: u32,
    b: u32,
    lo: f64,
    hi: f64,
    /// What of the excess each end takes over: rho w1 / (w1 + w2), and 2 for 1.
    share_a: f64,
    share_b: f64,
    /// (w1 + w2) ^ -1/2: the distance to satisfaction that an excess of 1 means.
    distance: f64,
}

impl Sweep {
    /// What sweeps over the constraints of an island need.
    pub fn new(island: &Island, coefficient: Coefficient) -> Self {
        let mut sweep =
            Self { bars: Vec::new(), others: Vec::new(), n_wheels: 0, shares: Vec::new() };
        for (c, constraint) in island.constraints.iter().enumerate() {
            let rho = coefficient.of(&island.own_rho, c);
            let c = c as u32;
            if let Constraint::Length(bar) = constraint
                && bar.points[0] != bar.points[1]
                && bar.bounds.lo <= bar.bounds.hi
            {
                let [a, b] = bar.points;
                let (w1, w2) = (island.w[a as usize], island.w[b as usize]);
                // An island has no bar whose ends are both frozen: the sum is not 0.
                let sum = w1 + w2;
                let (share_a, share_b) = (rho * w1 / sum, rho * w2 / sum);
                let (lo, hi, distance) = (bar.bounds.lo, bar.bounds.hi, 1.0 / sum.sqrt());
                sweep.bars.push(Bar { c, a, b, lo, hi, share_a, share_b, distance });
            } else {
                sweep.others.push((c, rho));
                sweep.n_wheels += u64::from(constraint.traits().is_wheel);
            }
        }
        if sweep.bars.len() >= parallel::ENOUGH_FOR_A_SWEEP {
            sweep.shares = shares(&sweep.bars, island.x.len());
        }
        sweep
    }

    /// Adds up the corrections of all constraints in `d`, which has a place for every point;
    /// gives the largest distance to satisfaction of those that can move anything.
    pub fn correct_all(
        &mut self,
        constraints: &[Constraint],
        x: &[Point],
        w: &[f64],
        d: &mut [Vector],
        work: &mut Counters,
    ) -> f64 {
        work.evaluations += constraints.len() as u64;
        work.wheel_evaluations += self.n_wheels;
        let mut worst = if self.shares.is_empty() {
            d.fill(Vector::ZERO);
            correct_each(&self.bars, constraints, x, 0, d)
        } else {
            self.correct_shares(constraints, x, d)
        };
        for &(c, rho) in &self.others {
            let mut squared = 0.0;
            constraints[c as usize].correct(x, w, &mut |p, v| {
                let p = p as usize;
                if w[p] > 0.0 {
                    squared += v.norm_squared() / w[p];
                    d[p] += v * rho;
                }
            });
            worst = worst.max(squared.sqrt());
        }
        worst
    }
}

impl Sweep {
    /// The same for the bars alone, share by share.
    fn correct_shares(&mut self, constraints: &[Constraint], x: &[Point], d: &mut [Vector]) -> f64 {
        let Self { bars, shares, .. } = self;
        let worst = parallel::map_reduce(
            shares,
            1,
            |share| {
                share.d.fill(Vector::ZERO);
                let bars = &bars[share.bars.clone()];
                correct_each(bars, constraints, x, share.first_point, &mut share.d)
            },
            0.0,
            f64::max,
        );
        let shares = &*shares;
        parallel::for_each_chunk(d, SHARE, |k, d| {
            d.fill(Vector::ZERO);
            for share in shares {
                share.add_to(k * SHARE, d);
            }
        });
        worst
    }
}

impl Share {
    /// Adds what it asks for to the points from `first` on.
    fn add_to(&self, first: usize, d: &mut [Vector]) {
        let from = first.max(self.first_point);
        let to = (first + d.len()).min(self.first_point + self.d.len());
        if from < to {
            let asked = &self.d[from - self.first_point..to - self.first_point];
            d[from - first..to - first].iter_mut().zip(asked).for_each(|(d, asked)| *d += *asked);
        }
    }
}

/// Parts bars, which are in the order of their points; nothing where bars that follow each other
/// hold points so far from each other that adding up would be most of the work.
fn shares(bars: &[Bar], n_points: usize) -> Vec<Share> {
    let mut shares = Vec::new();
    let mut n_sums = 0;
    for (k, part) in bars.chunks(SHARE).enumerate() {
        let ends = || part.iter().flat_map(|bar| [bar.a as usize, bar.b as usize]);
        let (first, last) = (ends().min().unwrap_or(0), ends().max().unwrap_or(0));
        n_sums += last + 1 - first;
        let bars = k * SHARE..k * SHARE + part.len();
        shares.push(Share { bars, first_point: first, d: vec![Vector::ZERO; last + 1 - first] });
        if n_sums > MOST_SUMS * n_points {
            return Vec::new();
        }
    }
    shares
}

/// Adds up the corrections of bars in `d`, which begins with the point `first`; gives the largest
/// distance to satisfaction.
fn correct_each(
    bars: &[Bar],
    constraints: &[Constraint],
    x: &[Point],
    first: usize,
    d: &mut [Vector],
) -> f64 {
    let mut worst = 0.0_f64;
    let (chunks, rest) = bars.as_chunks::<LANES>();
    for bars in chunks {
        worst = worst.max(correct_bars(bars, constraints, x, first, d));
    }
    for bar in rest {
        worst = worst.max(correct_bar(bar, constraints, x, first, d));
    }
    worst
}

/// The corrections of several bars; gives the largest distance to satisfaction.
#[inline]
fn correct_bars(
    bars: &[Bar; LANES],
    constraints: &[Constraint],
    x: &[Point],
    first: usize,
    d: &mut [Vector],
) -> f64 {
    let between = bars.each_ref().map(|bar| x[bar.b as usize] - x[bar.a as usize]);
    let squares = between.map(Vector::norm_squared);
    if !squares.iter().all(|square| SAFE_SQUARES.contains(square)) {
        let each = bars.iter().map(|bar| correct_bar(bar, constraints, x, first, d));
        return each.fold(0.0, f64::max);
    }
    let mut results = [(0.0, 0.0); LANES];
    for ((result, bar), square) in results.iter_mut().zip(bars).zip(squares) {
        *result = bar.excess(square);
    }
    let mut worst = 0.0_f64;
    for ((bar, between), (excess, factor)) in bars.iter().zip(between).zip(results) {
        bar.give(between * factor, first, d);
        worst = worst.max(excess.abs() * bar.distance);
    }
    worst
}

/// The correction of one bar, whatever its length.
fn correct_bar(
    bar: &Bar,
    constraints: &[Constraint],
    x: &[Point],
    first: usize,
    d: &mut [Vector],
) -> f64 {
    let between = x[bar.b as usize] - x[bar.a as usize];
    let square = between.norm_squared();
    if SAFE_SQUARES.contains(&square) {
        // The very operations of many at once: mirror images stay such to the bit.
        let (excess, factor) = bar.excess(square);
        bar.give(between * factor, first, d);
        return excess.abs() * bar.distance;
    }
    let mut excess = 0.0;
    constraints[bar.c as usize].jacobian(x, &mut |row| {
        excess = row.f;
        bar.give(row.gradient[1] * excess, first, d);
    });
    excess.abs() * bar.distance
}

impl Bar {
    /// The excess of its length, and the same as a part of the length.
    #[inline]
    fn excess(&self, square: f64) -> (f64, f64) {
        let l = square.sqrt();
        let excess = l - l.max(self.lo).min(self.hi);
        (excess, excess / l)
    }

    /// Lets each end take over its share.
    #[inline]
    fn give(&self, tau: Vector, first: usize, d: &mut [Vector]) {
        d[self.a as usize - first] += tau * self.share_a;
        d[self.b as usize - first] -= tau * self.share_b;
    }
}
