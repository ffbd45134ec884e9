//! Time going on: what a frame advances, and what takes back all that running changed.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::dependencies::Ramp;
use super::environments::Within;
use super::log::{Motion, Places};
use super::quadrature::mean;
use super::repeated::Repeated;
use super::same::{are_same_places, are_same_states, is_same_constraint, same_place};
use super::tally::TallyMark;
use super::trace::Tail;
use super::turning::{TurnCounts, TurnsAhead, are_same_counts};
use super::{Clock, ConstraintId, Ghost, MeasureId, Sample, SampleList, World};
use crate::constraint::{Constraint, ConstraintKind, Field, Heading, Point};
use crate::diag::Diagnostic;

impl World {
    /// The traces and ghosts as they are, to go back to.
    pub(super) fn tails(&self) -> (Vec<Tail<SampleList>>, Tail<Vec<Ghost>>) {
        (self.traces.iter().map(|t| Tail::mark(&t.samples)).collect(), Tail::mark(&self.ghosts))
    }

    /// The values of measures as they are, to go back to.
    pub(super) fn tally_marks(&self) -> Vec<(MeasureId, TallyMark)> {
        self.measures().map(|(id, measure)| (id, measure.tally.mark())).collect()
    }

    /// Puts the values of measures back as they were; gives what takes that back.
    pub(super) fn swap_tallies(
        &mut self,
        marks: Vec<(MeasureId, TallyMark)>,
    ) -> Vec<(MeasureId, TallyMark)> {
        let swap = |(id, mark): (MeasureId, TallyMark)| {
            let measure = self.measures.get_mut(id.idx())?;
            Some((id, measure.tally.swap(mark)))
        };
        marks.into_iter().filter_map(swap).collect()
    }

    /// What brings the present back while nothing has changed.
    pub(super) fn bare_motion(&self) -> Motion {
        let (traces, ghosts) = self.tails();
        Motion {
            points: Repeated::default(),
            at: Places::default(),
            motors: Repeated::default(),
            headings: Vec::new(),
            constraints: Vec::new(),
            start: None,
            clock: self.clock,
            turn_counts: (!self.turn_counts.is_empty()).then(|| self.turn_counts.clone()),
            traces,
            tallies: self.tally_marks(),
            ghosts,
        }
    }

    /// Whether a motion would leave everything as it is.
    pub(super) fn is_at(&self, motion: &Motion) -> bool {
        let mut places = motion.points.iter().zip(&*motion.at);
        let mut motors = motion.motors.iter().zip(&motion.headings);
        let mut traces = self.traces.iter().zip(&motion.traces);
        let constraint = |id: &ConstraintId| self.constraint(*id).map(|record| &record.constraint);
        let has_turned_so = |motor: Option<&Constraint>, then: Heading| {
            motor.and_then(heading).is_some_and(|now| now.is_same(then))
        };
        self.clock == motion.clock
            && places.all(|(id, at)| same_place(&self.points.at[id.idx()], at))
            && motors.all(|(id, heading)| has_turned_so(constraint(id), *heading))
            && motion
                .constraints
                .iter()
                .all(|(id, then)| constraint(id).is_some_and(|now| is_same_constraint(now, then)))
            && motion.start.as_ref().is_none_or(|start| {
                are_same_places(&self.points.start, &start.at)
                    && are_same_states(&self.start_states, &start.states)
            })
            && are_same_counts(
                &self.turn_counts,
                motion.turn_counts.as_ref().unwrap_or(&TurnCounts::new()),
            )
            && self.traces.len() == motion.traces.len()
            && traces.all(|(trace, tail)| tail.is_all_of(&trace.samples))
            && motion.tallies.iter().all(|(id, mark)| {
                self.measure(*id).is_some_and(|measure| measure.tally.is_at(mark))
            })
            && motion.ghosts.is_all_of(&self.ghosts)
    }

