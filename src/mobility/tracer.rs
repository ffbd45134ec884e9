//! Points that only follow others: where a mechanism goes does not depend on them.

use std::collections::BTreeSet;

use super::system::ConstraintSystem;
use crate::constraint::{ConstraintKind, PointIdx, Vector};

/// Two equations count as one if the sine of the angle between what they ask of a point is below
/// this.
const PARALLEL: f64 = 1e-6;

/// Of the constraints that hang together with those that are driven, all given by their places in a
/// scene, those that are left when points are left out, again and again, that hang on the others by exactly two
/// linear equations: wherever the others are, there is one place for such a point, however far
/// away.
pub fn without_tracers(scene: &ConstraintSystem, driven: &BTreeSet<usize>) -> Vec<usize> {
    let sources = scene.neighbours(driven);
    let mut at: Vec<Vec<usize>> = vec![Vec::new(); scene.x.len()];
    for &c in &sources {
        for &p in scene.constraints[c].points() {
            if at[p as usize].last() != Some(&c) {
                at[p as usize].push(c);
            }
        }
    }
    let mut is_left_out = vec![false; scene.constraints.len()];
    let mut open: Vec<PointIdx> = (0..scene.x.len() as PointIdx).rev().collect();
    while let Some(p) = open.pop() {
        let holders = at[p as usize].iter().copied();
        let holders: Vec<usize> = holders.filter(|&c| !is_left_out[c]).collect();
        let may_follow = scene.w[p as usize] > 0.0 && !holders.iter().any(|c| driven.contains(c));
        if may_follow && only_follows(scene, p, &holders) {
            for c in holders {
                is_left_out[c] = true;
                open.extend(scene.constraints[c].points().iter().filter(|&&q| q != p));
            }
        }
    }
    sources.into_iter().filter(|&c| !is_left_out[c]).collect()
}

/// Whether a point has one place wherever the other points of what holds it are.
fn only_follows(scene: &ConstraintSystem, p: PointIdx, holders: &[usize]) -> bool {
    let is_linear = |&c: &usize| scene.constraints[c].traits().is_linear;
    if !matches!(holders.len(), 1 | 2) || !holders.iter().all(is_linear) {
        return false;
    }
    let mut gradients = Vec::new();
    for &c in holders {
        scene.constraints[c].jacobian(scene.x, &mut |row| {
            let own = row.terms().filter(|&(q, _)| q == p);
            gradients.push(own.fold(Vector::ZERO, |sum, (_, g)| sum + g));
        });
    }
    let [a, b] = gradients[..] else { return false };
    a.perp().dot(b).abs() > PARALLEL * a.norm() * b.norm()
}
