//! A mechanism followed along its motion, the angle of a motor being one of the unknowns, so
//! that nothing is special about a pose at which the motor can go no further.

use super::projector::Projector;
use super::system::{ConstraintSystem, UnitRows};
use super::tracer::without_tracers;
use crate::constraint::{
    Activity, Carried, Constraint, ConstraintKind, Field, Point, PointIdx, Vector,
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

/// A mechanism with a motor whose angle is free.
pub struct Mechanism<'a> {
    /// The constraints, those that carry something on as of the last pose that counted.
    constraints: Vec<Constraint>,
    /// Their places in the scene.
    pub sources: Vec<usize>,
    w: &'a [f64],
    motor: usize,
    /// The points that move.
    points: Vec<PointIdx>,
    /// How large it is, length units.
    pub size: f64,
    phase: f64,
    tolerance: f64,
}

/// Where the points are, and how far the motor has turned from where it was.
#[derive(Debug, Clone)]
pub struct Stand {
    /// The positions of all points of the scene.
    pub x: Vec<Point>,
    /// The turn, radians.
    pub turn: f64,
}

/// A pose on the motion, with the direction in which the motion goes on.
#[derive(Debug, Clone)]
pub struct Waypoint {
    /// The pose.
    pub stand: Stand,
    /// The unit tangent over the unknowns: (x, y) of each point, then the turn times the size,
    /// then an idle place.
    pub tangent: Vec<f64>,
    /// The freedoms there are, the motor's own included.
    pub n_freedoms: usize,
    /// A measure of how far the rows are from being more dependent than elsewhere.
    pub regularity: f64,
    /// The rows at this pose, as places in the scene and parts.
    pub active: Vec<(usize, usize)>,
}

impl Waypoint {
    /// How fast the motor turns along the motion, in units of the size.
    pub fn pace(&self) -> f64 {
        self.tangent[self.tangent.len() - 2]
    }
}

impl<'a> Mechanism<'a> {
    /// What hangs together with the constraint at place `motor` of a scene, which is a motor, but
    /// for points that only follow.
    pub fn new(scene: &ConstraintSystem<'a>, motor: usize) -> Self {
        let moves = |p: &&PointIdx| scene.w[**p as usize] > 0.0;
        let sources = without_tracers(scene, motor);
        let constraints: Vec<_> =
            sources.iter().map(|&k| Constraint::clone(scene.constraints[k])).collect();
        let mut held: Vec<_> =
            constraints.iter().flat_map(ConstraintKind::points).copied().collect();
        held.sort_unstable();
        held.dedup();
        // What moves says how large it is: the ends of a rail may be far away.
        let driven = scene.constraints[motor].points();
        let moved = held.iter().filter(|p| moves(p) || driven.contains(p));
        let extent = |of: fn(&Point) -> f64| {
            let values = moved.clone().map(|&p| of(&scene.x[p as usize]));
            let ends = |(lo, hi): (f64, f64), v: f64| (lo.min(v), hi.max(v));
            let (lo, hi) = values.fold((f64::INFINITY, f64::NEG_INFINITY), ends);
            hi - lo
        };
        let radius = scene.constraints[motor].get(Field::Radius).unwrap_or(0.0).abs();
        let size = extent(|p| p.x).max(extent(|p| p.y)).max(radius);
        let size = if size > 0.0 { size } else { 1.0 };
        let farthest = held.iter().map(|&p| scene.x[p as usize].to_vector().norm());
        let rounding = 8.0 * f64::EPSILON * farthest.fold(0.0, f64::max);
        let points = held.iter().filter(moves).copied().collect();
        Self {
            motor: sources.iter().position(|&k| k == motor).unwrap_or(0),
            phase: scene.constraints[motor].get(Field::Phase).unwrap_or(0.0),
            constraints,
            sources,
            w: scene.w,
            points,
            size,
            tolerance: rounding.max(NOTHING * size),
        }
    }

    /// Corrections up to this are rounding.
    pub fn noise(&self) -> f64 {
        10.0 * self.tolerance
    }

    /// Whether everything holds at this pose, up to a part of the size.
    pub fn holds(&mut self, x: &[Point], tolerance: f64) -> bool {
        self.rows(&Stand { x: x.to_vec(), turn: 0.0 }).worst() <= tolerance * self.size
    }

    /// Whether anything of it can move.
    pub fn can_move(&self) -> bool {
        !self.points.is_empty()
    }

    /// The constraints of a kind that depends on more than the pose.
    pub fn has_velocities(&self) -> bool {
        self.constraints.iter().any(|c| c.traits().carried == Carried::ByFrame)
    }

    /// From here on angles are unwrapped from this pose.
    pub fn accept(&mut self, stand: &Stand) {
        self.constraints.iter_mut().for_each(|c| c.accept(&stand.x));
    }

