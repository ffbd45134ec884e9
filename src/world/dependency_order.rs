//! What depends on what, and the order in which live values are brought up to date.

use std::collections::{BTreeMap, BTreeSet};

use super::dependencies::{LiveConstraints, Ramp, Unlisted, enlist, is_motor};
use super::{ConstraintId, Depends, Entity, Formula, Mention, ParameterId, Record, World};
use crate::constraint::{ConstraintKind as _, Field};
use crate::terms::Member;

/// Whether a motor turns: its speed is not 0, or may not be 0 at another time.
fn is_turning(record: &Record) -> bool {
    is_motor(record)
        && (record.constraint.get(Field::Speed) != Some(0.0)
            || record.driver(Field::Speed).is_some())
}

/// Adds the parameters that a formula mentions.
fn note_parameters(formula: &Formula, mentioned: &mut BTreeSet<ParameterId>) {
    formula.mentions(&mut |mention| {
        if let Mention::Parameter(id) = mention {
            mentioned.insert(id);
        }
    });
}

impl World {
    /// Brings the order of live parameters up to date.
    pub(super) fn sort_parameters(&mut self) {
        if !self.dependencies.take_order_dirty() {
            return;
        }
        let mut order: Vec<ParameterId> = Vec::new();
        let mut is_seen = vec![false; self.parameters.n_handles()];
        let is_live = |id: ParameterId| self.parameter(id).is_some_and(|p| p.depends.is_live());
        for (root, _) in self.parameters().filter(|(_, p)| p.depends.is_live()) {
            let mut stack = vec![(root, false)];
            while let Some((id, is_expanded)) = stack.pop() {
                if is_expanded {
                    order.push(id);
                } else if !std::mem::replace(&mut is_seen[id.idx()], true) {
                    stack.push((id, true));
                    let parameter = self.parameter(id).expect("a mentioned parameter lives");
                    let mut used = BTreeSet::new();
                    note_parameters(&parameter.formula, &mut used);
                    parameter.formula.mentions(&mut |mention| {
                        // By how much it is missed depends on what drives it.
                        if let Mention::Member(
                            id,
                            Member::Residual | Member::Radius | Member::Value,
                        ) = mention
                        {
                            let record = self.constraint(id).expect("a used constraint lives");
                            let drivers = record.drivers().iter();
                            drivers.for_each(|(_, formula)| note_parameters(formula, &mut used));
                        }
                    });
                    stack.extend(used.into_iter().filter(|id| is_live(*id)).map(|id| (id, false)));
                }
            }
        }
        self.dependencies.set_order(order);
    }

    /// Brings the lists of driven constraints and motors up to date.
    pub(super) fn sort_constraints(&mut self) {
        let unlisted = self.dependencies.take_unlisted();
        if unlisted == Unlisted::None {
            return;
        }
        self.sort_parameters();
        let lists = match unlisted {
            Unlisted::Few(ids) => {
                let mut lists = self.dependencies.take_lists();
                for id in ids {
                    lists.remove(id);
                    if let Some(record) = self.constraint(id) {
                        self.list(id, record, &mut lists);
                    }
                }
                debug_assert!(lists.is_like(&self.all_lists()), "each has its place");
                lists
            }
            Unlisted::None | Unlisted::All => self.all_lists(),
        };
        self.dependencies.set_lists(lists);
        self.log.note_motor_lists();
    }

    fn all_lists(&self) -> LiveConstraints {
        let mut lists = LiveConstraints::default();
        self.constraints().for_each(|(id, record)| self.list(id, record, &mut lists));
        lists
    }

    /// Puts a constraint on the lists where it belongs.
    fn list(&self, id: ConstraintId, record: &Record, lists: &mut LiveConstraints) {
        if record.is_on && is_turning(record) {
            match record.driver(Field::Speed).filter(|speed| self.depends(speed).on_time) {
                Some(speed) => enlist(&mut lists.ramps, self.ramp(id, speed), |ramp| ramp.motor),
                None => enlist(&mut lists.motors, id, |id| *id),
            }
        }
        if record.live().iter().any(|(_, formula)| self.depends(formula).is_live()) {
            enlist(&mut lists.driven, id, |id| *id);
        }
        let is_turned =
            |formula: &Formula| self.depends(formula).on_angles || formula.counts_turns();
        if record.live().iter().any(|(_, formula)| is_turned(formula)) {
            enlist(&mut lists.turned, id, |id| *id);
        }
    }

