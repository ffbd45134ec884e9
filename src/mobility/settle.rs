//! Solving a few constraints by themselves, some of them counted less than others.

use super::motions::Random;
use super::system::{ConstraintSystem, UnitRow, UnitRows};
use crate::constraint::{Constraint, ConstraintKind, Point, PointIdx, Vector};
use crate::linalg::NormalMatrix;
use nalgebra::{DMatrix, DVector};

const N_STEPS: usize = 60;

/// A step that promises no more than this part of the energy leads nowhere: a best fit. Near a
/// pose where all holds, a step promises nearly all of it.
const NOWHERE: f64 = 1e-6;
/// The same where something that counts little keeps nearly all of the energy.
const NOWHERE_NEARLY: f64 = 1e-15;
/// With this much damping steps vanish.
const MOST_DAMPING: f64 = 1e8;
/// How far points are pushed, as parts of the size, before it is said that constraints cannot
/// hold: off a line of centres, and over to another branch.
const PUSHES: [f64; 4] = [1e-2, -1e-2, 0.3, -0.3];
/// The same for a few constraints, whose branches may all be far away: so many more, in a direction
/// of its own each and as far as these in turn. Of 2336 sets found with the four pushes alone 37 could
/// hold, of 1169 with 24 more two, with these none.
const N_MORE_PUSHES: usize = 72;
const MORE_PUSHES: [f64; 2] = [0.3, 1.0];
/// So many constraints are few.
const FEW: usize = 16;
/// Of more unknowns than this the curvature is not worked out, which is dense; pushes are all
/// there is then.
const MOST_CURVED: usize = 40;
/// A curvature that is negative by less than this part of the residuals over the size is 0.
const ROUND: f64 = 1e-6;
/// How many saddles are left on one way.
const MOST_LEFT: usize = 6;

/// Some constraints of a scene, with points of their own.
pub struct Subset {
    constraints: Vec<Constraint>,
    /// Where the constraints and the points stand in the scene, ascending.
    sources: Vec<usize>,
    held: Vec<PointIdx>,
    /// The pose of the scene, and the inverse masses.
    x: Vec<Point>,
    w: Vec<f64>,
    /// The points that move.
    points: Vec<PointIdx>,
}

/// A pose that was reached, and how far it is from satisfying each constraint alike.
pub struct Reached {
    /// The positions of all points of the subset.
    pub x: Vec<Point>,
    /// The largest distance to satisfaction of what was counted, length units.
    pub worst: f64,
}

impl Subset {
    /// These constraints of a scene, given by their places in it, ascending.
    pub fn new(scene: &ConstraintSystem, sources: &[usize]) -> Self {
        let points = sources.iter().flat_map(|&c| scene.constraints[c].points());
        let mut held: Vec<_> = points.copied().collect();
        held.sort_unstable();
        held.dedup();
        let place = |p: PointIdx| held.partition_point(|&q| q < p) as PointIdx;
        let constraints = sources.iter().map(|&c| {
            let mut constraint = scene.constraints[c].clone();
            constraint.map_points(place);
            constraint
        });
        let constraints = constraints.collect();
        let x = held.iter().map(|&p| scene.x[p as usize]).collect();
        let w: Vec<f64> = held.iter().map(|&p| scene.w[p as usize]).collect();
        let points = (0..held.len() as PointIdx).filter(|&p| w[p as usize] > 0.0).collect();
        Self { constraints, sources: sources.to_vec(), held, x, w, points }
    }

    /// Where its points stand in the scene.
    pub fn start(&self) -> Vec<Point> {
        self.x.clone()
    }

    /// By how much the constraint at this place of the scene is off, in its own unit.
    pub fn residual(&self, source: usize, x: &[Point]) -> f64 {
        self.constraints[self.sources.partition_point(|&c| c < source)].residual(x)
    }

    /// Moves the points from `x` towards where all constraints hold, by damped Gauss-Newton
    /// steps. The one at place `light.0` of the scene counts as that part of the others; 0: not at
    /// all.
    pub fn settle(&self, x: Vec<Point>, light: (usize, f64), tolerance: f64) -> Reached {
        self.settle_with(&mut Steps::default(), x, light, tolerance)
    }

