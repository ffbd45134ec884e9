//! A mechanism followed along its motion, the driver being one of the unknowns, so that nothing is
//! special about a pose at which it can go no further.

use std::collections::BTreeSet;

use super::driver::{Driven, Driver, set_values, slopes};
use super::projector::Projector;
use super::system::{ConstraintSystem, UnitRows};
use super::tracer::without_tracers;
use crate::constraint::{
    Activity, Carried, Constraint, ConstraintKind, Field, Flaw, Point, PointIdx, Vector,
};

/// Newton steps near a solution double the digits; more than this are none.
const MOST_STEPS: usize = 12;
/// Damping of these steps, in units of squares of singular values: below what counts as
/// singular, and above what rounding makes of 0.
const DAMPING: f64 = 1e-12;
/// Distances up to this part of the size are none, if Newton steps gain nothing any more.
const NOTHING: f64 = 1e-13;
/// Newton steps that leave less than this part of the size are enough.
const EXACT: f64 = 1e-14;

/// A mechanism with a driver that is free. It has points of its own, so that a large scene around it costs
/// nothing.
pub struct Mechanism<'a> {
    /// The constraints, those that carry something on as of the last pose that counted.
    constraints: Vec<Constraint>,
    /// Their places in the scene.
    sources: Vec<usize>,
    /// The pose of the scene, and the inverse masses.
    x: Vec<Point>,
    w: Vec<f64>,
    driver: &'a Driver<'a>,
    /// The places of the constraints that are driven among those here.
    driven: Vec<usize>,
    /// The points that move.
    points: Vec<PointIdx>,
    /// How large it is, length units.
    pub size: f64,
    /// What counts as one of the driver: about what moves something by the size, and a radian of
    /// angles.
    pub unit: f64,
    tolerance: f64,
    /// The last projector: mostly the next rows stand between the same points.
    projector: Option<Projector>,
    /// What is probed with how regular a pose is.
    probe: Vec<f64>,
}

/// Where the points are, and how far the driver has gone from where it was.
#[derive(Debug, Clone)]
pub struct Stand {
    /// The positions of the points of the mechanism.
    pub x: Vec<Point>,
    /// How far it has gone, in its units: the turn, radians, of an angle.
    pub turn: f64,
}

/// A value of a constraint is none there.
#[derive(Debug, Clone, Copy)]
pub struct NoValue {
    /// What is wrong with it; none if it cannot be evaluated.
    pub flaw: Option<Flaw>,
}

/// A pose on the motion, with the direction in which the motion goes on.
#[derive(Debug, Clone)]
pub struct Waypoint {
    /// The pose.
    pub stand: Stand,
    /// The unit tangent over the unknowns: (x, y) of each point, then the turn times the size,
    /// then an idle place.
    pub tangent: Vec<f64>,
    /// The freedoms there are, the driver's own included.
    pub n_freedoms: usize,
    /// A measure of how far the rows are from being more dependent than elsewhere.
    pub regularity: f64,
    /// The rows at this pose, as places in the scene and parts.
    pub active: Vec<(usize, usize)>,
}

impl Waypoint {
    /// How fast the driver goes along the motion, in units of the size.
    pub fn pace(&self) -> f64 {
        self.tangent[self.tangent.len() - 2]
    }
}

