//! A soft drag: points come as near to places as the constraints allow, and nothing is torn.
//!
//! Half the sum of the squared distances to the places is made least on the poses that meet all
//! constraints: by conjugate gradients within the motions that these leave open, each step as long
//! as the curvature of the way says and then brought back onto the constraints. A pose that is
//! left behind met everything, and so does the one that is kept.

use crate::constraint::{
    Constraint, ConstraintKind as _, Field, Jet, Point, PointIdx, Real as _, Vec2, Vector,
};
use crate::solve::island::Island;
use crate::solve::method::spectrum::noise;
use crate::solve::method::{Limits, Pose, Stiffness, Workspace, newton};
use crate::solve::report::{Counters, Status};
use crate::solve::velocity;

/// Steps of a pull; a dozen are usual, and few more wherever a linkage is stretched out.
const MOST_STEPS: u32 = 100;
/// A slope this small, relative to the size and to the distances that are left, counts as none.
const FLAT: f64 = 1e-12;
/// A direction that leads down less than this part of the steepest one is not taken.
const STEEP: f64 = 0.1;
/// How often a step is projected.
const PROJECTIONS: u32 = 2;
/// A step is no longer than this part of the size: the way is to be followed, not jumped.
const LONGEST_STEP: f64 = 0.1;
/// A step that does not come nearer is taken in part, at most so often.
const MOST_CUTS: u32 = 8;
const CUT: f64 = 0.25;
/// A step that moves no point by this part of its length leads against an end stop.
const BLOCKED: f64 = 1e-3;
/// How far points are pushed aside, relative to the size, and the part of the squared distance that
/// this has to gain.
const PUSH: f64 = 1e-3;
const WORTHWHILE: f64 = 1e-9;
/// What rounding leaves of a sum of squares.
const ROUNDING: f64 = 1e-14;
/// A bound is reached if the value is within this part of the size, or so many radians.
const AT_BOUND: f64 = 1e-9;
/// Steps by which a pose is brought back onto the constraints: it is near, and they converge
/// quadratically.
const MOST_CORRECTIONS: u32 = 30;

/// A point and the place that it is pulled to.
pub(crate) type Pulled = (usize, Point);

/// Pulls points of an island that is solved.
pub(crate) fn pull(island: &mut Island, pulled: &[Pulled], limits: &Limits, work: &mut Counters) {
    let limits = Limits { n_iterations: MOST_CORRECTIONS, ..*limits };
    let mut workspace = island.take_workspace();
    descend(island, &mut workspace, pulled, &limits, work);
    if distance(island, pulled).sqrt() > FLAT * limits.size {
        leave_toggle(island, &mut workspace, pulled, &limits, work);
    }
    let mut pose = Pose { constraints: &island.constraints, x: &mut island.x };
    workspace.evaluate(&pose, work);
    if !workspace.is_met(&limits) {
        // Released bounds and counted wheels may differ from what was solved by rounding.
        let _ = newton::solve_near(&mut workspace, &mut pose, &limits, work);
    }
    island.residual = workspace.rows.worst / limits.size;
    let is_met = workspace.is_met(&limits);
    island.status = if is_met { Status::Converged } else { Status::Stalled };
    island.put_workspace(workspace);
    island.feasible = None;
    island.remembered.take();
    island.history.forget();
    island.accept_pose();
    island.update_sides();
}

/// Goes on as long as a way leads nearer.
fn descend(
    island: &mut Island,
    workspace: &mut Workspace,
    pulled: &[Pulled],
    limits: &Limits,
    work: &mut Counters,
) {
    let mut way = Way { direction: Vec::new(), slope: Vec::new(), held: Vec::new() };
    for _ in 0..MOST_STEPS {
        let mut bounds = Bounds::take(island, limits);
        let leads_on = way.turn(island, workspace, &mut bounds, pulled, limits, work);
        bounds.act(island);
        let went = leads_on && step(island, workspace, &way, pulled, limits, work);
        bounds.release(island);
        if !went || limits.budget.is_spent() {
            break;
        }
        island.accept_pose();
    }
}

/// Where two bars lie in one line, the point that they hold gives way to their joint's moving aside
/// only with its square, and no slope shows it. So what is open is pushed a little, one way and the
/// other; where that leads no nearer, all stays where it is.
fn leave_toggle(
    island: &mut Island,
    workspace: &mut Workspace,
    pulled: &[Pulled],
    limits: &Limits,
    work: &mut Counters,
) {
    let before = distance(island, pulled);
    let here: Box<[Point]> = island.x[..island.n_free].into();
    let pose = Pose { constraints: &island.constraints, x: &mut island.x };
    workspace.evaluate(&pose, work);
    workspace.assemble(Stiffness::None).factor(velocity::FLOOR);
    work.factorisations += 1;
    // By place and not by handle, which a saved session gives anew.
    let aside = open_part(workspace, (0..2 * island.n_free as u32).map(noise).collect());
    let reach = workspace.equations.reach(&aside);
    if reach <= ROUNDING {
        return;
    }
    for way in [PUSH, -PUSH] {
        let mut pose = Pose { constraints: &island.constraints, x: &mut island.x };
        let t = way * limits.size / reach;
        if workspace.equations.displace(pose.x, &here, &aside, t)
            && newton::solve_near(workspace, &mut pose, limits, work).is_converged()
        {
            descend(island, workspace, pulled, limits, work);
            if distance(island, pulled) < before * (1.0 - WORTHWHILE) {
                return;
            }
        }
        island.x[..here.len()].copy_from_slice(&here);
        island.accept_pose();
    }
}

