//! Who uses what: the question that `delete` asks.

use std::collections::BTreeSet;

use super::{Entity, User, World};

impl World {
    fn users_of(&self, entity: Entity) -> Vec<User> {
        match entity {
            Entity::Point(id) => {
                let Self { constraints, parameters, measures, .. } = self;
                self.point_users.of(id, constraints, parameters, measures).collect()
            }
            Entity::Parameter(id) => self.dependencies.users(id).collect(),
            Entity::Constraint(id) => self.dependencies.member_users(id).collect(),
            Entity::Measure(id) => self.dependencies.measure_users(id).collect(),
        }
    }

    /// What uses any of these entities directly, the entities themselves left out, in order
    /// of creation, constraints first.
    pub fn users(&self, of: &[Entity]) -> BTreeSet<User> {
        let mut users: BTreeSet<User> = of.iter().flat_map(|&e| self.users_of(e)).collect();
        if !users.is_empty() {
            let of: BTreeSet<Entity> = of.iter().copied().collect();
            users.retain(|user| !of.contains(&user.entity()));
        }
        users
    }

    /// These entities and all that uses them, directly or through others: what a cascading
    /// `delete` removes, users before what they use.
    pub fn with_users(&self, of: &[Entity]) -> Vec<Entity> {
        let mut all: Vec<Entity> = of.to_vec();
        let mut is_listed: BTreeSet<Entity> = of.iter().copied().collect();
        let mut n_asked = 0;
        while n_asked < all.len() {
            let latest = self.users(&all[n_asked..]);
            n_asked = all.len();
            let new = latest.iter().rev().map(|user| user.entity());
            all.extend(new.filter(|entity| is_listed.insert(*entity)));
        }
        all.reverse();
        all
    }
}
