//! Motors that cannot go on: where and why.

use super::Solver;
use super::island::Island;
use super::island::before::Before;
use super::report::Status;
use crate::constraint::Constraint;
use crate::mobility::{ConstraintSystem, RangeEnd, dead_end};
use crate::world::ConstraintId;

/// What keeps a motor from going on; angles as they are against the x axis, radians, with
/// whole turns.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Halt {
    /// A dead point at this angle.
    DeadPoint(f64),
    /// An inequality, at this angle.
    Stop(f64, ConstraintId),
    /// Something else, at a best fit; the angle is the one it was to have.
    Unclear(f64),
}

impl Island {
    /// Its motors that cannot go on since the frame that was just tried.
    fn halted(&self) -> impl Iterator<Item = (ConstraintId, Halt)> {
        self.before.iter().flat_map(|before| {
            before.constraints.iter().filter_map(|&(c, ref was)| {
                Some((self.ids[c as usize], self.halt(before, c as usize, was)?))
            })
        })
    }

    fn halt(&self, before: &Before, c: usize, was: &Constraint) -> Option<Halt> {
        let (Constraint::Motor(now), Constraint::Motor(was)) = (&self.constraints[c], was) else {
            return None;
        };
        let way = now.turned().total() - was.turned().total();
        if way == 0.0 {
            return None;
        }
        let mut constraints: Vec<&Constraint> = self.constraints.iter().collect();
        for (c, was) in &before.constraints {
            constraints[*c as usize] = was;
        }
        let scene = ConstraintSystem { constraints: &constraints, x: &before.x, w: &self.w };
        match dead_end(&scene, c, way) {
            Some(RangeEnd::DeadPoint(turned)) => Some(Halt::DeadPoint(turned)),
            Some(RangeEnd::Stop(turned, by)) => Some(Halt::Stop(turned, self.ids[by])),
            _ if before.is_first || self.status != Status::BestFit => None,
            _ => Some(Halt::Unclear(now.angle())),
        }
    }
}

impl Solver {
    /// The motors that could not follow in the last frame and could in the one before, each
    /// with what keeps it.
    pub fn halted(&self) -> Vec<(ConstraintId, Halt)> {
        let mut halted: Vec<(ConstraintId, Halt)> =
            self.missed_islands().flat_map(Island::halted).collect();
        halted.sort_by_key(|(id, _)| *id);
        halted
    }
}