impl<'a> Mechanism<'a> {
    /// What hangs together with the constraints that are driven, but for points that only follow.
    pub fn new(scene: &ConstraintSystem, driver: &'a Driver<'a>) -> Self {
        let moves = |p: &&PointIdx| scene.w[**p as usize] > 0.0;
        let sources = without_tracers(scene, &driver.constraints);
        let mut constraints: Vec<_> =
            sources.iter().map(|&k| Constraint::clone(scene.constraints[k])).collect();
        let mut held: Vec<_> =
            constraints.iter().flat_map(ConstraintKind::points).copied().collect();
        held.sort_unstable();
        held.dedup();
        // What moves says how large it is: the ends of a rail may be far away.
        let stated = || driver.constraints.iter().map(|&k| scene.constraints[k]);
        let of_driven: BTreeSet<_> = stated().flat_map(ConstraintKind::points).collect();
        let moved = held.iter().filter(|p| moves(p) || of_driven.contains(p));
        let extent = |of: fn(&Point) -> f64| {
            let values = moved.clone().map(|&p| of(&scene.x[p as usize]));
            let ends = |(lo, hi): (f64, f64), v: f64| (lo.min(v), hi.max(v));
            let (lo, hi) = values.fold((f64::INFINITY, f64::NEG_INFINITY), ends);
            hi - lo
        };
        let radii = stated().filter_map(|c| c.get(Field::Radius));
        let radius = radii.fold(0.0, |most: f64, radius| most.max(radius.abs()));
        let size = extent(|p| p.x).max(extent(|p| p.y)).max(radius);
        let size = if size > 0.0 { size } else { 1.0 };
        let farthest = held.iter().map(|&p| scene.x[p as usize].to_vector().norm());
        let rounding = 8.0 * f64::EPSILON * farthest.fold(0.0, f64::max);
        let place = |p: PointIdx| held.partition_point(|&q| q < p) as PointIdx;
        constraints.iter_mut().for_each(|constraint| constraint.map_points(place));
        let w: Vec<f64> = held.iter().map(|&p| scene.w[p as usize]).collect();
        let points: Vec<_> = (0..held.len() as PointIdx).filter(|&p| w[p as usize] > 0.0).collect();
        let places = driver.constraints.iter();
        let mut mechanism = Self {
            driven: places.filter_map(|k| sources.binary_search(k).ok()).collect(),
            constraints,
            sources,
            x: held.iter().map(|&p| scene.x[p as usize]).collect(),
            w,
            driver,
            // All places differ, so that no symmetry of a mechanism hides a motion from it.
            probe: (0..2 * points.len() + 2).map(|k| libm::sin(1.0 + 0.7 * k as f64)).collect(),
            points,
            size,
            unit: 1.0,
            tolerance: rounding.max(NOTHING * size),
            projector: None,
        };
        if !driver.is_angle {
            mechanism.unit = mechanism.natural_unit();
        }
        mechanism
    }

    /// Where it is in the scene.
    fn start(&self) -> Stand {
        Stand { x: self.x.clone(), turn: 0.0 }
    }

    /// How much of the driver changes the distances that are asked for by the size.
    fn natural_unit(&mut self) -> f64 {
        let n = 2 * self.points.len();
        let start = self.start();
        let rows = self.rows(&start);
        let mut turning = vec![0.0; n + 2];
        turning[n] = 1.0;
        let along = rows.iter().flat_map(|rows| &rows.rows).map(|row| row.dot(&turning));
        // Rows have it in units of the size.
        let slope = along.map(|g| g * g).sum::<f64>().sqrt();
        if slope.is_finite() && slope > 0.0 { 1.0 / slope } else { self.driver.now.abs().max(1.0) }
    }

    /// Corrections up to this are rounding.
    pub fn noise(&self) -> f64 {
        10.0 * self.tolerance
    }

    /// Whether everything holds where it is, up to a part of the size.
    pub fn holds(&mut self, tolerance: f64) -> bool {
        let start = self.start();
        let rows = self.rows(&start);
        rows.is_ok_and(|rows| rows.worst() <= tolerance * self.size)
    }

    /// Whether anything of it can move: all that is driven to a value has a point that does.
    pub fn can_move(&self) -> bool {
        let moves = |p: &PointIdx| self.w[*p as usize] > 0.0;
        let is_movable = |c: &Constraint| {
            let binds = c.n_rows() > 0 && c.traits().activity == Activity::Always;
            !binds || c.points().iter().any(moves)
        };
        !self.points.is_empty() && self.driven.iter().all(|&c| is_movable(&self.constraints[c]))
    }

    /// Whether the driver is an angle.
    pub const fn is_turned(&self) -> bool {
        self.driver.is_angle
    }

    /// Whether a constraint is of a kind that depends on more than the pose.
    pub fn has_velocities(&self) -> bool {
        self.constraints.iter().any(|c| c.traits().carried == Carried::ByFrame)
    }

    /// From here on angles are unwrapped from this pose.
    pub fn accept(&mut self, stand: &Stand) {
        self.constraints.iter_mut().for_each(|c| c.accept(&stand.x));
    }

