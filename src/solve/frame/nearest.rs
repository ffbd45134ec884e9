//! Of the solutions that a solve may choose from, the nearest: an island with freedom left moves
//! no farther than its constraints ask for, and a range that is entered from outside ends on its
//! stop.

use crate::constraint::{Constraint, ConstraintKind, Field, Point};
use crate::solve::island::Island;
use crate::solve::method::{Limits, Pose, Stiffness, Workspace, newton};
use crate::solve::report::Counters;

/// Of a way from the start the part that the constraints do not ask for, relative to all of it,
/// is none if it is below this: it makes the way longer by its square.
const NONE: f64 = 1e-12;
/// Taken back so far, more is only worth its steps while it goes fast.
const LITTLE: f64 = 1e-2;
/// A round that leaves more than this part of what there was goes slowly.
const FAST: f64 = 0.25;
const MOST_ROUNDS: u32 = 12;
/// Angles, radians, that differ by no more than this are alike.
const ALIKE: f64 = 1e-9;
/// Each angle that may turn either way doubles the ways that are tried.
const MOST_UNDECIDED: usize = 3;
/// Lengths that differ by less than this part are the same.
const ROUNDING: f64 = 1e-14;
/// A way shorter than this part of the size is not looked at.
const STILL: f64 = 1e-9;
/// What is added to J^T J for projections onto what it leaves open, and how often they are
/// repeated: a direction that it holds with a square of 1e-4 is taken out to 1e-8.
const FLOOR: f64 = 1e-10;
const PROJECTIONS: u32 = 2;

/// Moves a solution that was found from `start` towards the nearest one.
pub(crate) fn approach(
    island: &mut Island,
    workspace: &mut Workspace,
    start: &[Point],
    limits: &Limits,
    work: &mut Counters,
) {
    let mut before = f64::INFINITY;
    for _ in 0..MOST_ROUNDS {
        let mut pose = Pose { constraints: &island.constraints, x: &mut island.x };
        workspace.evaluate(&pose, work);
        workspace.remember(&pose);
        let mut way = Vec::new();
        workspace.equations.gather(pose.x, &mut workspace.expected);
        workspace.equations.way(start, &workspace.expected, &mut way);
        let length = norm(&way);
        if workspace.equations.reach(&way) <= STILL * limits.size || limits.budget.is_spent() {
            return;
        }
        project(workspace, &mut way, work);
        let superfluous = norm(&way) / length;
        if superfluous <= NONE || superfluous <= LITTLE && superfluous > FAST * before {
            return;
        }
        before = superfluous;
        let here: Box<[Point]> = workspace.expected[..].into();
        workspace.step.clear();
        workspace.step.extend(way.iter().map(|y| -y));
        // A short way back does not overshoot; a long one may lead to another branch.
        let is_nearer = [1.0, 0.25].into_iter().any(|part| {
            workspace.equations.scatter(&here, pose.x);
            workspace.remember(&pose);
            if !workspace.try_step(&mut pose, part, work).is_finite() {
                return false;
            }
            let step = workspace.step.clone();
            let outcome = newton::solve_near(workspace, &mut pose, limits, work);
            workspace.step = step;
            workspace.equations.gather(pose.x, &mut workspace.expected);
            let mut way = Vec::new();
            workspace.equations.way(start, &workspace.expected, &mut way);
            // What little is left to take back does not show in the length.
            outcome.is_converged() && norm(&way) <= length * (1.0 + ROUNDING)
        });
        if !is_nearer {
            workspace.equations.scatter(&here, pose.x);
            workspace.evaluate(&pose, work);
            return;
        }
    }
}

/// Keeps of a way in the weighted unknowns what changes no row.
fn project(workspace: &mut Workspace, way: &mut [f64], work: &mut Counters) {
    work.factorisations += 1;
    let matrix = workspace.assemble(Stiffness::None);
    matrix.factor(FLOOR);
    for _ in 0..PROJECTIONS {
        matrix.solve(way);
        way.iter_mut().for_each(|y| *y *= FLOOR);
    }
}

fn norm(way: &[f64]) -> f64 {
    way.iter().map(|y| y * y).sum::<f64>().sqrt()
}

/// An angle that begins exactly between the two ways to turn it, and the one that would be taken.
#[derive(Clone, Copy)]
pub(crate) struct Undecided {
    constraint: usize,
    way: f64,
}

impl Undecided {
    /// All of an island; none where they are too many to try all ways.
    pub fn all(island: &Island) -> Vec<Self> {
        let undecided = island.stateful.iter().filter_map(|&c| Self::of(island, c as usize));
        let all: Vec<Self> = undecided.take(MOST_UNDECIDED + 1).collect();
        if all.len() > MOST_UNDECIDED { Vec::new() } else { all }
    }

    /// A constraint that no pose has put on a side yet, if it is off alike from either.
    fn of(island: &Island, constraint: usize) -> Option<Self> {
        let as_is = &island.constraints[constraint];
        if as_is.traits().is_wheel || as_is.state()? != [0.0] {
            return None;
        }
        let [one, other] = [1.0, -1.0].map(|way| {
            let mut decided = as_is.clone();
            decided.set_state(&[way]);
            decided.residual(&island.x)
        });
        let is_alike = one != other && (one + other).abs() <= ALIKE;
        let way = if as_is.residual(&island.x) == one { 1.0 } else { -1.0 };
        is_alike.then_some(Self { constraint, way })
    }

    /// Decides which of these turn the other way, by the bits of a number.
    pub fn decide(all: &[Self], island: &mut Island, turned: usize) {
        for (k, one) in all.iter().enumerate() {
            let way = if turned >> k & 1 == 0 { one.way } else { -one.way };
            island.constraints[one.constraint].set_state(&[way]);
        }
    }

    /// None of these was ever turned.
    pub fn release(all: &[Self], island: &mut Island) {
        for one in all {
            island.constraints[one.constraint].set_state(&[0.0]);
        }
    }
}

/// How long the way from a start to the present pose is, in the metric of the weights.
pub(crate) fn distance(workspace: &Workspace, start: &[Point], x: &[Point]) -> f64 {
    let (mut here, mut way) = (Vec::new(), Vec::new());
    workspace.equations.gather(x, &mut here);
    workspace.equations.way(start, &here, &mut way);
    norm(&way)
}

/// Ranges that were left when a solve began, as they were.
pub(crate) struct Held(Vec<(usize, Constraint)>);

impl Held {
    /// Makes equalities of the ranges whose value lies outside: a solve that ends with them met
    /// ends on their stops, and not somewhere inside where its last step led.
    pub fn new(island: &mut Island) -> Self {
        let mut held = Vec::new();
        for (c, constraint) in island.constraints.iter_mut().enumerate() {
            let (Some(lo), Some(hi)) = (constraint.get(Field::Lo), constraint.get(Field::Hi))
            else {
                continue;
            };
            let residual = constraint.residual(&island.x);
            if lo >= hi || residual == 0.0 || residual.is_nan() {
                continue;
            }
            let stop = if residual > 0.0 { hi } else { lo };
            let as_was = constraint.clone();
            if stop.is_finite()
                && constraint.set(Field::Lo, stop)
                && constraint.set(Field::Hi, stop)
            {
                held.push((c, as_was));
            }
        }
        Self(held)
    }

    /// Whether there are any.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Makes ranges of them again.
    pub fn release(self, island: &mut Island) {
        for (c, as_was) in self.0 {
            island.constraints[c] = as_was;
        }
    }
}
