//! Live expressions: what depends on what, and bringing values up to date in that order.

use std::collections::HashMap;

use super::records::Dependent;
use super::{
    ConstraintId, Depends, Edit, Environment, Formula, Mention, Parameter, ParameterId, PointId,
    Record, Value, World,
};
use crate::constraint::{Field, Jet, Kind, Place, Real, Relation, Vector};
use crate::diag::Diagnostic;

/// What was worked out about live expressions; a scene without any keeps nothing here.
#[derive(Debug, Clone, Default)]
pub(super) struct Live {
    /// For each parameter that is used, its users.
    dependents: HashMap<ParameterId, Vec<Dependent>>,
    /// Live parameters, each after those it mentions.
    order: Vec<ParameterId>,
    /// Constraints with a value that time or points drive, in order of creation.
    driven: Vec<ConstraintId>,
    /// Those among them that points drive.
    measured: Vec<ConstraintId>,
    /// Motors that are switched on.
    pub motors: Vec<ConstraintId>,
    /// Whether the lists above have to be made anew.
    pub is_dirty: bool,
    /// Whether time or points changed since the live parameters were evaluated.
    pub is_stale: bool,
}

impl Live {
    pub fn link_parameter(&mut self, id: ParameterId, formula: &Formula) {
        link(&mut self.dependents, formula, Dependent::Parameter(id));
    }

    pub fn unlink_parameter(&mut self, id: ParameterId, formula: &Formula) {
        unlink(&mut self.dependents, formula, Dependent::Parameter(id));
    }
}

fn link(dependents: &mut HashMap<ParameterId, Vec<Dependent>>, formula: &Formula, user: Dependent) {
    formula.mentions(&mut |mention| {
        if let Mention::Parameter(used) = mention {
            dependents.entry(used).or_default().push(user);
        }
    });
}

fn unlink(
    dependents: &mut HashMap<ParameterId, Vec<Dependent>>,
    formula: &Formula,
    user: Dependent,
) {
    formula.mentions(&mut |mention| {
        if let Mention::Parameter(used) = mention
            && let Some(users) = dependents.get_mut(&used)
            && let Some(k) = users.iter().rposition(|u| *u == user)
        {
            // The order of users means nothing; keep it all the same, for reproducible work.
            users.remove(k);
            if users.is_empty() {
                dependents.remove(&used);
            }
        }
    });
}

/// Velocities and accelerations of all points, by handle.
#[derive(Debug, Clone, Default)]
pub struct Rates {
    /// Rates of change, per time unit.
    pub velocity: Vec<Vector>,
    /// Second derivatives, per time unit squared.
    pub acceleration: Vec<Vector>,
}

/// A world as formulas see it, with rates where they were computed.
struct Here<'a> {
    world: &'a World,
    rates: Option<&'a Rates>,
    /// Values of parameters that depend on rates.
    values: HashMap<ParameterId, Value>,
}

impl Environment<f64> for Here<'_> {
    fn parameter(&self, id: ParameterId) -> Result<Value, Diagnostic> {
        let parameter = self.world.parameter(id).expect("a mentioned parameter lives");
        match parameter.value.or_else(|| self.values.get(&id).copied()) {
            Some(value) => Ok(value),
            // It needs rates and there are none: its own formula says so, at the right place.
            None => parameter.formula.evaluate(self),
        }
    }

    fn position(&self, id: PointId) -> Place<f64> {
        let p = self.world.points.at(id);
        Place { x: p.x, y: p.y }
    }

    fn time(&self) -> f64 {
        self.world.clock.time()
    }

    fn rates(&self, id: PointId) -> Option<(Place<f64>, Place<f64>)> {
        let rates = self.rates?;
        let (v, a) = (rates.velocity[id.idx()], rates.acceleration[id.idx()]);
        Some((Place { x: v.x, y: v.y }, Place { x: a.x, y: a.y }))
    }
}

/// A world in motion as formulas see it: everything with its derivatives in time.
struct Moving<'a> {
    world: &'a World,
    rates: &'a Rates,
    values: HashMap<ParameterId, Value<Jet>>,
}

