//! The equations of an island, linearised at a pose: normalised and weighted.

use std::ops::Range;

use crate::constraint::{
    Activity, Constraint, ConstraintKind, Field, Jet, Point, PointIdx, Real, Row, Vec2, Vector,
};
use crate::interrupt::tick;
use crate::solve::report::Counters;

/// A constraint of no more points has all of them in each of its rows, as far as we know; so has
/// one with measured values.
const MOST_POINTS_OF_A_ROW: usize = 4;

/// Which constraints are to be met by moving which points, and which rows hold which of them.
///
/// The pattern does not depend on the pose: inactive inequalities keep their place.
#[derive(Debug, Clone)]
pub(crate) struct Equations {
    /// The constraints, as indices among those of the island, ascending.
    constraints: Vec<u32>,
    /// The points to move, as indices among those of the island, ascending.
    points: Vec<PointIdx>,
    /// The square root of the inverse mass of each of them.
    root_w: Vec<f64>,
    /// Row `r` has the entries `start[r]..start[r + 1]`.
    start: Vec<u32>,
    /// For each entry which of `points` it is.
    unknown: Vec<u32>,
    /// How many of `constraints` hold wheels.
    n_wheels: u64,
    /// Whether all rows are linear, whatever the pose.
    is_affine: bool,
}

impl Equations {
    /// The rows of `constraints` as far as they depend on `points`.
    pub fn new(
        all: &[Constraint],
        constraints: Vec<u32>,
        points: Vec<PointIdx>,
        x: &[Point],
        w: &[f64],
    ) -> Self {
        let mut unknown_of = vec![None; x.len()];
        for (unknown, &p) in points.iter().enumerate() {
            unknown_of[p as usize] = Some(unknown as u32);
        }
        let mut start = vec![0];
        let mut unknown = Vec::new();
        let mut push = |row: &[PointIdx]| {
            let first = unknown.len();
            for entry in row.iter().filter_map(|&p| unknown_of[p as usize]) {
                if !unknown[first..].contains(&entry) {
                    unknown.push(entry);
                }
            }
            start.push(unknown.len() as u32);
        };
        for &c in &constraints {
            let constraint = &all[c as usize];
            if constraint.points().len() <= MOST_POINTS_OF_A_ROW
                || matches!(constraint, Constraint::Measured(_))
            {
                (0..constraint.n_rows()).for_each(|_| push(constraint.points()));
            } else {
                // Large bodies: each row holds the same few points at every pose.
                constraint.jacobian(x, &mut |row| push(&row.points[..row.n_points]));
            }
        }
        start.shrink_to_fit();
        unknown.shrink_to_fit();
        let n_wheels =
            constraints.iter().filter(|&&c| all[c as usize].traits().is_wheel).count() as u64;
        let is_affine = constraints.iter().all(|&c| {
            let traits = all[c as usize].traits();
            traits.is_linear && traits.activity == Activity::Always
        });
        let root_w = points.iter().map(|&p| w[p as usize].sqrt()).collect();
        Self { constraints, points, root_w, start, unknown, n_wheels, is_affine }
    }

    /// Whether all rows are linear, whatever the pose: one step meets them, however long.
    pub const fn is_affine(&self) -> bool {
        self.is_affine
    }

    /// The points to move.
    pub fn points(&self) -> &[PointIdx] {
        &self.points
    }

    /// How many rows there are.
    pub fn n_rows(&self) -> usize {
        self.start.len() - 1
    }

    /// The points that row `r` holds, as indices among [`Equations::points`].
    fn unknowns(&self, r: usize) -> &[u32] {
        &self.unknown[self.start[r] as usize..self.start[r + 1] as usize]
    }

    /// For each row the points it holds, as indices among [`Equations::points`].
    pub fn pattern(&self) -> impl Iterator<Item = &[u32]> + Clone {
        self.start.windows(2).map(|ends| &self.unknown[ends[0] as usize..ends[1] as usize])
    }

    /// Moves the points by `t` times a step in the weighted unknowns; true if all of them
    /// are finite after it.
    pub fn displace(&self, x: &mut [Point], from: &[Point], step: &[f64], t: f64) -> bool {
        let mut is_finite = true;
        let (steps, _) = step.as_chunks::<2>();
        for (((&p, from), step), root_w) in
            self.points.iter().zip(from).zip(steps).zip(&self.root_w)
        {
            let k = t * root_w;
            let to = *from + Vector::new(step[0] * k, step[1] * k);
            is_finite &= to.is_finite();
            x[p as usize] = to;
        }
        is_finite
    }

