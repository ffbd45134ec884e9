//! A frame in smaller steps: what drives the island is interpolated between the last frame
//! and the present one, and each step is expected from those before it.

use super::attempt::{Attempt, NO_MOTION, SURPRISE, attempt, motion_since};
use super::interpolate::Ends;
use crate::constraint::{Point, Vector};
use crate::solve::island::Island;
use crate::solve::method::Limits;
use crate::solve::report::Counters;

/// The smallest step, as a part of the frame. A gap between two branches that is passed in
/// less than this is not seen.
const SMALLEST: f64 = 1.0 / 32.0;
/// After a step whose correction stayed below this part of its motion the next may be longer.
const EASY: f64 = 0.05;
/// More iterations than this in a step near its solution: there is none.
const MOST_ITERATIONS: u32 = 12;
/// How many poses an expectation is made from.
const MOST_NODES: usize = 4;

/// Poses at instants of the frame; 0 is its beginning, 1 its end.
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

/// Solves a frame from the pose it begins with; none if the motion cannot be followed. The
/// values of all constraints are those at the end of the frame afterwards.
pub(crate) fn frame(island: &mut Island, limits: &Limits, work: &mut Counters) -> Option<Attempt> {
    let n_free = island.n_free;
    let ends = Ends::of_frame(island);
    let limits = Limits { n_iterations: limits.n_iterations.min(MOST_ITERATIONS), ..*limits };
    let mut track = Track::new(island);
    let (mut t, mut h) = (0.0, 0.5);
    let mut last = None;
    let mut n_iterations = 0;
    while t < 1.0 {
        let to = if t + h >= 1.0 { 1.0 } else { t + h };
        ends.interpolate(island, to);
        let is_predicted = track.predict(to, &island.degree, &mut island.x[..n_free]);
        let tried = attempt(island, is_predicted, &limits, work);
        work.substeps += 1;
        let is_smallest = to - t <= SMALLEST;
        let motion = motion_since(island, track.here());
        let Some(step) = tried.filter(|step| is_smallest || step.is_safe(motion, &limits)) else {
            island.x[..n_free].copy_from_slice(track.here());
            if is_smallest || limits.budget.is_spent() {
                ends.interpolate(island, 1.0);
                ends.restore_states(island);
                return None;
            }
            h *= 0.5;
            continue;
        };
        n_iterations += step.n_iterations;
        t = to;
        if step.correction > SURPRISE * motion && motion > NO_MOTION * limits.size {
            island.note_turning_over();
        }
        island.keep_sides();
        if t < 1.0 {
            island.accept_pose();
        }
        track.push(t, island);
        last = Some(step);
        if step.correction <= EASY * motion {
            h = (2.0 * h).min(1.0);
        }
    }
    last.map(|step| Attempt { n_iterations, ..step })
}
