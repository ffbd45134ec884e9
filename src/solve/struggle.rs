//! A pose that does not follow from the one before: a first solve, a place out of reach, or
//! the way back from there.

use super::island::Island;
use super::method::{Limits, Outcome, Pose, Workspace};
use super::relaxation::{self, Coefficient};
use super::spectrum::{Spectrum, noise};
use super::status::{Counters, Status};
use super::{conjugate, newton};
use crate::constraint::{Point, Vector};

/// A start this far off, relative to the size, is far: first-order steps first.
const FAR: f64 = 1e-3;
/// How many of them.
const FIRST_ORDER_STEPS: u32 = 300;
/// How far points are pushed to leave a saddle, relative to the size.
const PUSH: f64 = 1e-4;
/// The paper's coefficient, for relaxation as a first step.
const GENTLE: f64 = 0.5;
/// The part of the energy a push has to gain to count.
const WORTHWHILE: f64 = 1e-6;

/// Solves an island from where it stands, or from its last feasible pose.
pub(super) fn settle(island: &mut Island, limits: &Limits, work: &mut Counters) -> Outcome {
    let n_free = island.n_free;
    if island.status == Status::Converged && !island.inputs.is_disturbed {
        island.feasible = Some(island.x[..n_free].into());
    }
    island.history.forget();
    let start: Box<[Point]> = island.x[..n_free].into();
    let is_elsewhere = island.feasible.as_ref().is_some_and(|pose| *pose != start);
    let mut room = island.take_room();
    let mut best = descend(island, &mut room, limits, work);
    // What is reached from the last feasible pose does not depend on the way since then. It
    // counts unless it is worse: there and back ends where it began.
    if let Some(feasible) = island.feasible.take() {
        if is_elsewhere {
            let here: Box<[Point]> = island.x[..n_free].into();
            island.x[..n_free].copy_from_slice(&feasible);
            let from_feasible = descend(island, &mut room, limits, work);
            if is_better(&best, &from_feasible) {
                island.x[..n_free].copy_from_slice(&here);
            } else {
                best = from_feasible;
            }
        }
        island.feasible = Some(feasible);
    }
    if !best.is_converged() && !island.is_probed && !limits.budget.is_spent() {
        island.is_probed = true;
        best = probe(island, &mut room, best, limits, work);
        if !best.is_converged() {
            best = relax_first(island, &mut room, &start, best, limits, work);
        }
    }
    island.put_room(room);
    if best.is_converged() {
        island.feasible = None;
        island.is_probed = false;
        island.accept_pose();
        island.update_sides();
        island.drop_room();
    }
    best
}

/// Whether one ending is better than another, by more than rounding.
fn is_better(one: &Outcome, other: &Outcome) -> bool {
    match (one.is_converged(), other.is_converged()) {
        (true, other) => !other,
        (false, true) => false,
        (false, false) => one.energy < other.energy * (1.0 - WORTHWHILE),
    }
}

/// Newton steps; where they do not arrive from afar, first-order steps and then again.
fn descend(
    island: &mut Island,
    room: &mut Workspace,
    limits: &Limits,
    work: &mut Counters,
) -> Outcome {
    let mut pose = Pose { constraints: &island.constraints, x: &mut island.x };
    let first = newton::solve(room, &mut pose, limits, work);
    if first.status != Status::Stalled
        || first.worst <= FAR * limits.size
        || limits.budget.is_spent()
    {
        return first;
    }
    let many = Limits { n_iterations: FIRST_ORDER_STEPS, ..*limits };
    let second = conjugate::solve(room, &mut pose, &many, work);
    let last = newton::solve(room, &mut pose, limits, work);
    let n_iterations = first.n_iterations + second.n_iterations + last.n_iterations;
    Outcome { n_iterations, ..last }
}

/// Pushes the points a little and lets go: a saddle is left for a better place.
fn probe(
    island: &mut Island,
    room: &mut Workspace,
    before: Outcome,
    limits: &Limits,
    work: &mut Counters,
) -> Outcome {
    let n_free = island.n_free;
    let here: Box<[Point]> = island.x[..n_free].into();
    for (x, id) in island.x[..n_free].iter_mut().zip(&island.points) {
        let push = Vector::new(noise(2 * id.0), noise(2 * id.0 + 1));
        *x += push * (PUSH * limits.size);
    }
    let after = descend(island, room, limits, work);
    if is_better(&after, &before) {
        return Outcome { n_iterations: before.n_iterations + after.n_iterations, ..after };
    }
    island.x[..n_free].copy_from_slice(&here);
    before
}

/// Relaxes from the start before the Newton steps: of the many best fits of a scene that
/// contradicts itself the one taken is no worse than the one the paper's method finds.
fn relax_first(
    island: &mut Island,
    room: &mut Box<Workspace>,
    start: &[Point],
    before: Outcome,
    limits: &Limits,
    work: &mut Counters,
) -> Outcome {
    let n_free = island.n_free;
    let here: Box<[Point]> = island.x[..n_free].into();
    island.x[..n_free].copy_from_slice(start);
    room.rows.evaluate(&room.equations, &island.constraints, &island.x, work);
    let mut spectrum = Spectrum::new(&island.points[..n_free]);
    let largest = spectrum.largest(&room.equations, &room.rows, |_| 1.0);
    let mut coefficient = Coefficient::at_most(GENTLE, largest);
    relaxation::solve(island, &mut coefficient, limits, work);
    let after = descend(island, room, limits, work);
    if is_better(&after, &before) {
        return Outcome { n_iterations: before.n_iterations + after.n_iterations, ..after };
    }
    island.x[..n_free].copy_from_slice(&here);
    before
}
