//! Edits carried out: the one way in which a world changes.

use super::batch::{Batch, BatchRecords};
use super::motion::whole_state;
use super::{
    Clock, ConstraintId, Edit, Entity, Ghost, Measure, MeasureId, NameText, Parameter, ParameterId,
    PointId, PointRecord, Record, Refreeze, Touched, World,
};
use crate::constraint::Constraint;

impl World {
    /// Makes an edit; gives the edit that takes it back.
    ///
    /// Names must be free and handles alive: whoever makes the edit has asked.
    pub fn apply(&mut self, edit: Edit) -> Edit {
        self.revision += u64::from(edit.is_structural());
        match edit {
            Edit::Point(id, record) => Edit::Point(id, self.swap_point(id, record)),
            Edit::Move(id, at) => {
                debug_assert!(at.is_finite(), "a position is finite");
                self.note_place(id);
                self.touched.moved.push(id);
                self.dependencies.note_change();
                Edit::Move(id, std::mem::replace(&mut self.points.at[id.idx()], at))
            }
            Edit::Freeze(id, frozen) => {
                self.touched.points.push(id);
                let was = std::mem::replace(&mut self.points.is_frozen[id.idx()], frozen);
                let bound = if was == frozen { Vec::new() } else { self.rebind_measures(id) };
                if bound.is_empty() {
                    return Edit::Freeze(id, was);
                }
                Edit::Refreeze(Box::new(Refreeze { point: id, is_frozen: was, bound }))
            }
            Edit::Refreeze(mut it) => {
                let Refreeze { point, is_frozen, bound } = &mut *it;
                self.touched.points.push(*point);
                std::mem::swap(&mut self.points.is_frozen[point.idx()], is_frozen);
                bound.iter_mut().for_each(|(id, record)| self.swap_bound(*id, record));
                Edit::Refreeze(it)
            }
            Edit::Weight(id, weight) => {
                self.touched.points.push(id);
                Edit::Weight(id, self.points.set_weight(id, weight))
            }
            Edit::Constraint(id, record) => Edit::Constraint(id, self.swap_constraint(id, record)),
            Edit::Switch(id, on) => {
                self.touched.constraints.push(id);
                self.dependencies.note_switch(id);
                let record = self.constraints.get_mut(id.idx()).expect("a living constraint");
                Edit::Switch(id, std::mem::replace(&mut record.is_on, on))
            }
            Edit::Rename(entity, mut name) => {
                self.swap_name(entity, &mut name);
                Edit::Rename(entity, name)
            }
            Edit::DeleteBatch(batch) => Edit::RestoreBatch(Box::new(self.delete_batch(batch))),
            Edit::RestoreBatch(records) => Edit::DeleteBatch(self.restore_batch(*records)),
            Edit::Parameter(id, parameter) => {
                Edit::Parameter(id, self.swap_parameter(id, parameter))
            }
            Edit::Measure(id, measure) => Edit::Measure(id, self.swap_measure(id, measure)),
            Edit::Clock(clock) => {
                self.dependencies.note_change();
                Edit::Clock(Box::new(std::mem::replace(&mut self.clock, *clock)))
            }
            Edit::Trace(idx, Some(trace)) => {
                self.traces.insert(idx, *trace);
                Edit::Trace(idx, None)
            }
            Edit::Trace(idx, None) => Edit::Trace(idx, Some(Box::new(self.traces.remove(idx)))),
            Edit::Ghost(Some(ghost)) => {
                self.ghosts.push(*ghost);
                Edit::Ghost(None)
            }
            Edit::Ghost(None) => Edit::Ghost(self.ghosts.pop().map(Box::new)),
            Edit::Start(id, at) => {
                self.note_start();
                Edit::Start(id, std::mem::replace(&mut self.points.start[id.idx()], at))
            }
            Edit::StartState(id, state) => {
                self.note_start();
                let old = match state {
                    Some(state) => self.start_states.insert(id, state.into_vec()),
                    None => self.start_states.remove(&id),
                };
                Edit::StartState(id, old.map(Vec::into_boxed_slice))
            }
            Edit::StartStates(states) => {
                self.note_start();
                Edit::StartStates(Box::new(std::mem::replace(&mut self.start_states, *states)))
            }
            Edit::TurnCount(mut count) => {
                let (turning, it) = &mut *count;
                *it = self.swap_turn_count(*turning, it.take());
                Edit::TurnCount(count)
            }
            Edit::Motion(motion) => Edit::Motion(Box::new(self.swap_motion(*motion))),
            Edit::Everything(mut world) => {
                self.swap_all(&mut world);
                Edit::Everything(world)
            }
        }
    }