/// Half the sum of the squared distances that are left.
fn distance(island: &Island, pulled: &[Pulled]) -> f64 {
    0.5 * pulled.iter().map(|&(p, to)| (island.x[p] - to).norm_squared()).sum::<f64>()
}

/// Where a pull goes on to.
struct Way {
    /// The direction, in the weighted unknowns.
    direction: Vec<f64>,
    /// The part of the slope that the constraints leave open, where the last step began.
    slope: Vec<f64>,
    /// The bounds that held then.
    held: Vec<usize>,
}

/// An inequality whose value is at a bound.
struct AtBound {
    /// Which constraint it is.
    c: usize,
    /// As it is.
    as_is: Constraint,
    /// As one that holds its value there.
    held: Constraint,
    /// Which way leads out of its bounds.
    outward: f64,
    is_held: bool,
}

/// The inequalities whose values are at a bound. They say nothing until a direction leads out.
struct Bounds(Vec<AtBound>);

impl Bounds {
    fn take(island: &mut Island, limits: &Limits) -> Self {
        let reached = (AT_BOUND * limits.size.max(1.0)).max(2.0 * limits.tolerance);
        let mut all = Vec::new();
        for (c, constraint) in island.constraints.iter_mut().enumerate() {
            let (Some(lo), Some(hi)) = (constraint.get(Field::Lo), constraint.get(Field::Hi))
            else {
                continue;
            };
            if lo >= hi {
                continue;
            }
            for (bound, outward) in [(lo, -1.0), (hi, 1.0)] {
                let held = with_bounds(constraint, [bound; 2]);
                if bound.is_finite() && held.residual(&island.x).abs() <= reached {
                    let silent = with_bounds(constraint, [lo - 2.0 * reached, hi + 2.0 * reached]);
                    let as_is = std::mem::replace(constraint, silent);
                    all.push(AtBound { c, as_is, held, outward, is_held: false });
                    break;
                }
            }
        }
        Self(all)
    }

    /// Holds those that a direction would leave; false if there are none but those that are held
    /// already.
    fn hold(&mut self, island: &mut Island, direction: &[f64]) -> bool {
        let mut is_another = false;
        for bound in self.0.iter_mut().filter(|bound| !bound.is_held) {
            let place = |p: PointIdx| {
                let (p, x) = (p as usize, island.x[p as usize]);
                let v = velocity_of(island, direction, p);
                Vec2 { x: Jet::new(x.x, v.x, 0.0), y: Jet::new(x.y, v.y, 0.0) }
            };
            let mut rate = 0.0;
            let field = |_: Field, value: f64| Jet::constant(value);
            bound.held.equations(&place, &field, &mut |f: Jet| rate = f.d);
            if rate * bound.outward > 0.0 {
                bound.is_held = true;
                is_another = true;
                island.constraints[bound.c] = bound.held.clone();
            }
        }
        is_another
    }

    /// Which are held.
    fn held(&self) -> Vec<usize> {
        self.0.iter().filter(|bound| bound.is_held).map(|bound| bound.c).collect()
    }

    /// Those that are not held act again.
    fn act(&self, island: &mut Island) {
        for bound in self.0.iter().filter(|bound| !bound.is_held) {
            island.constraints[bound.c] = bound.as_is.clone();
        }
    }

    /// All are as they were.
    fn release(self, island: &mut Island) {
        for bound in self.0 {
            island.constraints[bound.c] = bound.as_is;
        }
    }
}

fn with_bounds(constraint: &Constraint, [lo, hi]: [f64; 2]) -> Constraint {
    let mut other = constraint.clone();
    other.set(Field::Lo, lo);
    other.set(Field::Hi, hi);
    other
}

impl Way {
    /// Turns the direction at the present pose; false if no way leads nearer. What of the bounds
    /// would be left on that way is held from here on.
    fn turn(
        &mut self,
        island: &mut Island,
        workspace: &mut Workspace,
        bounds: &mut Bounds,
        pulled: &[Pulled],
        limits: &Limits,
        work: &mut Counters,
    ) -> bool {
        loop {
            let pose = Pose { constraints: &island.constraints, x: &mut island.x };
            workspace.evaluate(&pose, work);
            workspace.assemble(Stiffness::None).factor(velocity::FLOOR);
            work.factorisations += 1;
            let mut slope = vec![0.0; 2 * island.n_free];
            for &(p, to) in pulled {
                let d = (island.x[p] - to) * island.w[p].sqrt();
                slope[2 * p] += d.x;
                slope[2 * p + 1] += d.y;
            }
            let steepest = dot(&slope, &slope).sqrt();
            let slope = open_part(workspace, slope);
            let square = dot(&slope, &slope);
            if square.sqrt() <= FLAT * (limits.size + steepest) {
                return false;
            }
            let direction = self.direction_from(&slope, &bounds.held(), workspace);
            if !bounds.hold(island, &direction) {
                (self.direction, self.slope, self.held) = (direction, slope, bounds.held());
                return true;
            }
        }
    }