    /// A motor with a speed that mentions time, and what of its parameters time changes.
    fn ramp(&self, motor: ConstraintId, speed: &Formula) -> Ramp {
        let mut mentioned = BTreeSet::new();
        note_parameters(speed, &mut mentioned);
        let mut parameters = Vec::new();
        // What mentions others comes after them: from the last to the first all is seen.
        for &id in self.dependencies.order().iter().rev() {
            let parameter = self.parameter(id).expect("a listed parameter lives");
            if mentioned.contains(&id) && parameter.depends.on_time {
                parameters.push(id);
                note_parameters(&parameter.formula, &mut mentioned);
            }
        }
        parameters.reverse();
        Ramp { motor, speed: speed.clone(), parameters }
    }

    /// Whether a formula mentions a point that can move, at any depth.
    pub fn follows_motion(&self, formula: &Formula) -> bool {
        let mut follows = false;
        // Each parameter is looked at once: those that mention others twice would double.
        let mut seen = BTreeSet::new();
        let mut open = vec![formula.clone()];
        while let Some(formula) = open.pop().filter(|_| !follows) {
            formula.mentions(&mut |mention| match mention {
                Mention::Point(id) => follows |= !self.points.is_frozen(id),
                Mention::Parameter(id) if seen.insert(id) => {
                    open.extend(self.parameter(id).map(|parameter| parameter.formula.clone()));
                }
                Mention::Member(id, Member::Radius) => match self.radius_driver(id) {
                    Some(formula) => open.push(formula.clone()),
                    None => follows |= self.radius_depends(id).on_points,
                },
                Mention::Member(id, Member::Value) => open.push(self.measured_by(id)),
                Mention::Parameter(_) | Mention::Member(..) | Mention::Measure(_) => {}
            });
        }
        follows
    }

    /// Whether some motor is switched on and turns.
    pub fn has_running_motors(&mut self) -> bool {
        self.sort_constraints();
        !self.dependencies.motors().is_empty() || !self.dependencies.ramps().is_empty()
    }

    /// What can change a formula, its parameters' own formulas included.
    pub fn depends(&self, formula: &Formula) -> Depends {
        let mut depends = formula.depends();
        if depends.on_parameters {
            formula.mentions(&mut |mention| match mention {
                Mention::Parameter(id) => {
                    if let Some(parameter) = self.parameter(id) {
                        depends = depends.or(parameter.depends);
                    }
                }
                Mention::Member(id, Member::Radius) => {
                    depends = depends.or(self.radius_depends(id));
                }
                Mention::Member(id, Member::Value) => {
                    depends = depends.or(self.depends(&self.measured_by(id)));
                }
                Mention::Member(..) | Mention::Point(_) | Mention::Measure(_) => {}
            });
        }
        depends
    }

    /// How a parameter, or the radius of a circle, would come to depend on itself through `formula`:
    /// what is on the way, itself last. None where it would not.
    pub fn cycle(&self, of: Entity, formula: &Formula) -> Option<Vec<Entity>> {
        let mut pending: Vec<Entity> = Vec::new();
        // Through what each was reached; itself, where by the formula.
        let mut reached: BTreeMap<Entity, Entity> = BTreeMap::new();
        let mut look = |formula: &Formula, from, pending: &mut Vec<Entity>| {
            formula.mentions(&mut |mention| {
                let used = match mention {
                    Mention::Parameter(used) => Entity::Parameter(used),
                    Mention::Member(used, Member::Radius | Member::Value) => {
                        Entity::Constraint(used)
                    }
                    Mention::Member(..) | Mention::Point(_) | Mention::Measure(_) => return,
                };
                reached.entry(used).or_insert_with(|| {
                    pending.push(used);
                    from
                });
            });
        };
        look(formula, of, &mut pending);
        while let Some(used) = pending.pop() {
            if used == of {
                break;
            }
            let formula = match used {
                Entity::Parameter(id) => {
                    self.parameter(id).map(|parameter| parameter.formula.clone())
                }
                Entity::Constraint(id) if self.curve(id).is_some() => {
                    self.radius_driver(id).cloned()
                }
                Entity::Constraint(id) => Some(self.measured_by(id)),
                Entity::Point(_) | Entity::Measure(_) => None,
            };
            if let Some(formula) = formula {
                look(&formula, used, &mut pending);
            }
        }
        let mut path = vec![of];
        let mut at = *reached.get(&of)?;
        while at != of {
            path.push(at);
            at = reached[&at];
        }
        path.reverse();
        Some(path)
    }
}
