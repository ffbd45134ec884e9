//! Time going on: what a frame advances, and all that running changes as one piece of data.

use std::collections::BTreeMap;

use super::trace::Tail;
use super::{Clock, ConstraintId, Edit, Ghost, Sample, World};
use crate::constraint::{Constraint, Point, Relation};
use crate::diag::Diagnostic;

/// All that running changes: positions, clock, states of motors and wheels, traces, ghosts.
/// One of these takes a whole run back, however many frames it had.
#[derive(Debug, Clone)]
pub struct Motion {
    at: Vec<Point>,
    start: Vec<Point>,
    start_states: BTreeMap<ConstraintId, Vec<f64>>,
    clock: Clock,
    states: BTreeMap<ConstraintId, Vec<f64>>,
    /// Constraints with live values, which a frame sets: whole.
    driven: Vec<(ConstraintId, Constraint)>,
    traces: Vec<Tail<Sample>>,
    ghosts: Tail<Ghost>,
}

impl Motion {
    /// Roughly how many bytes it holds.
    pub fn n_bytes(&self) -> usize {
        size_of_val(&*self.at)
            + size_of_val(&*self.start)
            + size_of_val(&*self.driven)
            + 80 * self.states.len()
    }
}

impl World {
    /// All that running changes, as it is now.
    pub fn motion(&self) -> Motion {
        let (traces, ghosts) = self.tails();
        Motion {
            at: self.points.at.clone(),
            start: self.points.start.clone(),
            start_states: self.start_states.clone(),
            clock: self.clock,
            states: self.states(),
            driven: self.driven(),
            traces,
            ghosts,
        }
    }

    /// The states of all constraints that running changes.
    fn states(&self) -> BTreeMap<ConstraintId, Vec<f64>> {
        self.constraints().filter_map(|(id, r)| Some((id, r.constraint.state()?))).collect()
    }

    /// All constraints with live values, whole.
    fn driven(&self) -> Vec<(ConstraintId, Constraint)> {
        let driven = self.constraints().filter(|(_, r)| !r.drivers.is_empty());
        driven.map(|(id, r)| (id, r.constraint.clone())).collect()
    }

    pub(super) fn swap_motion(&mut self, motion: Motion) -> Motion {
        let (states, driven) = (self.states(), self.driven());
        for (id, constraint) in motion.driven {
            if let Some(record) = self.constraints.get_mut(id.idx()) {
                record.constraint = constraint;
            }
        }
        for (id, state) in &motion.states {
            self.restore_state(*id, state);
        }
        let mut traces: Vec<Tail<Sample>> = motion.traces;
        for (trace, tail) in self.traces.iter_mut().zip(&mut traces) {
            let wanted = std::mem::replace(tail, Tail::cleared());
            *tail = wanted.swap(&mut trace.samples);
        }
        let old = Motion {
            at: std::mem::replace(&mut self.points.at, motion.at),
            start: std::mem::replace(&mut self.points.start, motion.start),
            start_states: std::mem::replace(&mut self.start_states, motion.start_states),
            clock: std::mem::replace(&mut self.clock, motion.clock),
            states,
            driven,
            traces,
            ghosts: motion.ghosts.swap(&mut self.ghosts),
        };
        self.touched.all = true;
        self.live.note_change();
        old
    }

    fn restore_state(&mut self, id: ConstraintId, state: &[f64]) {
        if let Some(record) = self.constraints.get_mut(id.idx()) {
            record.constraint.set_state(state);
        }
    }

    /// The motion that brings back the start: time 0, every point where it stood when the
    /// clock left 0, empty traces and no ghosts. Live values are those of now: call
    /// [`World::refresh`] after.
    pub fn start(&self) -> Motion {
        let mut motion = self.motion();
        if self.clock.frame > 0 {
            motion.at.clone_from(&self.points.start);
            motion.states.clone_from(&self.start_states);
        }
        motion.clock = self.clock.at_start();
        motion.traces.iter_mut().for_each(|tail| *tail = Tail::cleared());
        motion.ghosts = Tail::cleared();
        motion
    }

    /// Goes one frame on: the clock ticks, live expressions are evaluated anew, motors turn.
    /// The points stay for the solver to move.
    ///
    /// # Errors
    /// A live expression that has no value at this time; the world is then to be taken back.
    pub fn advance(&mut self) -> Result<(), Diagnostic> {
        if self.clock.frame == 0 {
            self.points.start.clone_from(&self.points.at);
            self.start_states = self.states();
        }
        self.clock.tick();
        self.refresh()?;
        let dt = self.clock.dt;
        for k in 0..self.live.motors().len() {
            let id = self.live.motors()[k];
            if self.constraint_state_mut(id).advance(dt) {
                self.touched.values.push(id);
            }
        }
        Ok(())
    }

    /// Keeps the places of traced points, for the traces that are due at this frame.
    pub fn sample_traces(&mut self, missed: bool) {
        let frame = self.clock.frame;
        for trace in &mut self.traces {
            if frame.is_multiple_of(trace.every) {
                trace.samples.push(Sample { at: self.points.at[trace.point.idx()], missed });
            }
        }
    }

    /// The edit that keeps a ghost of the mechanism as it stands.
    pub fn expose(&self) -> Edit {
        let at = self.points.ids().map(|id| (id, self.points.at(id))).collect();
        Edit::Ghost(Some(Box::new(Ghost { at })))
    }

    /// What `reset` brings back to a constraint that is made while the clock is running.
    pub(super) fn note_start_state(&mut self, id: ConstraintId) {
        if self.clock.frame > 0
            && !self.start_states.contains_key(&id)
            && let Some(state) = self.constraints.get(id.idx()).and_then(|r| r.constraint.state())
        {
            self.start_states.insert(id, state);
        }
    }

    /// The states that `reset` brings back.
    pub fn start_states(&self) -> &BTreeMap<ConstraintId, Vec<f64>> {
        &self.start_states
    }
}
