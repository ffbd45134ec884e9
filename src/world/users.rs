//! Who uses what: the question that `delete` asks.

use std::collections::BTreeSet;
use std::sync::OnceLock;

use crate::constraint::ConstraintKind;

use super::{ConstraintId, Entity, Formula, Mention, ParameterId, PointId, Record, World};

/// Something that uses an entity.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum User {
    /// A constraint that holds it or mentions it in a value.
    Constraint(ConstraintId),
    /// A parameter whose expression mentions it.
    Parameter(ParameterId),
}

impl User {
    /// The first of all in order.
    pub(super) const FIRST: Self = Self::Constraint(ConstraintId(0));
    /// The last of all in order.
    pub(super) const LAST: Self = Self::Parameter(ParameterId(u32::MAX));

    /// The user as an entity.
    pub const fn entity(self) -> Entity {
        match self {
            Self::Constraint(id) => Entity::Constraint(id),
            Self::Parameter(id) => Entity::Parameter(id),
        }
    }
}

/// By point, what holds or mentions it. Made when it is first asked for, since only `delete` asks,
/// and kept up from then on, so that a thousand deletions look at the scene once.
#[derive(Debug, Clone, Default)]
pub(super) struct PointUsers(OnceLock<BTreeSet<(PointId, User)>>);

impl PointUsers {
    /// What uses a point, in order.
    fn of(&self, id: PointId, world: &World) -> impl Iterator<Item = User> {
        let all = self.0.get_or_init(|| {
            let mut all: Vec<(PointId, User)> = Vec::new();
            for (id, record) in world.constraints() {
                points_of_record(record, &mut |point| all.push((point, User::Constraint(id))));
            }
            for (id, parameter) in world.parameters() {
                let user = User::Parameter(id);
                points_of_formula(&parameter.formula, &mut |point| all.push((point, user)));
            }
            all.into_iter().collect()
        });
        all.range((id, User::FIRST)..=(id, User::LAST)).map(|(_, user)| *user)
    }

    /// A constraint was made, changed or deleted.
    pub fn note_constraint(
        &mut self,
        id: ConstraintId,
        old: Option<&Record>,
        new: Option<&Record>,
    ) {
        let Some(all) = self.0.get_mut() else { return };
        let user = User::Constraint(id);
        if let Some(record) = old {
            points_of_record(record, &mut |point| {
                all.remove(&(point, user));
            });
        }
        if let Some(record) = new {
            points_of_record(record, &mut |point| {
                all.insert((point, user));
            });
        }
    }

    /// A parameter was made, changed or deleted.
    pub fn note_parameter(
        &mut self,
        id: ParameterId,
        old: Option<&Formula>,
        new: Option<&Formula>,
    ) {
        let Some(all) = self.0.get_mut() else { return };
        let user = User::Parameter(id);
        if let Some(formula) = old {
            points_of_formula(formula, &mut |point| {
                all.remove(&(point, user));
            });
        }
        if let Some(formula) = new {
            points_of_formula(formula, &mut |point| {
                all.insert((point, user));
            });
        }
    }
}

fn points_of_record(record: &Record, visit: &mut impl FnMut(PointId)) {
    record.constraint.points().iter().for_each(|&p| visit(PointId(p)));
    for (_, formula) in record.drivers() {
        points_of_formula(formula, visit);
    }
}

fn points_of_formula(formula: &Formula, visit: &mut impl FnMut(PointId)) {
    formula.mentions(&mut |mention| {
        if let Mention::Point(id) = mention {
            visit(id);
        }
    });
}

impl World {
    fn users_of(&self, entity: Entity) -> Vec<User> {
        match entity {
            Entity::Point(id) => self.point_users.of(id, self).collect(),
            Entity::Parameter(id) => self.live.users(id).collect(),
            Entity::Constraint(_) => Vec::new(),
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
