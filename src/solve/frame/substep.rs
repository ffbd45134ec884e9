//! A frame in smaller steps: what drives the island is interpolated between the last frame
//! and the present one, and each step is expected from the exact velocity and acceleration at its
//! beginning.
//!
//! A step counts as understood if it ends much nearer to where it was expected than the other place
//! where the constraints hold, and if the motions at both of its ends fit the way between them. What
//! is not understood is divided. Through an exact change point the smooth motion changes the sign of
//! the determinant, and its velocities fit far better; a kinked one and the other branch of two
//! that come near do not.

use super::attempt::{Attempt, attempt, motion_since};
use super::branch::NEARLY_SINGULAR;
use super::expected::{NO_MOTION, SURPRISE};
use super::interpolate::Ends;
use super::motion::Rates;
use crate::constraint::{Point, Vector};
use crate::solve::island::Island;
use crate::solve::island::sides::{SINGULAR, Sides};
use crate::solve::method::{Limits, newton};
use crate::solve::report::Counters;

/// The smallest step, as a part of the frame.
const SMALLEST: f64 = 1.0 / 65536.0;
/// Steps of one frame before it counts as not to be followed; those that were, of random triads,
/// six-bars and mechanisms with change points at up to 30 degrees a frame, took 58 at most.
const MOST_STEPS: u32 = 200;
/// After so many steps it is asked whether to go on. A step of many points asks by itself.
const STEPS_A_LOOK: u32 = 16;
/// After a step whose correction stayed below this part of its motion the next may be longer.
const EASY: f64 = 0.05;
/// The part of the way by which the motions at its ends may miss it: 0.3 percent for a crank that
/// turns by 20 degrees, everything where the motion goes on along another branch.
const KINK: f64 = 0.02;
/// They miss the way of a step that is twice as long by so many times as much.
const TWICE: f64 = 8.0;
/// The same where the sign of the determinant changes. Next to a gap between two branches, passed in
/// a part e of the step, the motions miss the way by e squared.
const CROSSING: f64 = 1e-4;
/// A correction may be this part of the way to the other place where the constraints hold.
const CLEAR: f64 = 0.25;
/// A correction of this part of the way, where the way is known from the frames before only, leads
/// to another branch: the ways along two branches that cross differ by more than the longer one.
const VAGUE: f64 = 0.75;
/// The part of a step that is tried after it. Not a half: a singular pose is often in the middle.
const SHORTER: f64 = 0.45;
/// How far before and beyond a singular pose at its end the motion of a frame is looked at: as far as
/// it is understood, since the places next to it are the less well known the nearer they are.
const NEXT_TO: [f64; 4] = [1.0 / 16.0, 1.0 / 64.0, 1.0 / 256.0, 1.0 / 1024.0];
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
type Motion = Option<Vec<Rates>>;

fn motion_at(island: &mut Island, ends: &Ends) -> Motion {
    (!island.is_singular(SINGULAR)).then(|| ends.motion(island))
}

/// Puts the points where their motion takes them in a part of the frame.
fn follow(here: &[Point], motion: &[Rates], degree: &[u8], h: f64, free: &mut [Point]) {
    for (k, to) in free.iter_mut().enumerate() {
        let [v, a] = motion[k];
        // What has freedom left goes the shortest way, and has no motion of its own to go on with.
        let a = if degree[k] > 1 { a } else { Vector::ZERO };
        *to = here[k] + v * h + a * (0.5 * h * h);
    }
}

/// How far the motions at both ends of a step miss the way between them: the farthest point, and by
/// which part of the longest way.
///
/// The way is that of the polynomial of degree 5 through both ends but for h^5 / 720 of the fifth
/// derivative, the change of the velocity but for h^4 / 12 of the fourth.
fn misfit(island: &Island, before: &[Point], motions: [&[Rates]; 2], h: f64) -> (u32, f64) {
    let [first, last] = motions;
    let (mut way, mut off, mut point) = (0.0_f64, 0.0_f64, 0);
    for k in (0..island.n_free).filter(|&k| island.degree[k] > 1) {
        let d = island.x[k] - before[k];
        let ([v0, a0], [v1, a1]) = (first[k], last[k]);
        let missed = (d - (v0 + v1) * (0.5 * h) - (a0 - a1) * (h * h / 12.0)).norm();
        let kink = (v1 - v0 - (a0 + a1) * (0.5 * h)).norm() * h;
        way = way.max(d.norm());
        if missed.max(kink) > off {
            (off, point) = (missed.max(kink), k as u32);
        }
    }
    (point, if way > 0.0 { off / way } else { 0.0 })
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
    n_steps: u32,
    n_iterations: u32,
    last: Option<Attempt>,
}

