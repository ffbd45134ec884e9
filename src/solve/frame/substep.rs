//! A frame in smaller steps: what drives the island is interpolated between the last frame
//! and the present one, and each step is expected from the exact velocity and acceleration at its
//! beginning.
//!
//! A step counts as understood if it ends near where it was expected, if the velocities at both of
//! its ends fit the way between them, and if no singular pose may lie in it. What is not understood
//! is divided. Through an exact change point the smooth motion changes the sign of the
//! determinant however small the step, and its velocities fit; a kinked one and the other branch of
//! two that come near do not.

use super::attempt::{Attempt, NO_MOTION, SURPRISE, attempt, motion_since};
use super::interpolate::Ends;
use crate::constraint::{Point, Vector};
use crate::solve::island::Island;
use crate::solve::island::sides::Sides;
use crate::solve::method::{Limits, newton};
use crate::solve::report::Counters;

/// The smallest step, as a part of the frame. A gap between two branches that is passed in
/// less than this is not seen.
const SMALLEST: f64 = 1.0 / 256.0;
/// How far to leap over a pose that it hits exactly, in smallest steps.
const LEAPS: [f64; 3] = [2.5, 4.0, 7.0];
/// After a step whose correction stayed below this part of its motion the next may be longer.
const EASY: f64 = 0.01;
/// The part of the way by which the velocities at its ends may miss it, by the trapezoidal rule: 0.6
/// percent for a crank that turns by 15 degrees, everything where the motion goes on along another
/// branch.
const KINK: f64 = 0.05;
/// A correction of this part of the way, where the way is known from the frames before only, leads
/// to another branch: the ways along two branches that cross differ by more than the longer one.
const VAGUE: f64 = 0.75;
/// How far before and beyond a singular pose at its end the motion of a frame is looked at.
const NEXT_TO: f64 = 1.0 / 64.0;
/// More iterations than this in a step near its solution: there is none.
const MOST_ITERATIONS: u32 = 12;
/// What a pose may be off, as a part of the size, so that steps of a part of a frame are understood.
const FINE: f64 = 1e-8;
/// How many poses an expectation is made from where the velocity is not known.
const MOST_NODES: usize = 4;

/// Poses at instants of the frame; 0 is its beginning, 1 its end.
#[derive(Clone)]
struct Track {
    /// The latest last; no more than expectations are made from.
    nodes: Vec<(f64, Vec<Point>)>,
    /// Whether any pose before the latest is known, kept or not.
    has_past: bool,
}

impl Track {
    /// The poses the island was in at the frames before.
    fn new(island: &Island) -> Self {
        let history = &island.history;
        let n_past = history.n_past().min(n_nodes(island) - 1);
        let past = (0..=n_past).rev().map(|k| (-(k as f64), history.past(k).to_vec()));
        Self { nodes: past.collect(), has_past: history.n_past() > 0 }
    }

    /// The latest pose.
    fn here(&self) -> &[Point] {
        let (_, here) = self.nodes.last().expect("a track begins with the pose of the frame");
        here
    }

    /// Puts the points where they are expected at `t`; false if nothing is known.
    fn predict(&self, t: f64, degree: &[u8], free: &mut [Point]) -> bool {
        if !self.has_past {
            return false;
        }
        let n_nodes = self.nodes.len();
        // By degree, so that points with the same one share the weights.
        let weights: Vec<Vec<f64>> =
            (0..n_nodes).map(|degree| lagrange(&self.nodes, degree, t)).collect();
        let here = self.here();
        for (k, to) in free.iter_mut().enumerate() {
            // What has freedom left has no motion of its own to go on with.
            let degree = if degree[k] > 1 { degree[k] as usize } else { 0 };
            let weights = &weights[degree.min(n_nodes - 1)];
            let mut d = Vector::ZERO;
            for (weight, (_, pose)) in weights.iter().zip(self.nodes.iter().rev()) {
                d += (pose[k] - here[k]) * *weight;
            }
            *to = here[k] + d;
        }
        true
    }

    /// Adds the pose of an island at `t`.
    fn push(&mut self, t: f64, island: &Island) {
        self.has_past = true;
        let free = &island.x[..island.n_free];
        let pose = if self.nodes.len() >= n_nodes(island) {
            let (_, mut oldest) = self.nodes.remove(0);
            oldest.copy_from_slice(free);
            oldest
        } else {
            free.to_vec()
        };
        self.nodes.push((t, pose));
    }
}

/// How many poses an expectation is made from: what has freedom left has no motion of its own to
/// go on with.
fn n_nodes(island: &Island) -> usize {
    if island.highest_degree() > 1 { MOST_NODES } else { 1 }
}

/// The weights of the last `degree + 1` nodes, the latest first, in the polynomial through
/// them at `t`. The nodes are at different instants.
fn lagrange(nodes: &[(f64, Vec<Point>)], degree: usize, t: f64) -> Vec<f64> {
    let times: Vec<f64> = nodes.iter().rev().take(degree + 1).map(|(t, _)| *t).collect();
    let weight = |k: usize| -> f64 {
        let others = times.iter().enumerate().filter(|&(j, _)| j != k);
        others.map(|(_, other)| (t - other) / (times[k] - other)).product()
    };
    (0..times.len()).map(weight).collect()
}

