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
    /// The bar that says it; [`NONE`] where it follows from those of a body.
    bar: u32,
    /// Which of the lengths that differ from lane to lane it is; [`NONE`] where it stays.
    timed: u32,
}

/// No bar, no place.
const NONE: u32 = u32::MAX;

/// A length in each lane.
#[derive(Clone, Copy)]
pub(super) struct Timed<const N: usize> {
    /// At the end of the frame.
    pub now: [f64; N],
    /// By how much it changed in the frame, at most.
    pub changed: [f64; N],
}

impl<const N: usize> Timed<N> {
    pub const NOT: Self = Self { now: [f64::NAN; N], changed: [0.0; N] };
}

impl Length {
    /// One that stays.
    pub fn fixed(now: f64) -> Self {
        Self { now, changed: 0.0, bar: NONE, timed: NONE }
    }

    /// That of a bar, which is the constraint of number `c`.
    pub fn of_bar(now: f64, c: u32) -> Self {
        Self { now, changed: 0.0, bar: c, timed: NONE }
    }

    /// The bar that says it.
    pub fn bar(&self) -> Option<u32> {
        (self.bar != NONE).then_some(self.bar)
    }

    /// In lanes it differs between them if one of these bars, ascending, says it.
    pub fn set_timed(&mut self, bars: &[u32]) {
        self.timed = bars.binary_search(&self.bar).map_or(NONE, |k| k as u32);
    }

    /// Whether it differs between lanes.
    #[inline(always)]
    pub fn is_timed(&self) -> bool {
        self.timed != NONE
    }

    /// How long it is in each lane.
    #[inline(always)]
    pub fn each<const N: usize>(&self, lengths: &[Timed<N>]) -> Timed<N> {
        if self.is_timed() {
            lengths[self.timed as usize]
        } else {
            Timed { now: [self.now; N], changed: [self.changed; N] }
        }
    }

    /// The same in one of them.
    #[inline(always)]
    pub fn in_lane<const N: usize>(self, each: &Timed<N>, l: usize) -> Self {
        Self { now: each.now[l], changed: each.changed[l], ..self }
    }

    /// Whether it is one.
    pub fn is_sound(&self) -> bool {
        let square = self.now * self.now;
        self.now > 0.0 && square > 0.0 && square.is_finite()
    }

    /// Takes in how long it is in a frame. What is no length is not a number.
    pub fn drive(&mut self, values: &Values) {
        let Some(c) = self.bar() else { return };
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
