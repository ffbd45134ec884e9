//! Who uses what: the question that `delete` asks.

use std::collections::BTreeSet;

use crate::constraint::Relation;

use super::{ConstraintId, Entity, Formula, Mention, ParameterId, World};

/// Something that uses an entity.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum User {
    /// A constraint that holds it or mentions it in a value.
    Constraint(ConstraintId),
    /// A parameter whose expression mentions it.
    Parameter(ParameterId),
}

impl User {
    /// The user as an entity.
    pub const fn entity(self) -> Entity {
        match self {
            Self::Constraint(id) => Entity::Constraint(id),
            Self::Parameter(id) => Entity::Parameter(id),
        }
    }
}

impl World {
    /// What uses any of these entities directly, the entities themselves left out, in order
    /// of creation, constraints first.
    pub fn users(&self, of: &[Entity]) -> BTreeSet<User> {
        let n_points = self.points.column().len();
        let mut is_asked = vec![false; n_points];
        let mut asked_parameters = BTreeSet::new();
        let mut users = BTreeSet::new();
        for entity in of {
            match entity {
                Entity::Point(id) => is_asked[id.idx()] = true,
                Entity::Parameter(id) => drop(asked_parameters.insert(*id)),
                Entity::Constraint(_) => {}
            }
        }
        let mentions = |formula: &Formula| {
            let mut found = false;
            formula.mentions(&mut |mention| {
                found |= match mention {
                    Mention::Point(id) => is_asked[id.idx()],
                    Mention::Parameter(id) => asked_parameters.contains(&id),
                };
            });
            found
        };
        for (id, record) in self.constraints() {
            if record.constraint.points().iter().any(|&p| is_asked[p as usize])
                || record.drivers.iter().any(|(_, formula)| mentions(formula))
            {
                users.insert(User::Constraint(id));
            }
        }
        for (id, parameter) in self.parameters() {
            if mentions(&parameter.formula) {
                users.insert(User::Parameter(id));
            }
        }
        users.retain(|user| !of.contains(&user.entity()));
        users
    }

    /// These entities and all that uses them, directly or through others: what a cascading
    /// `delete` removes, users before what they use.
    pub fn with_users(&self, of: &[Entity]) -> Vec<Entity> {
        let mut all: Vec<Entity> = of.to_vec();
        loop {
            let users = self.users(&all);
            if users.is_empty() {
                break;
            }
            all.extend(users.iter().rev().map(|user| user.entity()));
        }
        all.reverse();
        all
    }
}
