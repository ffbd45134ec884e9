//! The one namespace of points, constraints and parameters.

use std::collections::BTreeSet;
use std::hash::{BuildHasher, Hasher};

use rustc_hash::{FxBuildHasher, FxHashMap};

use super::{ConstraintId, Entity, ParameterId, PointId, World};
use crate::diag::push_integer;

/// Who has which name. The texts lie with those who have them.
#[derive(Debug, Clone, Copy)]
pub struct Names<'a>(pub(super) &'a World);

impl<'a> Names<'a> {
    /// What has this name.
    pub fn get(self, name: &str) -> Option<Entity> {
        self.0.index.find(name, |entity| self.0.word_of(entity).as_bytes() == name.as_bytes())
    }

    /// Whether names `name.something` exist.
    pub fn is_instance(self, name: &str) -> bool {
        self.0.index.instances.contains_key(name)
    }

    /// Whether nothing and no instance has this name.
    pub fn is_free(self, name: &str) -> bool {
        self.get(name).is_none() && !self.is_instance(name)
    }

    /// All names: of points, of constraints, of parameters, each in order of creation.
    pub fn iter(self) -> impl Iterator<Item = (&'a str, Entity)> {
        let world = self.0;
        let points = world.points().ids().map(Entity::Point);
        let constraints = world.constraints().map(|(id, _)| Entity::Constraint(id));
        let parameters = world.parameters().map(|(id, _)| Entity::Parameter(id));
        let all = points.chain(constraints).chain(parameters);
        all.map(|entity| (world.name_of(entity), entity))
    }

    /// The names of instances, in no order that means anything.
    pub fn instances(self) -> impl Iterator<Item = &'a str> {
        self.0.index.instances.keys().map(|name| &**name)
    }

    /// What has a name that begins with `instance.`, each sort in order of creation.
    pub fn members(self, instance: &str) -> impl Iterator<Item = Entity> {
        self.0.index.instances.get(instance).into_iter().flatten().copied()
    }
}

impl World {
    /// The first of `{stem}1`, `{stem}2`, ... that is free. A function of what is taken now,
    /// so that a loaded world goes on numbering as the saved one would have.
    pub fn numbered_name(&mut self, stem: &str) -> String {
        let mut number = self.index.numbered.get(stem).copied().unwrap_or(1);
        let mut name = String::with_capacity(stem.len() + 8);
        name.push_str(stem);
        loop {
            name.truncate(stem.len());
            push_integer(&mut name, i64::from(number));
            if self.names().is_free(&name) {
                break;
            }
            number += 1;
        }
        match self.index.numbered.get_mut(stem) {
            Some(hint) => *hint = number,
            None => drop(self.index.numbered.insert(stem.into(), number)),
        }
        name
    }
}

/// Finds what has a name by the hash of the name: a table with open places, looked through from
/// the place that the hash says up to the first empty one.
#[derive(Debug, Clone, Default)]
pub(super) struct Index {
    /// A power of two of them, or none.
    places: Vec<Place>,
    n_taken: usize,
    /// What has names that begin with this prefix and a dot: an instance of a definition.
    instances: FxHashMap<Box<str>, BTreeSet<Entity>>,
    /// Under `prefix` + word, a number below which every numbered name is taken.
    numbered: FxHashMap<Box<str>, u32>,
}

/// A place of the table: the sort in the two highest bits of `code`, the handle below.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Place {
    hash: u32,
    code: u32,
}

impl Place {
    const EMPTY: Self = Self { hash: 0, code: u32::MAX };

    fn new(hash: u32, entity: Entity) -> Self {
        let (sort, id) = match entity {
            Entity::Point(id) => (0, id.0),
            Entity::Constraint(id) => (1, id.0),
            Entity::Parameter(id) => (2, id.0),
        };
        assert!(id < 1 << 30, "a world holds fewer than 2^30 of a kind");
        Self { hash, code: sort << 30 | id }
    }

    fn entity(self) -> Option<Entity> {
        let id = self.code & ((1 << 30) - 1);
        match self.code >> 30 {
            0 => Some(Entity::Point(PointId(id))),
            1 => Some(Entity::Constraint(ConstraintId(id))),
            2 => Some(Entity::Parameter(ParameterId(id))),
            _ => None,
        }
    }
}

impl Index {
    /// The first that `is_it` among those with the hash of this name.
    fn find(&self, name: &str, is_it: impl Fn(Entity) -> bool) -> Option<Entity> {
        let hash = hash_of(name);
        self.places[self.position(hash, is_it)?].entity()
    }

