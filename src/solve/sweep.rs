//! One sweep over all constraints: each corrected exactly from the same pose, the corrections
//! added up. The innermost loop of the paper's method.

use rayon::prelude::*;

use super::crew::{self, SHARE};
use super::island::Island;
use super::relaxation::Coefficient;
use super::rows::is_wheel;
use super::status::Counters;
use crate::constraint::{Constraint, Point, Relation, Vector};

/// Bars are taken so many at a time, for the vector units: their roots and quotients cost
/// most and do not depend on each other.
const LANES: usize = 8;
/// Squares of lengths outside this range have lost digits or overflowed.
const SAFE_SQUARES: std::ops::Range<f64> = 1e-280..1e280;

/// What a sweep needs to know of the constraints of an island; made once for many sweeps.
pub(super) struct Sweep {
    bars: Vec<Bar>,
    /// The constraints that are no bars, and the coefficient of each.
    others: Vec<(u32, f64)>,
    n_wheels: u64,
    /// What takes the bars to all cores; none where that does not pay.
    shared: Option<Shared>,
}

/// The same corrections, told by point instead of by bar: each point adds up what its bars ask
/// for in their order, so that the sums are those of one core.
struct Shared {
    /// Point `p` has the ends `first[p]..first[p + 1]`.
    first: Vec<u32>,
    /// Which bar, and whether it is its second end.
    ends: Vec<(u32, bool)>,
    /// Room for the correction of each bar.
    taus: Vec<Vector>,
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
        let mut sweep = Self { bars: Vec::new(), others: Vec::new(), n_wheels: 0, shared: None };
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
                sweep.n_wheels += u64::from(is_wheel(constraint));
            }
        }
        if crew::pays_for_a_sweep(sweep.bars.len()) {
            sweep.shared = Some(Shared::new(&sweep.bars, island.x.len()));
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
        let mut worst = if let Some(shared) = &mut self.shared {
            shared.correct_all(&self.bars, constraints, x, d)
        } else {
            d.fill(Vector::ZERO);
            correct_each(&self.bars, constraints, x, |bar, tau| bar.give(tau, d))
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

impl Shared {
    fn new(bars: &[Bar], n_points: usize) -> Self {
        let mut first = vec![0; n_points + 1];
        for bar in bars {
            first[bar.a as usize + 1] += 1;
            first[bar.b as usize + 1] += 1;
        }
        for p in 0..n_points {
            first[p + 1] += first[p];
        }
        let mut next = first.clone();
        let mut ends = vec![(0, false); 2 * bars.len()];
        for (k, bar) in bars.iter().enumerate() {
            for (p, is_second) in [(bar.a, false), (bar.b, true)] {
                let at = &mut next[p as usize];
                ends[*at as usize] = (k as u32, is_second);
                *at += 1;
            }
        }
        Self { first, ends, taus: vec![Vector::ZERO; bars.len()] }
    }

    /// Sets `d` to the corrections of all bars; gives the largest distance to satisfaction.
    fn correct_all(
        &mut self,
        bars: &[Bar],
        constraints: &[Constraint],
        x: &[Point],
        d: &mut [Vector],
    ) -> f64 {
        let shares = self.taus.par_chunks_mut(SHARE).zip(bars.par_chunks(SHARE));
        let worst = shares.map(|(taus, bars)| {
            let mut taus = taus.iter_mut();
            correct_each(bars, constraints, x, |_, tau| {
                *taus.next().expect("one for each bar") = tau;
            })
        });
        let worst = worst.reduce(|| 0.0, f64::max);
        let Self { first, ends, taus } = &*self;
        d.par_chunks_mut(SHARE).enumerate().for_each(|(share, d)| {
            for (p, d) in (share * SHARE..).zip(d) {
                *d = Vector::ZERO;
                for &(k, is_second) in &ends[first[p] as usize..first[p + 1] as usize] {
                    let (bar, tau) = (&bars[k as usize], taus[k as usize]);
                    if is_second {
                        *d -= tau * bar.share_b;
                    } else {
                        *d += tau * bar.share_a;
                    }
                }
            }
        });
        worst
    }
}

/// Hands on the correction of each bar, in order; gives the largest distance to satisfaction.
fn correct_each(
    bars: &[Bar],
    constraints: &[Constraint],
    x: &[Point],
    mut give: impl FnMut(&Bar, Vector),
) -> f64 {
    let mut worst = 0.0_f64;
    let (chunks, rest) = bars.as_chunks::<LANES>();
    for bars in chunks {
        worst = worst.max(correct_bars(bars, constraints, x, &mut give));
    }
    for bar in rest {
        worst = worst.max(correct_bar(bar, constraints, x, &mut give));
    }
    worst
}

/// The corrections of several bars; gives the largest distance to satisfaction.
#[inline]
fn correct_bars(
    bars: &[Bar; LANES],
    constraints: &[Constraint],
    x: &[Point],
    give: &mut impl FnMut(&Bar, Vector),
) -> f64 {
    let between = bars.each_ref().map(|bar| x[bar.b as usize] - x[bar.a as usize]);
    let squares = between.map(Vector::norm_squared);
    if !squares.iter().all(|square| SAFE_SQUARES.contains(square)) {
        let each = bars.iter().map(|bar| correct_bar(bar, constraints, x, give));
        return each.fold(0.0, f64::max);
    }
    let mut results = [(0.0, 0.0); LANES];
    for ((result, bar), square) in results.iter_mut().zip(bars).zip(squares) {
        *result = bar.excess(square);
    }
    let mut worst = 0.0_f64;
    for ((bar, between), (excess, factor)) in bars.iter().zip(between).zip(results) {
        give(bar, between * factor);
        worst = worst.max(excess.abs() * bar.distance);
    }
    worst
}

/// The correction of one bar, whatever its length.
fn correct_bar(
    bar: &Bar,
    constraints: &[Constraint],
    x: &[Point],
    give: &mut impl FnMut(&Bar, Vector),
) -> f64 {
    let between = x[bar.b as usize] - x[bar.a as usize];
    let square = between.norm_squared();
    if SAFE_SQUARES.contains(&square) {
        // The very operations of many at once: mirror images stay such to the bit.
        let (excess, factor) = bar.excess(square);
        give(bar, between * factor);
        return excess.abs() * bar.distance;
    }
    let mut excess = 0.0;
    constraints[bar.c as usize].jacobian(x, &mut |row| {
        excess = row.f;
        give(bar, row.gradient[1] * excess);
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
    fn give(&self, tau: Vector, d: &mut [Vector]) {
        d[self.a as usize] += tau * self.share_a;
        d[self.b as usize] -= tau * self.share_b;
    }
}
