//! The method `conjugate`: nonlinear conjugate gradients with the step length of Gauss-Newton
//! and the stiffness of stretched lengths. Needs no coefficient.

use super::method::{Limits, Outcome, Pose, Workspace};
use super::status::{Counters, Status};

/// A step longer than this part of the size is no longer a small change.
const LONGEST_STEP: f64 = 0.1;
/// A direction that is this far from down, relative to steepest, leads nowhere.
const LEAST_FACTOR: f64 = 1e-10;

/// A gain below this part of the energy is lost in its rounding.
const INVISIBLE: f64 = 1e-17;

/// Improves a pose; gives how it ended.
pub(super) fn solve(
    room: &mut Workspace,
    pose: &mut Pose,
    limits: &Limits,
    work: &mut Counters,
) -> Outcome {
    room.evaluate(pose, work);
    room.update_slope();
    let restart = 2 * room.slope.len() as u32;
    let mut before = vec![0.0; room.slope.len()];
    // What the step is shortened by after a restart that went up.
    let mut factor = 1.0;
    let mut n_since = 0;
    steepest(room);
    for n in 0..limits.n_iterations {
        if room.is_met(limits) {
            return room.outcome(Status::Converged, n);
        }
        if limits.budget.is_spent() {
            return room.outcome(Status::Stalled, n);
        }
        if factor < LEAST_FACTOR {
            return room.outcome(Status::BestFit, n);
        }
        let mut along: f64 = dot(&room.step, &room.slope);
        if along >= 0.0 || n_since > restart {
            steepest(room);
            along = -dot(&room.slope, &room.slope);
            n_since = 0;
        }
        let curvature = room.rows.curvature(&room.equations, &room.step);
        if !(along < 0.0 && curvature > 0.0) {
            return room.outcome(Status::BestFit, n);
        }
        let longest = limits.longest_step(LONGEST_STEP, room) / room.equations.reach(&room.step);
        let t = factor * (-along / curvature).min(longest);
        let start = room.rows.energy;
        if -along * t < INVISIBLE * start {
            return room.outcome(Status::BestFit, n);
        }
        room.remember(pose);
        if room.try_step(pose, t, work) > start {
            room.reject(pose, work);
            steepest(room);
            factor *= 0.5;
            n_since = 0;
            continue;
        }
        factor = (2.0 * factor).min(1.0);
        before.copy_from_slice(&room.slope);
        room.update_slope();
        // Polak and Ribiere, restarted where it would turn round.
        let square = dot(&before, &before);
        let beta = (dot(&room.slope, &room.slope) - dot(&room.slope, &before)) / square;
        let beta = if beta > 0.0 { beta } else { 0.0 };
        let Workspace { step, slope, .. } = room;
        step.iter_mut().zip(&*slope).for_each(|(p, g)| *p = beta * *p - g);
        n_since += 1;
    }
    let status = if room.is_met(limits) { Status::Converged } else { Status::Stalled };
    room.outcome(status, limits.n_iterations)
}

/// Aims straight down.
fn steepest(room: &mut Workspace) {
    let Workspace { step, slope, .. } = room;
    step.iter_mut().zip(&*slope).for_each(|(p, g)| *p = -g);
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