impl<'a> Walk<'a> {
    fn new(island: &mut Island, ends: Ends, limits: Limits<'a>) -> Self {
        let mut track = Track::new(island);
        ends.interpolate(island, 0.0);
        if let Some((_, here)) = track.nodes.last_mut() {
            here.copy_from_slice(&island.x[..island.n_free]);
        }
        let motion = motion_at(island, &ends);
        let (n_steps, n_iterations) = (0, 0);
        Self { limits, ends, track, motion, t: 0.0, h: 1.0, n_steps, n_iterations, last: None }
    }

    /// Goes the frame before once more, up to a little before its end: where that was next to a
    /// singular pose, how the motion goes on from there shows in how it came. False if what drives
    /// the island did not go as fast then.
    fn begin_before(&mut self, island: &mut Island, work: &mut Counters) -> bool {
        if island.history.n_past() == 0 {
            return false;
        }
        self.ends.interpolate(island, -1.0);
        let n_free = island.n_free;
        island.x[..n_free].copy_from_slice(island.history.past(1));
        let there = attempt(island, true, &self.limits, work);
        if there.is_none_or(|there| there.correction > FINE * self.limits.size) {
            return false;
        }
        island.keep_sides();
        self.motion = motion_at(island, &self.ends);
        self.t = -1.0;
        let nodes = vec![(self.t, island.x[..n_free].to_vec())];
        self.track = Track { nodes, has_past: false };
        self.motion.is_some() && self.go(island, -NEXT_TO[0], work)
    }

    /// Goes on to an instant; false if the motion cannot be followed so far.
    fn go(&mut self, island: &mut Island, until: f64, work: &mut Counters) -> bool {
        while self.t < until {
            let is_asked = self.n_steps > 0 && self.n_steps.is_multiple_of(STEPS_A_LOOK);
            if self.n_steps >= MOST_STEPS || is_asked && self.limits.budget.is_spent() {
                return false;
            }
            let to = if self.t + self.h >= until { until } else { self.t + self.h };
            let h = to - self.t;
            if !self.step(island, to, work) {
                if h <= SMALLEST {
                    return false;
                }
                self.h = SHORTER * h;
            }
        }
        true
    }

