//! The interval a measured value has to lie in: `c1 <= f <= c2` (section 2 of the paper).

use super::content::add_all;
use crate::constraint::{Field, Real};

/// A closed interval; an equality is an interval of width 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    /// The least value allowed; minus infinity for none.
    pub lo: f64,
    /// The greatest value allowed; infinity for none.
    pub hi: f64,
}

impl Bounds {
    /// The value itself and nothing else.
    pub const fn exactly(value: f64) -> Self {
        Self { lo: value, hi: value }
    }

    /// Whether this is an equality, so that its row is active whatever the pose.
    pub fn is_equality(self) -> bool {
        self.lo == self.hi
    }

    /// The value nearest to `f` that is allowed. Bounds that cross allow their middle.
    pub fn clamp(self, f: f64) -> f64 {
        if self.lo > self.hi {
            return 0.5 * (self.lo + self.hi);
        }
        f.max(self.lo).min(self.hi)
    }

    /// How far `f` lies outside; 0 inside.
    pub fn excess(self, f: f64) -> f64 {
        f - self.clamp(f)
    }

    /// The same over any number type.
    pub(crate) fn excess_of<T: Real>(self, f: T, field: &impl Fn(Field, f64) -> T) -> T {
        if self.is_equality() || f.value() < self.lo {
            f - field(Field::Lo, self.lo)
        } else if f.value() > self.hi {
            f - field(Field::Hi, self.hi)
        } else {
            T::constant(0.0)
        }
    }

    /// The bits of both ends.
    pub(crate) fn content(self, word: &mut impl FnMut(u64)) {
        let Self { lo, hi } = self;
        add_all([lo, hi], word);
    }

    /// The end an expression drives; none for other fields.
    pub fn get(self, field: Field) -> Option<f64> {
        match field {
            Field::Lo => Some(self.lo),
            Field::Hi => Some(self.hi),
            _ => None,
        }
    }

    /// Sets one end; false for fields that are not ends.
    pub fn set(&mut self, field: Field, value: f64) -> bool {
        match field {
            Field::Lo => self.lo = value,
            Field::Hi => self.hi = value,
            _ => return false,
        }
        true
    }
}