impl Environment<Jet> for Moving<'_> {
    fn parameter(&self, id: ParameterId) -> Result<Value<Jet>, Diagnostic> {
        if let Some(value) = self.values.get(&id) {
            return Ok(*value);
        }
        let parameter = self.world.parameter(id).expect("a mentioned parameter lives");
        match parameter.value {
            Some(Value::Number(n)) => Ok(Value::Number(Jet::constant(n))),
            Some(Value::Vector(v)) => {
                Ok(Value::Vector(Place { x: Jet::constant(v.x), y: Jet::constant(v.y) }))
            }
            None => parameter.formula.evaluate(self),
        }
    }

    fn position(&self, id: PointId) -> Place<Jet> {
        let p = self.world.points.at(id);
        let at = |rates: &[Vector]| rates.get(id.idx()).copied().unwrap_or_default();
        let (v, a) = (at(&self.rates.velocity), at(&self.rates.acceleration));
        Place { x: Jet::new(p.x, v.x, a.x), y: Jet::new(p.y, v.y, a.y) }
    }

    fn time(&self) -> Jet {
        Jet::new(self.world.clock.time(), 1.0, 0.0)
    }

    fn rates(&self, _id: PointId) -> Option<(Place<Jet>, Place<Jet>)> {
        None
    }
}

impl World {
    /// The value of an expression, live parameters brought up to date first.
    ///
    /// # Errors
    /// Where it has none; velocities have none without `rates`.
    pub fn evaluate(
        &mut self,
        formula: &Formula,
        rates: Option<&Rates>,
    ) -> Result<Value, Diagnostic> {
        if formula.depends().on_parameters {
            self.refresh_parameters()?;
        }
        let mut here = Here { world: self, rates, values: HashMap::new() };
        if rates.is_some() {
            for &id in &self.live.order {
                let parameter = self.parameter(id).expect("a listed parameter lives");
                if parameter.depends.on_rates {
                    let value = parameter.formula.evaluate(&here)?;
                    here.values.insert(id, value);
                }
            }
        }
        formula.evaluate(&here)
    }

    /// What can change a formula, its parameters' own formulas included.
    pub fn depends(&self, formula: &Formula) -> Depends {
        let mut depends = formula.depends();
        if depends.on_parameters {
            formula.mentions(&mut |mention| {
                if let Mention::Parameter(id) = mention
                    && let Some(parameter) = self.parameter(id)
                {
                    depends = depends.or(parameter.depends);
                }
            });
        }
        depends
    }

    /// Whether parameter `id` would be mentioned, at any depth, by `formula`: a cycle.
    pub fn would_cycle(&self, id: ParameterId, formula: &Formula) -> bool {
        let mut pending: Vec<ParameterId> = Vec::new();
        let mut is_seen = vec![false; self.parameters.n_handles()];
        let mut found = false;
        let mut look = |formula: &Formula, pending: &mut Vec<ParameterId>| {
            formula.mentions(&mut |mention| {
                if let Mention::Parameter(used) = mention {
                    found |= used == id;
                    if !std::mem::replace(&mut is_seen[used.idx()], true) {
                        pending.push(used);
                    }
                }
            });
        };
        look(formula, &mut pending);
        while let Some(used) = pending.pop() {
            if let Some(parameter) = self.parameter(used) {
                look(&parameter.formula, &mut pending);
            }
        }
        found
    }

    /// Changes a parameter and everything that depends on it; what takes it back is added to
    /// `undo` edit by edit.
    ///
    /// # Errors
    /// Where the new value, or one that depends on it, cannot be had. The caller takes back
    /// what `undo` lists.
    pub fn set_parameter(
        &mut self,
        id: ParameterId,
        name: std::rc::Rc<str>,
        formula: Formula,
        undo: &mut Vec<Edit>,
    ) -> Result<(), Diagnostic> {
        let depends = self.depends(&formula);
        let value = if depends.on_rates { None } else { Some(self.evaluate(&formula, None)?) };
        let record = Parameter { name, formula, value, depends };
        undo.push(self.apply(Edit::Parameter(id, Some(Box::new(record)))));
        self.update_dependents(id, undo)
    }

    fn update_dependents(
        &mut self,
        id: ParameterId,
        undo: &mut Vec<Edit>,
    ) -> Result<(), Diagnostic> {
        if !self.live.dependents.contains_key(&id) {
            return Ok(());
        }
        let (parameters, constraints) = self.affected(id);
        for id in parameters {
            let mut record = self.parameter(id).expect("a listed parameter lives").clone();
            record.depends = self.depends(&record.formula);
            record.value = if record.depends.on_rates {
                None
            } else {
                Some(self.evaluate(&record.formula, None)?)
            };
            undo.push(self.apply(Edit::Parameter(id, Some(Box::new(record)))));
        }
        for id in constraints {
            let mut record = self.constraint(id).expect("a listed constraint lives").clone();
            self.drive(&mut record)?;
            undo.push(self.apply(Edit::Constraint(id, Some(Box::new(record)))));
        }
        Ok(())
    }

