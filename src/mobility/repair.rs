//! By how much a single constraint has to change so that all hold, beyond the first order.

use super::settle::Subset;
use super::system::ConstraintSystem;

/// How much the constraint to be changed still counts, from round to round: less and less, so
/// that the others hold and it changes as little as they allow.
const COUNTS: [f64; 4] = [0.3, 0.1, 1e-2, 1e-3];

/// The change of the value of `constraint`, in its own unit, with which all of `among` hold,
/// itself included; none if the others do not hold whatever its value. It is the smallest
/// change near this pose: where the others leave a choice, they go as far as they can.
pub fn repair(
    scene: &ConstraintSystem,
    constraint: usize,
    among: &[usize],
    tolerance: f64,
) -> Option<f64> {
    let subset = Subset::new(scene, among);
    let mut x = subset.start();
    for counts in COUNTS {
        x = subset.settle(x, (constraint, counts), 0.0).x;
    }
    // The last bits: what the value is measured on has to be a solution of the others.
    let reached = subset.settle(x, (constraint, 0.0), 1e-3 * tolerance);
    let change = subset.residual(constraint, &reached.x);
    (reached.worst <= tolerance && change.is_finite()).then_some(change)
}