    /// Puts everything back as a motion has it; gives the motion that takes this back.
    pub(super) fn swap_motion(&mut self, mut motion: Motion) -> Motion {
        for (id, at) in motion.points.iter().zip(Arc::make_mut(&mut motion.at)) {
            std::mem::swap(&mut self.points.at[id.idx()], at);
            // Those that constraints may move the solver knows of itself.
            if self.points.is_frozen[id.idx()] {
                self.touched.moved.push(*id);
            }
        }
        for (id, constraint) in &mut motion.constraints {
            if let Some(record) = self.constraints.get_mut(id.idx()) {
                std::mem::swap(&mut record.constraint, constraint);
                self.touched.constraints.push(*id);
            }
        }
        for (id, heading) in motion.motors.iter().zip(&mut motion.headings) {
            if let Some(record) = self.constraints.get_mut(id.idx()) {
                swap_heading(&mut record.constraint, heading);
                self.touched.values.push(*id);
            }
        }
        if let Some(start) = &mut motion.start {
            std::mem::swap(&mut self.points.start, &mut start.at);
            std::mem::swap(&mut self.start_states, &mut start.states);
            if self.points.start.len() < self.points.at.len() {
                // Those that were made since live no more.
                self.points.start.resize(self.points.at.len(), Point::ORIGIN);
            }
        }
        std::mem::swap(&mut self.clock, &mut motion.clock);
        if let Some(counts) = &mut motion.turn_counts {
            std::mem::swap(&mut self.turn_counts, counts);
        }
        for (trace, tail) in self.traces.iter_mut().zip(&mut motion.traces) {
            let wanted = std::mem::replace(tail, Tail::cleared());
            *tail = wanted.swap(&mut trace.samples);
        }
        motion.tallies = self.swap_tallies(motion.tallies);
        motion.ghosts = motion.ghosts.swap(&mut self.ghosts);
        self.turns_ahead = TurnsAhead::default();
        self.dependencies.note_change();
        motion
    }

    /// Goes one frame on: the clock ticks, live expressions are evaluated anew, motors turn.
    /// The points stay for the solver to move.
    ///
    /// # Errors
    /// A live expression that has no value at this time; the world is then to be taken back.
    pub fn advance(&mut self) -> Result<(), Diagnostic> {
        if self.clock.frame == 0 {
            self.note_start();
            self.points.start.clone_from(&self.points.at);
            let states = self.constraints();
            let states = states.filter_map(|(id, r)| Some((id, whole_state(&r.constraint)?)));
            self.start_states = states.collect();
            self.note_first_turns();
        }
        let before = self.angles_before();
        self.clock.tick();
        self.refresh()?;
        let dt = self.clock.dt;
        self.note_headings();
        for k in 0..self.dependencies.motors().len() {
            let id = self.dependencies.motors()[k];
            let record = self.constraints.get_mut(id.idx()).expect("a listed constraint lives");
            if record.constraint.advance(dt) {
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
            if frame.is_multiple_of(trace.every) && !trace.is_ended {
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
            self.note_start();
            self.start_states.insert(id, state);
        }
    }

    /// The states that `reset` brings back.
    pub fn start_states(&self) -> &BTreeMap<ConstraintId, Vec<f64>> {
        &self.start_states
    }
}

/// How far a motor has turned; none if its angle is measured on the pose, or it is none.
pub(super) fn heading(constraint: &Constraint) -> Option<Heading> {
    match constraint {
        Constraint::Motor(motor) => Some(motor.heading()),
        _ => None,
    }
}

/// Exchanges how far a motor has turned.
pub(super) fn swap_heading(constraint: &mut Constraint, other: &mut Heading) {
    if let Constraint::Motor(motor) = constraint {
        let now = motor.heading();
        motor.set_heading(std::mem::replace(other, now));
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
pub(super) fn restore_whole(constraint: &mut Constraint, whole: &[f64], is_live: bool) {
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
