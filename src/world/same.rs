//! What is the same to the bit: 0 and -0 differ.

use std::collections::BTreeMap;

use super::{ConstraintId, Parameter, Record, Value};
use crate::constraint::{Constraint, ConstraintKind, Point};

/// By constraint, the numbers that running changes of it.
pub(super) type States = BTreeMap<ConstraintId, Vec<f64>>;

/// The bits of some numbers.
pub(super) fn bits(numbers: &[f64]) -> Vec<u64> {
    numbers.iter().map(|number| number.to_bits()).collect()
}

/// Whether two points are in the same place.
pub(crate) fn same_place(a: &Point, b: &Point) -> bool {
    [a.x.to_bits(), a.y.to_bits()] == [b.x.to_bits(), b.y.to_bits()]
}

/// Whether two lists are of the same places.
pub(super) fn are_same_places(a: &[Point], b: &[Point]) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| same_place(a, b))
}

/// Whether the same constraints are in the same states.
pub(super) fn are_same_states(a: &States, b: &States) -> bool {
    let is_same = |((i, a), (j, b)): ((_, &Vec<f64>), (_, &Vec<f64>))| i == j && bits(a) == bits(b);
    a.len() == b.len() && a.iter().zip(b).all(is_same)
}

/// Whether two records say the same. One that stays in being keeps its name; one with live values
/// counts as changed.
pub(super) fn is_same_record(a: &Record, b: &Record) -> bool {
    let is_plain = a.drivers().is_empty() && b.drivers().is_empty();
    is_plain
        && (a.is_on, a.rho()) == (b.is_on, b.rho())
        && is_same_constraint(&a.constraint, &b.constraint)
}

/// Whether two constraints are the same to the bit.
pub(super) fn is_same_constraint(a: &Constraint, b: &Constraint) -> bool {
    a == b && content(a) == content(b)
}

/// The bits of all of a constraint but its points.
fn content(constraint: &Constraint) -> Vec<u64> {
    let mut words = Vec::new();
    constraint.content(&mut |word| words.push(word));
    words
}

/// Whether two parameters that nothing changes have the same number.
pub(super) fn is_same_number(a: &Parameter, b: &Parameter) -> bool {
    let is_fixed = |p: &Parameter| p.formula.depends().is_constant() && p.depends.is_constant();
    let number = |p: &Parameter| match p.value {
        Some(Value::Number(number)) => Some(number.to_bits()),
        _ => None,
    };
    is_fixed(a) && is_fixed(b) && number(a).is_some() && number(a) == number(b)
}
