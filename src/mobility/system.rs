//! A scene at rest, as the analysis takes it, and its rows of length 1.

use std::collections::BTreeSet;

use smallvec::SmallVec;

use crate::constraint::{Constraint, ConstraintKind, Jet, Point, PointIdx, Row, Vec2, Vector};
use crate::linalg::DisjointSets;

/// At how many other poses what seems to hold everywhere is looked at.
const OTHER_POSES: u32 = 3;
/// The angle between directions no few of which are alike, radians.
const GOLDEN_ANGLE: f64 = 2.399_963_229_728_653;

/// Constraints, in order of creation, at a pose.
#[derive(Clone, Copy)]
pub struct ConstraintSystem<'a> {
    /// What must hold; results name constraints by their places here.
    pub constraints: &'a [&'a Constraint],
    /// The positions of all points.
    pub x: &'a [Point],
    /// The inverse masses of all points; 0: frozen.
    pub w: &'a [f64],
}

/// One equation a constraint makes active, scaled to gradient length 1 in the metric of the
/// weights, so that lengths and angles compare and `f` is a distance.
#[derive(Debug, Clone)]
pub struct UnitRow {
    /// Which constraint, and which of its rows.
    pub source: (usize, usize),
    /// The distance to satisfaction, signed.
    pub f: f64,
    /// `f` divided by the value in the unit of the constraint.
    pub scale: f64,
    /// What rounding leaves of `f`: each row's own, as one that holds points on a circle of a
    /// million is known to a millionth of what another of the same scene is.
    pub rounding: f64,
    points: SmallVec<[u32; 4]>,
    values: SmallVec<[f64; 8]>,
}

impl UnitRow {
    /// The points that move, as indices into [`UnitRows::points`].
    pub fn points(&self) -> &[u32] {
        &self.points
    }

    /// The gradient by (x, y) of each of these points.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// The same row over points with other indices.
    pub fn renumbered(&self, place: impl Fn(u32) -> u32) -> Self {
        let mut row = self.clone();
        row.points.iter_mut().for_each(|p| *p = place(*p));
        row
    }

    /// Makes the row count `k` times.
    pub fn count(&mut self, k: f64) {
        self.f *= k;
        self.rounding *= k;
        self.values.iter_mut().for_each(|value| *value *= k);
    }

    /// Adds a further unknown, the first of the two at `place`.
    pub fn add_unknown(&mut self, place: u32, gradient: f64) {
        self.points.push(place);
        self.values.extend([gradient, 0.0]);
    }

    /// The product with a vector of unknowns.
    pub fn dot(&self, y: &[f64]) -> f64 {
        let terms = self.points().iter().zip(self.values().as_chunks::<2>().0);
        terms.map(|(&p, g)| g[0] * y[2 * p as usize] + g[1] * y[2 * p as usize + 1]).sum()
    }

    /// Adds `k` times the gradient to a vector of unknowns.
    pub fn add_to(&self, k: f64, y: &mut [f64]) {
        for (&p, g) in self.points().iter().zip(self.values().as_chunks::<2>().0) {
            y[2 * p as usize] += k * g[0];
            y[2 * p as usize + 1] += k * g[1];
        }
    }
}

/// The active rows of points that hang together, over the points that move.
#[derive(Debug, Clone, Default)]
pub struct UnitRows {
    /// The points that move; their displacements divided by the roots of their weights are
    /// the unknowns, (x, y) for each.
    pub points: Vec<PointIdx>,
    /// The rows, in order of creation.
    pub rows: Vec<UnitRow>,
}

impl UnitRows {
    /// How many unknowns there are.
    pub fn n_unknowns(&self) -> usize {
        2 * self.points.len()
    }

    /// The largest distance to satisfaction.
    pub fn worst(&self) -> f64 {
        self.rows.iter().fold(0.0, |worst, row| row.f.abs().max(worst))
    }

    /// Half the sum of the squares of the distances.
    pub fn energy(&self) -> f64 {
        0.5 * self.rows.iter().map(|row| row.f * row.f).sum::<f64>()
    }

    /// Those rows that `keep` chooses, over the same points.
    pub fn filtered(&self, keep: impl Fn(&UnitRow) -> bool) -> Self {
        let rows = self.rows.iter().filter(|row| keep(row)).cloned().collect();
        Self { points: self.points.clone(), rows }
    }

