//! Values that a frame changed, taken in by each island when it is visited: all that is asked of it is
//! then at hand once.

use crate::world::ConstraintId;

/// No value.
const NONE: u32 = u32::MAX;

/// A constraint, and its local index in its island.
pub(super) type Local = (ConstraintId, usize);

/// The constraints whose values changed, by island.
#[derive(Debug, Default)]
pub(super) struct Delayed {
    /// Each with the place of the next of its island.
    constraints: Vec<(Local, u32)>,
    /// By island the places of the first and the last.
    ends: Vec<[u32; 2]>,
}

impl Delayed {
    /// Values of a constraint in an island changed.
    pub fn push(&mut self, island: u32, constraint: Local) {
        let (k, at) = (island as usize, self.constraints.len() as u32);
        if k >= self.ends.len() {
            self.ends.resize(k + 1, [NONE; 2]);
        }
        match &mut self.ends[k] {
            [first, last] if *first != NONE => {
                self.constraints[*last as usize].1 = at;
                *last = at;
            }
            ends => *ends = [at; 2],
        }
        self.constraints.push((constraint, NONE));
    }

    /// The constraints of an island, in the order in which they came; each is given once.
    pub fn pop(&mut self, island: u32) -> Option<Local> {
        let [first, _] = self.ends.get_mut(island as usize)?;
        let (constraint, next) = *self.constraints.get(*first as usize)?;
        *first = next;
        Some(constraint)
    }

    /// All of them were given, or are none any more.
    pub fn clear(&mut self) {
        if !self.constraints.is_empty() {
            self.constraints.clear();
            self.ends.fill([NONE; 2]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_island_gets_its_own_in_their_order() {
        let mut delayed = Delayed::default();
        for (island, constraint) in [(2, 7), (0, 1), (2, 3), (2, 9)] {
            delayed.push(island, (ConstraintId(constraint), 0));
        }
        let mut all = |island| {
            let given = std::iter::from_fn(|| delayed.pop(island));
            given.map(|(it, _)| it.0).collect::<Vec<_>>()
        };
        assert_eq!([2, 0, 1, 2, 5].map(&mut all), [vec![7, 3, 9], vec![1], vec![], vec![], vec![]]);
        delayed.push(0, (ConstraintId(4), 0));
        delayed.clear();
        assert_eq!(delayed.pop(0), None);
    }
}
