//! Velocities and accelerations at a pose, point by point in the order in which they are found: no
//! squares are made of the rows, so they are exact next to a singular pose too.

use smallvec::SmallVec;

use super::decomposition::Part;
use crate::constraint::{Constraint, ConstraintKind, Field, Jet, Point, PointIdx, Vec2, Vector};
use crate::linalg::{MOST_UNKNOWNS, Square};
use crate::solve::island::Island;

/// Velocity and acceleration of a point.
pub(crate) type Rates = [Vector; 2];

/// Velocity and acceleration of each point of an island at a solution: `drive` gives the rates of
/// the values of a constraint, `hand` the velocity of a frozen point. None where they are not
/// determined by as many equations as there are coordinates.
pub(crate) fn point_by_point(
    island: &Island,
    drive: &impl Fn(usize, Field, f64) -> Jet,
    hand: &impl Fn(usize) -> Vector,
) -> Option<Vec<Rates>> {
    let mut motion = vec![[Vector::ZERO; 2]; island.x.len()];
    for (p, motion) in motion.iter_mut().enumerate().skip(island.n_free) {
        motion[0] = hand(p);
    }
    block_by_block(island, drive, &mut motion, solve_one)?;
    for part in &island.plan.rest {
        for order in 0..2 {
            solve_part(island, part, drive, &mut motion, order)?;
        }
    }
    Some(motion)
}

/// The rates of an island whose points are all found from two equations each, which are far from in
/// line: however they are worked out, they are the same. None of others.
pub(crate) fn well_determined(
    island: &Island,
    drive: &impl Fn(usize, Field, f64) -> Jet,
) -> Option<Vec<Rates>> {
    let plan = &island.plan;
    if !plan.is_complete() || !plan.blocks.iter().all(|block| block.is_determined) {
        return None;
    }
    let mut motion = vec![[Vector::ZERO; 2]; island.x.len()];
    block_by_block(island, drive, &mut motion, |rows, _| match rows {
        [(g, _), (h, _)] if g.cross(*h).abs() > FAR_FROM_IN_LINE => solve_one(rows, true),
        _ => None,
    })?;
    Some(motion)
}

/// The sine of the angle between two rows from which on the rate that they ask for is exact.
const FAR_FROM_IN_LINE: f64 = 1e-3;

/// The rates of the points that are found one by one; `solve` gives that of a point from its rows.
fn block_by_block(
    island: &Island,
    drive: &impl Fn(usize, Field, f64) -> Jet,
    motion: &mut [Rates],
    solve: impl Fn(&[(Vector, f64)], bool) -> Option<Vector>,
) -> Option<()> {
    let mut rows = Vec::new();
    for block in &island.plan.blocks {
        let which = &island.plan.constraints[block.first as usize..block.end as usize];
        rows.clear();
        for order in 0..2 {
            if order == 0 {
                gather(island, which, &[block.point], drive, motion, order, &mut rows);
            } else {
                ask_again(island, which, drive, motion, order, &mut rows);
            }
            let own: SmallVec<[_; 4]> =
                rows.iter().map(|row| (row.gradient[0].1, row.rhs)).collect();
            motion[block.point as usize][order] = solve(&own, block.is_determined)?;
        }
    }
    Some(())
}

/// Where a point is this near to its singular pose its rows do not tell how far off it is across
/// them: that it was expected there does.
const UNKNOWN: f64 = 1e-5;

/// Of some points, by their places among those that are looked for, the gradient.
type Gradient = SmallVec<[(usize, Vector); 4]>;

/// A row of some points, and what it times their unknown rates has to be.
struct Row {
    gradient: Gradient,
    rhs: f64,
    /// The reciprocal of the length that the gradient had.
    scale: f64,
    /// Which of the rows of all its constraints it is.
    place: usize,
}

/// The rows of constraints, divided by the length of their gradients, for the rates of an order.
fn gather(
    island: &Island,
    which: &[u32],
    points: &[PointIdx],
    drive: &impl Fn(usize, Field, f64) -> Jet,
    motion: &[Rates],
    order: usize,
    rows: &mut Vec<Row>,
) {
    let rhs = right_sides(island, which, drive, motion, order);
    let mut next = 0;
    for &c in which {
        let constraint: &Constraint = &island.constraints[c as usize];
        constraint.jacobian(&island.x, &mut |row| {
            let place = next;
            next += 1;
            if !row.is_active {
                return;
            }
            let own = row.terms().filter_map(|(p, g)| Some((points.binary_search(&p).ok()?, g)));
            let mut gradient: Gradient = own.collect();
            let squared: f64 = gradient.iter().map(|(_, g)| g.norm_squared()).sum();
            if squared > 0.0 {
                let scale = 1.0 / squared.sqrt();
                gradient.iter_mut().for_each(|(_, g)| *g *= scale);
                rows.push(Row { gradient, rhs: rhs[place] * scale, scale, place });
            }
        });
    }
}

/// Gives rows of these constraints what they have to be for the rates of another order.
fn ask_again(
    island: &Island,
    which: &[u32],
    drive: &impl Fn(usize, Field, f64) -> Jet,
    motion: &[Rates],
    order: usize,
    rows: &mut [Row],
) {
    let rhs = right_sides(island, which, drive, motion, order);
    rows.iter_mut().for_each(|row| row.rhs = rhs[row.place] * row.scale);
}

