//! Velocities and accelerations at a solution: the equations, differentiated in time.
//!
//! f(x, t) = 0 holds at all times, so J v = -df/dt with the points held, and J a = minus
//! what is left of the second derivative when the points move on with constant v. Where
//! there is freedom left the shortest v and a are taken.

use super::frame::motion;
use super::island::Island;
use super::island::partition::Partition;
use super::method::rows::{add_row, dot_row};
use super::method::{Stiffness, Workspace};
use super::report::Counters;
use crate::constraint::{ConstraintKind, Field, Jet, PointIdx, Real, Vec2, Vector};
use crate::diag::Diagnostic;
use crate::world::{ConstraintId, Rates, World};

/// Far below the smallest square of a singular value that matters; the repetitions remove
/// what it does to the result.
pub(super) const FLOOR: f64 = 1e-10;
/// Repetitions of the solve on what is left; each gains the digits that the floor costs.
const REPETITIONS: u32 = 4;

/// The values of constraints that change in time, in order of constraint.
pub(super) type FieldRates = [(ConstraintId, Field, Jet)];

/// Velocities and accelerations of all points, where the solver has taken in the world.
///
/// # Errors
/// A live value that has none now.
pub(super) fn rates(partition: &mut Partition, world: &mut World) -> Result<Rates, Diagnostic> {
    let n = world.points().column().len();
    let still = || vec![Vector::ZERO; n];
    let mut rates = Rates { velocity: still(), acceleration: still() };
    let fields = field_rates(world, &rates)?;
    let all: Vec<u32> = partition.iter().map(|(k, _)| k).collect();
    for k in all {
        if let Some(island) = partition.get_mut(k) {
            add_rates(island, &fields, &mut rates);
        }
    }
    Ok(rates)
}

/// The values that time drives, with their rates, given those of the points.
///
/// # Errors
/// A live value that has none now.
pub(super) fn field_rates(
    world: &mut World,
    rates: &Rates,
) -> Result<Vec<(ConstraintId, Field, Jet)>, Diagnostic> {
    let mut fields = world.field_rates(rates)?;
    fields.sort_by_key(|(id, ..)| *id);
    Ok(fields)
}

/// Works out the rates of the free points of an island.
pub(super) fn add_rates(island: &mut Island, fields: &FieldRates, rates: &mut Rates) {
    let ids = island.ids.clone();
    let drive = |c: usize, field: Field, value: f64| {
        let first = fields.partition_point(|(other, ..)| *other < ids[c]);
        let mut own = fields[first..].iter().take_while(|(other, ..)| *other == ids[c]);
        let driven = own.find(|(_, f, _)| *f == field);
        driven.map_or(Jet::constant(value), |(_, _, jet)| Jet::new(value, jet.d, jet.dd))
    };
    let motion = motion::well_determined(island, &drive)
        .unwrap_or_else(|| motion(island, &drive, &|_| Vector::ZERO));
    for (id, [velocity, acceleration]) in island.points[..island.n_free].iter().zip(motion) {
        rates.velocity[id.idx()] = velocity;
        rates.acceleration[id.idx()] = acceleration;
    }
}

/// Velocity and acceleration of each point of an island at a solution: `drive` gives the rates of
/// the values of a constraint, `hand` the velocity of a frozen point.
pub(super) fn motion(
    island: &mut Island,
    drive: &impl Fn(usize, Field, f64) -> Jet,
    hand: &impl Fn(usize) -> Vector,
) -> Vec<[Vector; 2]> {
    let mut workspace = island.take_workspace();
    let mut work = Counters::default();
    workspace.rows.evaluate(&workspace.equations, &island.constraints, &island.x, &mut work);
    workspace.assemble(Stiffness::None).factor(FLOOR);
    let mut motion = vec![[Vector::ZERO; 2]; island.x.len()];
    for (p, motion) in motion.iter_mut().enumerate().skip(island.n_free) {
        motion[0] = hand(p);
    }
    for order in 0..2 {
        let rhs = right_side(island, &workspace, drive, &motion, order);
        let y = shortest(&mut workspace, &rhs);
        let (y, _) = y.as_chunks::<2>();
        for (p, y) in y.iter().enumerate() {
            motion[p][order] = Vector::new(y[0], y[1]) * island.w[p].sqrt();
        }
    }
    island.put_workspace(workspace);
    motion
}

/// How far the farthest free point of an island is from where its constraints say, to first
/// order: the step that would meet what is left of them.
pub(super) fn position_error(island: &mut Island) -> f64 {
    if island.plan.is_complete() {
        return motion::position_error(island);
    }
    let n_free = island.n_free;
    let mut workspace = island.take_workspace();
    let mut work = Counters::default();
    workspace.rows.evaluate(&workspace.equations, &island.constraints, &island.x, &mut work);
    workspace.assemble(Stiffness::None).factor(FLOOR);
    let rows = workspace.rows.iter(&workspace.equations);
    // What is met to the bit may be off by the rounding of its value all the same.
    let rounding = f64::EPSILON * island.size();
    let left: Vec<f64> = rows.map(|(f, ..)| -f.abs().max(rounding).copysign(f)).collect();
    let y = shortest(&mut workspace, &left);
    island.put_workspace(workspace);
    let steps = y.as_chunks::<2>().0.iter().zip(&island.w[..n_free]);
    let squares = steps.map(|(y, w)| (y[0] * y[0] + y[1] * y[1]) * w);
    squares.fold(0.0, f64::max).sqrt()
}

/// What the rows of J times the unknown rates have to be.
pub(super) fn right_side(
    island: &Island,
    workspace: &Workspace,
    drive: &impl Fn(usize, Field, f64) -> Jet,
    motion: &[[Vector; 2]],
    order: usize,
) -> Vec<f64> {
    let place = |p: PointIdx| {
        let (x, [v, _]) = (island.x[p as usize], motion[p as usize]);
        Vec2 { x: Jet::new(x.x, v.x, 0.0), y: Jet::new(x.y, v.y, 0.0) }
    };
    let mut rhs = Vec::with_capacity(workspace.equations.n_rows());
    for (c, constraint) in island.constraints.iter().enumerate() {
        let field = |field: Field, value: f64| drive(c, field, value);
        constraint.equations(&place, &field, &mut |f: Jet| {
            rhs.push(-if order == 0 { f.d } else { f.dd });
        });
    }
    for (value, scale) in rhs.iter_mut().zip(workspace.rows.scales()) {
        *value = if value.is_finite() { *value * scale } else { 0.0 };
    }
    rhs
}

/// The shortest y for which J y comes nearest to the right side.
pub(super) fn shortest(workspace: &mut Workspace, rhs: &[f64]) -> Vec<f64> {
    let mut y = vec![0.0; 2 * workspace.equations.points().len()];
    let mut d = y.clone();
    for _ in 0..REPETITIONS {
        d.fill(0.0);
        for ((_, unknowns, gradient, _), rhs) in workspace.rows.iter(&workspace.equations).zip(rhs)
        {
            let left = rhs - dot_row(&y, unknowns, gradient);
            add_row(&mut d, unknowns, gradient, left);
        }
        workspace.matrix().solve(&mut d);
        y.iter_mut().zip(&d).for_each(|(y, d)| *y += d);
    }
    y
}
