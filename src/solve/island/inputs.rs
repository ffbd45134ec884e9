//! What drives an island in a frame: what changed since it was visited last.

use crate::constraint::{Constraint, Heading, Point};

/// What changed since the last visit, with the values before.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Inputs {
    /// Motors that turned on, which is all that most frames change. One that is in `constraints`
    /// too turned after its values changed.
    turns: Vec<(u32, Heading)>,
    /// Constraints whose values changed.
    constraints: Vec<(u32, Constraint)>,
    /// Frozen points that were put elsewhere.
    pub points: Vec<(u32, Point)>,
    /// Whether a free point was put elsewhere.
    pub is_disturbed: bool,
}

impl Inputs {
    /// Whether nothing changed.
    pub fn is_empty(&self) -> bool {
        let Self { turns, constraints, points, is_disturbed } = self;
        turns.is_empty() && constraints.is_empty() && points.is_empty() && !is_disturbed
    }

    /// A motor turned on.
    pub fn note_turn(&mut self, c: u32, before: Heading) {
        push_one(&mut self.turns, (c, before));
    }

    /// Values of a constraint changed.
    pub fn note_values(&mut self, c: u32, mut before: Constraint) {
        if let Constraint::Motor(motor) = &mut before
            && let Some(&(_, first)) = self.turns.iter().find(|(turned, _)| *turned == c)
        {
            motor.set_heading(first);
            self.turns.retain(|(turned, _)| *turned != c);
        }
        push_one(&mut self.constraints, (c, before));
    }

    /// The motors that turned on, with where they pointed before.
    pub fn turns(&self) -> &[(u32, Heading)] {
        &self.turns
    }

    /// The constraints whose values changed, as they were before.
    pub fn constraints(&self) -> &[(u32, Constraint)] {
        &self.constraints
    }

    /// A constraint as it was before each change of its values.
    pub fn values_before(&self, c: u32) -> impl Iterator<Item = &Constraint> {
        self.constraints.iter().filter(move |(changed, _)| *changed == c).map(|(_, before)| before)
    }

    /// The constraints that changed, as they were before; `now` are those of the island.
    pub fn constraints_before(&mut self, now: &[Constraint]) -> Vec<(u32, Constraint)> {
        self.tidy();
        let turned = self.turns.iter().map(|&(c, heading)| {
            let mut before = now[c as usize].clone();
            if let Constraint::Motor(motor) = &mut before {
                motor.set_heading(heading);
            }
            (c, before)
        });
        let mut all: Vec<_> = turned.chain(self.constraints.iter().cloned()).collect();
        all.sort_by_key(|(c, _)| *c);
        all
    }

    /// What changed twice began where the first change found it.
    pub fn tidy(&mut self) {
        self.constraints.sort_by_key(|(c, _)| *c);
        self.constraints.dedup_by_key(|(c, _)| *c);
        let constraints = &self.constraints;
        self.turns.retain(|(c, _)| constraints.binary_search_by_key(c, |(c, _)| *c).is_err());
        self.turns.sort_by_key(|(c, _)| *c);
        self.turns.dedup_by_key(|(c, _)| *c);
        self.points.sort_by_key(|(p, _)| *p);
        self.points.dedup_by_key(|(p, _)| *p);
    }

    /// Nothing changed since now.
    pub fn clear(&mut self) {
        let Self { turns, constraints, points, is_disturbed } = self;
        turns.clear();
        constraints.clear();
        points.clear();
        *is_disturbed = false;
    }

    /// Exchanges what changed, in an island with these constraints and places, with what it was
    /// before.
    pub fn swap(&mut self, constraints: &mut [Constraint], x: &mut [Point]) {
        self.tidy();
        for (c, other) in &mut self.constraints {
            std::mem::swap(&mut constraints[*c as usize], other);
        }
        for (c, other) in &mut self.turns {
            if let Constraint::Motor(motor) = &mut constraints[*c as usize] {
                let now = motor.heading();
                motor.set_heading(std::mem::replace(other, now));
            }
        }
        for (p, other) in &mut self.points {
            std::mem::swap(&mut x[*p as usize], other);
        }
    }
}

/// Appends to a list that mostly holds one: one motor, or one length, drives most islands.
fn push_one<T>(list: &mut Vec<T>, item: T) {
    if list.capacity() == 0 {
        list.reserve_exact(1);
    }
    list.push(item);
}
