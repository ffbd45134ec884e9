//! The world: all that a script has made, and the time it is.

use std::collections::BTreeMap;

use super::dependencies::Dependencies;
use super::log::Log;
use super::name_index::NameIndex;
use super::point_users::PointUsers;
use super::records::Table;
use super::turning::{TurnCounts, TurnsAhead};
use super::{
    Clock, ConstraintId, Entity, Formula, Ghost, Measure, MeasureId, Mention, NameText, Parameter,
    ParameterId, PointId, Points, Record, Touched, Trace,
};
use crate::constraint::{Constraint, Point};

/// Everything a script has made, and the time it is.
#[derive(Debug, Clone, Default)]
pub struct World {
    pub(super) points: Points,
    pub(super) constraints: Table<Record>,
    pub(super) n_constraints: usize,
    pub(super) parameters: Table<Parameter>,
    pub(super) measures: Table<Measure>,
    /// How many of them there are.
    pub(super) n_measures: usize,
    pub(super) index: NameIndex,
    pub(super) clock: Clock,
    /// The state of motors and wheels when the clock left 0, or at birth if made later.
    pub(super) start_states: BTreeMap<ConstraintId, Vec<f64>>,
    /// How far directions have turned, where that is asked for.
    pub(super) turn_counts: TurnCounts,
    pub(super) turns_ahead: TurnsAhead,
    pub(super) traces: Vec<Trace>,
    pub(super) ghosts: Vec<Ghost>,
    pub(super) dependencies: Dependencies,
    pub(super) point_users: PointUsers,
    pub(super) touched: Box<Touched>,
    pub(super) log: Log,
    pub(super) revision: u64,
}

impl World {
    /// An empty world at time 0.
    pub fn new() -> Self {
        Self::default()
    }

    /// The points.
    pub const fn points(&self) -> &Points {
        &self.points
    }

    /// The constraints, in order of creation.
    pub fn constraints(&self) -> impl DoubleEndedIterator<Item = (ConstraintId, &Record)> {
        self.constraints.iter().map(|(k, record)| (ConstraintId::new(k), record))
    }

    /// How many constraints there are.
    pub const fn n_constraints(&self) -> usize {
        self.n_constraints
    }

    /// One constraint, if it exists.
    pub fn constraint(&self, id: ConstraintId) -> Option<&Record> {
        self.constraints.get(id.idx())
    }

    /// The parameters, in order of creation.
    pub fn parameters(&self) -> impl Iterator<Item = (ParameterId, &Parameter)> {
        self.parameters.iter().map(|(k, parameter)| (ParameterId::new(k), parameter))
    }

    /// One parameter, if it exists.
    pub fn parameter(&self, id: ParameterId) -> Option<&Parameter> {
        self.parameters.get(id.idx())
    }

    /// The measures, in order of creation.
    pub fn measures(&self) -> impl Iterator<Item = (MeasureId, &Measure)> {
        self.measures.iter().map(|(k, measure)| (MeasureId::new(k), measure))
    }

    /// One measure, if it exists.
    pub fn measure(&self, id: MeasureId) -> Option<&Measure> {
        self.measures.get(id.idx())
    }

    /// The name of an entity.
    pub fn name_of(&self, entity: Entity) -> &str {
        self.name_text_of(entity)
    }

    pub(super) fn name_text_of(&self, entity: Entity) -> &NameText {
        match entity {
            Entity::Point(id) => self.points.name_text(id),
            Entity::Constraint(id) => {
                &self.constraint(id).expect("a handle of a living constraint").name
            }
            Entity::Parameter(id) => {
                &self.parameter(id).expect("a handle of a living parameter").name
            }
            Entity::Measure(id) => &self.measure(id).expect("a handle of a living measure").name,
        }
    }

    pub(super) fn name_text_mut(&mut self, entity: Entity) -> &mut NameText {
        let name = match entity {
            Entity::Point(id) => self.points.name[id.idx()].as_mut(),
            Entity::Constraint(id) => self.constraints.get_mut(id.idx()).map(|it| &mut it.name),
            Entity::Parameter(id) => self.parameters.get_mut(id.idx()).map(|it| &mut it.name),
            Entity::Measure(id) => self.measures.get_mut(id.idx()).map(|it| &mut it.name),
        };
        name.expect("a handle of what lives")
    }

    /// Whether all that a formula mentions is there.
    pub fn has_all(&self, formula: &Formula) -> bool {
        let mut has_all = true;
        formula.mentions(&mut |mention| {
            has_all &= match mention {
                Mention::Point(id) => self.points.is_alive(id),
                Mention::Parameter(id) => self.parameter(id).is_some(),
                Mention::Member(id, _) => self.constraint(id).is_some(),
                Mention::Measure(id) => self.measure(id).is_some(),
            };
        });
        has_all
    }

    /// The clock.
    pub const fn clock(&self) -> &Clock {
        &self.clock
    }

    /// Counts the edits that changed what there is: while it stays the same, a motion can be
    /// gone back to.
    pub const fn revision(&self) -> u64 {
        self.revision
    }

    /// The traces, in the order they were asked for.
    pub fn traces(&self) -> &[Trace] {
        &self.traces
    }

    /// The ghosts, the oldest first.
    pub fn ghosts(&self) -> &[Ghost] {
        &self.ghosts
    }

    /// A handle for a point to be made.
    pub fn next_point(&self) -> PointId {
        PointId::new(self.points.column().len())
    }

    /// A handle for a constraint to be made.
    pub fn next_constraint(&self) -> ConstraintId {
        ConstraintId::new(self.constraints.n_handles())
    }

    /// A handle for a parameter to be made.
    pub fn next_parameter(&self) -> ParameterId {
        ParameterId::new(self.parameters.n_handles())
    }

    /// A handle for a measure to be made.
    pub fn next_measure(&self) -> MeasureId {
        MeasureId::new(self.measures.n_handles())
    }

    /// Whether nothing changed since it was last asked what did.
    pub fn is_untouched(&self) -> bool {
        self.touched.is_empty()
    }

    /// What changed since it was last taken.
    pub(crate) fn touched(&self) -> &Touched {
        &self.touched
    }

    /// What changed since this was last asked for. `room` lends its lists to what comes next.
    pub fn take_touched(&mut self, mut room: Box<Touched>) -> Box<Touched> {
        room.clear();
        let mut touched = std::mem::replace(&mut self.touched, room);
        if touched.all {
            touched.clear();
            touched.all = true;
        }
        touched
    }

    /// Puts a point where the solver found it. A position that is out of reach is refused and
    /// the one before kept.
    pub fn set_position(&mut self, id: PointId, at: Point) {
        if at.is_in_reach() {
            self.note_place(id);
            self.points.at[id.idx()] = at;
            self.dependencies.note_change();
        }
    }

    /// The relation as the solver carries it on: unwrapped angles and the like. Not for edits.
    pub fn constraint_state_mut(&mut self, id: ConstraintId) -> &mut Constraint {
        self.note_constraint(id);
        &mut self.constraints.get_mut(id.idx()).expect("a handle of a living constraint").constraint
    }
}
