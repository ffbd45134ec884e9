//! Which constraints contradict each other, and what would settle it.

use super::dependence::{Dependence, dependences};
use super::scene::{Rows, Scene, UnitRow};
use super::settle::can_hold_alone;

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

/// Conflicts of an island at its best fit, none of which shares a constraint with another.
///
/// At a best fit the residuals are a stress that the rows bear among themselves. Each
/// dependent row with those it depends on is a smallest set that can bear one, so it
/// contradicts itself if its residuals do work on that stress, and no subset of it does.
pub fn conflicts(scene: &Scene, island: &Rows, tolerance: f64) -> Vec<Conflict> {
    let mut apart: Vec<Conflict> = Vec::new();
    for dependence in contradictions(island, tolerance) {
        let conflict = conflict(&dependence, &island.rows);
        let is_apart = |known: &Conflict| {
            known.constraints.iter().all(|c| conflict.constraints.binary_search(c).is_err())
        };
        if apart.iter().all(is_apart) && !can_hold_alone(scene, &conflict.constraints, tolerance) {
            apart.push(conflict);
        }
    }
    apart
}

/// The smallest set of constraints found that `constraint` contradicts at the best fit, if any.
pub fn conflict_with(scene: &Scene, constraint: usize, tolerance: f64) -> Option<Conflict> {
    let (rows, _) = scene.rows(tolerance);
    let has_it = |island: &Rows| island.rows.iter().any(|row| row.source.0 == constraint);
    let mut island = rows.islands().into_iter().find(has_it)?;
    // Taken last, it depends on the others if it can.
    island.rows.sort_by_key(|row| (row.source.0 == constraint, row.source));
    contradictions(&island, tolerance)
        .iter()
        .map(|dependence| conflict(dependence, &island.rows))
        .filter(|conflict| conflict.constraints.contains(&constraint))
        .find(|conflict| !can_hold_alone(scene, &conflict.constraints, tolerance))
}

/// The dependent rows whose residuals do work on their stress, those of few rows first, and
/// among equals the worst.
fn contradictions(island: &Rows, tolerance: f64) -> Vec<Dependence> {
    if island.worst() <= tolerance {
        return Vec::new();
    }
    let misfit = |dependence: &Dependence| dependence.misfit(&island.rows).abs();
    let mut found = dependences(island, AT_BEST_FIT);
    let worst = found.iter().map(misfit).fold(0.0, f64::max);
    found.retain(|dependence| misfit(dependence) > tolerance.max(SECOND_ORDER * worst));
    found.sort_by(|a, b| a.on.len().cmp(&b.on.len()).then(misfit(b).total_cmp(&misfit(a))));
    found
}

fn conflict(dependence: &Dependence, rows: &[UnitRow]) -> Conflict {
    let work: f64 = dependence.stress().map(|(k, y)| y * rows[k].f).sum();
    let mut terms: Vec<_> = dependence.stress().map(|(k, y)| (&rows[k], y)).collect();
    terms.sort_by_key(|(row, _)| row.source);
    let mut constraints: Vec<_> = terms.iter().map(|(row, _)| row.source.0).collect();
    constraints.dedup();
    let residual = terms.iter().fold(0.0, |worst: f64, (row, _)| row.f.abs().max(worst));
    let repairs = terms.chunk_by(|a, b| a.0.source.0 == b.0.source.0).filter_map(|of_one| {
        // Of a vector equation no single value could be changed.
        let [(row, y)] = of_one else { return None };
        Some(Repair { constraint: row.source.0, change: work / (y * row.scale) })
    });
    let repairs = repairs.collect();
    Conflict { constraints, residual, repairs }
}
