//! Live expressions: what depends on what, and the order in which values are brought up to date.

use std::collections::{BTreeMap, BTreeSet};

use super::{ConstraintId, Depends, Formula, Mention, ParameterId, Record, User, World};
use crate::constraint::{ConstraintKind as _, Field, Kind};
use crate::diag::Diagnostic;

/// What was worked out about live expressions; a scene without any keeps nothing here.
#[derive(Debug, Clone, Default)]
#[allow(clippy::struct_excessive_bools, reason = "each is a fact of its own")]
pub(super) struct Live {
    /// By parameter, what mentions it.
    users: BTreeSet<(ParameterId, User)>,
    /// Live parameters, each after those it mentions.
    order: Vec<ParameterId>,
    /// Why live parameters have no value now.
    failures: BTreeMap<ParameterId, Diagnostic>,
    /// Constraints with a value that time or points drive, in order of creation.
    driven: Vec<ConstraintId>,
    /// Those among them that points drive.
    measured: Vec<ConstraintId>,
    /// Whether the solver moves such a point: values and pose have to agree then.
    is_mutual: bool,
    /// Motors that are switched on and turn.
    motors: Vec<ConstraintId>,
    /// Whether `order` has to be made anew.
    is_order_dirty: bool,
    /// Whether the lists of constraints have to be made anew.
    are_lists_dirty: bool,
    /// Whether time or points changed since the live parameters were evaluated.
    is_stale: bool,
}

impl Live {
    /// Time or points changed.
    pub fn note_change(&mut self) {
        self.is_stale = true;
    }

    /// A constraint was switched.
    pub fn note_switch(&mut self) {
        self.are_lists_dirty = true;
    }

    /// Live parameters, each after those it mentions.
    pub fn order(&self) -> &[ParameterId] {
        &self.order
    }

    /// Constraints with a value that time or points drive.
    pub fn driven(&self) -> &[ConstraintId] {
        &self.driven
    }

    /// Constraints with a value that points drive.
    pub fn measured(&self) -> &[ConstraintId] {
        &self.measured
    }

    /// Motors that are switched on and turn.
    pub fn motors(&self) -> &[ConstraintId] {
        &self.motors
    }

    /// Why a live parameter has no value now.
    pub fn failure(&self, id: ParameterId) -> Option<&Diagnostic> {
        self.failures.get(&id)
    }

    /// The first reason why a live parameter has no value now.
    pub fn first_failure(&self) -> Option<&Diagnostic> {
        self.failures.first_key_value().map(|(_, why)| why)
    }

    /// Notes why a live parameter has no value now.
    pub fn fail(&mut self, id: ParameterId, why: Diagnostic) {
        self.failures.insert(id, why);
    }

    /// Whether no value depends on time or points.
    pub fn is_idle(&self) -> bool {
        self.order.is_empty() && self.driven.is_empty() && self.failures.is_empty()
    }

    /// Whether the solver moves a point that drives a constraint.
    pub fn is_mutual(&self) -> bool {
        self.is_mutual
    }

    /// A point was made, deleted, frozen or thawed.
    pub fn note_freeze(&mut self) {
        self.are_lists_dirty |= !self.measured.is_empty();
    }

    /// Forgets why parameters had no values.
    pub fn forget_failures(&mut self) {
        self.failures.clear();
    }

    /// Whether live parameters are to be evaluated anew; they count as evaluated from here on.
    pub fn take_stale(&mut self) -> bool {
        std::mem::take(&mut self.is_stale)
    }

    /// Who mentions a parameter, in order.
    pub fn users(&self, id: ParameterId) -> impl Iterator<Item = User> {
        self.users.range((id, User::FIRST)..=(id, User::LAST)).map(|(_, user)| *user)
    }

    /// A parameter was made, changed or deleted. One that was there before may come back with
    /// the value of another time; `is_new` says that it was not.
    pub fn note_parameter(
        &mut self,
        id: ParameterId,
        old: Option<(&Formula, Depends)>,
        new: Option<(&Formula, Depends)>,
        is_new: bool,
    ) {
        let is_live = |of: Option<(&Formula, Depends)>| of.is_some_and(|(_, d)| d.is_live());
        self.is_stale |= !is_new && (is_live(old) || is_live(new));
        if let Some((formula, _)) = old {
            self.unlink(formula, User::Parameter(id));
        }
        if let Some((formula, _)) = new {
            self.link(formula, User::Parameter(id));
        }
        match (old, new) {
            // It mentions only what was there before it, so it may stand last.
            (None, Some((_, depends))) if depends.is_live() => self.order.push(id),
            (Some((was, a)), Some((is, b))) => {
                let is_like_before = a.is_live() == b.is_live() && was.is_same(is);
                self.is_order_dirty |= (a.is_live() || b.is_live()) && !is_like_before;
                self.are_lists_dirty |= a != b;
            }
            (Some((_, depends)), None) => self.is_order_dirty |= depends.is_live(),
            _ => {}
        }
    }

