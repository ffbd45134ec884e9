//! Which constraints contradict each other, and what would settle it.

use super::dependence::{Dependence, dependences};
use super::settle::held_alone;
use super::system::{ConstraintSystem, UnitRow, UnitRows};
use crate::constraint::ConstraintKind;

/// Constraints that cannot all hold.
#[derive(Debug, Clone, PartialEq)]
pub struct Conflict {
    /// The smallest set found, in order of creation: without any one of them the others agree.
    pub constraints: Vec<usize>,
    /// How far the best fit leaves the worst of them from satisfaction, length units.
    pub residual: f64,
    /// What would settle it: any one of these alone.
    pub repairs: Vec<Repair>,
}

/// A change of a single constraint that lets all of a conflict hold, to first order.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Repair {
    /// Which constraint.
    pub constraint: usize,
    /// What to add to its length, angle or other measured value, in its own unit.
    pub change: f64,
}

/// What may be left of a row that depends on others, at a best fit: rows are dependent there
/// only as exactly as the fit is best.
const AT_BEST_FIT: f64 = 1e-5;

/// Rows that agree contradict each other at a pose where they do not hold by the square of
/// their distances; less than this part of the worst contradiction is not looked at.
const SECOND_ORDER: f64 = 1e-3;

/// Sets of more constraints than this are reported as found: each trial that leaves one out
/// settles the others.
const MOST_TRIED: usize = 200;

/// Conflicts of an island at its best fit, none of which shares a constraint with another.
///
/// At a best fit the residuals are a stress that the rows bear among themselves. Each
/// dependent row with those it depends on is a smallest set that can bear one, so to first
/// order it contradicts itself if its residuals do work on that stress. That is a first guess: what
/// is reported cannot hold, and can without any one of its members.
pub fn conflicts(scene: &ConstraintSystem, island: &UnitRows, tolerance: f64) -> Vec<Conflict> {
    let mut apart: Vec<Conflict> = Vec::new();
    for set in contradictions(island, tolerance) {
        let is_known = |c: &usize| apart.iter().any(|known| known.constraints.contains(c));
        if set.iter().any(is_known) {
            continue;
        }
        let mut others = constraints_of(island);
        others.retain(|c| !is_known(c));
        if let Some(set) = contradictory(scene, set, &others, tolerance) {
            let set = smallest(scene, set, None, tolerance);
            apart.push(conflict(island, set));
        }
    }
    apart
}

/// The smallest set of constraints found that `constraint` contradicts at the best fit, if any:
/// the one that `conflicts` has, if it is in one of these.
pub fn conflict_with(
    scene: &ConstraintSystem,
    constraint: usize,
    tolerance: f64,
) -> Option<Conflict> {
    let (rows, _) = scene.rows(tolerance);
    let has_it = |island: &UnitRows| island.rows.iter().any(|row| row.source.0 == constraint);
    let mut island = rows.islands().into_iter().find(has_it)?;
    let mut known = conflicts(scene, &island, tolerance).into_iter();
    if let Some(conflict) = known.find(|c| c.constraints.contains(&constraint)) {
        return Some(conflict);
    }
    let all = constraints_of(&island);
    // Taken last, it depends on the others if it can.
    island.rows.sort_by_key(|row| (row.source.0 == constraint, row.source));
    let sets = contradictions(&island, tolerance).into_iter();
    let mut about_it =
        sets.filter(|set| set.binary_search(&constraint).is_ok()).filter_map(|set| {
            let set = contradictory(scene, set, &all, tolerance)?;
            let set = smallest(scene, set, Some(constraint), tolerance);
            let others: Vec<_> = set.iter().copied().filter(|&c| c != constraint).collect();
            held_alone(scene, &others, tolerance).map(|_| set)
        });
    about_it.next().map(|set| conflict(&island, set))
}

/// The constraints that have rows in an island, ascending.
fn constraints_of(island: &UnitRows) -> Vec<usize> {
    let mut constraints: Vec<_> = island.rows.iter().map(|row| row.source.0).collect();
    constraints.sort_unstable();
    constraints.dedup();
    constraints
}

