//! What an edit leaves of an island: at rest, as it is, or to be solved.

use super::{Island, rounding};
use crate::constraint::{Carried, Constraint, ConstraintKind, Point};
use crate::solve::report::Status;

impl Island {
    /// Whether nothing in it carries anything on, and everything holds as it is: each constraint as
    /// exactly as numbers of the size of its own coordinates can tell, so that it does in any part of
    /// the island too.
    pub fn holds(&self) -> bool {
        self.is_passive() && self.constraints.iter().all(|c| holds(c, &self.x))
    }

    /// Whether nothing in it carries anything on from frame to frame, and points are frozen or like all
    /// others.
    pub fn is_passive(&self) -> bool {
        self.w.iter().copied().all(is_plain) && self.constraints.iter().all(is_passive)
    }

    /// Whether it is where the last solve left it, and met everything there.
    pub(super) fn is_met(&self) -> bool {
        self.status == Status::Converged && !(self.is_new || self.is_edited || self.is_awake)
    }

    /// It is solved as it is, and there is nothing to be remembered of it.
    pub fn rest(&mut self) {
        self.is_blank = true;
        self.is_new = false;
        self.is_edited = false;
        self.is_awake = false;
        self.status = Status::Converged;
        self.residual = 0.0;
        self.remembered.take();
    }

    /// The user changed something since the last visit: a value, or the place of a free point.
    /// Before time goes on the island has to be solved as it is now.
    pub fn note_edit(&mut self, is_disturbed: bool) {
        if self.is_blank {
            return self.begin();
        }
        if is_disturbed {
            // A point put elsewhere is a wish for another pose.
            self.feasible = None;
        } else if self.status == Status::Converged {
            self.feasible = Some(self.x[..self.n_free].into());
        }
        self.status = Status::Stalled;
        // A saddle of what was is not one of what is.
        self.probed_at = 0.0;
        self.is_edited = true;
        self.is_awake = true;
        self.history.forget();
        self.inputs.clear();
        self.remembered.take();
    }

    /// It is as if it had just been made.
    fn begin(&mut self) {
        self.is_blank = false;
        self.is_new = true;
        self.is_awake = true;
        self.status = Status::Stalled;
        self.residual = f64::INFINITY;
        self.inputs.clear();
        self.remembered.take();
        self.update_sides();
    }

    /// There is something to solve: what is remembered of it is about to be otherwise.
    pub fn begin_change(&mut self) {
        self.remembered.take();
        self.is_blank = false;
    }
}

/// Whether a constraint asks for the same from frame to frame, unless its values are changed.
pub(super) fn is_passive(constraint: &Constraint) -> bool {
    constraint.traits().carried == Carried::Nothing
}

/// Whether a point of this inverse mass is frozen, or of the weight that all have.
pub(super) fn is_plain(w: f64) -> bool {
    w == 0.0 || w == 1.0
}

/// Whether a constraint holds, whichever of its points may move, up to what rounding leaves of their
/// coordinates.
pub(super) fn holds(constraint: &Constraint, x: &[Point]) -> bool {
    let mut off = 0.0_f64;
    constraint.jacobian(x, &mut |row| {
        if row.f != 0.0 && row.is_active {
            let slopes = row.terms().map(|(_, g)| g.norm()).filter(|slope| *slope > 0.0);
            let least = slopes.fold(f64::INFINITY, f64::min);
            let by = if least.is_finite() { row.f / least } else { row.f };
            off += by * by;
        }
    });
    let held = constraint.points().iter().map(|&p| x[p as usize]);
    let farthest = held.fold(0.0_f64, |most, at| most.max(at.x.abs()).max(at.y.abs()));
    off.sqrt() <= rounding(farthest)
}
