//! Which bodies and points of a part are found together, where none can be found by itself.

use super::Step;
use super::block::{Block, Leg, MOST, Turning};
use super::compile::{Compiler, is_told};
use super::equation::{End, Equation};
use super::length::{Length, bar};
use super::parts::Assembly;
use crate::constraint::{Constraint, PointIdx, Vector};
use crate::solve::frame::decomposition::Part;

/// In a part with more bodies and points than that none are looked for.
const MOST_UNITS: usize = 16;
/// No more of them are found together.
const MOST_AT_ONCE: usize = 3;

/// What has numbers of its own.
#[derive(Clone, Copy)]
enum Unit {
    Body(usize),
    Point(PointIdx),
}

/// A block on its way: which units have their numbers already.
#[derive(Default)]
struct Draft {
    bases: Vec<PointIdx>,
    bodies: Vec<Turning>,
    /// The body of each of these, and its point that is the pivot.
    of_bodies: Vec<(usize, PointIdx)>,
}

impl Compiler<'_> {
    /// Adds the step that finds some bodies and points together, as few as there are; false if there are
    /// none.
    pub fn together(&mut self, part: &Part, assembly: &mut Assembly) -> bool {
        let units = assembly.units(part);
        if units.len() > MOST_UNITS {
            return false;
        }
        let constraints = self.given.constraints;
        let unmet = || part.constraints.iter().filter(|&&c| !assembly.is_met[c as usize]);
        let bars = unmet().filter_map(|&c| {
            let (ends, length) = bar(&constraints[c as usize])?;
            Some((ends, Length::of_bar(length, c)))
        });
        let bars: Vec<_> = bars.collect();
        let others = unmet().map(|&c| (c, &constraints[c as usize]));
        let others = others.filter(|(_, other)| bar(other).is_none() && is_told(other));
        let others: Vec<_> = others.collect();
        let blocks =
            (1..1_u32 << units.len()).filter(|set| set.count_ones() as usize <= MOST_AT_ONCE);
        let blocks = blocks.filter_map(|set| {
            let members = units.iter().enumerate().filter(|(k, _)| set >> k & 1 == 1);
            assembly.block(members.map(|(_, unit)| *unit).collect(), &bars, &others)
        });
        let Some(block) = blocks.min_by_key(Block::n_numbers) else { return false };
        let found: Vec<PointIdx> = block.finds().collect();
        self.form.has_blocks = true;
        for equation in &block.equations {
            let firm = equation.firm.clone();
            self.note_driver(firm.c);
            // Some of its points may be found after the block, with their body.
            assembly.is_met[firm.c as usize] = true;
            assembly.unchecked.push(Step::Firm(firm));
        }
        self.form.steps.push(Step::Block(Box::new(block)));
        found.into_iter().for_each(|p| assembly.learn(self, p));
        true
    }
}

impl Assembly<'_> {
    /// The bodies that are not placed, and the points of none that are not known.
    fn units(&self, part: &Part) -> Vec<Unit> {
        let bodies = (0..self.bodies.len()).filter(|&b| !self.is_placed[b]).map(Unit::Body);
        let is_alone = |p: &&PointIdx| {
            let bodies = &self.of_point[**p as usize];
            !self.search.knows(**p) && bodies.iter().all(|&b| self.is_placed[b as usize])
        };
        bodies.chain(part.points.iter().filter(is_alone).map(|&p| Unit::Point(p))).collect()
    }

    /// What finds these together, by bars and other constraints; none if there are more numbers than these say, or
    /// than are found together.
    fn block(
        &self,
        mut units: Vec<Unit>,
        bars: &[([PointIdx; 2], Length)],
        others: &[(u32, &Constraint)],
    ) -> Option<Block> {
        let mut draft = Draft::default();
        while !units.is_empty() {
            let is_held = |unit: &Unit| self.pivot(*unit, &draft).is_some();
            let k = units.iter().position(is_held).unwrap_or(0);
            let unit = units.remove(k);
            let pivot = self.pivot(unit, &draft);
            match unit {
                Unit::Point(p) => draft.bases.push(p),
                Unit::Body(b) => {
                    // One that hangs on nothing yet does so on a point that is another's too.
                    let points = || self.bodies[b].points.iter().map(|(p, _)| *p);
                    let is_shared = |&p: &PointIdx| {
                        let others = &self.of_point[p as usize];
                        others.len() > 1
                    };
                    let pivot = pivot.or_else(|| {
                        let p = points().find(is_shared).or_else(|| points().next())?;
                        draft.bases.push(p);
                        Some((p, End::Base(draft.bases.len() - 1)))
                    });
                    self.turn(b, pivot?, &mut draft)?;
                }
            }
            if 2 * draft.bases.len() + draft.bodies.len() > MOST {
                return None;
            }
        }
        let n = 2 * draft.bases.len() + draft.bodies.len();
        let legs = bars.iter().filter_map(|&(ends, length)| {
            let ends = [self.end(ends[0], &draft)?, self.end(ends[1], &draft)?];
            // One between points that are found is checked, and says nothing of these.
            let is_leg = !matches!(ends, [End::Known(_), End::Known(_)]);
            is_leg.then_some(Leg { ends, length })
        });
        let legs: Vec<Leg> = legs.take(n).collect();
        let mut n_left = n - legs.len();
        let mut equations = Vec::new();
        for (c, constraint) in others {
            let end = |p: PointIdx| self.end(p, &draft);
            if let Some(equation) =
                Equation::new(*c, constraint, end).filter(|it| it.firm.n_rows <= n_left)
            {
                n_left -= equation.firm.n_rows;
                equations.push(equation);
            }
        }
        (n_left == 0).then(|| Block::new(draft.bases, draft.bodies, legs, equations))
    }

    /// The point of a body that is known, or is one of what has its numbers; none of others.
    fn pivot(&self, unit: Unit, draft: &Draft) -> Option<(PointIdx, End)> {
        let Unit::Body(b) = unit else { return None };
        self.bodies[b].points.iter().find_map(|&(p, _)| Some((p, self.end(p, draft)?)))
    }

    /// Gives a body its angle; none if another of its points has its place already.
    fn turn(&self, b: usize, (pivot, end): (PointIdx, End), draft: &mut Draft) -> Option<()> {
        let from = self.bodies[b].place(pivot)?;
        let others = || self.bodies[b].points.iter().filter(|(p, _)| *p != pivot);
        if others().any(|&(p, _)| self.end(p, draft).is_some()) {
            return None;
        }
        let away = |at: Vector| (at - from).norm_squared();
        let &(to, at) = others().max_by(|one, two| away(one.1).total_cmp(&away(two.1)))?;
        draft.bodies.push(Turning { pivot: end, to, arm: (at - from).norm() });
        draft.of_bodies.push((b, pivot));
        Some(())
    }

    /// How a point moves; none if it is none of those that have their numbers.
    fn end(&self, p: PointIdx, draft: &Draft) -> Option<End> {
        if self.search.knows(p) {
            return Some(End::Known(p));
        }
        if let Some(k) = draft.bases.iter().position(|base| *base == p) {
            return Some(End::Base(k));
        }
        let mut bodies = draft.of_bodies.iter().enumerate();
        bodies.find_map(|(j, &(b, pivot))| {
            let body = &self.bodies[b];
            let (at, from) = (body.place(p)?, body.place(pivot)?);
            let to = body.place(draft.bodies[j].to)?;
            Some(End::On(j, (at - from).over(to - from)))
        })
    }
}