    /// Gives the constraints that are driven the values that they have for a driver; how the rows of
    /// each change with it.
    fn drive(&mut self, stand: &Stand) -> Result<Vec<(usize, Vec<f64>)>, NoValue> {
        let all = self.driver.values(stand.turn * self.unit).ok_or(NoValue { flaw: None })?;
        let mut of_each = Vec::with_capacity(self.driven.len());
        for driven in all.chunk_by(|a: &Driven, b: &Driven| a.constraint == b.constraint) {
            let Ok(place) = self.sources.binary_search(&driven[0].constraint) else { continue };
            let constraint = &mut self.constraints[place];
            set_values(constraint, driven).map_err(|flaw| NoValue { flaw: Some(flaw) })?;
            of_each.push((place, slopes(constraint, driven, &stand.x)));
        }
        // What is measured on the pose may have none there.
        let has_value = |c: &Constraint| c.residual(&stand.x).is_finite();
        let all_have = self.constraints.iter().all(has_value);
        if all_have { Ok(of_each) } else { Err(NoValue { flaw: None }) }
    }

    fn rows(&mut self, stand: &Stand) -> Result<UnitRows, NoValue> {
        let driven = self.drive(stand)?;
        let constraints: Vec<&Constraint> = self.constraints.iter().collect();
        let scene = ConstraintSystem { constraints: &constraints, x: &stand.x, w: &self.w };
        let all: Vec<usize> = (0..constraints.len()).collect();
        let mut rows = scene.rows_over(self.points.clone(), &all);
        // An inequality that is met exactly stops nothing that leads away from it. Of what stays
        // on a line between end stops no row may go.
        rows.rows.retain(|row| {
            let activity = constraints[row.source.0].traits().activity;
            row.f.abs() > self.tolerance || activity != Activity::Outside
        });
        let turn = rows.points.len() as u32;
        rows.points.push(PointIdx::MAX);
        for row in &mut rows.rows {
            if let Ok(k) = driven.binary_search_by_key(&row.source.0, |(place, _)| *place) {
                let slope = driven[k].1[row.source.1];
                let slope = slope * (self.unit / self.size) * row.scale;
                row.add_unknown(turn, slope);
                // One that changes beyond all measure, as a root does at 0, is told by the driver.
                if slope.abs() > 1.0 {
                    row.count(1.0 / slope.abs());
                }
            }
        }
        Ok(rows)
    }

    /// A projector for these rows.
    fn project(&mut self, rows: &UnitRows) -> &mut Projector {
        let projector = match self.projector.take() {
            Some(last) => last.anew(rows),
            None => Projector::of(rows),
        };
        self.projector.insert(projector)
    }

    fn displace(&self, stand: &mut Stand, t: f64, y: &[f64]) {
        for (&p, y) in self.points.iter().zip(y.as_chunks::<2>().0) {
            let root_w = self.w[p as usize].sqrt();
            stand.x[p as usize] += Vector::new(y[0], y[1]) * (t * root_w);
        }
        stand.turn += t * y[y.len() - 2] / self.size;
    }

    /// Moves a pose onto the motion by the shortest way; gives the rows there and how long
    /// the way was. None if there is no solution within `reach`.
    fn correct(&mut self, stand: &mut Stand, reach: f64) -> Option<(UnitRows, f64)> {
        let mut way = 0.0;
        let mut before = f64::INFINITY;
        for _ in 0..MOST_STEPS {
            let rows = self.rows(stand).ok()?;
            let worst = rows.worst();
            // As exact as it gets: the last steps gain nothing.
            if worst <= EXACT * self.size || (worst <= self.tolerance && worst > 0.3 * before) {
                return Some((rows, way));
            }
            let mut y = vec![0.0; rows.n_unknowns()];
            rows.rows.iter().for_each(|row| row.add_to(-row.f, &mut y));
            self.project(&rows).solve_damped(DAMPING, &mut y);
            way += norm(&y);
            if way.is_nan() || way > reach {
                return None;
            }
            self.displace(stand, 1.0, &y);
            before = worst;
        }
        None
    }

