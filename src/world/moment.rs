//! All that running changes at one moment, of the whole scene: where a motion that is to be done again
//! began, and what `reset` goes back to.

use super::log::Motion;
use super::motion::{restore_whole, whole_state};
use super::same::{States, bits, is_same_constraint, same_place};
use super::tally::TallyMark;
use super::trace::Tail;
use super::turning::{TurnCounts, TurnsAhead};
use super::{Clock, ConstraintId, Ghost, MeasureId, PointId, SampleList, World};
use crate::constraint::{Constraint, Field, Point};

/// All that running changes: positions, clock, motors and wheels, traces, ghosts.
#[derive(Debug, Clone)]
pub struct Moment {
    at: Vec<Point>,
    start: Vec<Point>,
    start_states: States,
    clock: Clock,
    turn_counts: TurnCounts,
    /// Constraints that running changes, whole.
    constraints: Vec<(ConstraintId, Constraint)>,
    /// States that these are to have instead.
    states: States,
    traces: Vec<Tail<SampleList>>,
    tallies: Vec<(MeasureId, TallyMark)>,
    ghosts: Tail<Vec<Ghost>>,
}

impl World {
    /// All that running changes, as it is now.
    pub fn moment(&self) -> Moment {
        let (traces, ghosts) = self.tails();
        let changing = self
            .constraints()
            .filter(|(_, record)| !record.live().is_empty() || record.constraint.state().is_some());
        Moment {
            at: self.points.at.clone(),
            start: self.points.start.clone(),
            start_states: self.start_states.clone(),
            clock: self.clock,
            turn_counts: self.turn_counts.clone(),
            constraints: changing.map(|(id, record)| (id, record.constraint.clone())).collect(),
            states: States::new(),
            traces,
            tallies: self.tally_marks(),
            ghosts,
        }
    }

    /// The moment at the start: time 0, every point where it stood when the clock left 0, empty
    /// traces and measures and no ghosts. Live values are those of now: call [`World::refresh`] after.
    pub fn start(&self) -> Moment {
        let mut moment = self.moment();
        if self.clock.frame > 0 {
            moment.at.clone_from(&moment.start);
            moment.states = self.start_states.clone();
            moment.turn_counts = self.turn_counts_at_start();
        }
        moment.clock = self.clock.at_start();
        // What is as long as it will be is no part of a run.
        for (trace, tail) in self.traces.iter().zip(&mut moment.traces) {
            if !trace.is_ended {
                *tail = Tail::cleared();
            }
        }
        moment.tallies.iter_mut().for_each(|(_, mark)| *mark = TallyMark::empty());
        moment.ghosts = Tail::cleared();
        moment
    }

    /// Puts everything as it was at a moment, since which the structure is the same; gives what of it
    /// no one notes: clock, counts, and the ends of paths and ghosts.
    pub fn go_to(&mut self, moment: Moment) -> Motion {
        let mut before = self.bare_motion();
        for (k, at) in moment.at.iter().enumerate() {
            if !same_place(&self.points.at[k], at) {
                self.note_place(PointId::new(k));
                self.points.at[k] = *at;
            }
        }
        for (id, constraint) in moment.constraints {
            if self
                .constraint(id)
                .is_some_and(|now| !is_same_constraint(&now.constraint, &constraint))
            {
                *self.constraint_state_mut(id) = constraint;
            }
        }
        for (id, state) in &moment.states {
            self.restore_state(*id, state);
        }
        self.note_start();
        self.points.start[..moment.start.len()].copy_from_slice(&moment.start);
        self.start_states = moment.start_states;
        self.clock = moment.clock;
        self.turn_counts = moment.turn_counts;
        let lists = self.traces.iter_mut().zip(moment.traces);
        before.traces = lists.map(|(trace, tail)| tail.swap(&mut trace.samples)).collect();
        before.tallies = self.swap_tallies(moment.tallies);
        before.ghosts = moment.ghosts.swap(&mut self.ghosts);
        self.turns_ahead = TurnsAhead::default();
        self.touched.all = true;
        self.dependencies.note_change();
        before
    }

    fn restore_state(&mut self, id: ConstraintId, state: &[f64]) {
        let Some(record) = self.constraints.get(id.idx()) else { return };
        if whole_state(&record.constraint).is_some_and(|now| bits(&now) == bits(state)) {
            return;
        }
        let is_live = record
            .drivers()
            .iter()
            .any(|(field, _)| field.is_of_gearing() || *field == Field::Radius);
        restore_whole(self.constraint_state_mut(id), state, is_live);
    }
}