    fn settle_with(
        &self,
        steps: &mut Steps,
        mut x: Vec<Point>,
        light: (usize, f64),
        tolerance: f64,
    ) -> Reached {
        let mut here = self.rows(&x, light);
        let nowhere = if light.1 == 1.0 { NOWHERE } else { NOWHERE_NEARLY };
        let mut mu = 1e-6;
        for _ in 0..N_STEPS {
            if here.worst() <= tolerance || mu > MOST_DAMPING {
                break;
            }
            let mut downhill = downhill(&here);
            let slope = downhill.clone();
            steps.solve(&here, mu, &mut downhill);
            let promised: f64 = 0.5 * downhill.iter().zip(&slope).map(|(s, d)| s * d).sum::<f64>();
            // Damping makes a step promise less, and says nothing of where it could lead.
            if promised * (1.0 + mu) <= nowhere * here.energy() {
                break;
            }
            let moved = self.moved(&x, &downhill, 1.0);
            let there = self.rows(&moved, light);
            if there.energy() < here.energy() {
                (x, here) = (moved, there);
                mu = (0.1 * mu).max(1e-12);
            } else {
                mu *= 10.0;
            }
        }
        Reached { x, worst: here.worst() }
    }

    /// A pose where all hold, reached from this one or, as a pose may be a saddle or on the wrong
    /// side of something, from one of a few that the points are pushed to.
    fn hold(&self, tolerance: f64) -> Option<Vec<Point>> {
        let start = self.rows(&self.x, ALL);
        let size = self.extent().max(start.worst());
        let mut steps = Steps::default();
        let mut random = Random::new();
        let mut direction =
            || -> Vec<f64> { (0..2 * self.points.len()).map(|_| random.next()).collect() };
        let first = direction();
        let is_few = self.constraints.len() <= FEW;
        let n_more = if is_few { N_MORE_PUSHES } else { 0 };
        let more = MORE_PUSHES.into_iter().cycle().take(n_more).map(|part| (part, direction()));
        let pushes = PUSHES.into_iter().map(|part| (part, first.clone())).chain(more);
        let pushed = pushes.map(|(part, direction)| {
            let mut x = self.x.clone();
            for (&p, d) in self.points.iter().zip(direction.as_chunks::<2>().0) {
                x[p as usize] += Vector::new(d[0], d[1]) * (part * size);
            }
            x
        });
        [self.start()].into_iter().chain(pushed).find_map(|x| {
            let mut reached = self.settle_with(&mut steps, x, ALL, tolerance);
            for _ in 0..MOST_LEFT {
                if reached.worst <= tolerance {
                    return Some(reached.x);
                }
                let lower = self.leave(&reached, size)?;
                reached = self.settle_with(&mut steps, lower, ALL, tolerance);
            }
            None
        })
    }

    /// A lower pose along the most negative curvature of the energy, `J^T J + sum f hess f`, if
    /// there is any: what compressed rods do that line up.
    fn leave(&self, from: &Reached, size: f64) -> Option<Vec<Point>> {
        let rows = self.rows(&from.x, ALL);
        let n = rows.n_unknowns();
        if n > MOST_CURVED || size <= 0.0 {
            return None;
        }
        let refs: Vec<&Constraint> = self.constraints.iter().collect();
        let scene = ConstraintSystem { constraints: &refs, x: &from.x, w: &self.w };
        let second = |y: &[f64]| -> f64 {
            let bent = scene.curvatures(&rows, y);
            let terms = rows.rows.iter().zip(bent);
            let along = |row: &UnitRow| row.dot(y);
            terms.map(|(row, dd)| row.f * dd + along(row) * along(row)).sum()
        };
        let mut y = vec![0.0; n];
        let mut hessian = DMatrix::zeros(n, n);
        for i in 0..n {
            y[i] = 1.0;
            hessian[(i, i)] = second(&y);
            y[i] = 0.0;
        }
        for i in 0..n {
            for j in 0..i {
                (y[i], y[j]) = (1.0, 1.0);
                let both = 0.5 * (second(&y) - hessian[(i, i)] - hessian[(j, j)]);
                (y[i], y[j]) = (0.0, 0.0);
                (hessian[(i, j)], hessian[(j, i)]) = (both, both);
            }
        }
        let eigen = hessian.symmetric_eigen();
        let (least, value) = eigen.eigenvalues.argmin();
        if value > -ROUND * rows.worst() / size {
            return None;
        }
        let way: DVector<f64> = eigen.eigenvectors.column(least).into_owned();
        let reaches = [0.5, 0.1, 0.02, 1e-3].map(|part| part * size);
        let both = reaches.into_iter().flat_map(|reach| [reach, -reach]);
        let energy = |x: &[Point]| self.rows(x, ALL).energy();
        let there = both.map(|t| self.moved(&from.x, way.as_slice(), t));
        let best = there.min_by(|a, b| energy(a).total_cmp(&energy(b)))?;
        (energy(&best) < rows.energy()).then_some(best)
    }