    /// The waypoint at a pose that is a solution nearly; its tangent leans to `direction`, or is
    /// the one along which the driver goes farthest for its length. None if no solution is within
    /// `reach` or nothing can move there.
    fn waypoint(
        &mut self,
        mut stand: Stand,
        direction: Option<&[f64]>,
        reach: f64,
    ) -> Option<(Waypoint, f64)> {
        let (rows, way) = self.correct(&mut stand, reach)?;
        let n = rows.n_unknowns();
        let projector = self.project(&rows);
        // The idle place is free too.
        let n_freedoms = projector.nullity() - 1;
        // Freedoms besides the driver's are left alone as far as they can be.
        let turned = if direction.is_none() || n_freedoms > 1 {
            let mut turning = vec![0.0; n];
            turning[n - 2] = 1.0;
            projector.onto_motions(&mut turning);
            (norm(&turning) > 1e-6).then_some(turning)
        } else {
            None
        };
        let is_turned = turned.is_some();
        let mut tangent = match (turned, direction) {
            (Some(mut turning), Some(direction)) => {
                let k = direction[n - 2].signum();
                turning.iter_mut().for_each(|t| *t *= k);
                turning
            }
            (Some(turning), None) => turning,
            (None, Some(direction)) => direction.to_vec(),
            (None, None) => {
                // The driver stands at an end already: any motion there is.
                let mut any: Vec<f64> = (0..n).map(|k| 1.0 / (1.5 + k as f64)).collect();
                any[n - 1] = 0.0;
                any
            }
        };
        if !is_turned {
            projector.onto_motions(&mut tangent);
        }
        let length = norm(&tangent);
        let is_short = length.is_nan() || length <= 1e-3;
        if is_short && direction.is_some() || length == 0.0 || n_freedoms == 0 {
            return None;
        }
        tangent.iter_mut().for_each(|t| *t /= length);
        let projector = self.projector.as_mut().expect("it was made for these rows");
        let regularity = regularity(projector, &self.probe, &tangent);
        let source = |&(c, part): &(usize, usize)| (self.sources[c], part);
        let active = rows.rows.iter().map(|row| source(&row.source)).collect();
        Some((Waypoint { stand, tangent, n_freedoms, regularity, active }, way))
    }

    /// The waypoint at which following begins.
    pub fn begin(&mut self) -> Option<Waypoint> {
        let reach = 1e-3 * self.size;
        self.waypoint(self.start(), None, reach).map(|(waypoint, _)| waypoint)
    }

    /// The waypoint a way `h` on from a waypoint, with the length of the correction it took.
    pub fn step(&mut self, from: &Waypoint, h: f64) -> Option<(Waypoint, f64)> {
        let mut stand = from.stand.clone();
        self.displace(&mut stand, h, &from.tangent);
        self.waypoint(stand, Some(&from.tangent), h.abs() + self.noise())
    }
}

impl Mechanism<'_> {
    /// The rows a way `h` on from a waypoint, solved or not, as places in the scene and parts.
    ///
    /// # Errors
    /// If values have none there.
    pub fn active_beyond(
        &mut self,
        from: &Waypoint,
        h: f64,
    ) -> Result<Vec<(usize, usize)>, NoValue> {
        let mut stand = from.stand.clone();
        self.displace(&mut stand, h, &from.tangent);
        let rows = self.rows(&stand)?;
        Ok(rows.rows.iter().map(|row| (self.sources[row.source.0], row.source.1)).collect())
    }

    /// How far the driver is where the last values are on a straight way `h` on from a waypoint at
    /// whose end there are none.
    pub fn last_value(&mut self, from: &Waypoint, h: f64) -> f64 {
        let [mut known, mut none] = [0.0, h];
        let mut last = from.stand.turn;
        for _ in 0..60 {
            let middle = 0.5 * (known + none);
            let mut stand = from.stand.clone();
            self.displace(&mut stand, middle, &from.tangent);
            if self.rows(&stand).is_ok() {
                (known, last) = (middle, stand.turn);
            } else {
                none = middle;
            }
        }
        last
    }
}

/// The length of a vector of unknowns.
pub fn norm(y: &[f64]) -> f64 {
    y.iter().map(|y| y * y).sum::<f64>().sqrt()
}

/// About the smallest singular value that belongs to no motion: for a fixed probe c across the
/// motion, the root of `|c|^2 / c^T (J^T J)^+ c`.
fn regularity(projector: &mut Projector, probe: &[f64], tangent: &[f64]) -> f64 {
    let n = tangent.len();
    let across = |y: &mut [f64]| {
        let along: f64 = y.iter().zip(tangent).map(|(a, b)| a * b).sum();
        y.iter_mut().zip(tangent).for_each(|(a, b)| *a -= along * b);
        y[n - 1] = 0.0;
    };
    let mut probe = probe.to_vec();
    across(&mut probe);
    let mut y = probe.clone();
    projector.solve_damped(1e-2 * DAMPING, &mut y);
    across(&mut y);
    let product: f64 = y.iter().zip(&probe).map(|(a, b)| a * b).sum();
    if product > 0.0 { norm(&probe) / product.sqrt() } else { f64::INFINITY }
}
