//! Time going on: what a frame advances, and all that running changes as one piece of data.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::dependencies::Ramp;
use super::environments::Within;
use super::quadrature::mean;
use super::same::{States, are_same_places, are_same_states};
use super::trace::Tail;
use super::turning::{TurnCounts, TurnsAhead, are_same_counts};
use super::{Clock, ConstraintId, Ghost, Sample, World};
use crate::constraint::{Constraint, ConstraintKind, Field, Point};
use crate::diag::Diagnostic;

/// All that running changes: positions, clock, states of motors and wheels, traces, ghosts.
/// One of these takes a whole run back, however many frames it had. Copies share what is large.
#[derive(Debug, Clone)]
pub struct Motion {
    at: Arc<Vec<Point>>,
    start: Arc<Vec<Point>>,
    start_states: Arc<States>,
    clock: Clock,
    turn_counts: Arc<TurnCounts>,
    states: Arc<States>,
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
    /// The traces and ghosts as they are, for a motion to go back to.
    fn tails(&self) -> (Vec<Tail<Sample>>, Tail<Ghost>) {
        (self.traces.iter().map(|t| Tail::mark(&t.samples)).collect(), Tail::mark(&self.ghosts))
    }

    /// All that running changes, as it is now.
    pub fn motion(&self) -> Motion {
        let (traces, ghosts) = self.tails();
        let at = Arc::new(self.points.at.clone());
        let is_at_start = are_same_places(&self.points.start, &self.points.at);
        let start = if is_at_start { at.clone() } else { Arc::new(self.points.start.clone()) };
        Motion {
            at,
            start,
            start_states: Arc::new(self.start_states.clone()),
            clock: self.clock,
            turn_counts: Arc::new(self.turn_counts.clone()),
            states: Arc::new(self.states()),
            driven: self.driven(),
            traces,
            ghosts,
        }
    }

    /// The same, sharing with an earlier one what did not change since.
    pub fn motion_since(&self, earlier: &Motion) -> Motion {
        let mut motion = self.motion();
        share(&mut motion.at, &earlier.at, are_same_places);
        share(&mut motion.start, &earlier.start, are_same_places);
        share(&mut motion.start_states, &earlier.start_states, are_same_states);
        share(&mut motion.states, &earlier.states, are_same_states);
        motion
    }

    /// Whether this is the motion there is.
    pub(super) fn is_at(&self, motion: &Motion) -> bool {
        let traces = self.traces.iter().zip(&motion.traces);
        self.clock == motion.clock
            && are_same_places(&self.points.at, &motion.at)
            && are_same_places(&self.points.start, &motion.start)
            && are_same_states(&self.start_states, &motion.start_states)
            && are_same_states(&self.states(), &motion.states)
            && are_same_counts(&self.turn_counts, &motion.turn_counts)
            && self.driven() == motion.driven
            && self.traces.len() == motion.traces.len()
            && traces.into_iter().all(|(trace, tail)| tail.is_all_of(&trace.samples))
            && motion.ghosts.is_all_of(&self.ghosts)
    }

    /// The states of all constraints that running changes.
    fn states(&self) -> States {
        self.constraints().filter_map(|(id, r)| Some((id, whole_state(&r.constraint)?))).collect()
    }

    /// All constraints with live values, whole.
    fn driven(&self) -> Vec<(ConstraintId, Constraint)> {
        let driven = self.constraints().filter(|(_, r)| !r.live().is_empty());
        driven.map(|(id, r)| (id, r.constraint.clone())).collect()
    }

    pub(super) fn swap_motion(&mut self, motion: Motion) -> Motion {
        let (states, driven) = (self.states(), self.driven());
        for (id, constraint) in motion.driven {
            if let Some(record) = self.constraints.get_mut(id.idx()) {
                record.constraint = constraint;
            }
        }
        for (id, state) in &*motion.states {
            self.restore_state(*id, state);
        }
        let mut traces: Vec<Tail<Sample>> = motion.traces;
        for (trace, tail) in self.traces.iter_mut().zip(&mut traces) {
            let wanted = std::mem::replace(tail, Tail::cleared());
            *tail = wanted.swap(&mut trace.samples);
        }
        let old = Motion {
            at: exchange(&mut self.points.at, motion.at),
            start: exchange(&mut self.points.start, motion.start),
            start_states: exchange(&mut self.start_states, motion.start_states),
            clock: std::mem::replace(&mut self.clock, motion.clock),
            turn_counts: exchange(&mut self.turn_counts, motion.turn_counts),
            states: Arc::new(states),
            driven,
            traces,
            ghosts: motion.ghosts.swap(&mut self.ghosts),
        };
        self.turns_ahead = TurnsAhead::default();
        self.touched.all = true;
        self.dependencies.note_change();
        old
    }

    fn restore_state(&mut self, id: ConstraintId, state: &[f64]) {
        let Some(record) = self.constraints.get_mut(id.idx()) else { return };
        let is_live = record
            .drivers()
            .iter()
            .any(|(field, _)| field.is_of_gearing() || *field == Field::Radius);
        restore_whole(&mut record.constraint, state, is_live);
    }