    fn rows(&mut self, stand: &Stand) -> UnitRows {
        let motor = &mut self.constraints[self.motor];
        motor.set(Field::Phase, self.phase + stand.turn);
        let slopes = match motor {
            Constraint::Motor(motor) => motor.slopes(&stand.x),
            _ => [0.0; 2],
        };
        let constraints: Vec<&Constraint> = self.constraints.iter().collect();
        let scene = ConstraintSystem { constraints: &constraints, x: &stand.x, w: self.w };
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
        for row in rows.rows.iter_mut().filter(|row| row.source.0 == self.motor) {
            row.add_unknown(turn, slopes[row.source.1] * (1.0 / self.size) * row.scale);
        }
        rows
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
            let rows = self.rows(stand);
            let worst = rows.worst();
            // As exact as it gets: the last steps gain nothing.
            if worst <= EXACT * self.size || (worst <= self.tolerance && worst > 0.3 * before) {
                return Some((rows, way));
            }
            let mut y = vec![0.0; rows.n_unknowns()];
            rows.rows.iter().for_each(|row| row.add_to(-row.f, &mut y));
            Projector::of(&rows).solve_damped(DAMPING, &mut y);
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
    /// the one that turns the motor most for its length. None if no solution is within
    /// `reach` or nothing can move there.
    fn waypoint(
        &mut self,
        mut stand: Stand,
        direction: Option<&[f64]>,
        reach: f64,
    ) -> Option<(Waypoint, f64)> {
        let (rows, way) = self.correct(&mut stand, reach)?;
        let n = rows.n_unknowns();
        let mut projector = Projector::of(&rows);
        // The idle place is free too.
        let n_freedoms = projector.nullity() - 1;
        let mut turning = vec![0.0; n];
        turning[n - 2] = 1.0;
        projector.onto_motions(&mut turning);
        let is_free = n_freedoms > 1;
        let mut tangent = match direction {
            // Freedoms besides the motor's are left alone as far as they can be.
            Some(direction) if is_free && norm(&turning) > 1e-6 => {
                let k = direction[n - 2].signum();
                turning.iter_mut().for_each(|t| *t *= k);
                turning
            }
            Some(direction) => {
                let mut tangent = direction.to_vec();
                projector.onto_motions(&mut tangent);
                tangent
            }
            None if norm(&turning) > 1e-6 => turning,
            None => {
                // The motor stands at an end already: any motion there is.
                let mut tangent: Vec<f64> = (0..n).map(|k| 1.0 / (1.5 + k as f64)).collect();
                tangent[n - 1] = 0.0;
                projector.onto_motions(&mut tangent);
                tangent
            }
        };
        let length = norm(&tangent);
        let is_short = length.is_nan() || length <= 1e-3;
        if is_short && direction.is_some() || length == 0.0 || n_freedoms == 0 {
            return None;
        }
        tangent.iter_mut().for_each(|t| *t /= length);
        let regularity = regularity(&mut projector, &tangent);
        let source = |&(c, part): &(usize, usize)| (self.sources[c], part);
        let active = rows.rows.iter().map(|row| source(&row.source)).collect();
        Some((Waypoint { stand, tangent, n_freedoms, regularity, active }, way))
    }

    /// The waypoint at which following begins.
    pub fn begin(&mut self, x: &[Point]) -> Option<Waypoint> {
        let stand = Stand { x: x.to_vec(), turn: 0.0 };
        let reach = 1e-3 * self.size;
        self.waypoint(stand, None, reach).map(|(waypoint, _)| waypoint)
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
    pub fn active_beyond(&mut self, from: &Waypoint, h: f64) -> Vec<(usize, usize)> {
        let mut stand = from.stand.clone();
        self.displace(&mut stand, h, &from.tangent);
        let rows = self.rows(&stand);
        rows.rows.iter().map(|row| (self.sources[row.source.0], row.source.1)).collect()
    }
}

/// The length of a vector of unknowns.
pub fn norm(y: &[f64]) -> f64 {
    y.iter().map(|y| y * y).sum::<f64>().sqrt()
}

/// About the smallest singular value that belongs to no motion: for a fixed probe c across the
/// motion, the root of `|c|^2 / c^T (J^T J)^+ c`.
fn regularity(projector: &mut Projector, tangent: &[f64]) -> f64 {
    let n = tangent.len();
    let across = |y: &mut [f64]| {
        let along: f64 = y.iter().zip(tangent).map(|(a, b)| a * b).sum();
        y.iter_mut().zip(tangent).for_each(|(a, b)| *a -= along * b);
        y[n - 1] = 0.0;
    };
    // All places differ, so that no symmetry of a mechanism hides a motion from it.
    let mut probe: Vec<f64> = (0..n).map(|k| libm::sin(1.0 + 0.7 * k as f64)).collect();
    across(&mut probe);
    let mut y = probe.clone();
    projector.solve_damped(1e-2 * DAMPING, &mut y);
    across(&mut y);
    let product: f64 = y.iter().zip(&probe).map(|(a, b)| a * b).sum();
    if product > 0.0 { norm(&probe) / product.sqrt() } else { f64::INFINITY }
}
