//! How two wheels are geared: by the ratio of their radii, or by their numbers of teeth.

use super::content::add_all;
use crate::constraint::{Field, Flag, Flaw, Given};

/// The second wheel over the first.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Gearing {
    /// Of the radii; negative where one wheel runs inside the other.
    ratio: f64,
    /// The teeth of both, where it was said by these.
    teeth: Option<Teeth>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct Teeth {
    first: f64,
    second: f64,
    is_inside: bool,
}

/// More teeth than this are a slip; up to here a ratio tells the numbers to which it reduces.
const MOST_TEETH: f64 = 1e5;

impl Teeth {
    fn ratio(self) -> f64 {
        let ratio = self.second / self.first;
        if self.is_inside { -ratio } else { ratio }
    }
}

fn is_number_of_teeth(n: f64) -> bool {
    (1.0..=MOST_TEETH).contains(&n) && n.fract() == 0.0
}

impl Gearing {
    /// By the ratio of the radii.
    pub const fn of(ratio: f64) -> Self {
        Self { ratio, teeth: None }
    }

    /// As a statement says; teeth before a ratio.
    pub fn given(given: &Given) -> Self {
        let is_inside = given.has(Flag::Inside);
        let teeth = [Field::FirstTeeth, Field::SecondTeeth].map(|field| given.value(field));
        if let [Some(first), Some(second)] = teeth {
            let teeth = Teeth { first, second, is_inside };
            return Self { ratio: teeth.ratio(), teeth: Some(teeth) };
        }
        let ratio = given.value(Field::Ratio).unwrap_or_default();
        Self::of(if is_inside { -ratio.abs() } else { ratio })
    }

    /// The second radius over the first, negative where one wheel runs inside the other.
    pub const fn ratio(&self) -> f64 {
        self.ratio
    }

    /// See [`crate::constraint::ConstraintKind::get`].
    pub fn get(&self, field: Field) -> Option<f64> {
        match field {
            Field::Ratio => Some(self.ratio),
            Field::FirstTeeth => self.teeth.map(|teeth| teeth.first),
            Field::SecondTeeth => self.teeth.map(|teeth| teeth.second),
            _ => None,
        }
    }

    /// See [`crate::constraint::ConstraintKind::set`]; another ratio puts teeth aside.
    pub fn set(&mut self, field: Field, value: f64) -> bool {
        match (field, &mut self.teeth) {
            (Field::Ratio, _) => *self = Self::of(value),
            (Field::FirstTeeth, Some(teeth)) => teeth.first = value,
            (Field::SecondTeeth, Some(teeth)) => teeth.second = value,
            _ => return false,
        }
        // With a flaw it keeps a ratio that is one.
        if let Some(teeth) = self.teeth.filter(|_| self.flaw().is_none()) {
            self.ratio = teeth.ratio();
        }
        true
    }

    /// What its statement has to say besides: a negative ratio says it itself.
    pub fn flags(&self) -> &'static [Flag] {
        if self.teeth.is_some_and(|teeth| teeth.is_inside) { &[Flag::Inside] } else { &[] }
    }

    /// What is wrong with it.
    pub fn flaw(&self) -> Option<Flaw> {
        match self.teeth {
            Some(teeth) if !is_number_of_teeth(teeth.first) => Some(Flaw::FirstTeeth),
            Some(teeth) if !is_number_of_teeth(teeth.second) => Some(Flaw::SecondTeeth),
            _ => (self.ratio == 0.0).then_some(Flaw::ZeroRatio),
        }
    }

    /// The bits of the ratio, from which all else follows.
    pub fn content(&self, word: &mut impl FnMut(u64)) {
        let Self { ratio, teeth: _ } = self;
        add_all([*ratio], word);
    }
}