    fn swap_point(
        &mut self,
        id: PointId,
        record: Option<Box<PointRecord>>,
    ) -> Option<Box<PointRecord>> {
        self.touched.points.push(id);
        let old = self.points.is_alive(id).then(|| {
            let old = self.points.remove(id);
            self.index.remove(&old.name, Entity::Point(id));
            Box::new(old)
        });
        if let Some(record) = record {
            debug_assert!(record.at.is_finite(), "a position is finite");
            self.index.insert(&record.name, Entity::Point(id));
            self.points.insert(id, *record);
        }
        old
    }

    fn swap_constraint(
        &mut self,
        id: ConstraintId,
        record: Option<Box<Record>>,
    ) -> Option<Box<Record>> {
        self.touched.constraints.push(id);
        self.note_constraint(id);
        let old = self.constraints.get(id.idx());
        self.dependencies.note_constraint(id, old, record.as_deref());
        self.point_users.note_constraint(id, old, record.as_deref());
        match (old, &record) {
            (None, Some(new)) => {
                self.n_constraints += 1;
                self.index.insert(&new.name, Entity::Constraint(id));
            }
            (Some(old), None) => {
                self.n_constraints -= 1;
                self.index.remove(&old.name, Entity::Constraint(id));
            }
            (Some(old), Some(new)) => debug_assert_eq!(old.name, new.name, "a name stays"),
            (None, None) => {}
        }
        let old = self.constraints.swap(id.idx(), record.map(|record| *record));
        if old.is_none() {
            self.note_start_state(id);
        }
        old.map(Box::new)
    }

    fn swap_parameter(
        &mut self,
        id: ParameterId,
        parameter: Option<Box<Parameter>>,
    ) -> Option<Box<Parameter>> {
        let old = self.parameters.get(id.idx());
        self.dependencies.note_parameter(
            id,
            old.map(|p| (&p.formula, p.depends)),
            parameter.as_ref().map(|p| (&p.formula, p.depends)),
            id.idx() >= self.parameters.n_handles(),
        );
        let (was, is) = (old.map(|p| &p.formula), parameter.as_ref().map(|p| &p.formula));
        self.point_users.note_parameter(id, was, is);
        match (old, &parameter) {
            (None, Some(new)) => self.index.insert(&new.name, Entity::Parameter(id)),
            (Some(old), None) => self.index.remove(&old.name, Entity::Parameter(id)),
            _ => {}
        }
        self.parameters.swap(id.idx(), parameter.map(|p| *p)).map(Box::new)
    }

    fn swap_measure(&mut self, id: MeasureId, new: Option<Box<Measure>>) -> Option<Box<Measure>> {
        let old = self.measures.get(id.idx());
        let (was, is) = (old.map(|it| &it.formula), new.as_ref().map(|it| &it.formula));
        self.dependencies.note_measure(id, was, is);
        self.point_users.note_measure(id, was, is);
        match (old, &new) {
            (None, Some(new)) => {
                self.n_measures += 1;
                self.index.insert(&new.name, Entity::Measure(id));
            }
            (Some(old), None) => {
                self.n_measures -= 1;
                self.index.remove(&old.name, Entity::Measure(id));
            }
            _ => {}
        }
        self.measures.swap(id.idx(), new.map(|it| *it)).map(Box::new)
    }

