//! The pose in closed form: the limit of speed, the start of every peer, and the truth.

use crate::peer::Peer;
use crate::work::{Place, Step, Work};

fn minus(a: Place, b: Place) -> Place {
    [a[0] - b[0], a[1] - b[1]]
}

fn norm(a: Place) -> f64 {
    a[0].hypot(a[1])
}

/// Where the circles about two points meet, on the wanted side.
fn meet([a, b]: [Place; 2], [ra, rb]: [f64; 2], side: f64) -> Place {
    let e = minus(b, a);
    let l2 = e[0] * e[0] + e[1] * e[1];
    let along = (l2 + ra * ra - rb * rb) / (2.0 * l2);
    let across = side * (ra * ra / l2 - along * along).max(0.0).sqrt();
    [a[0] + along * e[0] - across * e[1], a[1] + along * e[1] + across * e[0]]
}

/// Puts the points that follow from others in their places.
pub fn follow(plan: &[Step], x: &mut [Place]) {
    for step in plan {
        match *step {
            Step::Dyad { p, of, lengths, side } => x[p] = meet(of.map(|k| x[k]), lengths, side),
            Step::Slider { p, of, length, direction: d } => {
                let along = x[of][0] * d[0] + x[of][1] * d[1];
                let across = x[of][1] * d[0] - x[of][0] * d[1];
                let t = along + (length * length - across * across).sqrt();
                x[p] = [t * d[0], t * d[1]];
            }
            Step::Corner { p, of, by } => x[p] = [x[of[0]][0] + by[0], x[of[0]][1] + by[1]],
            Step::Copy { p, of, as_far_as: [g, q] } => {
                x[p] = [x[of][0], x[of][1] + norm(minus(x[q], x[g]))];
            }
        }
    }
}

/// Two places no farther apart than this part of how far they are from the origin, or from a unit there, are one.
const ONE_PLACE: f64 = 1e-9;

/// Whether a point is on the wrong one of the two places its links allow: nearer to the mirror
/// image of where it belongs than to where it belongs, if these are two places.
pub fn is_wrong(plan: &[Step], truth: &[Place], x: &[Place]) -> bool {
    plan.iter().any(|step| {
        let (p, other) = match *step {
            Step::Dyad { p, of, .. } | Step::Corner { p, of, .. } => (p, mirror(truth, p, of)),
            Step::Slider { p, of, direction: d, .. } => {
                let t = truth[of][0] * d[0] + truth[of][1] * d[1];
                let [x, y] = minus(truth[p], [t * d[0], t * d[1]]);
                (p, [t * d[0] - x, t * d[1] - y])
            }
            Step::Copy { .. } => return false,
        };
        let are_two = norm(minus(other, truth[p])) > ONE_PLACE * (1.0 + norm(truth[p]));
        are_two && norm(minus(x[p], other)) < norm(minus(x[p], truth[p]))
    })
}

/// The mirror image of a point in the line through two others.
fn mirror(x: &[Place], p: usize, [a, b]: [usize; 2]) -> Place {
    let e = minus(x[b], x[a]);
    let r = minus(x[p], x[a]);
    let l2 = e[0] * e[0] + e[1] * e[1];
    let across = (e[0] * r[1] - e[1] * r[0]) / l2;
    [x[p][0] + 2.0 * across * e[1], x[p][1] - 2.0 * across * e[0]]
}

impl Work {
    /// Starts in the pose that the plan gives.
    pub fn from_plan(mut self) -> Self {
        for &(p, about) in &self.driven {
            self.start[p] = [about[0] + self.offsets[0][0], about[1] + self.offsets[0][1]];
        }
        follow(&self.plan, &mut self.start);
        self
    }
}

/// The formulas and nothing else.
pub struct Exact<'a> {
    work: &'a Work,
    x: Vec<Place>,
}

impl<'a> Exact<'a> {
    pub fn start(work: &'a Work) -> Option<Self> {
        (!work.plan.is_empty()).then(|| Self { work, x: work.start.clone() })
    }
}

impl Peer for Exact<'_> {
    fn frame(&mut self, k: usize) -> bool {
        for &(p, about) in &self.work.driven {
            self.x[p] = self.work.target(about, k);
        }
        follow(&self.work.plan, &mut self.x);
        std::hint::black_box(&self.x);
        true
    }

    fn pose(&mut self) -> Vec<Place> {
        self.x.clone()
    }
}