    /// Parameters that depend on one, each after those it mentions, and the constraints.
    fn affected(&self, id: ParameterId) -> (Vec<ParameterId>, Vec<ConstraintId>) {
        let mut finished: Vec<ParameterId> = Vec::new();
        let mut constraints: Vec<ConstraintId> = Vec::new();
        let mut is_seen = vec![false; self.parameters.n_handles()];
        // Depth first: a parameter is finished after all its dependents, so that the reverse
        // order is the order of evaluation.
        let mut stack = vec![(id, 0)];
        while let Some((at, next)) = stack.pop() {
            let users = self.live.dependents.get(&at).map_or(&[][..], Vec::as_slice);
            match users.get(next) {
                None => finished.push(at),
                Some(user) => {
                    stack.push((at, next + 1));
                    match *user {
                        Dependent::Constraint(c) => constraints.push(c),
                        Dependent::Parameter(p) => {
                            if !std::mem::replace(&mut is_seen[p.idx()], true) {
                                stack.push((p, 0));
                            }
                        }
                    }
                }
            }
        }
        finished.pop();
        finished.reverse();
        constraints.sort_unstable();
        constraints.dedup();
        (finished, constraints)
    }

    /// Puts the present values of its live expressions into a constraint.
    ///
    /// # Errors
    /// Where an expression has no value.
    pub fn drive(&mut self, record: &mut Record) -> Result<(), Diagnostic> {
        for k in 0..record.drivers.len() {
            let (field, formula) = record.drivers[k].clone();
            let value = match (field, self.evaluate(&formula, None)?) {
                (Field::X, Value::Vector(v)) => v.x,
                (Field::Y, Value::Vector(v)) => v.y,
                (_, value) => value.number(),
            };
            record.constraint.set(field, value);
        }
        Ok(())
    }

    /// Evaluates live parameters and driven constraints anew.
    pub(super) fn refresh(&mut self) -> Result<(), Diagnostic> {
        self.live.is_stale = true;
        self.refresh_parameters()?;
        for k in 0..self.live.driven.len() {
            self.refresh_constraint(self.live.driven[k])?;
        }
        Ok(())
    }

    /// Evaluates live parameters anew if time or points changed. Constraints keep their
    /// values: looking at a parameter never changes a run.
    fn refresh_parameters(&mut self) -> Result<(), Diagnostic> {
        if self.live.is_dirty {
            self.sort_live();
        }
        if self.live.is_stale {
            for k in 0..self.live.order.len() {
                self.refresh_parameter(self.live.order[k])?;
            }
            self.live.is_stale = false;
        }
        Ok(())
    }

    fn refresh_parameter(&mut self, id: ParameterId) -> Result<(), Diagnostic> {
        let parameter = self.parameter(id).expect("a listed parameter lives");
        if parameter.depends.on_rates {
            return Ok(());
        }
        let here = Here { world: self, rates: None, values: HashMap::new() };
        let value = parameter.formula.evaluate(&here)?;
        self.parameters.get_mut(id.idx()).expect("a listed parameter lives").value = Some(value);
        Ok(())
    }

    /// Gives the largest change of a value of the constraint.
    fn refresh_constraint(&mut self, id: ConstraintId) -> Result<f64, Diagnostic> {
        let mut change = 0.0_f64;
        let record = self.constraint(id).expect("a listed constraint lives");
        for k in 0..record.drivers.len() {
            let (field, value) = {
                let here = Here { world: self, rates: None, values: HashMap::new() };
                let (field, formula) = &self.constraint(id).expect("it lives").drivers[k];
                let value = match (*field, formula.evaluate(&here)?) {
                    (Field::X, Value::Vector(v)) => v.x,
                    (Field::Y, Value::Vector(v)) => v.y,
                    (_, value) => value.number(),
                };
                (*field, value)
            };
            let constraint = self.constraint_state_mut(id);
            if let Some(old) = constraint.get(field) {
                change = change.max((value - old).abs());
            }
            constraint.set(field, value);
        }
        if change > 0.0 {
            self.touched.values.push(id);
        }
        Ok(change)
    }