    /// Takes a step if it is understood, or if there is none smaller.
    fn step(&mut self, island: &mut Island, to: f64, work: &mut Counters) -> bool {
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
        self.n_steps += 1;
        if let Some(step) = tried {
            let sides = island.sides();
            island.keep_sides();
            if let Some(missed) = self.is_taken(island, &step, to) {
                self.n_iterations += step.n_iterations;
                self.last = Some(Attempt { n_iterations: self.n_iterations, ..step });
                let is_easy = step.correction <= EASY * motion_since(island, self.track.here());
                if is_easy && TWICE * missed <= KINK {
                    self.h = (2.0 * h).max(self.h).min(1.0);
                }
                self.t = to;
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

    /// By how much the motions at both ends of a step miss the way between them, as far as that was
    /// looked at; none if the island does not go on from the pose that it led to.
    fn is_taken(&mut self, island: &mut Island, step: &Attempt, to: f64) -> Option<f64> {
        let h = to - self.t;
        let is_smallest = h <= SMALLEST;
        let way = motion_since(island, self.track.here());
        let is_kept = !step.has_crossed && step.doubt_squared <= CLEAR * CLEAR;
        let is_still = way <= NO_MOTION * self.limits.size;
        // Where the velocity is not known the frames before are all there is to go by, and they may
        // have been shorter or longer.
        let is_known = self.motion.is_some();
        let is_near = step.correction <= if is_known { SURPRISE } else { VAGUE } * way;
        let may_fit = step.has_crossed || is_kept && (is_still || is_near);
        if !may_fit && !is_smallest {
            return None;
        }
        let after = motion_at(island, &self.ends);
        let (mut point, mut missed, mut is_understood) = (0, 0.0, is_kept && is_still);
        if let (false, Some(first), Some(last)) = (is_understood, &self.motion, &after) {
            (point, missed) = misfit(island, self.track.here(), [first, last], h);
            is_understood =
                if step.has_crossed { missed <= CROSSING } else { may_fit && missed <= KINK };
        } else {
            is_understood |= is_near && (to == 1.0 || !is_known);
        }
        if !is_understood && is_smallest {
            island.turned_over = island.turned_over.or(Some(point));
        }
        if is_understood || is_smallest {
            self.motion = after;
        }
        (is_understood || is_smallest).then_some(missed)
    }
}

/// A walk and its island, to come back to.
struct Checkpoint {
    x: Box<[Point]>,
    sides: Sides,
    states: Vec<(u32, Vec<f64>)>,
    track: Track,
    motion: Motion,
    t: f64,
    n_iterations: u32,
    turned_over: Option<u32>,
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
            t: walk.t,
            n_iterations: walk.n_iterations,
            turned_over: island.turned_over,
        }
    }

    fn restore(&self, island: &mut Island, walk: &mut Walk) {
        island.x[..self.x.len()].copy_from_slice(&self.x);
        island.set_sides(self.sides.clone());
        for (c, state) in &self.states {
            island.constraints[*c as usize].set_state(state);
        }
        (walk.track, walk.motion) = (self.track.clone(), self.motion.clone());
        walk.n_iterations = self.n_iterations;
        (walk.t, walk.h) = (self.t, 1.0);
        island.turned_over = self.turned_over;
    }
}

/// Solves a frame from the pose it begins with; none if the motion cannot be followed. The
/// values of all constraints are those at the end of the frame afterwards.
pub(crate) fn frame(
    island: &mut Island,
    ends_in_singular: bool,
    limits: &Limits,
    work: &mut Counters,
) -> Option<Attempt> {
    let tolerance = limits.tolerance.min(FINE * limits.size);
    let n_iterations = limits.n_iterations.min(MOST_ITERATIONS);
    let limits = Limits { tolerance, n_iterations, ..*limits };
    let ends = Ends::of_frame(island);
    if island.history.n_past() == 0 && island.residual * limits.size > tolerance {
        // Of a pose that is off by as much as a step is long the motion tells nothing.
        ends.interpolate(island, 0.0);
        island.with_workspace(|workspace, pose, _| {
            newton::solve_near(workspace, pose, &limits, work)
        });
    }
    let mut walk = Walk::new(island, ends, limits);
    if island.is_singular(NEARLY_SINGULAR) {
        let begin = Checkpoint::new(island, &walk);
        if !walk.begin_before(island, work) {
            begin.restore(island, &mut walk);
        }
    }
    let mut direct = None;
    if !ends_in_singular {
        let begin = Checkpoint::new(island, &walk);
        if walk.go(island, 1.0, work) {
            if !island.is_singular(NEARLY_SINGULAR) {
                return walk.last;
            }
            direct = walk.last.zip(Some(Checkpoint::new(island, &walk)));
        }
        if walk.t >= 1.0 - NEXT_TO[0] {
            begin.restore(island, &mut walk);
        }
    }
    // It ends in a singular pose, or close to one, or where there is none.
    for next_to in NEXT_TO {
        if walk.t >= 1.0 - next_to || !walk.go(island, 1.0 - next_to, work) {
            break;
        }
        let before = Checkpoint::new(island, &walk);
        if let Some(attempt) = through(island, &mut walk, next_to, work) {
            return Some(attempt);
        }
        before.restore(island, &mut walk);
    }
    if ends_in_singular && walk.go(island, 1.0, work) {
        return walk.last;
    }
    if let Some((last, there)) = direct {
        there.restore(island, &mut walk);
        walk.ends.interpolate(island, 1.0);
        return Some(last);
    }
    walk.ends.interpolate(island, 1.0);
    walk.ends.restore_states(island);
    None
}

/// Solves a frame that ends in a singular pose, where the equations do not say where the points
/// are but the motion does: from a little before to a little beyond, and in between by the
/// polynomial of degree 5 that has places, velocities and accelerations of both.
fn through(
    island: &mut Island,
    walk: &mut Walk,
    next_to: f64,
    work: &mut Counters,
) -> Option<Attempt> {
    let (here, before) = (walk.track.here().to_vec(), walk.motion.take()?);
    walk.motion = Some(before.clone());
    if !walk.step(island, 1.0 + next_to, work) {
        return None;
    }
    let (there, after) = (walk.track.here(), walk.motion.as_ref()?);
    let h = 2.0 * next_to;
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
    island.measure_part_sides(work);
    island.sides_are_next();
    let n_iterations = walk.n_iterations + outcome.n_iterations;
    Some(Attempt {
        worst: outcome.worst,
        n_iterations,
        least_side: f64::EPSILON,
        ..Attempt::default()
    })
}
