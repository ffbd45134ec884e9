//! The one namespace of points, constraints, parameters and measures.

use super::{Entity, World};
use crate::diag::push_integer;

/// Who has which name. The texts lie with those who have them.
#[derive(Debug, Clone, Copy)]
pub struct Namespace<'a>(&'a World);

impl<'a> Namespace<'a> {
    /// What has this name.
    pub fn get(self, name: &str) -> Option<Entity> {
        self.0.index.find(name, |entity| self.0.name_text_of(entity).as_bytes() == name.as_bytes())
    }

    /// Whether names `name.something` exist.
    pub fn is_instance(self, name: &str) -> bool {
        self.0.index.instances.contains_key(name)
    }

    /// Whether nothing and no instance has this name.
    pub fn is_free(self, name: &str) -> bool {
        self.get(name).is_none() && !self.is_instance(name)
    }

    /// All names: of points, of constraints, of parameters, of measures, each in order of creation.
    pub fn iter(self) -> impl Iterator<Item = (&'a str, Entity)> {
        let world = self.0;
        let points = world.points().ids().map(Entity::Point);
        let constraints = world.constraints().map(|(id, _)| Entity::Constraint(id));
        let parameters = world.parameters().map(|(id, _)| Entity::Parameter(id));
        let measures = world.measures().map(|(id, _)| Entity::Measure(id));
        let all = points.chain(constraints).chain(parameters).chain(measures);
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
    /// Who has which name.
    pub const fn names(&self) -> Namespace<'_> {
        Namespace(self)
    }

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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::constraint::Point;
    use crate::world::{Edit, PointId, PointRecord};

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
    fn a_number_that_is_free_again_is_given_again() {
        // As it may be taken: by the thing itself, by all members of an instance, by a member of
        // one; for stems that end in digits too.
        for (stem, member) in [("arm", ""), ("arm", ".X"), ("arm2", ""), ("arm2", ".in1.X")] {
            let mut world = World::new();
            let mut ids = Vec::new();
            for k in 1..=3 {
                let name = world.numbered_name(stem);
                assert_eq!(name, format!("{stem}{k}"));
                ids.push(add(&mut world, &format!("{name}{member}")));
            }
            world.apply(Edit::Point(ids[1], None));
            assert_eq!(world.numbered_name(stem), format!("{stem}2"), "{member}");
            let undo = world.apply(Edit::Point(ids[0], None));
            world.apply(undo);
            assert_eq!(world.numbered_name(stem), format!("{stem}2"), "{member}");
            world.apply(Edit::Point(ids[0], None));
            assert_eq!(world.numbered_name(stem), format!("{stem}1"), "{member}");
        }
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