    /// Whether some constraint's value is measured on the pose itself, so that a frame has to
    /// be solved until both agree.
    pub fn is_measured(&mut self) -> bool {
        if self.live.is_dirty {
            self.sort_live();
        }
        !self.live.measured.is_empty()
    }

    /// Evaluates anew what is measured on the pose; gives the largest change of a value.
    ///
    /// # Errors
    /// Where an expression has no value in this pose.
    pub fn refresh_measured(&mut self) -> Result<f64, Diagnostic> {
        self.live.is_stale = true;
        self.refresh_parameters()?;
        let mut change = 0.0_f64;
        for k in 0..self.live.measured.len() {
            change = change.max(self.refresh_constraint(self.live.measured[k])?);
        }
        Ok(change)
    }

    /// The values that time and points drive, with their derivatives in time, given the
    /// rates of the points. Motors turn with their speed besides.
    ///
    /// # Errors
    /// Where an expression has no value now.
    pub fn field_rates(
        &mut self,
        rates: &Rates,
    ) -> Result<Vec<(ConstraintId, Field, Jet)>, Diagnostic> {
        self.refresh_parameters()?;
        let mut moving = Moving { world: self, rates, values: HashMap::new() };
        for &id in &self.live.order {
            let parameter = self.parameter(id).expect("a listed parameter lives");
            if !parameter.depends.on_rates {
                let value = parameter.formula.evaluate(&moving)?;
                moving.values.insert(id, value);
            }
        }
        let mut all = Vec::new();
        for &id in &self.live.driven {
            for (field, formula) in &self.constraint(id).expect("a listed constraint lives").drivers
            {
                let jet = match (*field, formula.evaluate(&moving)?) {
                    (Field::X, Value::Vector(v)) => v.x,
                    (Field::Y, Value::Vector(v)) => v.y,
                    (_, value) => value.number(),
                };
                all.push((id, *field, jet));
            }
        }
        Ok(all)
    }

    /// Works out which parameters and constraints are live, and the order to evaluate them.
    fn sort_live(&mut self) {
        self.live.is_dirty = false;
        let mut order: Vec<ParameterId> = Vec::new();
        let mut is_seen = vec![false; self.parameters.n_handles()];
        for (root, _) in self.parameters().filter(|(_, p)| p.depends.is_live()) {
            let mut stack = vec![(root, false)];
            while let Some((id, is_expanded)) = stack.pop() {
                if is_expanded {
                    order.push(id);
                } else if !std::mem::replace(&mut is_seen[id.idx()], true) {
                    stack.push((id, true));
                    let parameter = self.parameter(id).expect("a mentioned parameter lives");
                    parameter.formula.mentions(&mut |mention| {
                        if let Mention::Parameter(used) = mention
                            && self.parameter(used).is_some_and(|p| p.depends.is_live())
                        {
                            stack.push((used, false));
                        }
                    });
                }
            }
        }
        self.live.order = order;
        let mut driven = Vec::new();
        let mut measured = Vec::new();
        let mut motors = Vec::new();
        for (id, record) in self.constraints() {
            if record.is_on && is_motor(record) {
                motors.push(id);
            }
            let depends = record
                .drivers
                .iter()
                .fold(Depends::default(), |all, (_, formula)| all.or(self.depends(formula)));
            if depends.is_live() {
                driven.push(id);
            }
            if depends.on_points {
                measured.push(id);
            }
        }
        self.live.driven = driven;
        self.live.measured = measured;
        self.live.motors = motors;
    }

    pub(super) fn link_constraint(&mut self, id: ConstraintId, record: &Record) {
        for (_, formula) in &record.drivers {
            link(&mut self.live.dependents, formula, Dependent::Constraint(id));
        }
        self.live.is_dirty |= !record.drivers.is_empty() || is_motor(record);
    }

    pub(super) fn unlink_constraint(&mut self, id: ConstraintId, record: &Record) {
        for (_, formula) in &record.drivers {
            unlink(&mut self.live.dependents, formula, Dependent::Constraint(id));
        }
        self.live.is_dirty |= !record.drivers.is_empty() || is_motor(record);
    }
}

fn is_motor(record: &Record) -> bool {
    record.constraint.kind() == Kind::Motor
}
