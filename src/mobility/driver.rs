//! What drives a mechanism: a number that values of its constraints follow.

use std::collections::BTreeSet;

use crate::constraint::{Constraint, ConstraintKind, Field, Flaw, Jet, Point, Real, Vec2};

/// A value of a constraint as a driver sets it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Driven {
    /// The constraint, by its place in the scene.
    pub constraint: usize,
    /// Which of its values.
    pub field: Field,
    /// What it is, with its derivatives by the driver.
    pub value: Jet,
}

/// A number that values of constraints follow.
pub struct Driver<'a> {
    /// The constraints with such values, by their places in the scene.
    pub constraints: BTreeSet<usize>,
    /// What it is now.
    pub now: f64,
    /// Whether it is an angle, radians: a whole turn more leads to the same values.
    pub is_angle: bool,
    /// What the values are for a driver that is so much more than now, constraint by constraint;
    /// none where they have none.
    values: Box<dyn Fn(f64) -> Option<Vec<Driven>> + 'a>,
}

impl<'a> Driver<'a> {
    /// A driver `now` of these constraints; `values` tells what their values are for one that is so
    /// much more than now, ordered as the constraints are.
    pub fn new(
        constraints: BTreeSet<usize>,
        now: f64,
        is_angle: bool,
        values: impl Fn(f64) -> Option<Vec<Driven>> + 'a,
    ) -> Self {
        Self { constraints, now, is_angle, values: Box::new(values) }
    }

    /// Values of one constraint at a place of a scene, all driven alike: both ends of an equality, or
    /// the phase of a motor.
    pub fn of_values(
        constraint: &'a Constraint,
        place: usize,
        fields: &'a [Field],
        now: f64,
        is_angle: bool,
    ) -> Self {
        let driven = move |by: f64, field: Field| {
            let value = Jet::new(constraint.get(field)? + by, 1.0, 0.0);
            Some(Driven { constraint: place, field, value })
        };
        let values = move |by| fields.iter().map(|&field| driven(by, field)).collect();
        Self::new(BTreeSet::from([place]), now, is_angle, values)
    }

    /// The values for a driver that is so much more than now.
    pub(super) fn values(&self, by: f64) -> Option<Vec<Driven>> {
        (self.values)(by)
    }
}

/// Gives a constraint values that a driver has set.
///
/// # Errors
/// What is wrong with them, if no pose could have them.
pub(super) fn set_values(constraint: &mut Constraint, driven: &[Driven]) -> Result<(), Flaw> {
    for driven in driven {
        constraint.set(driven.field, driven.value.v);
    }
    constraint.traits().flaw.map_or(Ok(()), Err)
}

/// How the rows of a constraint change with the driver of these values, at a pose.
pub(super) fn slopes(constraint: &Constraint, driven: &[Driven], x: &[Point]) -> Vec<f64> {
    let still = |p: u32| Vec2::constant(x[p as usize].to_vector());
    // Time stands still: no motor turns.
    let field = |field: Field, value: f64| match field {
        Field::Speed => Jet::constant(0.0),
        _ => driven
            .iter()
            .find(|driven| driven.field == field)
            .map_or(Jet::constant(value), |driven| Jet::new(value, driven.value.d, 0.0)),
    };
    let mut slopes = Vec::with_capacity(constraint.n_rows());
    constraint.equations(&still, &field, &mut |f: Jet| slopes.push(f.d));
    slopes
}