/// Velocity and acceleration of the free points, per frame; none at a singular pose.
type Motion = Option<Vec<[Vector; 2]>>;

fn motion_at(island: &mut Island, ends: &Ends) -> Motion {
    (!island.is_singular()).then(|| ends.motion(island))
}

/// Puts the points where their motion takes them in a part of the frame.
fn follow(here: &[Point], motion: &[[Vector; 2]], degree: &[u8], h: f64, free: &mut [Point]) {
    for (k, to) in free.iter_mut().enumerate() {
        let [v, a] = motion[k];
        // What has freedom left goes the shortest way, and has no motion of its own to go on with.
        let a = if degree[k] > 1 { a } else { Vector::ZERO };
        *to = here[k] + v * h + a * (0.5 * h * h);
    }
}

/// How far the velocities at both ends of a step miss the way between them: the farthest point,
/// and by which part of the longest way.
fn misfit(island: &Island, before: &[Point], motions: [&Motion; 2], h: f64) -> (u32, f64) {
    let (mut way, mut off, mut point) = (0.0_f64, 0.0_f64, 0);
    if let [Some(first), Some(last)] = motions {
        for k in (0..island.n_free).filter(|&k| island.degree[k] > 1) {
            let d = island.x[k] - before[k];
            let missed = (d - (first[k][0] + last[k][0]) * (0.5 * h)).norm();
            way = way.max(d.norm());
            if missed > off {
                (off, point) = (missed, k as u32);
            }
        }
    }
    (point, if way > 0.0 { off / way } else { 0.0 })
}

/// What a step may pass.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Stride {
    /// No singular pose, unless it is too short to be divided.
    Short,
    /// The singular pose that is known to be there.
    Over,
}

/// A way through a frame.
struct Walk<'a> {
    limits: Limits<'a>,
    ends: Ends,
    track: Track,
    motion: Motion,
    /// The instant that was reached.
    t: f64,
    /// The step to be tried next.
    h: f64,
    n_iterations: u32,
    last: Option<Attempt>,
}

impl<'a> Walk<'a> {
    fn new(island: &mut Island, ends: Ends, limits: Limits<'a>) -> Self {
        let track = Track::new(island);
        ends.interpolate(island, 0.0);
        let motion = motion_at(island, &ends);
        Self { limits, ends, track, motion, t: 0.0, h: 0.5, n_iterations: 0, last: None }
    }

    /// Goes on to an instant; false if the motion cannot be followed so far.
    fn go(&mut self, island: &mut Island, until: f64, work: &mut Counters) -> bool {
        while self.t < until {
            let to = if self.t + self.h >= until { until } else { self.t + self.h };
            if self.step(island, to, Stride::Short, work) {
                continue;
            }
            if self.limits.budget.is_spent() {
                return false;
            }
            if to - self.t <= SMALLEST {
                if !self.leap(island, until, work) {
                    return false;
                }
            } else {
                self.h = 0.5 * (to - self.t);
            }
        }
        true
    }

    /// Goes over a pose that the smallest step hits so exactly that no equation tells where the
    /// points are; what comes after has to fit what was before.
    fn leap(&mut self, island: &mut Island, until: f64, work: &mut Counters) -> bool {
        LEAPS.into_iter().any(|n| {
            let to = self.t + n * SMALLEST;
            to <= until && self.step(island, to, Stride::Over, work)
        })
    }

    /// Takes a step if it is understood, or if there is none smaller.
    fn step(&mut self, island: &mut Island, to: f64, stride: Stride, work: &mut Counters) -> bool {
        let (n_free, h) = (island.n_free, to - self.t);
        self.ends.interpolate(island, to);
        let free = &mut island.x[..n_free];
        let is_predicted = match &self.motion {
            Some(motion) => {
                follow(self.track.here(), motion, &island.degree, h, free);
                true
            }
            None => self.track.predict(to, &island.degree, free),
        };
        let tried = attempt(island, is_predicted, &self.limits, work);
        work.substeps += 1;
        let is_smallest = h <= SMALLEST;
        let way = motion_since(island, self.track.here());
        let is_still = way <= NO_MOTION * self.limits.size;
        let may_count = |step: &Attempt| {
            is_smallest || stride == Stride::Over || step.is_safe(way, &self.limits)
        };
        if let Some(step) = tried.filter(may_count) {
            let sides = island.sides();
            island.keep_sides();
            let after = motion_at(island, &self.ends);
            let (point, missed) = misfit(island, self.track.here(), [&self.motion, &after], h);
            // Where the velocity is not known the frames before are all there is to go by, and
            // they may have been shorter or longer.
            let surprise = if self.motion.is_some() { SURPRISE } else { VAGUE };
            let is_understood = is_still || missed <= KINK && step.correction <= surprise * way;
            if is_understood || is_smallest {
                if !is_understood {
                    island.turned_over = island.turned_over.or(Some(point));
                }
                self.t = to;
                self.motion = after;
                self.n_iterations += step.n_iterations;
                self.last = Some(Attempt { n_iterations: self.n_iterations, ..step });
                if step.correction <= EASY * way {
                    self.h = (2.0 * h).max(self.h).min(1.0);
                }
                if to != 1.0 {
                    island.accept_pose();
                }
                self.track.push(to, island);
                return true;
            }
            island.set_sides(sides);
        }
        island.x[..n_free].copy_from_slice(self.track.here());
        false
    }
}

