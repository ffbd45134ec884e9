//! The lengths that steps keep to, which may change from frame to frame.

use crate::constraint::{self, Constraint, PointIdx};
use crate::solve::island::inputs::Inputs;

/// The values of an island's constraints in a frame, and what they were before it.
pub(super) struct Values<'a> {
    pub constraints: &'a [Constraint],
    /// What drives the frame; none where no length changes.
    pub inputs: Option<&'a Inputs>,
}

/// A length.
#[derive(Clone, Copy)]
pub(super) struct Length {
    /// At the end of the frame.
    pub now: f64,
    /// By how much it changed in the frame, at most.
    pub changed: f64,
    /// The bar that says it; none where it follows from those of a body.
    bar: Option<u32>,
}

impl Length {
    /// One that stays.
    pub fn fixed(now: f64) -> Self {
        Self { now, changed: 0.0, bar: None }
    }

    /// That of a bar, which is the constraint of number `c`.
    pub fn of_bar(now: f64, c: u32) -> Self {
        Self { now, changed: 0.0, bar: Some(c) }
    }

    /// The bar that says it.
    pub fn bar(&self) -> Option<u32> {
        self.bar
    }

    /// Whether it is one.
    pub fn is_sound(&self) -> bool {
        let square = self.now * self.now;
        self.now > 0.0 && square > 0.0 && square.is_finite()
    }

    /// Takes in how long it is in a frame. What is no length is not a number.
    pub fn drive(&mut self, values: &Values) {
        let Some(c) = self.bar else { return };
        let now = bar(&values.constraints[c as usize]).map_or(f64::NAN, |(_, length)| length);
        let before = values.inputs.into_iter().flat_map(|inputs| inputs.values_before(c));
        // The way there leads from each to the next, and from the last to here.
        let change = |before: &Constraint| match bar(before) {
            Some((_, before)) => (now - before).abs(),
            None => f64::NAN,
        };
        (self.now, self.changed) = (now, before.map(change).sum());
    }
}

/// The ends and the length of a bar.
pub(super) fn bar(constraint: &Constraint) -> Option<([PointIdx; 2], f64)> {
    match constraint {
        Constraint::Length(constraint::Length { points: [a, b], bounds }) => {
            let is_bar = bounds.is_equality() && bounds.lo > 0.0 && a != b;
            is_bar.then_some(([*a, *b], bounds.lo))
        }
        _ => None,
    }
}