/// A set that cannot hold: the given one with as many of the others as that takes, each time the
/// one that is missed most where all so far hold. None if there is a pose where all hold, or if
/// the set becomes too large.
fn contradictory(
    scene: &ConstraintSystem,
    mut set: Vec<usize>,
    others: &[usize],
    tolerance: f64,
) -> Option<Vec<usize>> {
    loop {
        let Some(x) = held_alone(scene, &set, tolerance) else { return Some(set) };
        if set.len() > MOST_TRIED {
            return None;
        }
        let missed = others.iter().filter(|c| set.binary_search(c).is_err());
        let missed = missed.map(|&c| (scene.constraints[c].violation(&x, scene.w), c));
        let (most, worst) = missed.max_by(|a, b| a.0.total_cmp(&b.0).then(b.1.cmp(&a.1)))?;
        if most <= tolerance {
            return None;
        }
        set.insert(set.partition_point(|&c| c < worst), worst);
    }
}

/// Leaves out, the latest first, what a set contradicts itself without (a deletion filter);
/// never `kept`.
///
/// What stays was seen to be needed: the others could hold, and fewer of them can, too.
fn smallest(
    scene: &ConstraintSystem,
    mut set: Vec<usize>,
    kept: Option<usize>,
    tolerance: f64,
) -> Vec<usize> {
    if set.len() > MOST_TRIED {
        return set;
    }
    for k in (0..set.len()).rev() {
        let mut others = set.clone();
        let left_out = others.remove(k);
        if Some(left_out) != kept && held_alone(scene, &others, tolerance).is_none() {
            set = others;
        }
    }
    set
}

/// The constraints of dependent rows whose residuals do work on their stress, small sets
/// first, and among equals the worst.
fn contradictions(island: &UnitRows, tolerance: f64) -> Vec<Vec<usize>> {
    if island.worst() <= tolerance {
        return Vec::new();
    }
    let misfit = |dependence: &Dependence| dependence.misfit(&island.rows).abs();
    let mut found = dependences(island, AT_BEST_FIT);
    found.iter_mut().for_each(|dependence| dependence.keep_above(10.0 * AT_BEST_FIT));
    let worst = found.iter().map(misfit).fold(0.0, f64::max);
    found.retain(|dependence| misfit(dependence) > tolerance.max(SECOND_ORDER * worst));
    found.sort_by(|a, b| a.on.len().cmp(&b.on.len()).then(misfit(b).total_cmp(&misfit(a))));
    let constraints = |dependence: &Dependence| {
        let rows = dependence.stress().map(|(k, _)| island.rows[k].source.0);
        let mut constraints: Vec<_> = rows.collect();
        constraints.sort_unstable();
        constraints.dedup();
        constraints
    };
    found.iter().map(constraints).collect()
}

fn conflict(island: &UnitRows, constraints: Vec<usize>) -> Conflict {
    let rows = island.filtered(|row| constraints.binary_search(&row.source.0).is_ok());
    let mut stresses = dependences(&rows, AT_BEST_FIT);
    stresses.iter_mut().for_each(|stress| stress.keep_above(10.0 * AT_BEST_FIT));
    let misfit = |dependence: &&Dependence| dependence.misfit(&rows.rows).abs();
    let stress = stresses.iter().max_by(|a, b| misfit(a).total_cmp(&misfit(b)));
    let repairs = stress.map_or(Vec::new(), |stress| repairs(stress, &rows.rows));
    Conflict { constraints, residual: rows.worst(), repairs }
}

/// For each constraint with one row under stress, the change of its value after which the
/// residuals do no work.
fn repairs(stress: &Dependence, rows: &[UnitRow]) -> Vec<Repair> {
    let work: f64 = stress.stress().map(|(k, y)| y * rows[k].f).sum();
    let mut terms: Vec<_> = stress.stress().map(|(k, y)| (&rows[k], y)).collect();
    terms.sort_by_key(|(row, _)| row.source);
    let of_each = terms.chunk_by(|a, b| a.0.source.0 == b.0.source.0);
    let repair = |of_one: &[(&UnitRow, f64)]| match of_one {
        [(row, y)] => Some(Repair { constraint: row.source.0, change: work / (y * row.scale) }),
        // Of a vector equation no single value could be changed.
        _ => None,
    };
    of_each.filter_map(repair).collect()
}