    /// A constraint was made, changed or deleted.
    pub fn note_constraint(
        &mut self,
        id: ConstraintId,
        old: Option<&Record>,
        new: Option<&Record>,
    ) {
        for (_, formula) in old.iter().flat_map(|record| record.drivers()) {
            self.unlink(formula, User::Constraint(id));
        }
        for (_, formula) in new.iter().flat_map(|record| record.drivers()) {
            self.link(formula, User::Constraint(id));
        }
        let is_listed = |record: &Record| !record.drivers().is_empty() || is_motor(record);
        self.are_lists_dirty |= [old, new].into_iter().flatten().any(is_listed);
    }

    fn link(&mut self, formula: &Formula, user: User) {
        formula.mentions(&mut |mention| {
            if let Mention::Parameter(used) = mention {
                self.users.insert((used, user));
            }
        });
    }

    /// Before it is linked to what it mentions now.
    fn unlink(&mut self, formula: &Formula, user: User) {
        formula.mentions(&mut |mention| {
            if let Mention::Parameter(used) = mention {
                self.users.remove(&(used, user));
            }
        });
    }
}

fn is_motor(record: &Record) -> bool {
    record.constraint.kind() == Kind::Motor
}

/// Whether a motor turns: its speed is not 0, or may not be 0 at another time.
fn is_turning(record: &Record) -> bool {
    is_motor(record)
        && (record.constraint.get(Field::Speed) != Some(0.0)
            || record.driver(Field::Speed).is_some())
}

impl World {
    /// Brings the order of live parameters up to date.
    pub(super) fn sort_parameters(&mut self) {
        if !std::mem::take(&mut self.live.is_order_dirty) {
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
                    parameter.formula.mentions(&mut |mention| {
                        if let Mention::Parameter(used) = mention
                            && is_live(used)
                        {
                            stack.push((used, false));
                        }
                    });
                }
            }
        }
        self.live.order = order;
    }

    /// Brings the lists of driven constraints and motors up to date.
    pub(super) fn sort_constraints(&mut self) {
        if !std::mem::take(&mut self.live.are_lists_dirty) {
            return;
        }
        let (mut driven, mut measured, mut motors) = (Vec::new(), Vec::new(), Vec::new());
        let mut is_mutual = false;
        for (id, record) in self.constraints() {
            if record.is_on && is_turning(record) {
                motors.push(id);
            }
            let formulas = record.drivers().iter().map(|(_, formula)| self.depends(formula));
            let depends = formulas.fold(Depends::default(), Depends::or);
            if depends.is_live() {
                driven.push(id);
            }
            if depends.on_points {
                measured.push(id);
                is_mutual |= record.drivers().iter().any(|(_, f)| self.follows_motion(f));
            }
        }
        self.live.is_mutual = is_mutual;
        self.live.driven = driven;
        self.live.measured = measured;
        self.live.motors = motors;
    }

    /// Whether a formula mentions a point that can move, at any depth.
    pub fn follows_motion(&self, formula: &Formula) -> bool {
        let mut follows = false;
        formula.mentions(&mut |mention| {
            follows |= match mention {
                Mention::Point(id) => !self.points.is_frozen(id),
                Mention::Parameter(id) => {
                    self.parameter(id).is_some_and(|p| self.follows_motion(&p.formula))
                }
            };
        });
        follows
    }

    /// Whether some motor is switched on and turns.
    pub fn has_running_motors(&mut self) -> bool {
        self.sort_constraints();
        !self.live.motors().is_empty()
    }

    /// What can change a formula, its parameters' own formulas included.
    pub fn depends(&self, formula: &Formula) -> Depends {
        let mut depends = formula.depends();
        if depends.on_parameters {
            formula.mentions(&mut |mention| {
                if let Mention::Parameter(id) = mention
                    && let Some(parameter) = self.parameter(id)
                {
                    depends = depends.or(parameter.depends);
                }
            });
        }
        depends
    }

    /// How parameter `id` would come to depend on itself through `formula`: the parameters on
    /// the way, itself last. None where it would not.
    pub fn cycle(&self, id: ParameterId, formula: &Formula) -> Option<Vec<ParameterId>> {
        let mut pending: Vec<ParameterId> = Vec::new();
        // Through which parameter each was reached; itself, where by the formula.
        let mut reached: BTreeMap<ParameterId, ParameterId> = BTreeMap::new();
        let mut look = |formula: &Formula, from, pending: &mut Vec<ParameterId>| {
            formula.mentions(&mut |mention| {
                if let Mention::Parameter(used) = mention {
                    reached.entry(used).or_insert_with(|| {
                        pending.push(used);
                        from
                    });
                }
            });
        };
        look(formula, id, &mut pending);
        while let Some(used) = pending.pop() {
            if used == id {
                break;
            }
            if let Some(parameter) = self.parameter(used) {
                look(&parameter.formula, used, &mut pending);
            }
        }
        let mut path = vec![id];
        let mut at = *reached.get(&id)?;
        while at != id {
            path.push(at);
            at = reached[&at];
        }
        path.reverse();
        Some(path)
    }
}