    /// Copies the points to move out of a pose.
    pub fn gather(&self, x: &[Point], to: &mut Vec<Point>) {
        to.clear();
        to.extend(self.points.iter().map(|&p| x[p as usize]));
    }

    /// Copies them back.
    pub fn scatter(&self, from: &[Point], x: &mut [Point]) {
        for (&p, at) in self.points.iter().zip(from) {
            x[p as usize] = *at;
        }
    }

    /// The way from one pose of the points to another, in the weighted unknowns.
    pub fn way(&self, from: &[Point], to: &[Point], way: &mut Vec<f64>) {
        way.clear();
        for ((from, to), root_w) in from.iter().zip(to).zip(&self.root_w) {
            let d = (*to - *from) / *root_w;
            way.extend([d.x, d.y]);
        }
    }

    /// The longest displacement of a point in a step of the weighted unknowns.
    pub fn reach(&self, step: &[f64]) -> f64 {
        let (steps, _) = step.as_chunks::<2>();
        let squares = steps.iter().zip(&self.root_w);
        squares.fold(0.0_f64, |most, (s, w)| most.max(s[0].abs().max(s[1].abs()) * w))
    }
}

/// What the evaluation of a row takes, in ticks.
const ROW: usize = 20;

/// The rows at a pose, normalised: a gradient is of length 1 in the metric of the weights, so
/// that each value is a distance to satisfaction and all kinds compare.
#[derive(Debug, Clone, Default)]
pub(crate) struct Rows {
    /// What normalises each row; 0 for one that asks for nothing.
    scale: Vec<f64>,
    /// The normalised values.
    f: Vec<f64>,
    /// The normalised gradients, (x, y) for each entry of the pattern.
    gradient: Vec<f64>,
    /// `sqrt(f / l)` of a stretched length: how much stiffer than its rows it is crosswise.
    bend: Vec<f64>,
    /// The largest distance of a constraint to satisfaction, all its rows together: that does not
    /// depend on the axes. Not to be trusted while `energy` is not finite.
    pub worst: f64,
    /// Half the sum of their squares.
    pub energy: f64,
}

impl Rows {
    /// Evaluates all rows at a pose.
    pub fn evaluate(
        &mut self,
        equations: &Equations,
        all: &[Constraint],
        x: &[Point],
        work: &mut Counters,
    ) {
        self.evaluate_each(equations, all, x, work, |_, _, _| {});
    }

    /// The same; gives half the sum of squares in the scales of another pose, so that it compares
    /// with the energy there.
    pub fn evaluate_as_scaled_by(
        &mut self,
        scale: &[f64],
        equations: &Equations,
        all: &[Constraint],
        x: &[Point],
        work: &mut Counters,
    ) -> f64 {
        let mut squares = 0.0;
        self.evaluate_each(equations, all, x, work, |r, raw, own| {
            let f = raw * if scale[r] > 0.0 { scale[r] } else { own };
            squares += f * f;
        });
        0.5 * squares
    }

    /// Evaluates all rows; `note` gets the number of each, its value in the units of the
    /// constraint, and what normalises it.
    fn evaluate_each(
        &mut self,
        equations: &Equations,
        all: &[Constraint],
        x: &[Point],
        work: &mut Counters,
        mut note: impl FnMut(usize, f64, f64),
    ) {
        let n_rows = equations.n_rows();
        self.scale.resize(n_rows, 0.0);
        self.f.resize(n_rows, 0.0);
        self.bend.resize(n_rows, 0.0);
        self.gradient.resize(2 * equations.unknown.len(), 0.0);
        self.worst = 0.0;
        self.energy = 0.0;
        let mut r = 0;
        for &c in &equations.constraints {
            let first = r;
            let (mut distance, mut squares) = (0.0, 0.0);
            all[c as usize].jacobian(x, &mut |row| {
                note(r, row.f, self.set(equations, r, &row));
                // A row without a gradient is as far from satisfaction as its value says.
                distance = if self.scale[r] > 0.0 { self.f[r].abs() } else { row.f.abs() };
                squares += distance * distance;
                r += 1;
            });
            let of_one = if r - first == 1 { distance } else { squares.sqrt() };
            self.worst = self.worst.max(of_one);
        }
        tick(ROW * n_rows);
        debug_assert_eq!(r, n_rows, "a constraint gives as many rows as it says");
        self.energy *= 0.5;
        work.evaluations += equations.constraints.len() as u64;
        work.wheel_evaluations += equations.n_wheels;
    }

