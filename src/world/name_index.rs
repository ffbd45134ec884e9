//! The index of names: finds what has a name without keeping the name a second time.

use std::collections::BTreeSet;
use std::hash::{BuildHasher, Hasher};

use rustc_hash::{FxBuildHasher, FxHashMap};

use super::{ConstraintId, Entity, MeasureId, ParameterId, PointId};

/// Finds what has a name by the hash of the name: a table of slots, looked through from the
/// one that the hash says up to the first empty one.
#[derive(Debug, Clone, Default)]
pub(super) struct NameIndex {
    /// A power of two of them, or none.
    slots: Vec<Slot>,
    n_taken: usize,
    /// What has names that begin with this prefix and a dot: an instance of a definition.
    pub instances: FxHashMap<Box<str>, BTreeSet<Entity>>,
    /// Under `prefix` + word, a number below which every numbered name is taken.
    pub numbered: FxHashMap<Box<str>, u32>,
}

/// A slot of the table: the sort in the two highest bits of `code`, the handle below.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Slot {
    hash: u32,
    code: u32,
}

impl Slot {
    const EMPTY: Self = Self { hash: 0, code: u32::MAX };

    fn new(hash: u32, entity: Entity) -> Self {
        let (sort, id) = match entity {
            Entity::Point(id) => (0, id.0),
            Entity::Constraint(id) => (1, id.0),
            Entity::Parameter(id) => (2, id.0),
            Entity::Measure(id) => (3, id.0),
        };
        // The last of the last sort is the code of an empty slot.
        assert!(id < (1 << 30) - 1, "a world holds fewer than 2^30 of a kind");
        Self { hash, code: sort << 30 | id }
    }

    fn entity(self) -> Option<Entity> {
        if self == Self::EMPTY {
            return None;
        }
        let id = self.code & ((1 << 30) - 1);
        match self.code >> 30 {
            0 => Some(Entity::Point(PointId(id))),
            1 => Some(Entity::Constraint(ConstraintId(id))),
            2 => Some(Entity::Parameter(ParameterId(id))),
            _ => Some(Entity::Measure(MeasureId(id))),
        }
    }
}

impl NameIndex {
    /// How many names there are.
    pub const fn len(&self) -> usize {
        self.n_taken
    }

    /// Whether there is none.
    pub const fn is_empty(&self) -> bool {
        self.n_taken == 0
    }

    /// The first that `is_it` among those with the hash of this name.
    pub fn find(&self, name: &str, is_it: impl Fn(Entity) -> bool) -> Option<Entity> {
        let hash = hash_of(name);
        self.slots[self.position(hash, is_it)?].entity()
    }

    fn position(&self, hash: u32, is_it: impl Fn(Entity) -> bool) -> Option<usize> {
        let last = self.slots.len().checked_sub(1)?;
        let mut k = hash as usize & last;
        while self.slots[k] != Slot::EMPTY {
            if self.slots[k].hash == hash && self.slots[k].entity().is_some_and(&is_it) {
                return Some(k);
            }
            k = (k + 1) & last;
        }
        None
    }

    fn put(&mut self, new: Slot) {
        let last = self.slots.len() - 1;
        let mut k = new.hash as usize & last;
        while self.slots[k] != Slot::EMPTY {
            k = (k + 1) & last;
        }
        self.slots[k] = new;
    }

    /// Gives a free name to an entity.
    pub fn insert(&mut self, name: &str, entity: Entity) {
        // A quarter stays empty, so that a search is short.
        if 4 * (self.n_taken + 1) > 3 * self.slots.len() {
            let room = (2 * self.slots.len()).max(16);
            let old = std::mem::replace(&mut self.slots, vec![Slot::EMPTY; room]);
            let taken = old.into_iter().filter(|slot| *slot != Slot::EMPTY);
            taken.for_each(|slot| self.put(slot));
        }
        self.n_taken += 1;
        self.put(Slot::new(hash_of(name), entity));
        for dot in dots(name) {
            match self.instances.get_mut(&name[..dot]) {
                Some(members) => drop(members.insert(entity)),
                None => drop(self.instances.insert(name[..dot].into(), [entity].into())),
            }
        }
    }

    /// Takes the name of an entity away.
    pub fn remove(&mut self, name: &str, entity: Entity) {
        let Some(mut hole) = self.position(hash_of(name), |other| other == entity) else { return };
        self.n_taken -= 1;
        let last = self.slots.len() - 1;
        // What would no longer be found beyond the hole moves into it.
        let mut k = hole;
        loop {
            k = (k + 1) & last;
            let slot = self.slots[k];
            if slot == Slot::EMPTY {
                break;
            }
            let is_before_hole =
                (k.wrapping_sub(slot.hash as usize) & last) >= (k.wrapping_sub(hole) & last);
            if is_before_hole {
                self.slots[hole] = slot;
                hole = k;
            }
        }
        self.slots[hole] = Slot::EMPTY;
        for dot in dots(name) {
            let instance = &name[..dot];
            if let Some(members) = self.instances.get_mut(instance) {
                members.remove(&entity);
                if members.is_empty() {
                    self.instances.remove(instance);
                    self.free_number(instance);
                }
            }
        }
        self.free_number(name);
    }

    /// A name is free again: whoever numbers names of its stem is to try its number. Where the
    /// stem ends cannot be told from the name, `arm21` may be the first `arm2` or the twenty-first
    /// `arm`.
    fn free_number(&mut self, name: &str) {
        if self.numbered.is_empty() {
            return;
        }
        let stem = name.trim_end_matches(|c: char| c.is_ascii_digit());
        for end in stem.len()..name.len() {
            if let Some(hint) = self.numbered.get_mut(&name[..end]) {
                *hint = name[end..].parse().map_or(*hint, |number: u32| number.min(*hint));
            }
        }
    }
}

fn hash_of(name: &str) -> u32 {
    let mut hasher = FxBuildHasher.build_hasher();
    hasher.write(name.as_bytes());
    let hash = hasher.finish();
    (hash ^ (hash >> 32)) as u32
}

/// Where the dots of a name are.
fn dots(name: &str) -> impl Iterator<Item = usize> {
    name.bytes().enumerate().filter(|&(_, byte)| byte == b'.').map(|(k, _)| k)
}
