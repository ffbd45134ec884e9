//! The method `successive`: each constraint is corrected in turn and the next one sees the
//! result, as in Sketchpad. Its result depends on the order; ours is that of the island.

use super::relaxation::ending;
use super::{Limits, Outcome};
use crate::constraint::{ConstraintKind, Vector};
use crate::solve::island::Island;
use crate::solve::report::Counters;
use crate::solve::settings::Settings;

/// Corrects one constraint after the other in one round.
pub(crate) fn round(
    island: &mut Island,
    settings: &Settings,
    limits: &Limits,
    work: &mut Counters,
) -> (Outcome, Option<f64>) {
    (solve(island, settings.rho, limits, work), None)
}

/// Improves the pose of an island; gives how it ended.
fn solve(island: &mut Island, rho: f64, limits: &Limits, work: &mut Counters) -> Outcome {
    let n_wheels = island.constraints.iter().filter(|c| c.traits().is_wheel).count() as u64;
    for n in 0..limits.n_iterations {
        let mut worst = 0.0_f64;
        for (c, constraint) in island.constraints.iter().enumerate() {
            let rho = island.own_rho.get(c).copied().flatten().unwrap_or(rho);
            // No more points move than the longest list of a constraint: a body's are added
            // as they come, the pose it was corrected from being its own.
            let mut squared = 0.0;
            let mut moves = Moves::default();
            constraint.correct(&island.x, &island.w, &mut |p, v| {
                if (p as usize) < island.n_free {
                    squared += v.norm_squared() / island.w[p as usize];
                    moves.push(p, v * rho);
                }
            });
            worst = worst.max(squared);
            if moves.are_finite() {
                moves.for_each(|p, d| island.x[p as usize] += d);
            }
        }
        work.evaluations += island.constraints.len() as u64;
        work.wheel_evaluations += n_wheels;
        if worst.sqrt() <= limits.tolerance || limits.budget.is_spent() {
            return ending(island, limits, n, f64::INFINITY, work);
        }
    }
    ending(island, limits, limits.n_iterations, f64::INFINITY, work)
}

/// The moves of one correction: the first few in place, the many of a body in a list.
#[derive(Default)]
struct Moves {
    n: usize,
    few: [(u32, Vector); 4],
    more: Vec<(u32, Vector)>,
}

impl Moves {
    fn push(&mut self, p: u32, d: Vector) {
        match self.few.get_mut(self.n) {
            Some(place) => *place = (p, d),
            None => self.more.push((p, d)),
        }
        self.n += 1;
    }

    fn iter(&self) -> impl Iterator<Item = &(u32, Vector)> {
        self.few[..self.n.min(self.few.len())].iter().chain(&self.more)
    }

    fn are_finite(&self) -> bool {
        self.iter().all(|(_, d)| d.is_finite())
    }

    fn for_each(&self, mut f: impl FnMut(u32, Vector)) {
        self.iter().for_each(|&(p, d)| f(p, d));
    }
}
