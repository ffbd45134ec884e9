//! What the solver holds and does for the sake of each effect, for those who ask.

use super::Solver;
use super::island::history::History;
use crate::constraint::{Bounds, Constraint, ConstraintKind, Kind, Point};

/// An effect that the solver has to do with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Effect {
    /// Expecting the next pose from the ones before.
    Prediction,
    /// Angles of cog wheels and racks, counted on beyond half a turn.
    Wheels,
    /// Bounds that act on one side only: cords, telescopes, end stops.
    Inequalities,
}

/// Whether a constraint is a wheel: its angles are unwrapped.
pub fn is_wheel(constraint: &Constraint) -> bool {
    matches!(constraint.kind(), Kind::Cog | Kind::CogVelocity | Kind::Rack)
}

/// Whether a constraint asks for something at some poses and for nothing at others.
pub fn is_inequality(constraint: &Constraint) -> bool {
    let is_open = |bounds: Bounds| !bounds.is_equality();
    match constraint {
        Constraint::Length(c) => is_open(c.bounds),
        Constraint::Equal(c) => is_open(c.bounds),
        Constraint::Orientation(c) => is_open(c.bounds),
        Constraint::Distance(c) => is_open(c.bounds),
        Constraint::Glider(c) => c.bounded,
        _ => false,
    }
}

impl Effect {
    fn holds(self, constraint: &Constraint) -> bool {
        match self {
            Self::Prediction => false,
            Self::Wheels => is_wheel(constraint),
            Self::Inequalities => is_inequality(constraint),
        }
    }
}

impl Solver {
    /// The bytes kept for an effect: 0 where the scene does not call for it.
    pub fn bytes_of(&self, effect: Effect) -> usize {
        let islands = self.islands();
        match effect {
            Effect::Prediction => islands.map(|island| island.history.n_bytes()).sum(),
            Effect::Wheels => {
                let wheels = islands.flat_map(|island| &island.constraints);
                wheels.filter(|c| is_wheel(c)).count() * size_of::<Constraint>()
            }
            // An inequality keeps no more than an equality does.
            Effect::Inequalities => 0,
        }
    }

    /// Does the work that an effect makes in one visit of each island, once more, to no end
    /// but to be timed; gives the number of times something was evaluated.
    pub fn rehearse(&self, effect: Effect) -> u64 {
        let mut n_done = 0;
        for island in self.islands() {
            if effect == Effect::Prediction {
                n_done += rehearse_prediction(&island.history, &island.degree);
                continue;
            }
            for constraint in island.constraints.iter().filter(|c| effect.holds(c)) {
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