    fn position(&self, hash: u32, is_it: impl Fn(Entity) -> bool) -> Option<usize> {
        let last = self.places.len().checked_sub(1)?;
        let mut k = hash as usize & last;
        while self.places[k] != Place::EMPTY {
            if self.places[k].hash == hash && self.places[k].entity().is_some_and(&is_it) {
                return Some(k);
            }
            k = (k + 1) & last;
        }
        None
    }

    fn put(&mut self, new: Place) {
        let last = self.places.len() - 1;
        let mut k = new.hash as usize & last;
        while self.places[k] != Place::EMPTY {
            k = (k + 1) & last;
        }
        self.places[k] = new;
    }

    /// Gives a free name to an entity.
    pub fn insert(&mut self, name: &str, entity: Entity) {
        // A quarter stays empty, so that a search is short.
        if 4 * (self.n_taken + 1) > 3 * self.places.len() {
            let room = (2 * self.places.len()).max(16);
            let old = std::mem::replace(&mut self.places, vec![Place::EMPTY; room]);
            let taken = old.into_iter().filter(|place| *place != Place::EMPTY);
            taken.for_each(|place| self.put(place));
        }
        self.n_taken += 1;
        self.put(Place::new(hash_of(name), entity));
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
        let last = self.places.len() - 1;
        // What would no longer be found beyond the hole moves into it.
        let mut k = hole;
        loop {
            k = (k + 1) & last;
            let place = self.places[k];
            if place == Place::EMPTY {
                break;
            }
            let is_before_hole =
                (k.wrapping_sub(place.hash as usize) & last) >= (k.wrapping_sub(hole) & last);
            if is_before_hole {
                self.places[hole] = place;
                hole = k;
            }
        }
        self.places[hole] = Place::EMPTY;
        for dot in dots(name) {
            if let Some(members) = self.instances.get_mut(&name[..dot]) {
                members.remove(&entity);
                if members.is_empty() {
                    self.instances.remove(&name[..dot]);
                }
            }
        }
        let stem = name.trim_end_matches(|c: char| c.is_ascii_digit());
        if stem.len() < name.len()
            && let Some(hint) = self.numbered.get_mut(stem)
        {
            *hint = name[stem.len()..].parse().map_or(*hint, |number: u32| number.min(*hint));
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::constraint::Point;
    use crate::world::{Edit, PointRecord};

    fn add(world: &mut World, name: &str) -> PointId {
        let id = world.next_point();
        let (at, start) = (Point::ORIGIN, Point::ORIGIN);
        let record = PointRecord { name: name.into(), at, start, is_frozen: false, weight: 1.0 };
        world.apply(Edit::Point(id, Some(Box::new(record))));
        id
    }

    #[test]
    fn numbers_fill_the_first_gap() {
        let mut world = World::new();
        let mut ids = Vec::new();
        for k in 1..=3 {
            let name = world.numbered_name("length");
            assert_eq!(name, format!("length{k}"));
            ids.push(add(&mut world, &name));
        }
        world.apply(Edit::Point(ids[1], None));
        assert_eq!(world.numbered_name("length"), "length2");
    }

    #[test]
    fn an_instance_lives_as_long_as_its_members() {
        let mut world = World::new();
        let id = add(&mut world, "left.P");
        assert!(world.names().is_instance("left") && !world.names().is_free("left"));
        assert_eq!(world.names().members("left").collect::<Vec<_>>(), [Entity::Point(id)]);
        world.apply(Edit::Point(id, None));
        assert!(world.names().is_free("left"));
    }

    #[test]
    fn names_are_found_however_many_come_and_go() {
        let mut world = World::new();
        let ids: Vec<PointId> = (0..3000).map(|k| add(&mut world, &format!("p[{k}]"))).collect();
        for (k, &id) in ids.iter().enumerate().filter(|(k, _)| k % 3 != 1) {
            assert_eq!(world.names().get(&format!("p[{k}]")), Some(Entity::Point(id)));
            world.apply(Edit::Point(id, None));
        }
        for (k, &id) in ids.iter().enumerate() {
            let wanted = (k % 3 == 1).then_some(Entity::Point(id));
            assert_eq!(world.names().get(&format!("p[{k}]")), wanted);
        }
        assert_eq!(world.names().iter().count(), 1000);
    }
}
