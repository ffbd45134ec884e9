//! Constraints and parameters as the user made them, kept apart from what the solver runs on.

use std::rc::Rc;

use super::{ConstraintId, Depends, Formula, ParameterId, Value};
use crate::constraint::{Constraint, Field};

/// A constraint with its name and what drives its values.
#[derive(Debug, Clone)]
pub struct Record {
    /// Its name.
    pub name: Rc<str>,
    /// The relation, over handles of points, with its values as of now.
    pub constraint: Constraint,
    /// The live expressions behind some of its values.
    pub drivers: Vec<(Field, Formula)>,
    /// Whether it is in the active list.
    pub is_on: bool,
    /// The paper's rho of this constraint alone.
    pub rho: Option<f64>,
}

impl Record {
    /// The expression behind a value, if it is live.
    pub fn driver(&self, field: Field) -> Option<&Formula> {
        self.drivers.iter().find(|(f, _)| *f == field).map(|(_, formula)| formula)
    }
}

/// A named value.
#[derive(Debug, Clone)]
pub struct Parameter {
    /// Its name.
    pub name: Rc<str>,
    /// What it stands for.
    pub formula: Formula,
    /// The value now; none while it needs velocities, which are computed when asked for.
    pub value: Option<Value>,
    /// What can change it, its own parameters included.
    pub depends: Depends,
}

/// Rows by handle, in order of creation.
#[derive(Debug, Clone)]
pub(super) struct Table<T>(Vec<Option<T>>);

impl<T> Default for Table<T> {
    fn default() -> Self {
        Self(Vec::new())
    }
}

impl<T> Table<T> {
    pub fn n_handles(&self) -> usize {
        self.0.len()
    }

    pub fn get(&self, idx: usize) -> Option<&T> {
        self.0.get(idx).and_then(Option::as_ref)
    }

    pub fn get_mut(&mut self, idx: usize) -> Option<&mut T> {
        self.0.get_mut(idx).and_then(Option::as_mut)
    }

    pub fn iter(&self) -> impl DoubleEndedIterator<Item = (usize, &T)> {
        self.0.iter().enumerate().filter_map(|(k, row)| row.as_ref().map(|row| (k, row)))
    }

    /// Puts a row in a place, or empties it; gives what was there.
    pub fn swap(&mut self, idx: usize, row: Option<T>) -> Option<T> {
        if idx >= self.0.len() {
            self.0.resize_with(idx + 1, || None);
        }
        std::mem::replace(&mut self.0[idx], row)
    }
}

/// What follows when a parameter changes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Dependent {
    /// A parameter whose expression mentions it.
    Parameter(ParameterId),
    /// A constraint with a value whose expression mentions it.
    Constraint(ConstraintId),
}
