//! What running changes, as it was before a command changed it first: what it takes to go back is as
//! much as what was touched, however large the scene.

use std::sync::Arc;

use super::marks::Marks;
use super::repeated::Repeated;
use super::same::States;
use super::tally::TallyMark;
use super::trace::Tail;
use super::turning::TurnCounts;
use super::{Clock, ConstraintId, Ghost, MeasureId, PointId, SampleList};
use crate::constraint::{Constraint, Heading, Point};

/// Where points were, one behind the other.
pub(crate) type Places = Arc<Vec<Point>>;

/// What takes back all that running changed since a moment, and does it again: of points, motors
/// and constraints those that changed, as they were.
#[derive(Debug, Clone)]
pub struct Motion {
    pub(super) points: Repeated<PointId>,
    pub(super) at: Places,
    /// Motors of which nothing changed but how far they have turned.
    pub(super) motors: Repeated<ConstraintId>,
    pub(super) headings: Vec<Heading>,
    /// Constraints that changed in another way, whole.
    pub(super) constraints: Vec<(ConstraintId, Constraint)>,
    /// What `reset` brings back, where that changed.
    pub(super) start: Option<Box<Start>>,
    pub(super) clock: Clock,
    /// None if nothing was counted.
    pub(super) turn_counts: Option<TurnCounts>,
    pub(super) traces: Vec<Tail<SampleList>>,
    pub(super) tallies: Vec<(MeasureId, TallyMark)>,
    pub(super) ghosts: Tail<Vec<Ghost>>,
}

/// What `reset` brings back.
#[derive(Debug, Clone)]
pub(super) struct Start {
    pub at: Vec<Point>,
    pub states: States,
}

impl Motion {
    /// Roughly how many things it puts back.
    pub fn n_things(&self) -> usize {
        self.points.len() + self.motors.len() + self.constraints.len()
    }

    /// Roughly how many bytes it holds.
    pub fn n_bytes(&self) -> usize {
        let Self { points, at, motors, headings, constraints, start, turn_counts, .. } = self;
        let traces: usize = self.traces.iter().map(|tail| tail.then().n_bytes()).sum();
        let measured = self.tallies.iter().map(|(_, mark)| mark.n_bytes()).sum::<usize>();
        let exposed = self.ghosts.then().iter().map(Ghost::n_bytes).sum::<usize>();
        size_of::<Self>()
            + points.n_bytes()
            + size_of_val(&***at)
            + motors.n_bytes()
            + size_of_val(&**headings)
            + size_of_val(&**constraints)
            + start.as_ref().map_or(0, |s| size_of_val(&*s.at) + 80 * s.states.len())
            + turn_counts.as_ref().map_or(0, |counts| 80 * counts.len())
            + size_of_val(&*self.traces)
            + traces
            + size_of_val(&*self.tallies)
            + measured
            + exposed
    }

    /// Whether paths, ghosts or values of measures come back with it.
    pub fn has_paths(&self) -> bool {
        let mut traces = self.traces.iter();
        traces.any(|tail| !tail.then().is_empty())
            || !self.ghosts.then().is_empty()
            || self.tallies.iter().any(|(_, mark)| mark.has_readings())
    }

    /// Where the points were; none where none moved.
    pub(crate) fn places(&self) -> Option<&Places> {
        (!self.at.is_empty()).then_some(&self.at)
    }
}

/// What was noted since it was asked for.
#[derive(Debug, Default)]
pub(super) struct Log {
    /// All of it; none while nobody asks.
    pub motion: Option<Box<Motion>>,
    /// Where the points of the motion are, while they are noted.
    pub at: Vec<Point>,
    pub points: Marks,
    /// Where in the motion the place of a point is, where it was noted last.
    pub places: Vec<u32>,
    pub constraints: Marks,
    pub headings: Marks,
    /// Where in the motion the heading of a motor is, where it was noted.
    pub heading_places: Vec<u32>,
    /// The points that moved last, and the motors that turned: often the same do again.
    pub last: (Repeated<PointId>, Repeated<ConstraintId>),
    /// Whether the headings of all motors that are running now are noted.
    pub has_headings: bool,
}

impl Log {
    /// Whether anything is noted now.
    pub const fn is_on(&self) -> bool {
        self.motion.is_some()
    }
}

/// A copy of a world notes nothing until it is asked to.
impl Clone for Log {
    fn clone(&self) -> Self {
        Self::default()
    }
}

impl Log {
    /// Other motors may be running from here on.
    pub fn note_motor_lists(&mut self) {
        self.has_headings = false;
    }
}
