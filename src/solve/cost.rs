//! What the solver holds and does for the sake of each effect, for those who ask.

use super::Solver;
use super::island::history::History;
use crate::constraint::{Activity, Constraint, ConstraintKind, Point};

/// Whether a constraint is a wheel: its angles are unwrapped.
pub fn is_wheel(constraint: &Constraint) -> bool {
    constraint.traits().is_wheel
}

/// Whether a constraint asks for something at some poses and for nothing, or less, at others.
pub fn is_one_sided(constraint: &Constraint) -> bool {
    constraint.traits().activity != Activity::Always
}

impl Solver {
    /// The bytes kept to expect the next pose from the ones before.
    pub fn history_bytes(&self) -> usize {
        self.islands().map(|island| island.history.n_bytes()).sum()
    }

    /// The bytes kept for constraints of some kind.
    pub fn constraint_bytes(&self, is_one: fn(&Constraint) -> bool) -> usize {
        let constraints = self.islands().flat_map(|island| &island.constraints);
        constraints.filter(|c| is_one(c)).count() * size_of::<Constraint>()
    }

    /// Expects the next pose of each island that a frame visits once more, to no end but to be
    /// timed; gives how many of them had one to expect.
    pub fn rehearse_predictions(&self) -> u64 {
        self.awake_islands()
            .map(|island| rehearse_prediction(&island.history, &island.degree))
            .sum()
    }

    /// Does the work that constraints of some kind make in one visit of each island that a frame
    /// visits once more, to no end but to be timed; gives how many of them there are.
    pub fn rehearse_constraints(&self, is_one: fn(&Constraint) -> bool) -> u64 {
        let mut n_done = 0;
        for island in self.awake_islands() {
            for constraint in island.constraints.iter().filter(|c| is_one(c)) {
                constraint.jacobian(&island.x, &mut |row| {
                    std::hint::black_box(row);
                });
                n_done += 1;
            }
        }
        n_done
    }
}

fn rehearse_prediction(history: &History, degree: &[u8]) -> u64 {
    if history.n_past() == 0 {
        return 0;
    }
    let mut free = vec![Point::ORIGIN; degree.len()];
    history.predict(degree, &mut free);
    std::hint::black_box(&free);
    1
}