/// A walk and its island, to come back to.
struct Checkpoint {
    x: Box<[Point]>,
    sides: Sides,
    states: Vec<(u32, Vec<f64>)>,
    track: Track,
    motion: Motion,
    n_iterations: u32,
}

impl Checkpoint {
    fn new(island: &Island, walk: &Walk) -> Self {
        let states = island.stateful.iter();
        let states = states.filter_map(|&c| Some((c, island.constraints[c as usize].state()?)));
        Self {
            x: island.x[..island.n_free].into(),
            sides: island.sides(),
            states: states.collect(),
            track: walk.track.clone(),
            motion: walk.motion.clone(),
            n_iterations: walk.n_iterations,
        }
    }

    fn restore(self, island: &mut Island, walk: &mut Walk, t: f64) {
        island.x[..self.x.len()].copy_from_slice(&self.x);
        island.set_sides(self.sides);
        for (c, state) in &self.states {
            island.constraints[*c as usize].set_state(state);
        }
        let Self { track, motion, n_iterations, .. } = self;
        (walk.track, walk.motion, walk.n_iterations, walk.t) = (track, motion, n_iterations, t);
    }
}

/// Solves a frame from the pose it begins with; none if the motion cannot be followed. The
/// values of all constraints are those at the end of the frame afterwards.
pub(crate) fn frame(island: &mut Island, limits: &Limits, work: &mut Counters) -> Option<Attempt> {
    let tolerance = limits.tolerance.min(FINE * limits.size);
    let n_iterations = limits.n_iterations.min(MOST_ITERATIONS);
    let limits = Limits { tolerance, n_iterations, ..*limits };
    let ends = Ends::of_frame(island);
    let mut walk = Walk::new(island, ends, limits);
    let next_to = 1.0 - NEXT_TO;
    let is_next_to = walk.go(island, next_to, work);
    let before = is_next_to.then(|| Checkpoint::new(island, &walk));
    if is_next_to && walk.go(island, 1.0, work) && walk.motion.is_some() {
        return walk.last;
    }
    // It ends in a singular pose, or close to one, or where there is none.
    if let Some(before) = before {
        let last = walk.last.filter(|_| walk.t == 1.0);
        let there = Checkpoint::new(island, &walk);
        let turned_over = island.turned_over.take();
        before.restore(island, &mut walk, next_to);
        if let Some(attempt) = through(island, &mut walk, work) {
            return Some(attempt);
        }
        if let Some(last) = last {
            there.restore(island, &mut walk, 1.0);
            walk.ends.interpolate(island, 1.0);
            island.turned_over = turned_over;
            return Some(last);
        }
    }
    walk.ends.interpolate(island, 1.0);
    walk.ends.restore_states(island);
    None
}

/// Solves a frame that ends in a singular pose, where the equations do not say where the points
/// are but the motion does: from a little before to a little beyond, and in between by the
/// polynomial of degree 5 that has places, velocities and accelerations of both.
fn through(island: &mut Island, walk: &mut Walk, work: &mut Counters) -> Option<Attempt> {
    let (here, before) = (walk.track.here().to_vec(), walk.motion.take()?);
    walk.motion = Some(before.clone());
    walk.h = 2.0 * NEXT_TO;
    if !walk.step(island, 1.0 + NEXT_TO, Stride::Over, work) || island.turned_over.is_some() {
        return None;
    }
    let (there, after) = (walk.track.here(), walk.motion.as_ref()?);
    let h = 2.0 * NEXT_TO;
    for k in 0..island.n_free {
        let ([v0, a0], [v1, a1]) = (before[k], after[k]);
        let middle = here[k] + (there[k] - here[k]) * 0.5;
        island.x[k] = middle + (v0 - v1) * (5.0 * h / 32.0) + (a0 + a1) * (h * h / 64.0);
    }
    walk.ends.interpolate(island, 1.0);
    let limits = walk.limits;
    let outcome = island
        .with_workspace(|workspace, pose, _| newton::solve_near(workspace, pose, &limits, work));
    if !outcome.is_converged() {
        return None;
    }
    island.update_sides();
    island.sides_are_next();
    let n_iterations = walk.n_iterations + outcome.n_iterations;
    Some(Attempt {
        worst: outcome.worst,
        n_iterations,
        least_side: f64::EPSILON,
        ..Attempt::default()
    })
}
