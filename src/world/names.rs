//! The one namespace of points, constraints and parameters.

use std::collections::BTreeSet;
use std::rc::Rc;

use rustc_hash::FxHashMap;

use super::Entity;
use crate::diag::push_integer;

/// Who has which name.
#[derive(Debug, Clone, Default)]
pub struct Names {
    of: FxHashMap<Rc<str>, Entity>,
    /// What has names that begin with this prefix and a dot: an instance of a definition.
    instances: FxHashMap<Rc<str>, BTreeSet<Entity>>,
    /// Under `prefix` + word, a number below which every numbered name is taken.
    numbered: FxHashMap<Box<str>, u32>,
}

impl Names {
    /// What has this name.
    pub fn get(&self, name: &str) -> Option<Entity> {
        self.of.get(name).copied()
    }

    /// Whether names `name.something` exist.
    pub fn is_instance(&self, name: &str) -> bool {
        self.instances.contains_key(name)
    }

    /// Whether nothing and no instance has this name.
    pub fn is_free(&self, name: &str) -> bool {
        !self.of.contains_key(name) && !self.is_instance(name)
    }

    /// All names, in no order that means anything.
    pub fn iter(&self) -> impl Iterator<Item = (&str, Entity)> {
        self.of.iter().map(|(name, &entity)| (&**name, entity))
    }

    /// The names of instances, in no order that means anything.
    pub fn instances(&self) -> impl Iterator<Item = &str> {
        self.instances.keys().map(|name| &**name)
    }

    /// The first of `{stem}1`, `{stem}2`, ... that is free. A function of what is taken now,
    /// so that a loaded world goes on numbering as the saved one would have.
    pub fn numbered(&mut self, stem: &str) -> String {
        let mut number = self.numbered.get(stem).copied().unwrap_or(1);
        let mut name = String::with_capacity(stem.len() + 8);
        name.push_str(stem);
        loop {
            name.truncate(stem.len());
            push_integer(&mut name, i64::from(number));
            if self.is_free(&name) {
                break;
            }
            number += 1;
        }
        match self.numbered.get_mut(stem) {
            Some(hint) => *hint = number,
            None => drop(self.numbered.insert(stem.into(), number)),
        }
        name
    }

    /// What has a name that begins with `instance.`, each sort in order of creation.
    pub fn members(&self, instance: &str) -> impl Iterator<Item = Entity> {
        self.instances.get(instance).into_iter().flatten().copied()
    }

    /// Gives a free name to an entity.
    pub(super) fn insert(&mut self, name: Rc<str>, entity: Entity) {
        for dot in dots(&name) {
            match self.instances.get_mut(&name[..dot]) {
                Some(members) => drop(members.insert(entity)),
                None => drop(self.instances.insert(name[..dot].into(), [entity].into())),
            }
        }
        let taken = self.of.insert(name, entity);
        debug_assert!(taken.is_none(), "a name was given twice");
    }

    /// Frees a name.
    pub(super) fn remove(&mut self, name: &str) {
        let Some(entity) = self.of.remove(name) else { return };
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

/// Where the dots of a name are.
fn dots(name: &str) -> impl Iterator<Item = usize> {
    name.bytes().enumerate().filter(|&(_, byte)| byte == b'.').map(|(k, _)| k)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::world::PointId;

    #[test]
    fn numbers_fill_the_first_gap() {
        let mut names = Names::default();
        for k in 1..=3 {
            let name = names.numbered("length");
            assert_eq!(name, format!("length{k}"));
            names.insert(name.into(), Entity::Point(PointId(k)));
        }
        names.remove("length2");
        assert_eq!(names.numbered("length"), "length2");
    }

    #[test]
    fn an_instance_lives_as_long_as_its_members() {
        let mut names = Names::default();
        names.insert("left.P".into(), Entity::Point(PointId(0)));
        assert!(names.is_instance("left") && !names.is_free("left"));
        names.remove("left.P");
        assert!(names.is_free("left"));
    }
}
