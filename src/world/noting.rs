//! Notes, while a command is under way, what running changes as it was before it changes first.

use std::sync::Arc;

use super::log::{Log, Start};
use super::motion::{heading, swap_heading};
use super::repeated::Repeated;
use super::{ConstraintId, Motion, PointId, World};

impl World {
    /// From here on what running changes is noted as it is now, as soon as it is about to change.
    pub fn begin_motion(&mut self) {
        let mut motion = Box::new(self.bare_motion());
        let log = &mut self.log;
        // As much as moved last often moves again.
        let (points, motors) = &log.last;
        motion.points = Repeated::beside(points);
        motion.motors = Repeated::beside(motors);
        log.at = Vec::with_capacity(points.len());
        motion.headings.reserve_exact(motors.len());
        log.points.begin();
        log.constraints.begin();
        log.headings.begin();
        log.has_headings = false;
        log.motion = Some(motion);
    }

    /// What brings back all that running changed since [`begin_motion`](Self::begin_motion).
    pub fn end_motion(&mut self) -> Option<Box<Motion>> {
        let mut motion = self.log.motion.take()?;
        motion.points.shrink_to_fit();
        motion.motors.shrink_to_fit();
        motion.headings.shrink_to_fit();
        motion.constraints.shrink_to_fit();
        let mut at = std::mem::take(&mut self.log.at);
        at.shrink_to_fit();
        motion.at = Arc::new(at);
        self.log.last = (motion.points.clone(), motion.motors.clone());
        Some(motion)
    }

    /// Where among the places that a command noted that of a point is, if the last one that moved it
    /// was the last that moved any.
    pub(crate) fn noted_place(&self, id: PointId) -> usize {
        self.log.places.get(id.idx()).map_or(usize::MAX, |place| *place as usize)
    }

    /// A point is about to be put elsewhere.
    #[inline]
    pub(super) fn note_place(&mut self, id: PointId) {
        let Log { motion: Some(motion), at, points, places, .. } = &mut self.log else { return };
        if points.mark(id.idx()) {
            if id.idx() >= places.len() {
                places.resize(id.idx() + 1, u32::MAX);
            }
            places[id.idx()] = at.len() as u32;
            motion.points.push(id);
            at.push(self.points.at[id.idx()]);
        }
    }

    /// A constraint is about to change.
    #[inline]
    pub(super) fn note_constraint(&mut self, id: ConstraintId) {
        if self.log.motion.is_some() && self.log.constraints.mark(id.idx()) {
            self.keep_constraint(id);
        }
    }

    fn keep_constraint(&mut self, id: ConstraintId) {
        let (Some(motion), Some(record)) = (&mut self.log.motion, self.constraints.get(id.idx()))
        else {
            return;
        };
        let mut constraint = record.constraint.clone();
        if !self.log.headings.mark(id.idx())
            && let Some(&k) = self.log.heading_places.get(id.idx())
            && motion.motors.get(k as usize) == Some(&id)
        {
            // It has turned since it was noted: that goes into the whole.
            let k = k as usize;
            motion.motors.swap_remove(k);
            swap_heading(&mut constraint, &mut motion.headings.swap_remove(k));
            if let Some(moved) = motion.motors.get(k) {
                self.log.heading_places[moved.idx()] = k as u32;
            }
        }
        motion.constraints.push((id, constraint));
    }

    /// Motors are about to turn.
    pub(super) fn note_headings(&mut self) {
        if self.log.motion.is_none() || std::mem::replace(&mut self.log.has_headings, true) {
            return;
        }
        for k in 0..self.dependencies.motors().len() {
            let id = self.dependencies.motors()[k];
            let record = self.constraints.get(id.idx()).expect("a listed constraint lives");
            let Some(heading) = heading(&record.constraint) else {
                self.note_constraint(id);
                continue;
            };
            if self.log.headings.mark(id.idx())
                && let Some(motion) = &mut self.log.motion
            {
                let places = &mut self.log.heading_places;
                places.resize(places.len().max(id.idx() + 1), 0);
                places[id.idx()] = motion.motors.len() as u32;
                motion.motors.push(id);
                motion.headings.push(heading);
            }
        }
    }

    /// What `reset` brings back is about to change.
    pub(super) fn note_start(&mut self) {
        if let Some(motion) = &mut self.log.motion
            && motion.start.is_none()
        {
            let (at, states) = (self.points.start.clone(), self.start_states.clone());
            motion.start = Some(Box::new(Start { at, states }));
        }
    }
}
