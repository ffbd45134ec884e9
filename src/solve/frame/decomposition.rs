//! The order in which the points of an island can be found one after the other.
//!
//! A motor on a known centre says where its point is; two bars to known points say where
//! theirs is. What is found is known, and so on. Most mechanisms fall apart into such
//! blocks of one point; what is left is solved as a whole.

use crate::constraint::{Constraint, ConstraintKind, PointIdx};

/// The blocks of an island, each solvable when those before it are.
#[derive(Debug, Clone, Default)]
pub(crate) struct Plan {
    /// The points found one by one, in that order.
    pub blocks: Vec<Block>,
    /// The constraints of all blocks, one block after the other.
    pub constraints: Vec<u32>,
    /// What is left, as parts that do not depend on each other.
    pub rest: Vec<Part>,
    /// Whether some of the blocks have more equations than it takes.
    pub is_redundant: bool,
}

/// A point that is found from constraints to known points.
#[derive(Debug, Clone)]
pub(crate) struct Block {
    /// The point.
    pub point: PointIdx,
    /// Its constraints are `plan.constraints[first..end]`.
    pub first: u32,
    /// See `first`.
    pub end: u32,
    /// How many of them hold wheels.
    pub n_wheels: u32,
    /// What of the constraints is known beforehand.
    pub form: Form,
    /// Whether the constraints leave it no freedom.
    pub is_determined: bool,
    /// On which side of the singular pose it was last accepted.
    pub side: Side,
    /// The same for the pose that was tried last.
    pub next_side: Side,
}

/// On which side of the singular pose a point is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Side {
    /// The sine of the angle between its first row and another; 0 where nothing is known.
    pub sine: f64,
    /// Which other one: the second, or of more the one that is farthest from in line with the first.
    pub other: u32,
}

impl Default for Side {
    fn default() -> Self {
        Self { sine: 0.0, other: 1 }
    }
}

/// The forms of a block that are solved faster than by adding up rows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Form {
    /// Any constraints.
    Any,
    /// One constraint says outright where the point is.
    Assignment,
    /// Two bars of fixed lengths, to these two points.
    Dyad([PointIdx; 2]),
}

/// Points that are to be found together.
#[derive(Debug, Clone, Default)]
pub(crate) struct Part {
    /// The points, ascending.
    pub points: Vec<PointIdx>,
    /// The constraints, ascending.
    pub constraints: Vec<u32>,
}

impl Block {
    /// Whether there is more than one place where its constraints hold, and a way of telling them
    /// apart.
    pub fn has_branches(&self) -> bool {
        self.is_determined && self.form != Form::Assignment
    }
}

impl Plan {
    /// The plan for constraints over `n_points` points, the first `n_free` of them unknown.
    pub fn new(constraints: &[Constraint], n_free: usize, n_points: usize) -> Self {
        let mut search = Search::new(constraints, n_free, n_points);
        let mut plan = Self::default();
        let mut found = 0;
        let mut queue: Vec<PointIdx> = (0..n_free as u32).collect();
        while found < queue.len() {
            let p = queue[found];
            found += 1;
            if search.is_known[p as usize] || search.n_firm_rows(constraints, p) < 2 {
                continue;
            }
            plan.is_redundant |= search.n_firm_rows(constraints, p) > 2;
            let ready = search.take(p);
            plan.push(constraints, p, &ready, true);
            plan.blocks.last_mut().expect("just pushed").form = form(constraints, &ready, p);
            queue.extend(search.learn(constraints, p));
        }
        for part in search.rest(constraints, n_free) {
            if let &[point] = &*part.points {
                plan.push(constraints, point, &part.constraints, false);
            } else {
                plan.rest.push(part);
            }
        }
        plan.blocks.shrink_to_fit();
        plan.constraints.shrink_to_fit();
        plan
    }

    fn push(&mut self, all: &[Constraint], point: PointIdx, which: &[u32], is_determined: bool) {
        let first = self.constraints.len() as u32;
        self.constraints.extend(which);
        let end = self.constraints.len() as u32;
        let n_wheels = which.iter().filter(|&&c| all[c as usize].traits().is_wheel).count() as u32;
        let (side, next_side, form) = (Side::default(), Side::default(), Form::Any);
        let block = Block { point, first, end, n_wheels, form, is_determined, side, next_side };
        self.blocks.push(block);
    }

    /// Whether all of it is solved as one.
    pub fn is_one_part(&self) -> bool {
        self.blocks.is_empty() && self.rest.len() == 1
    }

    /// Whether every constraint says outright where its point is: there is one solution, and no
    /// branch to lose.
    pub fn is_linear(&self) -> bool {
        self.rest.is_empty() && self.blocks.iter().all(|block| block.form == Form::Assignment)
    }

    /// Whether every point is found one by one.
    pub fn is_complete(&self) -> bool {
        self.rest.is_empty()
    }
}

/// What is known so far.
pub(crate) struct Search {
    is_known: Vec<bool>,
    /// For each point the constraints that hold it.
    users: Vec<Vec<u32>>,
    /// For each constraint how many of its points are unknown.
    n_unknown: Vec<u32>,
    /// Constraints that belong to a block already.
    is_taken: Vec<bool>,
}