    /// Puts a row in its place; gives what normalises it.
    fn set(&mut self, equations: &Equations, r: usize, row: &Row) -> f64 {
        let entries = equations.start[r] as usize..equations.start[r + 1] as usize;
        if !row.f.is_finite() {
            return self.set_without_value(r, entries);
        }
        let gradient = &mut self.gradient[2 * entries.start..2 * entries.end];
        let (gradient, _) = gradient.as_chunks_mut::<2>();
        let mut squared = 0.0;
        for (&unknown, to) in equations.unknown[entries.clone()].iter().zip(&mut *gradient) {
            let unknown = unknown as usize;
            let point = equations.points[unknown];
            let term = row.terms().find(|&(p, _)| p == point);
            let g = term.map_or(Vector::ZERO, |(_, g)| g * equations.root_w[unknown]);
            *to = [g.x, g.y];
            squared += g.norm_squared();
        }
        let norm = if squared.is_normal() { squared.sqrt() } else { norm_of(gradient) };
        if !norm.is_finite() {
            return self.set_without_value(r, entries);
        }
        let scale = if row.is_active && norm > 0.0 { 1.0 / norm } else { 0.0 };
        gradient.as_flattened_mut().iter_mut().for_each(|g| *g *= scale);
        let f = row.f * scale;
        self.scale[r] = scale;
        self.f[r] = f;
        let is_stretched = row.span > 0.0 && row.f > 0.0;
        self.bend[r] = if is_stretched { (row.f / row.span).sqrt() } else { 0.0 };
        self.energy += f * f;
        scale
    }

    /// The same for a row that has no value at the pose: it is out of the question.
    fn set_without_value(&mut self, r: usize, entries: Range<usize>) -> f64 {
        self.gradient[2 * entries.start..2 * entries.end].fill(0.0);
        (self.scale[r], self.f[r], self.bend[r]) = (0.0, 0.0, 0.0);
        self.worst = f64::INFINITY;
        self.energy = f64::INFINITY;
        0.0
    }

    /// What normalises each row; 0 for one that asks for nothing.
    pub fn scales(&self) -> &[f64] {
        &self.scale
    }

    /// How many rows ask for something.
    pub fn n_active(&self) -> usize {
        self.scale.iter().filter(|scale| **scale > 0.0).count()
    }

    /// The rows: normalised value, gradient by entry, stiffness across a stretched length.
    pub fn iter<'a>(
        &'a self,
        equations: &'a Equations,
    ) -> impl Iterator<Item = (f64, &'a [u32], &'a [f64], f64)> {
        equations.start.windows(2).zip(self.f.iter().zip(&self.bend)).map(|(ends, (f, bend))| {
            let (a, b) = (ends[0] as usize, ends[1] as usize);
            (*f, &equations.unknown[a..b], &self.gradient[2 * a..2 * b], *bend)
        })
    }

    /// For each row that is not met its value times its second derivatives by the weighted
    /// unknowns, row by row of the matrix, with the row's number.
    pub fn each_curvature(
        &self,
        equations: &Equations,
        all: &[Constraint],
        x: &[Point],
        mut give: impl FnMut(usize, &[f64]),
    ) {
        // Time stands still: no motor turns.
        let at_rest = |field: Field, value: f64| {
            Jet::constant(if field == Field::Speed { 0.0 } else { value })
        };
        let mut first = 0;
        for &c in &equations.constraints {
            let constraint = &all[c as usize];
            let n_rows = constraint.n_rows();
            for part in 0..n_rows {
                let r = first + part;
                let unknowns = equations.unknowns(r);
                if self.f[r] != 0.0 && self.scale[r] > 0.0 && !unknowns.is_empty() {
                    let factor = self.f[r] * self.scale[r];
                    let matrix = second_derivatives(equations, unknowns, x, |at| {
                        let mut k = 0;
                        let mut found = 0.0;
                        constraint.equations(&at, &at_rest, &mut |f: Jet| {
                            if k == part {
                                found = f.dd;
                            }
                            k += 1;
                        });
                        factor * found
                    });
                    give(r, &matrix);
                }
            }
            first += n_rows;
        }
    }

    /// The derivative of the energy by the weighted unknowns.
    pub fn slope(&self, equations: &Equations, to: &mut [f64]) {
        to.fill(0.0);
        for (f, unknowns, gradient, _) in self.iter(equations) {
            add_row(to, unknowns, gradient, f);
        }
    }

    /// The curvature of the energy along a step: Gauss-Newton's, and that of stretched lengths.
    pub fn curvature(&self, equations: &Equations, step: &[f64]) -> f64 {
        let mut sum = 0.0;
        for (_, unknowns, gradient, bend) in self.iter(equations) {
            let along = dot_row(step, unknowns, gradient);
            sum += along * along;
            if bend > 0.0 {
                let across = bend * cross_row(step, unknowns, gradient);
                sum += across * across;
            }
        }
        sum
    }
}

