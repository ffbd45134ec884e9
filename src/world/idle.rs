//! Edits that would change nothing.

use super::{Edit, Parameter, Record, Value, World};
use crate::constraint::{Point, Relation};

impl World {
    /// Whether an edit would leave everything as it is. Says no where that is not seen at once.
    pub fn is_already(&self, edit: &Edit) -> bool {
        match edit {
            Edit::Move(id, at) => same_place(&self.points.at(*id), at),
            Edit::Start(id, at) => same_place(&self.points.start(*id), at),
            Edit::Freeze(id, is_frozen) => self.points.is_frozen(*id) == *is_frozen,
            Edit::Weight(id, weight) => self.points.weight(*id) == *weight,
            Edit::Switch(id, is_on) => self.constraint(*id).is_some_and(|r| r.is_on == *is_on),
            Edit::Constraint(id, Some(then)) => {
                self.constraint(*id).is_some_and(|now| is_same_record(now, then))
            }
            Edit::Parameter(id, Some(then)) => {
                self.parameter(*id).is_some_and(|now| is_same_number(now, then))
            }
            Edit::Clock(clock) => **clock == self.clock,
            Edit::StartState(id, state) => {
                self.start_states.get(id).map(Vec::as_slice) == state.as_deref()
            }
            Edit::StartStates(states) => **states == self.start_states,
            Edit::Motion(motion) => self.is_at(motion),
            _ => false,
        }
    }
}

/// The same to the bit: 0 and -0 differ.
pub(super) fn same_place(a: &Point, b: &Point) -> bool {
    [a.x.to_bits(), a.y.to_bits()] == [b.x.to_bits(), b.y.to_bits()]
}

/// A record that stays in being keeps its name; one with live values counts as changed.
fn is_same_record(a: &Record, b: &Record) -> bool {
    let is_plain = a.drivers().is_empty() && b.drivers().is_empty();
    let is_same_state = || a.constraint.state() == b.constraint.state();
    is_plain
        && (a.is_on, a.rho()) == (b.is_on, b.rho())
        && a.constraint == b.constraint
        && is_same_state()
}

fn is_same_number(a: &Parameter, b: &Parameter) -> bool {
    let is_fixed = |p: &Parameter| p.formula.depends().is_constant() && p.depends.is_constant();
    let number = |p: &Parameter| match p.value {
        Some(Value::Number(number)) => Some(number.to_bits()),
        _ => None,
    };
    is_fixed(a) && is_fixed(b) && number(a).is_some() && number(a) == number(b)
}