impl Search {
    /// The points from `n_free` on are known.
    pub fn new(constraints: &[Constraint], n_free: usize, n_points: usize) -> Self {
        let is_known: Vec<bool> = (0..n_points).map(|p| p >= n_free).collect();
        let mut users = vec![Vec::new(); n_points];
        let mut n_unknown = vec![0; constraints.len()];
        for (c, constraint) in constraints.iter().enumerate() {
            for p in distinct(constraint).filter(|&p| !is_known[p as usize]) {
                users[p as usize].push(c as u32);
                n_unknown[c] += 1;
            }
        }
        Self { is_known, users, n_unknown, is_taken: vec![false; constraints.len()] }
    }

    /// Whether a point is known.
    pub fn knows(&self, p: PointIdx) -> bool {
        self.is_known[p as usize]
    }

    /// The constraints that hold `p` and otherwise known points alone.
    pub fn ready(&self, p: PointIdx) -> impl Iterator<Item = u32> + '_ {
        self.users[p as usize].iter().copied().filter(|&c| self.n_unknown[c as usize] == 1)
    }

    /// How many equations say something about `p` alone, at every pose.
    fn n_firm_rows(&self, constraints: &[Constraint], p: PointIdx) -> usize {
        self.ready(p).map(|c| constraints[c as usize].traits().n_firm_rows).sum()
    }

    fn take(&mut self, p: PointIdx) -> Vec<u32> {
        let ready: Vec<u32> = self.ready(p).collect();
        for &c in &ready {
            self.is_taken[c as usize] = true;
        }
        ready
    }

    /// Makes a point known; gives the unknown points that this may have determined.
    pub fn learn(&mut self, constraints: &[Constraint], p: PointIdx) -> Vec<PointIdx> {
        self.is_known[p as usize] = true;
        let mut next = Vec::new();
        for &c in &self.users[p as usize] {
            self.n_unknown[c as usize] -= 1;
            if self.n_unknown[c as usize] == 1 {
                let constraint = &constraints[c as usize];
                next.extend(distinct(constraint).find(|&q| !self.is_known[q as usize]));
            }
        }
        next
    }

    /// The unknown points, by connection, with the constraints that hold any of them.
    fn rest(&self, constraints: &[Constraint], n_free: usize) -> Vec<Part> {
        let mut parts = Vec::new();
        let mut is_seen = vec![false; n_free];
        let mut is_listed = self.is_taken.clone();
        for seed in 0..n_free {
            if self.is_known[seed] || is_seen[seed] {
                continue;
            }
            let mut part = Part::default();
            is_seen[seed] = true;
            part.points.push(seed as u32);
            let mut next = 0;
            while let Some(&p) = part.points.get(next) {
                next += 1;
                for &c in &self.users[p as usize] {
                    if std::mem::replace(&mut is_listed[c as usize], true) {
                        continue;
                    }
                    part.constraints.push(c);
                    for q in distinct(&constraints[c as usize]) {
                        let q = q as usize;
                        if !self.is_known[q] && !std::mem::replace(&mut is_seen[q], true) {
                            part.points.push(q as u32);
                        }
                    }
                }
            }
            part.points.sort_unstable();
            part.constraints.sort_unstable();
            parts.push(part);
        }
        parts
    }
}

/// The points of a constraint, each once.
fn distinct(constraint: &Constraint) -> impl Iterator<Item = PointIdx> + '_ {
    let points = constraint.points();
    points.iter().enumerate().filter(|(k, p)| !points[..*k].contains(p)).map(|(_, p)| *p)
}

/// The form of the block of `p` with these constraints.
fn form(constraints: &[Constraint], which: &[u32], p: PointIdx) -> Form {
    let other_end = |c: u32| match &constraints[c as usize] {
        Constraint::Length(bar) if bar.bounds.is_equality() => {
            bar.points.into_iter().find(|&q| q != p)
        }
        _ => None,
    };
    match *which {
        [one] if constraints[one as usize].traits().is_linear => Form::Assignment,
        [one, two] => match (other_end(one), other_end(two)) {
            (Some(a), Some(b)) => Form::Dyad([a, b]),
            _ => Form::Any,
        },
        _ => Form::Any,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::constraint::{Bounds, Length, Motor};

    fn bar(a: PointIdx, b: PointIdx) -> Constraint {
        Length { points: [a, b], bounds: Bounds::exactly(1.0) }.into()
    }

    #[test]
    fn a_four_bar_is_an_assignment_and_a_dyad() {
        let motor = Motor::new([2, 0], 1.0, 0.0, 1.0).into();
        let plan = Plan::new(&[bar(0, 1), bar(1, 3), motor], 2, 4);
        let order: Vec<_> = plan.blocks.iter().map(|b| (b.point, b.form)).collect();
        assert_eq!(order, [(0, Form::Assignment), (1, Form::Dyad([0, 3]))]);
        assert!(plan.is_complete());
    }

    #[test]
    fn a_chain_is_left_as_a_whole() {
        let plan = Plan::new(&[bar(3, 0), bar(0, 1), bar(1, 2), bar(2, 4)], 3, 5);
        assert!(plan.blocks.is_empty());
        assert_eq!(plan.rest.len(), 1);
        assert_eq!(plan.rest[0].points, [0, 1, 2]);
        assert_eq!(plan.rest[0].constraints, [0, 1, 2, 3]);
    }

    #[test]
    fn a_pin_through_an_inequality_determines_nothing() {
        let cord = Length { points: [0, 1], bounds: Bounds { lo: 0.0, hi: 1.0 } }.into();
        let plan = Plan::new(&[cord, bar(0, 2)], 1, 3);
        assert_eq!(plan.blocks.len(), 1);
        assert!(!plan.blocks[0].is_determined);
    }
}
