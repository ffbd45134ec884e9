//! Evaluating live expressions: when looked at, when a parameter changes, and frame by frame.

use std::collections::BTreeSet;

use super::dependencies::Dependencies;
use super::environments::{Here, Moving};
use super::{
    ConstraintId, Depends, Edit, Formula, NameText, Parameter, ParameterId, Rates, Record, User,
    Value, World,
};
use crate::constraint::{Constraint, ConstraintKind as _, Field, Jet, Real};
use crate::diag::Diagnostic;
use crate::errors;

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
        if formula.depends().looks_up_parameters() {
            self.refresh_parameters();
        }
        formula.evaluate(&Here::new(self, rates))
    }

    /// Why a value that is measured on the pose has none there; none where all have one.
    pub fn failed_measure(&mut self) -> Option<Diagnostic> {
        self.refresh_parameters();
        let here = Here::new(self, None);
        let measured = self.constraints().filter(|(_, record)| {
            record.is_on && matches!(record.constraint, Constraint::Measured(_))
        });
        let mut formulas = measured.flat_map(|(_, record)| record.drivers());
        formulas.find_map(|(_, formula)| formula.evaluate(&here).err())
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
        name: NameText,
        formula: Formula,
        undo: &mut Vec<Edit>,
    ) -> Result<(), Diagnostic> {
        let depends = self.depends(&formula);
        if depends.looks_up_parameters() {
            self.refresh_parameters();
        }
        let value = self.parameter_value(&formula, depends)?;
        let record = Parameter { name, formula, value, depends };
        undo.push(self.apply(Edit::Parameter(id, Some(Box::new(record)))));
        if self.dependencies.users(id).next().is_none() {
            return Ok(());
        }
        self.refresh_parameters();
        let (parameters, constraints) = self.affected(self.dependencies.users(id));
        if (depends.on_constraints || depends.on_measures) && !constraints.is_empty() {
            return Err(self.follows_from_the_motion(id));
        }
        self.evaluate_anew(parameters, constraints, undo)
    }

    /// Brings what uses a member of a constraint up to date with it; what takes it back is added to
    /// `undo` edit by edit.
    ///
    /// # Errors
    /// Where a value cannot be had. The caller takes back what `undo` lists.
    pub fn rebind_users_of(
        &mut self,
        id: ConstraintId,
        undo: &mut Vec<Edit>,
    ) -> Result<(), Diagnostic> {
        if self.dependencies.member_users(id).next().is_none() {
            return Ok(());
        }
        self.refresh_parameters();
        let (parameters, constraints) = self.affected(self.dependencies.member_users(id));
        self.evaluate_anew(parameters, constraints, undo)
    }

    /// Makes a parameter that was there before, whether or not it has a value now, and binds what
    /// mentions it; what takes it back is added to `undo` edit by edit.
    pub fn restore_parameter(
        &mut self,
        id: ParameterId,
        name: NameText,
        formula: Formula,
        undo: &mut Vec<Edit>,
    ) {
        let depends = self.depends(&formula);
        if depends.looks_up_parameters() {
            self.refresh_parameters();
        }
        let value = self.parameter_value(&formula, depends).unwrap_or_default();
        // Why it has none is noted once it is asked for.
        self.dependencies.note_change();
        let parameter = Parameter { name, formula, value, depends };
        undo.push(self.apply(Edit::Parameter(id, Some(Box::new(parameter)))));
        let (parameters, constraints) = self.affected(self.dependencies.users(id));
        // A constraint that is given no value now keeps the one that it had last.
        let _ = self.evaluate_anew(parameters, constraints, undo);
    }

    /// The value of a parameter, those it mentions being up to date; none of what only a motion has.
    fn parameter_value(
        &self,
        formula: &Formula,
        depends: Depends,
    ) -> Result<Option<Value>, Diagnostic> {
        let value = || formula.evaluate(&Here::new(self, None));
        if depends.on_rates {
            Ok(None)
        } else if depends.on_measures {
            // What was not measured yet will be.
            Ok(value().ok())
        } else {
            value().map(Some)
        }
    }

    /// Evaluates parameters, each after those it mentions, and then constraints, all of them whether
    /// or not some have no value.
    ///
    /// # Errors
    /// The first reason why a value cannot be had.
    fn evaluate_anew(
        &mut self,
        parameters: Vec<ParameterId>,
        constraints: Vec<ConstraintId>,
        undo: &mut Vec<Edit>,
    ) -> Result<(), Diagnostic> {
        let mut first = Ok(());
        for id in parameters {
            let mut record = self.parameter(id).expect("a listed parameter lives").clone();
            record.depends = self.depends(&record.formula);
            let value = self.parameter_value(&record.formula, record.depends);
            record.value = *value.as_ref().unwrap_or(&None);
            first = first.and(value.map(drop));
            undo.push(self.apply(Edit::Parameter(id, Some(Box::new(record)))));
        }
        for id in constraints {
            let mut record = self.constraint(id).expect("a listed constraint lives").clone();
            self.bind(&mut record);
            let driven = record.drive(&Here::new(self, None));
            first = first.and(driven).and_then(|()| record.flaw().map_or(Ok(()), Err));
            undo.push(self.apply(Edit::Constraint(id, Some(Box::new(record)))));
        }
        first
    }

    /// Why a parameter cannot drive a constraint.
    fn follows_from_the_motion(&self, id: ParameterId) -> Diagnostic {
        let parameter = self.parameter(id).expect("a named parameter lives");
        let (what, why) = if parameter.depends.on_measures {
            ("a measure", "what is measured cannot drive a constraint")
        } else {
            ("a constraint", "what a constraint comes to cannot drive one")
        };
        let text = format!("`{}` follows from {what}", parameter.name);
        Diagnostic::error(errors::NOT_A_DRIVER, text)
            .at(parameter.formula.span(), why)
            .help("use it in `print`, `assert`, or a parameter that these use")
    }

    /// Parameters that some users are or depend on, each after those it mentions, and the
    /// constraints; what names a circle goes with it.
    pub(super) fn affected(
        &self,
        users: impl Iterator<Item = User>,
    ) -> (Vec<ParameterId>, Vec<ConstraintId>) {
        let mut finished: Vec<ParameterId> = Vec::new();
        let mut constraints: BTreeSet<ConstraintId> = BTreeSet::new();
        let mut is_seen = vec![false; self.parameters.n_handles()];
        // Depth first: a parameter is finished after all its users, so that the reverse order
        // is the order of evaluation.
        let mut stack: Vec<(Option<ParameterId>, Vec<User>)> = vec![(None, users.collect())];
        while let Some((at, users)) = stack.last_mut() {
            match users.pop() {
                None => {
                    finished.extend(*at);
                    stack.pop();
                }
                Some(User::Constraint(c)) => {
                    if constraints.insert(c) {
                        let further: Vec<User> = self.dependencies.member_users(c).collect();
                        users.extend(further);
                    }
                }
                // They are looked at frame by frame.
                Some(User::Measure(_)) => {}
                Some(User::Parameter(p)) => {
                    if !std::mem::replace(&mut is_seen[p.idx()], true) {
                        stack.push((Some(p), self.dependencies.users(p).collect()));
                    }
                }
            }
        }
        finished.reverse();
        (finished, constraints.into_iter().collect())
    }

    /// Evaluates live parameters and driven constraints anew, for the time and the pose as
    /// they are now.
    ///
    /// # Errors
    /// Where an expression has no value, or one that its constraint cannot have.
    pub fn refresh(&mut self) -> Result<(), Diagnostic> {
        self.dependencies.note_change();
        self.sort_parameters();
        self.sort_constraints();
        if self.dependencies.is_idle() {
            return Ok(());
        }
        self.refresh_parameters();
        if let Some(why) = self.dependencies.first_failure() {
            return Err(why.clone());
        }
        self.refresh_constraints(|dependencies| dependencies.driven())
    }

    /// Evaluates driven constraints anew for the pose as it is now, whether or not parameters that
    /// drive none have a value.
    ///
    /// # Errors
    /// Where an expression has no value now, or one that its constraint cannot have.
    pub fn refresh_driven(&mut self) -> Result<(), Diagnostic> {
        self.dependencies.note_change();
        self.refresh_parameters();
        self.sort_constraints();
        self.refresh_constraints(|dependencies| dependencies.driven())
    }

    /// Evaluates live parameters anew if time or points changed; one that has no value now
    /// fails who mentions it. Constraints keep their values: looking at a parameter never
    /// changes a run.
    pub(super) fn refresh_parameters(&mut self) {
        self.sort_parameters();
        if !self.dependencies.take_stale() {
            return;
        }
        self.dependencies.forget_failures();
        for k in 0..self.dependencies.order().len() {
            let id = self.dependencies.order()[k];
            let parameter = self.parameter(id).expect("a listed parameter lives");
            if parameter.depends.on_rates {
                continue;
            }
            let value = parameter.formula.evaluate(&Here::new(self, None));
            let parameter = self.parameters.get_mut(id.idx()).expect("a listed parameter lives");
            parameter.value = value.as_ref().ok().copied();
            let waits = parameter.depends.on_measures;
            if let Err(why) = value
                && !waits
            {
                self.dependencies.fail(id, why);
            }
        }
    }

    /// Evaluates anew what the angles of motors drive, once these have turned.
    ///
    /// # Errors
    /// Where an expression has no value at these angles.
    pub(super) fn refresh_turned(&mut self) -> Result<(), Diagnostic> {
        if self.dependencies.turned().is_empty() {
            return Ok(());
        }
        self.dependencies.note_change();
        self.refresh_parameters();
        self.refresh_constraints(|dependencies| dependencies.turned())
    }

    /// Evaluates those of a list anew; doing so changes no list.
    fn refresh_constraints(
        &mut self,
        list: impl Fn(&Dependencies) -> &[ConstraintId],
    ) -> Result<(), Diagnostic> {
        for k in 0..list(&self.dependencies).len() {
            self.refresh_constraint(list(&self.dependencies)[k])?;
        }
        Ok(())
    }

    fn refresh_constraint(&mut self, id: ConstraintId) -> Result<(), Diagnostic> {
        let mut is_changed = false;
        let n_live = self.constraint(id).expect("a listed constraint lives").live().len();
        for k in 0..n_live {
            let (field, formula) = &self.constraint(id).expect("it lives").live()[k];
            let field = *field;
            let value = formula.evaluate(&Here::new(self, None))?;
            let constraint = self.constraint_state_mut(id);
            let value = given(field, value);
            is_changed |= constraint.get(field).is_some_and(|old| value.to_bits() != old.to_bits());
            constraint.set(field, value);
        }
        if is_changed {
            self.touched.values.push(id);
            if let Some(flaw) = self.constraint(id).expect("it lives").flaw() {
                return Err(flaw);
            }
        }
        Ok(())
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
        self.refresh_parameters();
        self.sort_constraints();
        let moving = Moving::new(self, rates);
        let mut all = Vec::new();
        for &id in self.dependencies.driven() {
            let record = self.constraint(id).expect("a listed constraint lives");
            for (field, formula) in record.live() {
                let value = formula.evaluate(&moving)?;
                all.push((id, *field, given(*field, value)));
            }
        }
        Ok(all)
    }
}

impl Record {
    /// Puts the present values of its live expressions into the constraint.
    pub(super) fn drive(&mut self, here: &Here) -> Result<(), Diagnostic> {
        for k in 0..self.live().len() {
            let (field, ref formula) = self.live()[k];
            let value = formula.evaluate(here)?;
            let value = given(field, value);
            self.constraint.set(field, value);
        }
        Ok(())
    }
}

/// The number that a value gives to a field: the value, or the coordinate of it that the field is.
pub(super) fn given<T: Real>(field: Field, value: Value<T>) -> T {
    match (field, value) {
        (Field::X | Field::Value, Value::Vector(v)) => v.x,
        (Field::Y | Field::ValueY, Value::Vector(v)) => v.y,
        (_, value) => value.number(),
    }
}
