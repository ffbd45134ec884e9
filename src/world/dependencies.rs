//! What was worked out about live expressions, and what of it has to be worked out anew.

use std::collections::{BTreeMap, BTreeSet};

use super::{ConstraintId, Depends, Formula, MeasureId, Mention, ParameterId, Record, User};
use crate::constraint::{Carried, ConstraintKind as _};
use crate::diag::Diagnostic;

/// Who mentions what, and lists of what is live; a scene without live expressions keeps nothing
/// here.
#[derive(Debug, Clone, Default)]
#[allow(clippy::struct_excessive_bools, reason = "each is a fact of its own")]
pub(super) struct Dependencies {
    /// By parameter, what mentions it.
    users: BTreeSet<(ParameterId, User)>,
    /// By constraint, what mentions a member of it.
    member_users: BTreeSet<(ConstraintId, User)>,
    /// By measure, what mentions it.
    measure_users: BTreeSet<(MeasureId, User)>,
    /// Live parameters, each after those it mentions.
    order: Vec<ParameterId>,
    /// Why live parameters have no value now.
    failures: BTreeMap<ParameterId, Diagnostic>,
    /// What of constraints is live.
    lists: LiveConstraints,
    /// Whether `order` has to be made anew.
    is_order_dirty: bool,
    /// Which constraints the lists may be wrong about.
    unlisted: Unlisted,
    /// Whether time or points changed since the live parameters were evaluated.
    is_stale: bool,
    /// Whether some constraint has, or had, a value that may measure points.
    has_measures: bool,
}

/// What of constraints is live.
#[derive(Debug, Clone, Default)]
pub(super) struct LiveConstraints {
    /// Those with a value that time or points drive, in order of creation.
    pub driven: Vec<ConstraintId>,
    /// Those that the angles of motors drive, or the turns of directions.
    pub turned: Vec<ConstraintId>,
    /// Motors that are switched on and turn, but for those of `ramps`.
    pub motors: Vec<ConstraintId>,
    /// Motors that are switched on and whose speed is an expression that mentions time.
    pub ramps: Vec<Ramp>,
}

impl LiveConstraints {
    /// Takes a constraint off all lists.
    pub fn remove(&mut self, id: ConstraintId) {
        for list in [&mut self.driven, &mut self.turned, &mut self.motors] {
            if let Ok(k) = list.binary_search(&id) {
                list.remove(k);
            }
        }
        if let Ok(k) = self.ramps.binary_search_by_key(&id, |ramp| ramp.motor) {
            self.ramps.remove(k);
        }
    }

    /// Whether the same constraints are on each list.
    pub fn is_like(&self, other: &Self) -> bool {
        let motors_of = |ramps: &[Ramp]| ramps.iter().map(|it| it.motor).collect::<Vec<_>>();
        (&self.driven, &self.turned, &self.motors) == (&other.driven, &other.turned, &other.motors)
            && motors_of(&self.ramps) == motors_of(&other.ramps)
    }
}

/// Puts an item on a list where its key has its place.
pub(super) fn enlist<T>(list: &mut Vec<T>, item: T, key: impl Fn(&T) -> ConstraintId) {
    let place = match list.last() {
        Some(last) if key(last) > key(&item) => list.partition_point(|it| key(it) < key(&item)),
        _ => list.len(),
    };
    list.insert(place, item);
}

/// Which constraints the lists may be wrong about.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) enum Unlisted {
    /// None.
    #[default]
    None,
    /// These.
    Few(Vec<ConstraintId>),
    /// All.
    All,
}

/// So many changed constraints find their places on the lists faster than the lists are made anew.
const FEW: usize = 50;

/// A motor whose speed changes within a frame.
#[derive(Debug, Clone)]
pub(super) struct Ramp {
    /// The motor.
    pub motor: ConstraintId,
    /// What its speed is.
    pub speed: Formula,
    /// The parameters that its speed depends on and that depend on time, each after those it
    /// mentions.
    pub parameters: Vec<ParameterId>,
}

impl Dependencies {
    /// Whether some constraint may have a value that measures points.
    pub const fn has_measures(&self) -> bool {
        self.has_measures
    }

    /// Time or points changed.
    pub fn note_change(&mut self) {
        self.is_stale = true;
    }

    /// A constraint was switched, or bound otherwise.
    pub fn note_switch(&mut self, id: ConstraintId) {
        // What drives it may drive those that mention it.
        let is_mentioned = self.has_members();
        match &mut self.unlisted {
            _ if is_mentioned => self.unlisted = Unlisted::All,
            Unlisted::None => self.unlisted = Unlisted::Few(vec![id]),
            Unlisted::Few(ids) if ids.len() < FEW => ids.push(id),
            Unlisted::Few(_) | Unlisted::All => self.unlisted = Unlisted::All,
        }
    }

