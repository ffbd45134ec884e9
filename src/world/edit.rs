//! Edits of a world as data, each with the edit that takes it back.

use std::collections::BTreeMap;

use super::batch::{Batch, BatchRecords};
use super::{
    Clock, ConstraintId, Entity, Ghost, Measure, MeasureId, Motion, NameText, Parameter,
    ParameterId, PointId, PointRecord, Record, Trace, TurnCount, Turning, World,
};
use crate::constraint::Point;

/// One edit, small: a history may hold millions. What is boxed is moved, never copied, so taking
/// an edit back costs no more than making it.
#[derive(Debug, Clone)]
pub enum Edit {
    /// Makes a point, or deletes it.
    Point(PointId, Option<Box<PointRecord>>),
    /// Puts a point somewhere.
    Move(PointId, Point),
    /// Freezes a point, or thaws it.
    Freeze(PointId, bool),
    /// The same, with the constraints that measure the point as they were bound then.
    Refreeze(Box<Refreeze>),
    /// Sets how strongly a point resists being moved.
    Weight(PointId, f64),
    /// Makes a constraint, changes it, or deletes it.
    Constraint(ConstraintId, Option<Box<Record>>),
    /// Switches a constraint on, or off.
    Switch(ConstraintId, bool),
    /// Gives something another name, which is free.
    Rename(Entity, Box<NameText>),
    /// Deletes points and constraints that were made one after the other.
    DeleteBatch(Batch),
    /// Makes them again.
    RestoreBatch(Box<BatchRecords>),
    /// Makes a parameter, changes it, or deletes it.
    Parameter(ParameterId, Option<Box<Parameter>>),
    /// Makes a measure, begins it anew, or deletes it.
    Measure(MeasureId, Option<Box<Measure>>),
    /// Sets the clock.
    Clock(Box<Clock>),
    /// Puts a trace at a place in the list of traces, or takes it out.
    Trace(usize, Option<Box<Trace>>),
    /// Adds a ghost, or takes the last one away.
    Ghost(Option<Box<Ghost>>),
    /// Sets where `reset` puts a point.
    Start(PointId, Point),
    /// Sets the state that `reset` brings back to a constraint.
    StartState(ConstraintId, Option<Box<[f64]>>),
    /// Sets all states that `reset` brings back.
    StartStates(Box<BTreeMap<ConstraintId, Vec<f64>>>),
    /// Begins to count how far something has turned, sets the count, or ends it.
    TurnCount(Box<(Turning, Option<TurnCount>)>),
    /// Sets all that running changes.
    Motion(Box<Motion>),
    /// Puts another world in the place of this one.
    Everything(Box<World>),
}

/// Whether a point is frozen, and how constraints that measure it are bound then: what they are given
/// from outside is as old as the frame that gave it.
#[derive(Debug, Clone)]
pub struct Refreeze {
    /// The point.
    pub point: PointId,
    /// Whether it is frozen.
    pub is_frozen: bool,
    /// The constraints as they are bound.
    pub bound: Vec<(ConstraintId, Record)>,
}

impl Edit {
    /// Whether it changes what there is, and not only where it is, when, or how it is shown.
    pub(super) const fn is_structural(&self) -> bool {
        match self {
            Self::Point(..)
            | Self::Freeze(..)
            | Self::Refreeze(_)
            | Self::Weight(..)
            | Self::Constraint(..)
            | Self::Switch(..)
            | Self::Rename(..)
            | Self::DeleteBatch(_)
            | Self::RestoreBatch(_)
            | Self::Parameter(..)
            | Self::Measure(..)
            | Self::Everything(_) => true,
            Self::Move(..)
            | Self::Clock(_)
            | Self::Trace(..)
            | Self::Ghost(_)
            | Self::Start(..)
            | Self::StartState(..)
            | Self::StartStates(_)
            | Self::TurnCount(_)
            | Self::Motion(_) => false,
        }
    }
}

impl Edit {
    /// Roughly how many bytes it holds, but for itself.
    pub fn n_bytes(&self) -> usize {
        match self {
            Self::Point(_, Some(record)) => size_of_val(&**record),
            Self::Refreeze(it) => {
                let records = it.bound.iter().map(|(_, record)| record.n_bytes());
                size_of_val(&**it) + records.sum::<usize>()
            }
            Self::Constraint(_, Some(record)) => record.n_bytes(),
            Self::RestoreBatch(records) => records.n_bytes(),
            Self::Rename(_, name) => name.n_bytes(),
            Self::Parameter(_, Some(parameter)) => parameter.n_bytes(),
            Self::Measure(_, Some(measure)) => measure.n_bytes(),
            Self::Clock(clock) => size_of_val(&**clock),
            Self::Trace(_, Some(trace)) => size_of_val(&**trace) + trace.samples.n_bytes(),
            Self::Ghost(Some(ghost)) => ghost.n_bytes(),
            Self::StartState(_, Some(state)) => size_of_val(&**state),
            Self::StartStates(states) => 80 * states.len(),
            Self::TurnCount(count) => size_of_val(&**count),
            Self::Motion(motion) => motion.n_bytes(),
            Self::Everything(world) => world.n_bytes(),
            Self::Point(_, None)
            | Self::Move(..)
            | Self::Freeze(..)
            | Self::Weight(..)
            | Self::Constraint(_, None)
            | Self::Switch(..)
            | Self::DeleteBatch(_)
            | Self::Parameter(_, None)
            | Self::Measure(_, None)
            | Self::Trace(_, None)
            | Self::Ghost(None)
            | Self::Start(..)
            | Self::StartState(_, None) => 0,
        }
    }

    /// Roughly how many things it goes through.
    pub fn n_things(&self) -> usize {
        match self {
            Self::DeleteBatch(batch) => batch.len(),
            Self::RestoreBatch(records) => records.len(),
            Self::Motion(motion) => motion.n_things(),
            Self::StartStates(states) => states.len(),
            _ => 1,
        }
    }

    /// What an edit that deletes points or constraints deletes.
    fn deletes(&self) -> Option<Batch> {
        let mut batch = Batch::default();
        match self {
            Self::Point(id, None) => batch.points.extend(id.0),
            Self::Constraint(id, None) => batch.constraints.extend(id.0),
            Self::DeleteBatch(batch) => return Some(*batch),
            _ => return None,
        };
        Some(batch)
    }

    /// Takes in what deletes the point or constraint that was made right after those this one
    /// deletes; false if that is not what `next` does.
    pub fn absorb(&mut self, next: &Self) -> bool {
        let Some(mut batch) = self.deletes() else { return false };
        let fits = match next {
            Self::Point(id, None) => batch.points.extend(id.0),
            Self::Constraint(id, None) => batch.constraints.extend(id.0),
            _ => false,
        };
        if fits {
            *self = Self::DeleteBatch(batch);
        }
        fits
    }
}
