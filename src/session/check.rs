//! What `check` finds, and how it is told.

use crate::diag::{format_rounded, listed};
use crate::mobility::PoseClass;
use crate::solve::Status;

/// More redundant constraints than this are counted.
const MOST_REDUNDANT: usize = 30;

/// What `check` finds, with names.
#[derive(Debug, Clone)]
pub struct Check {
    /// In how many independent ways the points can begin to move, motors held.
    pub degrees_of_freedom: usize,
    /// Constraints that others imply, each with those that imply it.
    pub redundant: Vec<(String, Vec<String>)>,
    /// Sets of constraints that cannot all hold, each with its residual, length units.
    pub conflicting: Vec<(Vec<String>, f64)>,
    /// Constraints of frozen points only that do not hold.
    pub unsatisfiable: Vec<Unsatisfiable>,
    /// What the pose is.
    pub pose: PoseClass,
    /// How the pose stands that there is: stalled where solving from there goes on.
    pub status: Status,
    /// Its largest residual, relative to the scene's size.
    pub residual: f64,
    /// The verdict after solving from there, where it is another; all of the above but
    /// `status` and `residual` is of the pose after that.
    pub from_here: Option<FromHere>,
    /// The smallest singular value over the largest, where it says that small errors grow.
    pub near_singular: Option<f64>,
}

/// What solving comes to from a pose that is not solved.
#[derive(Debug, Clone, PartialEq)]
pub struct FromHere {
    /// By how much the worst constraint is missed before, in its own unit, and its name.
    pub as_drawn: String,
    /// How solving ended.
    pub status: Status,
    /// The largest residual then, relative to the scene's size.
    pub residual: f64,
}

/// A constraint of frozen points only that does not hold.
#[derive(Debug, Clone, PartialEq)]
pub struct Unsatisfiable {
    /// Its name.
    pub constraint: String,
    /// Its points.
    pub frozen: Vec<String>,
    /// By how much it is missed, in its own unit.
    pub miss: String,
}

impl Check {
    /// Whether every constraint holds, or does so once it is solved from here.
    pub fn is_sound(&self) -> bool {
        let status = self.from_here.as_ref().map_or(self.status, |after| after.status);
        status == Status::Converged && self.conflicting.is_empty() && self.unsatisfiable.is_empty()
    }

    /// The word for the pose.
    pub const fn pose_word(&self) -> &'static str {
        match self.pose {
            PoseClass::Regular => "regular",
            PoseClass::MobileSingular => "mobile-singular",
            PoseClass::ChangePoint => "change-point",
            PoseClass::Locked => "locked",
        }
    }

    /// The findings as lines of text.
    pub fn lines(&self) -> Vec<String> {
        let mut lines = vec![format!("degrees of freedom: {}", self.degrees_of_freedom)];
        for (name, depends_on) in self.redundant.iter().take(MOST_REDUNDANT) {
            lines.push(match &depends_on[..] {
                [] => format!("redundant: {name}, which holds whatever the pose"),
                others => format!("redundant: {name}, implied by {}", others.join(", ")),
            });
        }
        if let Some(n) = self.redundant.len().checked_sub(MOST_REDUNDANT).filter(|n| *n > 0) {
            lines.push(format!("redundant: {n} more, `why` tells of each"));
        }
        for (names, residual) in &self.conflicting {
            let residual = format_rounded(*residual);
            lines.push(format!("conflicting: {}, off by {residual}", names.join(", ")));
        }
        for Unsatisfiable { constraint, frozen, miss } in &self.unsatisfiable {
            let frozen = listed(frozen, "and");
            lines.push(format!("unsatisfiable: {constraint}, off by {miss}: {frozen} are frozen"));
        }
        lines.push(match (self.pose, self.near_singular) {
            (PoseClass::Regular, None) => "pose: regular".to_owned(),
            (PoseClass::Regular, Some(ratio)) => {
                let growth = format_rounded(1.0 / ratio);
                format!("pose: nearly singular, small errors grow {growth}-fold")
            }
            (PoseClass::MobileSingular, _) => "pose: singular, and truly mobile".to_owned(),
            (PoseClass::ChangePoint, _) => "pose: a change point, where motions cross".to_owned(),
            (PoseClass::Locked, _) => "pose: locked, mobile at the first instant only".to_owned(),
        });
        lines.push(match &self.from_here {
            None => format!(
                "status: {}, residual {}",
                self.status.phrase(),
                format_rounded(self.residual)
            ),
            Some(FromHere { as_drawn, status: Status::Converged, residual }) => {
                let residual = format_rounded(*residual);
                format!("status: as drawn: off by {as_drawn}; solved from here: {residual}")
            }
            Some(FromHere { as_drawn, status, residual }) => format!(
                "status: as drawn: off by {as_drawn}; solved from here: {}, residual {}",
                status.phrase(),
                format_rounded(*residual)
            ),
        });
        lines
    }
}