    /// Exchanges the name of what lives for a free one. Nothing else of it changes: all that refers to it
    /// does so by its handle.
    fn swap_name(&mut self, entity: Entity, name: &mut NameText) {
        // In this order: it may stay a member of the same instance.
        self.index.remove(&self.name_text_of(entity).clone(), entity);
        self.index.insert(name, entity);
        std::mem::swap(self.name_text_mut(entity), name);
    }

    /// Puts another world in the place of this one, and this one in that of the other. What is noted for
    /// the command under way, and the count of edits, go on.
    fn swap_all(&mut self, other: &mut Self) {
        debug_assert!(!self.log.is_on(), "what is noted is of one world");
        std::mem::swap(self, other);
        std::mem::swap(&mut self.log, &mut other.log);
        std::mem::swap(&mut self.revision, &mut other.revision);
        *self.touched = Touched::everything();
        *other.touched = Touched::default();
    }

    /// Whether there is nothing in it, and no time has passed.
    pub(super) fn is_blank(&self) -> bool {
        self.index.is_empty()
            && self.traces.is_empty()
            && self.ghosts.is_empty()
            && self.turn_counts.is_empty()
            && self.clock == Clock::default()
    }

    /// Roughly how many bytes it holds.
    pub(super) fn n_bytes(&self) -> usize {
        let constraints = self.constraints().map(|(_, record)| record.n_bytes());
        let parameters = self.parameters().map(|(_, parameter)| parameter.n_bytes());
        let measures = self.measures().map(|(_, measure)| measure.n_bytes());
        let traces = self.traces.iter().map(|trace| size_of_val(trace) + trace.samples.n_bytes());
        let ghosts = self.ghosts.iter().map(Ghost::n_bytes);
        size_of::<Self>()
            + self.points.n_bytes()
            + BESIDE * self.index.len()
            + constraints.sum::<usize>()
            + parameters.sum::<usize>()
            + measures.sum::<usize>()
            + traces.sum::<usize>()
            + ghosts.sum::<usize>()
            + BESIDE * (self.start_states.len() + self.turn_counts.len())
    }

    /// The edit that keeps a ghost of the mechanism as it stands.
    pub fn expose(&self) -> Edit {
        let at = self.points.ids().map(|id| (id, self.points.at(id))).collect();
        Edit::Ghost(Some(Box::new(Ghost { at })))
    }

    /// The edit that makes `reset` bring back a constraint as if it had been this at the start.
    pub fn begin_with(&self, id: ConstraintId, constraint: &Constraint) -> Edit {
        Edit::StartState(id, whole_state(constraint).map(Vec::into_boxed_slice))
    }
}

/// Bytes of a thing beside its own: its place among the names, and among what uses what.
const BESIDE: usize = 64;

impl World {
    fn delete_batch(&mut self, batch: Batch) -> BatchRecords {
        let constraints = batch.constraints.handles();
        let constraints = constraints.filter_map(|k| self.swap_constraint(ConstraintId(k), None));
        let constraints = constraints.map(|record| *record).collect();
        let points = batch.points.handles();
        let points = points.filter_map(|k| self.swap_point(PointId(k), None));
        BatchRecords { batch, constraints, points: points.map(|record| *record).collect() }
    }

    fn restore_batch(&mut self, records: BatchRecords) -> Batch {
        let BatchRecords { batch, points, constraints } = records;
        for (k, record) in batch.points.handles().zip(points) {
            self.swap_point(PointId(k), Some(Box::new(record)));
        }
        for (k, record) in batch.constraints.handles().zip(constraints) {
            self.swap_constraint(ConstraintId(k), Some(Box::new(record)));
        }
        batch
    }
}