    fn extent(&self) -> f64 {
        let extent = |of: fn(&Point) -> f64| {
            let ends = |(lo, hi): (f64, f64), v: f64| (lo.min(v), hi.max(v));
            let (lo, hi) = self.x.iter().map(of).fold((f64::INFINITY, f64::NEG_INFINITY), ends);
            (hi - lo).max(0.0)
        };
        extent(|p| p.x).max(extent(|p| p.y))
    }

    /// The points moved by `t` times a vector of unknowns.
    fn moved(&self, x: &[Point], y: &[f64], t: f64) -> Vec<Point> {
        let mut moved = x.to_vec();
        for (&p, y) in self.points.iter().zip(y.as_chunks::<2>().0) {
            moved[p as usize] += Vector::new(y[0], y[1]) * (t * self.w[p as usize].sqrt());
        }
        moved
    }

    fn rows(&self, x: &[Point], (source, counts): (usize, f64)) -> UnitRows {
        let refs: Vec<&Constraint> = self.constraints.iter().collect();
        let scene = ConstraintSystem { constraints: &refs, x, w: &self.w };
        let all: Vec<usize> = (0..refs.len()).collect();
        let mut rows = scene.rows_over(self.points.clone(), &all);
        let is_light = |place: usize| self.sources[place] == source;
        if counts == 0.0 {
            rows.rows.retain(|row| !is_light(row.source.0));
        } else {
            rows.rows.iter_mut().filter(|row| is_light(row.source.0)).for_each(|r| r.count(counts));
        }
        rows
    }
}

/// The normal matrix of some rows, kept as long as they stand between the same points: most of the
/// work of a step between a few is to see who has to do with whom.
#[derive(Default)]
struct Steps {
    /// The points of each row.
    pattern: Vec<Vec<u32>>,
    normal: Option<NormalMatrix>,
}

impl Steps {
    /// Replaces a right-hand side by the solution of J^T J + `mu` I.
    fn solve(&mut self, island: &UnitRows, mu: f64, rhs: &mut [f64]) {
        let of_rows = || island.rows.iter().map(UnitRow::points);
        let normal = match self.normal.take() {
            Some(mut normal) if of_rows().eq(self.pattern.iter().map(Vec::as_slice)) => {
                normal.clear();
                normal
            }
            _ => {
                self.pattern = of_rows().map(<[u32]>::to_vec).collect();
                NormalMatrix::new(island.points.len(), of_rows())
            }
        };
        let normal = self.normal.insert(normal);
        for (k, row) in island.rows.iter().enumerate() {
            normal.add_row(k, row.values());
        }
        normal.factor(mu);
        normal.solve(rhs);
    }
}

/// No constraint counts less than the others.
const ALL: (usize, f64) = (usize::MAX, 1.0);

/// The negative slope of the energy.
fn downhill(rows: &UnitRows) -> Vec<f64> {
    let mut downhill = vec![0.0; rows.n_unknowns()];
    rows.rows.iter().for_each(|row| row.add_to(-row.f, &mut downhill));
    downhill
}

/// A pose of the scene where these constraints hold, all others forgotten; none if none was found
/// from this pose and from some around it.
pub fn held_alone(
    scene: &ConstraintSystem,
    constraints: &[usize],
    tolerance: f64,
) -> Option<Vec<Point>> {
    let subset = Subset::new(scene, constraints);
    let reached = subset.hold(tolerance)?;
    let mut x = scene.x.to_vec();
    for (&p, there) in subset.held.iter().zip(reached) {
        x[p as usize] = there;
    }
    Some(x)
}
