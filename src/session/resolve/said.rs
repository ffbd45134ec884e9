//! What a statement says of a constraint: from the words of the language to the values of a
//! kind, and back.

use crate::constraint::{
    Bounds, Constraint, ConstraintKind as _, Field, Flag, Given, Kind, Point, PointIdx, Refusal,
    Traits,
};
use crate::lang::ast::{ConstraintWord, Role, Unit};
use crate::lang::catalogue::{Pattern, Slot};
use crate::world::Drivers;

/// What stands behind the values of a constraint.
#[derive(Default)]
pub(crate) struct Behind {
    /// The expressions of those that can change.
    pub drivers: Drivers,
    /// The units that the others are said in, where they have one.
    pub units: Vec<(Field, Unit)>,
}

/// What the parts of a statement say, looked up and evaluated.
#[derive(Default)]
pub(crate) struct Said {
    /// The points, in the groups in which they stand.
    pub groups: Vec<Vec<PointIdx>>,
    /// The interval, infinite where it is open.
    pub bounds: Option<Bounds>,
    /// The values.
    pub values: Vec<(Field, f64)>,
    /// The words that stand alone.
    pub flags: Vec<Flag>,
    /// The circles and arcs, by their handles.
    pub curves: Vec<u32>,
    /// Whether it was there before.
    pub is_restored: bool,
}

impl Said {
    /// What would have to be said to make a constraint as it is now.
    pub fn of(constraint: &Constraint) -> Self {
        let Traits { bounds, flags, .. } = constraint.traits();
        let mut points = constraint.points().iter().copied();
        let groups = pattern_of(constraint).slots.iter().filter_map(|slot| {
            let n_points = match slot {
                Slot::Points(n) => *n,
                Slot::AllPoints => usize::MAX,
                Slot::Line(_) => 2,
                Slot::Point(role) if *role != Role::On => 1,
                _ => return None,
            };
            let group: Vec<PointIdx> = points.by_ref().take(n_points).collect();
            // A line may be left out.
            (!group.is_empty()).then_some(group)
        });
        let values = Field::ALL.into_iter();
        let values = values.filter_map(|field| Some((field, constraint.get(field)?)));
        Self {
            groups: groups.collect(),
            bounds,
            values: values.collect(),
            flags: flags.to_vec(),
            curves: constraint.stated().curves().to_vec(),
            is_restored: false,
        }
    }

    /// Makes a constraint that is stated by this word, with all points at these places.
    ///
    /// # Errors
    /// Points or a pose that allow none.
    pub fn declare(&self, kind: Kind, word: &str, x: &[Point]) -> Result<Constraint, Refusal> {
        let Self { groups, bounds, values, flags, curves, is_restored } = self;
        let (bounds, is_restored) = (*bounds, *is_restored);
        kind.declare(&Given { word, groups, bounds, values, flags, curves, x, is_restored })
    }
}

/// How the statement of a constraint is written.
pub(crate) fn pattern_of(constraint: &Constraint) -> &'static Pattern {
    word_of(constraint).pattern()
}

/// The word that states a constraint.
pub(crate) fn word_of(constraint: &Constraint) -> ConstraintWord {
    ConstraintWord::named(constraint.traits().word).expect("each kind is stated by a word")
}

/// The value that a part gives.
pub(crate) fn field_of(role: Role) -> Field {
    match role {
        Role::Radius => Field::Radius,
        Role::Speed => Field::Speed,
        Role::Phase => Field::Phase,
        Role::At | Role::Ratio => Field::Ratio,
        Role::On
        | Role::To
        | Role::About
        | Role::From
        | Role::Teeth
        | Role::Inside
        | Role::Crossed
        | Role::Unbounded
        | Role::Through => {
            unreachable!("`{}` has no value", role.word())
        }
    }
}

/// The values that `teeth` gives.
pub(crate) const TEETH: [Field; 2] = [Field::FirstTeeth, Field::SecondTeeth];

/// What a word alone says.
pub(crate) fn flag_of(role: Role) -> Flag {
    match role {
        Role::Inside => Flag::Inside,
        Role::Crossed => Flag::Crossed,
        Role::Unbounded => Flag::Unbounded,
        _ => unreachable!("`{}` does not stand alone", role.word()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_word_states_a_kind() {
        for word in ConstraintWord::ALL {
            let keyword = word.pattern().entry.keyword;
            assert!(Kind::stated_by(keyword).is_some(), "{keyword}");
        }
    }
}