/// The norm of a gradient whose squares are beyond what numbers hold.
#[cold]
fn norm_of(gradient: &[[f64; 2]]) -> f64 {
    let components = || gradient.as_flattened().iter();
    let largest = components().fold(0.0, |most: f64, g| most.max(g.abs()));
    if !largest.is_normal() {
        return if largest.is_finite() { 0.0 } else { largest };
    }
    largest * components().map(|g| (g / largest) * (g / largest)).sum::<f64>().sqrt()
}

/// The second derivatives of a function of the places of some unknown points, by the weighted
/// unknowns: from those along each unknown and along each pair of them.
fn second_derivatives(
    equations: &Equations,
    unknowns: &[u32],
    x: &[Point],
    along: impl Fn(&dyn Fn(PointIdx) -> Vec2<Jet>) -> f64,
) -> Vec<f64> {
    let n = 2 * unknowns.len();
    let still = |p: PointIdx| x[p as usize];
    let rate = |p: PointIdx, k: usize| -> Vector {
        let unknown = unknowns[k / 2] as usize;
        if equations.points[unknown] != p {
            return Vector::ZERO;
        }
        let w = equations.root_w[unknown];
        if k.is_multiple_of(2) { Vector::new(w, 0.0) } else { Vector::new(0.0, w) }
    };
    let curvature = |i: usize, j: Option<usize>| -> f64 {
        along(&|p| {
            let (at, v) = (still(p), rate(p, i) + j.map_or(Vector::ZERO, |j| rate(p, j)));
            Vec2 { x: Jet::new(at.x, v.x, 0.0), y: Jet::new(at.y, v.y, 0.0) }
        })
    };
    let mut matrix = vec![0.0; n * n];
    for i in 0..n {
        matrix[n * i + i] = curvature(i, None);
    }
    for i in 0..n {
        for j in 0..i {
            let both = curvature(i, Some(j));
            let mixed = 0.5 * (both - matrix[n * i + i] - matrix[n * j + j]);
            matrix[n * i + j] = mixed;
            matrix[n * j + i] = mixed;
        }
    }
    matrix
}

/// Adds `k` times a row to a vector of unknowns.
pub(crate) fn add_row(to: &mut [f64], unknowns: &[u32], gradient: &[f64], k: f64) {
    let (to, _) = to.as_chunks_mut::<2>();
    for (&u, g) in unknowns.iter().zip(gradient.as_chunks::<2>().0) {
        let to = &mut to[u as usize];
        to[0] += k * g[0];
        to[1] += k * g[1];
    }
}

/// The product of a row with a vector of unknowns.
pub(crate) fn dot_row(step: &[f64], unknowns: &[u32], gradient: &[f64]) -> f64 {
    let (steps, _) = step.as_chunks::<2>();
    let terms = unknowns.iter().zip(gradient.as_chunks::<2>().0);
    terms.map(|(&u, g)| steps[u as usize][0] * g[0] + steps[u as usize][1] * g[1]).sum()
}

/// The product with the row turned a quarter turn at each of its points.
fn cross_row(step: &[f64], unknowns: &[u32], gradient: &[f64]) -> f64 {
    let (steps, _) = step.as_chunks::<2>();
    let terms = unknowns.iter().zip(gradient.as_chunks::<2>().0);
    terms.map(|(&u, g)| steps[u as usize][1] * g[0] - steps[u as usize][0] * g[1]).sum()
}