    /// Points and rows that share none of each other's points.
    pub fn islands(self) -> Vec<Self> {
        let mut sets = DisjointSets::default();
        for row in &self.rows {
            for ends in row.points().windows(2) {
                sets.join(ends[0] as usize, ends[1] as usize);
            }
        }
        let mut island_of = vec![usize::MAX; self.points.len()];
        let mut islands: Vec<Self> = Vec::new();
        let mut place = vec![0; self.points.len()];
        for (k, &point) in self.points.iter().enumerate() {
            let root = sets.least(k);
            if island_of[root] == usize::MAX {
                island_of[root] = islands.len();
                islands.push(Self::default());
            }
            let island = &mut islands[island_of[root]];
            place[k] = island.points.len() as u32;
            island.points.push(point);
        }
        for row in self.rows {
            let root = sets.least(row.points[0] as usize);
            islands[island_of[root]].rows.push(row.renumbered(|p| place[p as usize]));
        }
        islands
    }
}

impl ConstraintSystem<'_> {
    /// The active rows over all points that move, and the constraints that hold none of them
    /// and yet are off by more than `tolerance`.
    pub fn rows(&self, tolerance: f64) -> (UnitRows, Vec<usize>) {
        let moving = self.w.iter().enumerate().filter(|&(_, &w)| w > 0.0);
        let points = moving.map(|(p, _)| p as PointIdx).collect();
        let mut unsatisfiable = Vec::new();
        let all = 0..self.constraints.len();
        let rows = self.rows_and_rest(points, all, &mut |constraint, row| {
            // What has no value here may have one where its points can go.
            if row.f.is_finite() && row.distance(self.w) > tolerance {
                unsatisfiable.push(constraint);
            }
        });
        unsatisfiable.dedup();
        (rows, unsatisfiable)
    }

    /// The constraints that hold wherever their points go, or, where all of them are frozen, would
    /// go: no row of theirs feels a point that can, neither here nor at other poses, and all rows are
    /// met at each of them.
    pub fn identities(&self, tolerance: f64) -> Vec<usize> {
        let all = self.constraints.iter().enumerate();
        let is_one = |constraint: &Constraint| {
            let is_free = |p: PointIdx| self.w[p as usize] > 0.0;
            let is_any_free = constraint.points().iter().any(|&p| is_free(p));
            let can_move = |p: PointIdx| is_free(p) || !is_any_free;
            let holds_at = |x: &[Point]| {
                let mut holds = constraint.n_rows() > 0;
                constraint.jacobian(x, &mut |row| {
                    let is_felt = row.terms().any(|(p, g)| g != Vector::ZERO && can_move(p));
                    holds &= row.is_active && !is_felt && row.f.abs() <= tolerance;
                });
                holds
            };
            // At one pose a gradient may vanish though it does not at others, as that of a square.
            holds_at(self.x)
                && (1..=OTHER_POSES).all(|k| holds_at(&self.elsewhere(constraint, &can_move, k)))
        };
        all.filter(|(_, constraint)| is_one(constraint)).map(|(k, _)| k).collect()
    }

    /// The `k`th of some poses in which those points of a constraint that can move are somewhere
    /// else, about as far apart as they are.
    fn elsewhere(
        &self,
        constraint: &Constraint,
        can_move: &impl Fn(PointIdx) -> bool,
        k: u32,
    ) -> Vec<Point> {
        let mut x = self.x.to_vec();
        let points = constraint.points();
        let first = points.first().map_or(Point::ORIGIN, |&p| self.x[p as usize]);
        let size = points.iter().map(|&p| self.x[p as usize].distance(first)).fold(0.0, f64::max);
        let reach = if size > 0.0 { 0.5 * size } else { 1.0 };
        for (n, &p) in points.iter().enumerate().filter(|(_, p)| can_move(**p)) {
            // A golden angle apart no two points go the same way.
            let way = Vector::polar(reach, GOLDEN_ANGLE * f64::from(k) * (n + 1) as f64);
            x[p as usize] = self.x[p as usize] + way;
        }
        x
    }

    /// The places of all constraints that hang together with some through points that move,
    /// themselves included, ascending.
    pub fn neighbours(&self, of: &BTreeSet<usize>) -> Vec<usize> {
        let mut sets = DisjointSets::default();
        let moves = |p: &&PointIdx| self.w[**p as usize] > 0.0;
        for constraint in self.constraints {
            let moving: Vec<_> = constraint.points().iter().filter(moves).collect();
            moving.windows(2).for_each(|ends| sets.join(*ends[0] as usize, *ends[1] as usize));
        }
        let mut root = |k: usize| {
            self.constraints[k].points().iter().find(moves).map(|&p| sets.least(p as usize))
        };
        let here: BTreeSet<usize> = of.iter().filter_map(|&k| root(k)).collect();
        let all = 0..self.constraints.len();
        all.filter(|k| of.contains(k) || root(*k).is_some_and(|k| here.contains(&k))).collect()
    }

    /// The rows of an island as they are at this pose.
    pub fn rows_like(&self, island: &UnitRows) -> UnitRows {
        let mut constraints: Vec<_> = island.rows.iter().map(|row| row.source.0).collect();
        constraints.dedup();
        let rows = self.rows_over(island.points.clone(), &constraints);
        let sources: Vec<_> = island.rows.iter().map(|row| row.source).collect();
        rows.filtered(|row| sources.binary_search(&row.source).is_ok())
    }

    /// The rows of some constraints, over those points of theirs that move.
    pub fn rows_over(&self, points: Vec<PointIdx>, constraints: &[usize]) -> UnitRows {
        self.rows_and_rest(points, constraints.iter().copied(), &mut |_, _| ())
    }

    fn rows_and_rest(
        &self,
        points: Vec<PointIdx>,
        constraints: impl Iterator<Item = usize>,
        immovable: &mut impl FnMut(usize, &Row),
    ) -> UnitRows {
        let mut place = vec![None; self.x.len()];
        for (k, &p) in points.iter().enumerate() {
            place[p as usize] = Some(k as u32);
        }
        let mut rows = Vec::new();
        for constraint in constraints {
            let mut part = 0;
            self.constraints[constraint].jacobian(self.x, &mut |row| {
                if row.is_active {
                    match self.unit(&row, &place, (constraint, part)) {
                        Some(unit) => rows.push(unit),
                        None => immovable(constraint, &row),
                    }
                }
                part += 1;
            });
        }
        UnitRows { points, rows }
    }

    fn unit(&self, row: &Row, place: &[Option<u32>], source: (usize, usize)) -> Option<UnitRow> {
        let norm = row.norm(self.w);
        let scale = 1.0 / norm;
        if norm == 0.0 || !scale.is_normal() {
            return None;
        }
        let mut unit = UnitRow {
            source,
            f: row.f * scale,
            scale,
            rounding: self.rounding(row) * scale,
            points: SmallVec::new(),
            values: SmallVec::new(),
        };
        for (p, g) in row.terms() {
            if let Some(place) = place[p as usize] {
                let g = g * (self.w[p as usize].sqrt() * scale);
                unit.points.push(place);
                unit.values.extend([g.x, g.y]);
            }
        }
        Some(unit)
    }

    /// What rounding of the coordinates leaves of a row's value.
    fn rounding(&self, row: &Row) -> f64 {
        let place = |p: PointIdx| self.x[p as usize].to_vector().norm();
        8.0 * f64::EPSILON * row.terms().map(|(p, g)| g.norm() * place(p)).sum::<f64>()
    }

    /// The displacement of each point for a vector of unknowns.
    pub fn displacements(&self, points: &[PointIdx], y: &[f64]) -> Vec<Vector> {
        let mut moves = vec![Vector::ZERO; self.x.len()];
        for (&p, y) in points.iter().zip(y.as_chunks::<2>().0) {
            moves[p as usize] = Vector::new(y[0], y[1]) * self.w[p as usize].sqrt();
        }
        moves
    }

    /// The second derivative of each row along a straight motion with unknowns `y`.
    pub fn curvatures(&self, rows: &UnitRows, y: &[f64]) -> Vec<f64> {
        let velocity = self.displacements(&rows.points, y);
        let at = |p: PointIdx| {
            let (x, v) = (self.x[p as usize], velocity[p as usize]);
            Vec2 { x: Jet::new(x.x, v.x, 0.0), y: Jet::new(x.y, v.y, 0.0) }
        };
        let mut curvatures = Vec::with_capacity(rows.rows.len());
        for of_one in rows.rows.chunk_by(|a, b| a.source.0 == b.source.0) {
            let mut wanted = of_one.iter().peekable();
            let mut part = 0;
            let field = |_, value| Jet::new(value, 0.0, 0.0);
            self.constraints[of_one[0].source.0].equations(&at, &field, &mut |f| {
                if let Some(row) = wanted.next_if(|row| row.source.1 == part) {
                    curvatures.push(f.dd * row.scale);
                }
                part += 1;
            });
        }
        curvatures
    }
}
