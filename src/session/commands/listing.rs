//! What `list` and `show` say, as data.

use crate::constraint::ConstraintKind as _;
use crate::diag::Diagnostic;
use crate::interrupt::tick;
use crate::lang::ast::{ListWhat, Name};
use crate::session::execution::Execution;
use crate::session::finding::{
    ConstraintRow, Finding, Listing, MeasureRow, ParameterRow, PointRow, TraceRow,
};
use crate::session::resolve::unbind::Unbind;
use crate::session::state::State;
use crate::solve::present;
use crate::terms::Statistic;
use crate::world::{ConstraintId, Entity, Measure, ParameterId, PointId, World};

/// What the writing of a row takes, in ticks.
const ROW: usize = 1000;

impl Execution<'_> {
    /// Shows what has a name, as data.
    pub(super) fn show_as_data(&mut self, name: &Name) -> Result<(), Diagnostic> {
        let instance = self.resolve().instance(name)?;
        let entity = if instance.is_none() { Some(self.resolve().entity(name)?) } else { None };
        let (now, _) = present(&self.state.world);
        let (state, world) = (&*self.state, &self.state.world);
        let mut listing = Listing::default();
        let mut add_constraints = |is_wanted: &dyn Fn(ConstraintId) -> bool| {
            let ids = world.constraints().map(|(id, _)| id).filter(|&id| is_wanted(id));
            listing.constraints = ids.map(|id| state.constraint_row(&now, id)).collect();
        };
        match entity {
            None => {
                let prefix = format!("{}.", instance.as_deref().unwrap_or_default());
                let is_of = |entity| world.name_of(entity).starts_with(&prefix);
                add_constraints(&|id| is_of(Entity::Constraint(id)));
                let ids = world.points().ids().filter(|&id| is_of(Entity::Point(id)));
                listing.points = ids.map(|id| state.point_row(id)).collect();
            }
            Some(Entity::Point(id)) => {
                let uses =
                    |c| world.constraint(c).is_some_and(|r| r.constraint.points().contains(&id.0));
                add_constraints(&uses);
                listing.points.push(state.point_row(id));
            }
            Some(Entity::Constraint(id)) => add_constraints(&|other| other == id),
            Some(Entity::Measure(id)) => {
                listing.measures.extend(world.measure(id).map(|it| state.measure_row(it)));
            }
            Some(Entity::Parameter(id)) => listing.parameters.push(state.parameter_row(id)),
        }
        let shown = match (entity, instance) {
            (Some(entity), _) => world.name_of(entity).to_owned(),
            (None, instance) => instance.unwrap_or_default(),
        };
        self.host.find_out(&Finding::Shown(&shown, &listing));
        Ok(())
    }
}

impl State {
    /// Some of what there is, as `list` lists it.
    pub(super) fn listing(&self, is_asked: impl Fn(ListWhat) -> bool) -> Listing {
        let mut listing = Listing::default();
        if is_asked(ListWhat::Parameters) {
            let ids = self.parameters_in_order().into_iter();
            listing.parameters = ids.map(|id| self.parameter_row(id)).collect();
        }
        if is_asked(ListWhat::Points) {
            listing.points = self.world.points().ids().map(|id| self.point_row(id)).collect();
        }
        if is_asked(ListWhat::Constraints) {
            let (now, _) = present(&self.world);
            let ids = self.world.constraints().map(|(id, _)| id);
            listing.constraints = ids.map(|id| self.constraint_row(&now, id)).collect();
        }
        if is_asked(ListWhat::Traces) {
            let traces = self.world.traces().iter();
            listing.traces = traces
                .map(|trace| TraceRow {
                    point: self.world.points().name(trace.point).to_owned(),
                    label: trace.label.as_deref().map(str::to_owned),
                    every: trace.every,
                    n_places: trace.samples.len(),
                    is_ended: trace.is_ended,
                })
                .collect();
        }
        if is_asked(ListWhat::Measures) {
            listing.measures = self.world.measures().map(|(_, it)| self.measure_row(it)).collect();
        }
        if is_asked(ListWhat::Definitions) {
            let definitions = self.definitions.values();
            listing.definitions = definitions
                .map(|it| {
                    let parameters = it.parameters.iter().map(|p| p.text.to_string()).collect();
                    (it.name.text.to_string(), parameters)
                })
                .collect();
        }
        listing
    }

    fn parameter_row(&self, id: ParameterId) -> ParameterRow {
        tick(ROW);
        let value = self.world.parameter(id).and_then(|parameter| parameter.value);
        ParameterRow {
            name: self.world.name_of(Entity::Parameter(id)).to_owned(),
            statement: Unbind::of(&self.world).parameter_text(id),
            value,
        }
    }

    fn measure_row(&self, measure: &Measure) -> MeasureRow {
        tick(ROW);
        let statistics = Statistic::ALL.into_iter().filter_map(|which| {
            let value = measure.tally.get(which)?;
            Some((which.word(), value))
        });
        MeasureRow {
            name: measure.name.to_string(),
            statement: Unbind::of(&self.world).measure_statement(measure).to_string(),
            statistics: statistics.collect(),
        }
    }

    fn point_row(&self, id: PointId) -> PointRow {
        tick(ROW);
        let points = self.world.points();
        let at = points.at(id);
        PointRow {
            name: points.name(id).to_owned(),
            at: [at.x, at.y],
            is_frozen: points.is_frozen(id),
            weight: points.weight(id),
        }
    }

    /// A constraint, with its residual in a world that is as this one is `now`.
    fn constraint_row(&self, now: &World, id: ConstraintId) -> ConstraintRow {
        tick(ROW);
        let record = self.world.constraint(id).expect("a listed constraint lives");
        let there = &now.constraint(id).expect("it lives there too").constraint;
        let points = record.constraint.points().iter();
        ConstraintRow {
            name: record.name.to_string(),
            statement: Unbind::of(&self.world).constraint_text(record),
            points: points.map(|&p| self.world.points().name(PointId(p)).to_owned()).collect(),
            is_on: record.is_on,
            residual: there.residual(now.points().column()),
        }
    }
}