    /// The motion that brings back the start: time 0, every point where it stood when the
    /// clock left 0, empty traces and no ghosts. Live values are those of now: call
    /// [`World::refresh`] after.
    pub fn start(&self) -> Motion {
        let mut motion = self.motion();
        if self.clock.frame > 0 {
            motion.at = motion.start.clone();
            motion.states = motion.start_states.clone();
            motion.turn_counts = Arc::new(self.turn_counts_at_start());
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
            self.note_first_turns();
        }
        let before = self.angles_before();
        self.clock.tick();
        self.refresh()?;
        let dt = self.clock.dt;
        for k in 0..self.dependencies.motors().len() {
            let id = self.dependencies.motors()[k];
            if self.constraint_state_mut(id).advance(dt) {
                self.touched.values.push(id);
            }
        }
        if !self.dependencies.ramps().is_empty() {
            self.advance_ramps()?;
        }
        self.note_turns(&before);
        self.refresh_turned()
    }

    /// Turns the motors whose speed changes within the frame that the clock has just made: by the
    /// integral of their speed over it.
    fn advance_ramps(&mut self) -> Result<(), Diagnostic> {
        let dt = self.clock.dt;
        let begin = Clock { frame: self.clock.frame - 1, ..self.clock }.time();
        let grain = f64::EPSILON * self.clock.time().abs() / dt;
        for k in 0..self.dependencies.ramps().len() {
            let Ramp { motor, ref speed, ref parameters } = self.dependencies.ramps()[k];
            let mut within = Within::new(self);
            let mean_speed = mean(grain, |share| {
                within.go_to(share.mul_add(dt, begin), parameters)?;
                Ok(speed.evaluate(&within)?.number())
            })?;
            let constraint = self.constraint_state_mut(motor);
            if let Constraint::Motor(motor) = constraint.stated_mut() {
                motor.set_mean_speed(mean_speed);
            }
            if constraint.advance(dt) {
                self.touched.values.push(motor);
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

    /// The angle with whole turns that `reset` brings back to a motor; none if it has none.
    pub(super) fn motor_angle_at_start(&self, id: ConstraintId) -> Option<f64> {
        let mut constraint = self.constraint(id)?.constraint.clone();
        restore_whole(&mut constraint, self.start_states.get(&id)?, false);
        match constraint {
            Constraint::Motor(motor) => Some(motor.total()),
            _ => None,
        }
    }

    /// What `reset` brings back to a constraint that is made while the clock is running.
    pub(super) fn note_start_state(&mut self, id: ConstraintId) {
        if self.clock.frame > 0
            && !self.start_states.contains_key(&id)
            && let Some(record) = self.constraints.get(id.idx())
            && let Some(state) = whole_state(&record.constraint)
        {
            self.start_states.insert(id, state);
        }
    }

    /// The states that `reset` brings back.
    pub fn start_states(&self) -> &BTreeMap<ConstraintId, Vec<f64>> {
        &self.start_states
    }
}

/// The state of a constraint, then how wheels meshed for it and their ratio: `reset` undoes
/// what a gear change or switching on made of the mesh.
pub(super) fn whole_state(constraint: &Constraint) -> Option<Vec<f64>> {
    let mut whole = constraint.state()?;
    whole.extend(constraint.captured());
    whole.extend(constraint.get(Field::Ratio));
    Some(whole)
}

/// Brings back what [`whole_state`] gave, or a state alone. Another ratio or radius than then stays, as if
/// it had been changed then; a live one is about to be evaluated.
fn restore_whole(constraint: &mut Constraint, whole: &[f64], is_live: bool) {
    let n_state = constraint.state().map_or(0, |state| state.len());
    let n_mesh = constraint.captured().len();
    if whole.len() < n_state + n_mesh || n_mesh == 0 {
        return constraint.set_state(&whole[..n_state.min(whole.len())]);
    }
    let (state, rest) = whole.split_at(n_state);
    let (mesh, ratio) = rest.split_at(n_mesh);
    let mut then = constraint.clone();
    // Of a wheel on a rack the radius, which is among what is captured.
    let is_geared = constraint.get(Field::Ratio).is_some();
    let field = if is_geared { Field::Ratio } else { Field::Radius };
    let now = constraint.get(field);
    if let &[ratio] = ratio {
        then.set(Field::Ratio, ratio);
    }
    then.set_captured(mesh);
    then.set_state(state);
    match now {
        // A ratio that is said by numbers of teeth goes on being said so.
        Some(now) if !is_live || constraint.get(Field::FirstTeeth).is_some() => {
            then.set(field, now);
            constraint.set_captured(&then.captured());
            constraint.set_state(&then.state().unwrap_or_default());
        }
        _ => *constraint = then,
    }
}

/// Puts `new` in a place; gives what was there.
fn exchange<T: Clone>(place: &mut T, new: Arc<T>) -> Arc<T> {
    Arc::new(std::mem::replace(place, Arc::unwrap_or_clone(new)))
}

/// Gives up a copy for what it is equal to by this measure.
fn share<T>(copy: &mut Arc<T>, with: &Arc<T>, is_same: impl Fn(&T, &T) -> bool) {
    if is_same(copy, with) {
        copy.clone_from(with);
    }
}