    /// Live parameters, each after those it mentions.
    pub fn order(&self) -> &[ParameterId] {
        &self.order
    }

    /// Constraints with a value that time or points drive.
    pub fn driven(&self) -> &[ConstraintId] {
        &self.lists.driven
    }

    /// Constraints with a value that the angles of motors drive, or the turns of directions.
    pub fn turned(&self) -> &[ConstraintId] {
        &self.lists.turned
    }

    /// Motors that are switched on and turn, but for those that [`ramps`](Self::ramps) lists.
    pub fn motors(&self) -> &[ConstraintId] {
        &self.lists.motors
    }

    /// Motors that are switched on and whose speed changes within a frame.
    pub fn ramps(&self) -> &[Ramp] {
        &self.lists.ramps
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
        self.order.is_empty() && self.lists.driven.is_empty() && self.failures.is_empty()
    }

    /// Whether the order of live parameters is to be made anew; it counts as made from here on.
    pub fn take_order_dirty(&mut self) -> bool {
        std::mem::take(&mut self.is_order_dirty)
    }

    /// Puts live parameters in order.
    pub fn set_order(&mut self, order: Vec<ParameterId>) {
        self.order = order;
    }

    /// Which constraints the lists may be wrong about; they count as right from here on.
    pub fn take_unlisted(&mut self) -> Unlisted {
        std::mem::take(&mut self.unlisted)
    }

    /// Lends the lists, to be [given back](Self::set_lists).
    pub fn take_lists(&mut self) -> LiveConstraints {
        std::mem::take(&mut self.lists)
    }

    /// Says what of constraints is live.
    pub fn set_lists(&mut self, lists: LiveConstraints) {
        self.lists = lists;
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

    /// Who mentions a member of a constraint, in order.
    pub fn member_users(&self, id: ConstraintId) -> impl Iterator<Item = User> {
        self.member_users.range((id, User::FIRST)..=(id, User::LAST)).map(|(_, user)| *user)
    }

    /// Who mentions a measure, in order.
    pub fn measure_users(&self, id: MeasureId) -> impl Iterator<Item = User> {
        self.measure_users.range((id, User::FIRST)..=(id, User::LAST)).map(|(_, user)| *user)
    }

    /// The constraints of which something mentions a member, each once, in order.
    pub fn with_member_users(&self) -> BTreeSet<ConstraintId> {
        self.member_users.iter().map(|(id, _)| *id).collect()
    }

    /// Whether something mentions a member of a constraint.
    pub fn has_members(&self) -> bool {
        !self.member_users.is_empty()
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
                if a != b {
                    self.unlisted = Unlisted::All;
                }
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
        let measures = |record: &Record| {
            record.drivers().iter().any(|(_, f)| f.depends().on_points || f.depends().on_parameters)
        };
        self.has_measures |= new.is_some_and(measures);
        let is_listed = |record: &Record| !record.drivers().is_empty() || is_motor(record);
        if [old, new].into_iter().flatten().any(is_listed) {
            self.note_switch(id);
        }
        // What it measures, and by how much it is missed, may be other numbers now.
        self.is_stale |= self.has_members();
    }

    /// A measure was made, begun anew or deleted.
    pub fn note_measure(&mut self, id: MeasureId, old: Option<&Formula>, new: Option<&Formula>) {
        if let Some(formula) = old {
            self.unlink(formula, User::Measure(id));
        }
        if let Some(formula) = new {
            self.link(formula, User::Measure(id));
        }
        // What its values were is another number now.
        self.is_stale = true;
    }

    fn link(&mut self, formula: &Formula, user: User) {
        formula.mentions(&mut |mention| match mention {
            Mention::Parameter(used) => drop(self.users.insert((used, user))),
            Mention::Member(used, _) => drop(self.member_users.insert((used, user))),
            Mention::Measure(used) => drop(self.measure_users.insert((used, user))),
            Mention::Point(_) => {}
        });
    }

    /// Before it is linked to what it mentions now.
    fn unlink(&mut self, formula: &Formula, user: User) {
        formula.mentions(&mut |mention| match mention {
            Mention::Parameter(used) => drop(self.users.remove(&(used, user))),
            Mention::Member(used, _) => drop(self.member_users.remove(&(used, user))),
            Mention::Measure(used) => drop(self.measure_users.remove(&(used, user))),
            Mention::Point(_) => {}
        });
    }
}

/// Whether a constraint is a motor.
pub(super) fn is_motor(record: &Record) -> bool {
    record.constraint.traits().carried == Carried::ByClock
}