    /// The direction conjugate to the last one, at a new slope; the steepest one where there was
    /// none, other bounds held, or it leads hardly down.
    fn direction_from(&self, slope: &[f64], held: &[usize], workspace: &mut Workspace) -> Vec<f64> {
        let steepest = || slope.iter().map(|g| -g).collect();
        if held != self.held || self.slope.len() != slope.len() {
            return steepest();
        }
        // Polak and Ribiere's factor; a negative one begins anew.
        let change: f64 = slope.iter().zip(&self.slope).map(|(g, h)| g * (g - h)).sum();
        let beta = change / dot(&self.slope, &self.slope);
        if beta <= 0.0 || beta.is_nan() {
            return steepest();
        }
        let conjugate = self.direction.iter().zip(slope).map(|(d, g)| beta * d - g);
        let direction = open_part(workspace, conjugate.collect());
        let leads_down = dot(&direction, slope) <= -STEEP * dot(slope, slope);
        if leads_down { direction } else { steepest() }
    }
}

/// The displacement of a point in a step of the weighted unknowns.
fn velocity_of(island: &Island, step: &[f64], p: usize) -> Vector {
    match step.get(2 * p..2 * p + 2) {
        Some(v) => Vector::new(v[0], v[1]) * island.w[p].sqrt(),
        None => Vector::ZERO,
    }
}

/// The part of a step in the weighted unknowns that the rows leave open. What is left of the other
/// part is that of the floor, squared; what rounding does is a part of the result or of the last
/// digit of the step, however small the result is.
fn open_part(workspace: &mut Workspace, mut step: Vec<f64>) -> Vec<f64> {
    for _ in 0..PROJECTIONS {
        workspace.matrix().solve(&mut step);
        step.iter_mut().for_each(|y| *y *= velocity::FLOOR);
    }
    step
}

/// Takes a step on the way; false if none comes nearer.
fn step(
    island: &mut Island,
    workspace: &mut Workspace,
    way: &Way,
    pulled: &[Pulled],
    limits: &Limits,
    work: &mut Counters,
) -> bool {
    let bend = bend(island, workspace, &way.direction);
    let rise = dot(&way.slope, &way.direction);
    let curvature: f64 = pulled
        .iter()
        .map(|&(p, to)| {
            let (v, a) = (velocity_of(island, &way.direction, p), velocity_of(island, &bend, p));
            v.norm_squared() + (island.x[p] - to).dot(a)
        })
        .sum();
    let reach = workspace.equations.reach(&way.direction);
    let longest = LONGEST_STEP * limits.size / reach;
    let mut t = if curvature > 0.0 { (-rise / curvature).min(longest) } else { longest };
    let before = distance(island, pulled);
    let here: Box<[Point]> = island.x[..island.n_free].into();
    for _ in 0..MOST_CUTS {
        let bent = way.direction.iter().zip(&bend).map(|(v, a)| t * v + 0.5 * t * t * a);
        let bent: Vec<f64> = bent.collect();
        let mut pose = Pose { constraints: &island.constraints, x: &mut island.x };
        if workspace.equations.displace(pose.x, &here, &bent, 1.0)
            && newton::solve_near(workspace, &mut pose, limits, work).is_converged()
            && distance(island, pulled) <= before * (1.0 + ROUNDING)
        {
            let moved = island.x.iter().zip(&here).map(|(x, before)| x.distance(*before));
            let moved = moved.fold(0.0, f64::max);
            // At an end stop all of it is taken back.
            return moved > (ROUNDING * limits.size).max(BLOCKED * t * reach);
        }
        island.x[..here.len()].copy_from_slice(&here);
        t *= CUT;
    }
    false
}

/// How the way that begins in a direction bends to stay on the constraints.
fn bend(island: &Island, workspace: &mut Workspace, direction: &[f64]) -> Vec<f64> {
    // Time stands still: no motor turns.
    let at_rest = |_: usize, field: Field, value: f64| {
        Jet::constant(if field == Field::Speed { 0.0 } else { value })
    };
    let motion: Vec<[Vector; 2]> =
        (0..island.x.len()).map(|p| [velocity_of(island, direction, p), Vector::ZERO]).collect();
    let rhs = velocity::right_side(island, workspace, &at_rest, &motion, 1);
    velocity::shortest(workspace, &rhs)
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