/// What the gradient of each row of constraints times the unknown rates has to be.
fn right_sides(
    island: &Island,
    which: &[u32],
    drive: &impl Fn(usize, Field, f64) -> Jet,
    motion: &[Rates],
    order: usize,
) -> SmallVec<[f64; 8]> {
    let place = |p: PointIdx| {
        let (x, [v, a]) = (island.x[p as usize], motion[p as usize]);
        Vec2 { x: Jet::new(x.x, v.x, a.x), y: Jet::new(x.y, v.y, a.y) }
    };
    let mut rhs = SmallVec::new();
    for &c in which {
        let field = |field: Field, value: f64| drive(c as usize, field, value);
        island.constraints[c as usize].equations(&place, &field, &mut |f: Jet| {
            rhs.push(-if order == 0 { f.d } else { f.dd });
        });
    }
    rhs
}

/// The rate of a single point: the shortest that comes nearest to what its rows ask for.
fn solve_one(rows: &[(Vector, f64)], is_determined: bool) -> Option<Vector> {
    let rate = match rows {
        [] => Vector::ZERO,
        &[(g, f)] => g * f,
        &[(g, f), (h, k)] => Vector::new(f * h.y - k * g.y, k * g.x - f * h.x) / g.cross(h),
        _ => {
            let (mut xx, mut xy, mut yy, mut to) = (0.0, 0.0, 0.0, Vector::ZERO);
            for &(g, rhs) in rows {
                xx += g.x * g.x;
                xy += g.x * g.y;
                yy += g.y * g.y;
                to += g * rhs;
            }
            Vector::new(yy * to.x - xy * to.y, xx * to.y - xy * to.x) / (xx * yy - xy * xy)
        }
    };
    let is_known = rate.x.is_finite() && rate.y.is_finite();
    if is_known { Some(rate) } else { (!is_determined).then_some(Vector::ZERO) }
}

/// The rates of the points of a part; none where its equations are not as many as the unknowns, or
/// do not determine them.
fn solve_part(
    island: &Island,
    part: &Part,
    drive: &impl Fn(usize, Field, f64) -> Jet,
    motion: &mut [Rates],
    order: usize,
) -> Option<()> {
    let n = 2 * part.points.len();
    if n > MOST_UNKNOWNS {
        return None;
    }
    let mut rows = Vec::with_capacity(n);
    gather(island, &part.constraints, &part.points, drive, motion, order, &mut rows);
    if rows.len() != n {
        return None;
    }
    let mut square: Square = Square::new(n);
    for (r, row) in rows.iter().enumerate() {
        square.set_right_side(r, row.rhs);
        let to = square.row(r);
        for (k, g) in &row.gradient {
            to[2 * k] += g.x;
            to[2 * k + 1] += g.y;
        }
    }
    if square.eliminate() == 0.0 {
        return None;
    }
    let rates = square.solution();
    for (p, rate) in part.points.iter().zip(rates.as_chunks::<2>().0) {
        motion[*p as usize][order] = Vector::new(rate[0], rate[1]);
    }
    rates.iter().all(|rate| rate.is_finite()).then_some(())
}

/// Steps that lead one point to where it belongs at most: next to a singular pose the first goes far
/// too far, and each of those after it comes back half the way.
const MOST_STEPS: u32 = 40;
/// A step that is so much shorter than the whole way ends it.
const ROUGHLY: f64 = 0.01;

/// How far the farthest free point of an island that is found point by point is from where its
/// constraints say.
pub(crate) fn position_error(island: &Island) -> f64 {
    // What is met to the bit may be off by the rounding of its value all the same.
    let rounding = f64::EPSILON * island.size();
    let mut x = island.x.clone();
    let mut rows = Vec::new();
    let mut wanted = Vec::new();
    let mut worst = 0.0_f64;
    for block in &island.plan.blocks {
        let which = &island.plan.constraints[block.first as usize..block.end as usize];
        let which = || which.iter().map(|&c| &island.constraints[c as usize]);
        let p = block.point;
        rows_of(p, which(), &island.x, &mut rows);
        if block.has_branches() && block.side.sine.abs() < UNKNOWN {
            rows.truncate(1);
        }
        wanted.clear();
        wanted.extend(rows.iter().map(|&(_, f)| f - f.abs().max(rounding).copysign(f)));
        let from = x[p as usize];
        let mut first = None;
        let mut is_there = false;
        for _ in 0..MOST_STEPS {
            rows_of(p, which(), &x, &mut rows);
            rows.truncate(wanted.len());
            rows.iter_mut().zip(&wanted).for_each(|((_, f), wanted)| *f = wanted - *f);
            let Some(step) = solve_one(&rows, false) else { break };
            x[p as usize] += step;
            first.get_or_insert(step);
            is_there = step.norm() <= ROUGHLY * (x[p as usize] - from).norm();
            if is_there {
                break;
            }
        }
        if !is_there {
            x[p as usize] = from + first.unwrap_or(Vector::ZERO);
        }
        worst = worst.max((x[p as usize] - from).norm_squared());
    }
    worst.sqrt()
}

/// The rows of a point: their gradients by it, made unit vectors, and how far off they are.
fn rows_of<'a>(
    p: PointIdx,
    which: impl Iterator<Item = &'a Constraint>,
    x: &[Point],
    rows: &mut Vec<(Vector, f64)>,
) {
    rows.clear();
    for constraint in which {
        if let Constraint::Length(bar) = constraint
            && let Some((f, g)) = bar.felt_by(p, x)
        {
            rows.push((g, f));
            continue;
        }
        constraint.jacobian(x, &mut |row| {
            let own = row.terms().find(|&(q, _)| q == p);
            let length = own.map_or(0.0, |(_, g)| g.norm());
            if let (true, Some((_, g))) = (row.is_active && length > 0.0, own) {
                rows.push((g / length, row.f / length));
            }
        });
    }
}
