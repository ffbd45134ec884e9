//! Motors that cannot go on: where and why.

use super::Solver;
use super::island::Island;
use super::mobility::{End, Scene, dead_end};
use super::status::Status;
use crate::constraint::{Constraint, Point};
use crate::world::ConstraintId;

/// An island as it was before the frame that it could not be solved in, kept until the next.
pub(super) struct Before {
    /// Where its points were.
    x: Vec<Point>,
    /// The constraints that changed in the frame, as they were.
    constraints: Vec<(u32, Constraint)>,
    /// Whether it was its first frame.
    is_first: bool,
}

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
    /// Keeps how it was before a frame that was just tried in vain.
    pub fn note_halt(&mut self, is_first: bool) {
        if self.history.origin().len() != self.n_free {
            return;
        }
        let constraints = self.inputs.constraints_before(&self.constraints);
        let mut x = self.x.clone();
        x[..self.n_free].copy_from_slice(self.history.origin());
        for &(p, before) in &self.inputs.points {
            x[p as usize] = before;
        }
        self.before = Some(Box::new(Before { x, constraints, is_first }));
    }

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
        let scene = Scene { constraints: &constraints, x: &before.x, w: &self.w };
        match dead_end(&scene, c, way) {
            Some(End::DeadPoint(turned)) => Some(Halt::DeadPoint(turned)),
            Some(End::Stop(turned, by)) => Some(Halt::Stop(turned, self.ids[by])),
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
