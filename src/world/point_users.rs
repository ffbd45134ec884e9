//! The index of what uses each point.

use std::collections::BTreeSet;
use std::sync::OnceLock;

use super::records::Table;
use super::{
    ConstraintId, Formula, Measure, MeasureId, Mention, Parameter, ParameterId, PointId, Record,
    User,
};
use crate::constraint::ConstraintKind;

/// By point, what holds or mentions it. Made when it is first asked for, since only `delete` asks,
/// and freezing where points are measured, and kept up from then on, so that a thousand deletions
/// look at the scene once.
#[derive(Debug, Clone, Default)]
pub(super) struct PointUsers(OnceLock<BTreeSet<(PointId, User)>>);

impl PointUsers {
    /// What uses a point, in order.
    pub fn of(
        &self,
        id: PointId,
        constraints: &Table<Record>,
        parameters: &Table<Parameter>,
        measures: &Table<Measure>,
    ) -> impl Iterator<Item = User> {
        let all = self.0.get_or_init(|| {
            let mut all: Vec<(PointId, User)> = Vec::new();
            for (k, record) in constraints.iter() {
                let user = User::Constraint(ConstraintId::new(k));
                points_of_record(record, &mut |point| all.push((point, user)));
            }
            for (k, parameter) in parameters.iter() {
                let user = User::Parameter(ParameterId::new(k));
                points_of_formula(&parameter.formula, &mut |point| all.push((point, user)));
            }
            for (k, measure) in measures.iter() {
                let user = User::Measure(MeasureId::new(k));
                points_of_formula(&measure.formula, &mut |point| all.push((point, user)));
            }
            all.into_iter().collect()
        });
        all.range((id, User::FIRST)..=(id, User::LAST)).map(|(_, user)| *user)
    }

    /// A constraint was made, changed or deleted.
    pub fn note_constraint(
        &mut self,
        id: ConstraintId,
        old: Option<&Record>,
        new: Option<&Record>,
    ) {
        let Some(all) = self.0.get_mut() else { return };
        let user = User::Constraint(id);
        if let Some(record) = old {
            points_of_record(record, &mut |point| {
                all.remove(&(point, user));
            });
        }
        if let Some(record) = new {
            points_of_record(record, &mut |point| {
                all.insert((point, user));
            });
        }
    }

    /// A parameter was made, changed or deleted.
    pub fn note_parameter(
        &mut self,
        id: ParameterId,
        old: Option<&Formula>,
        new: Option<&Formula>,
    ) {
        self.note_formula(User::Parameter(id), old, new);
    }

    /// A measure was made, begun anew or deleted.
    pub fn note_measure(&mut self, id: MeasureId, old: Option<&Formula>, new: Option<&Formula>) {
        self.note_formula(User::Measure(id), old, new);
    }

    fn note_formula(&mut self, user: User, old: Option<&Formula>, new: Option<&Formula>) {
        let Some(all) = self.0.get_mut() else { return };
        if let Some(formula) = old {
            points_of_formula(formula, &mut |point| {
                all.remove(&(point, user));
            });
        }
        if let Some(formula) = new {
            points_of_formula(formula, &mut |point| {
                all.insert((point, user));
            });
        }
    }
}

fn points_of_record(record: &Record, visit: &mut impl FnMut(PointId)) {
    record.constraint.points().iter().for_each(|&p| visit(PointId(p)));
    for (_, formula) in record.drivers() {
        points_of_formula(formula, visit);
    }
}

fn points_of_formula(formula: &Formula, visit: &mut impl FnMut(PointId)) {
    formula.mentions(&mut |mention| {
        if let Mention::Point(id) = mention {
            visit(id);
        }
    });
}
