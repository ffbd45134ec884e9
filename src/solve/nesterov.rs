//! The method `nesterov`: descent with momentum, restarted whenever it turns against itself.

use super::method::{Limits, Outcome, Pose, Workspace};
use super::spectrum::Spectrum;
use super::status::{Counters, Status};
use crate::constraint::{Point, Vector};
use crate::world::PointId;

/// A pose that moves by less, relative to the size, has come to rest.
const STILL: f64 = 1e-15;

/// A step of descent longer than this part of the size is no longer a small change.
const LONGEST_STEP: f64 = 0.1;

/// Improves a pose; gives how it ended.
pub(super) fn solve(
    room: &mut Workspace,
    points: &[PointId],
    pose: &mut Pose,
    limits: &Limits,
    work: &mut Counters,
) -> Outcome {
    room.evaluate(pose, work);
    let mut spectrum = Spectrum::new(points);
    let mut here: Vec<Point> = Vec::new();
    room.equations.gather(pose.x, &mut here);
    let energy_at_start = room.rows.energy;
    // Momentum may lead up for as long as it likes: the distance that belongs to an angle grows
    // with the way out. It then ends at the best pose on its way.
    let (mut best, mut energy_at_best) = (here.clone(), energy_at_start);
    let mut last = here.clone();
    let mut momentum = 1.0_f64;
    for n in 0..limits.n_iterations {
        if room.is_met(limits) {
            return room.outcome(Status::Converged, n);
        }
        let largest = spectrum.largest(&room.equations, &room.rows, |_| 1.0);
        if limits.budget.is_spent() || largest <= 0.0 {
            return room.outcome(Status::Stalled, n);
        }
        // A step of descent from the extrapolated pose.
        room.update_slope();
        room.remember(pose);
        let Workspace { step, slope, .. } = room;
        step.iter_mut().zip(&*slope).for_each(|(s, g)| *s = -g / largest);
        let longest = limits.longest_step(LONGEST_STEP, room);
        let t = (longest / room.equations.reach(&room.step)).min(1.0);
        if !room.equations.displace(pose.x, &room.before, &room.step, t) {
            room.reject(pose, work);
            return room.outcome(Status::Stalled, n);
        }
        room.equations.gather(pose.x, &mut here);
        // Uphill of where momentum carries us: stop and begin anew.
        let moved = |k: usize| -> Vector { here[k] - last[k] };
        let stepped = |k: usize| -> Vector { here[k] - room.before[k] };
        let uphill: f64 = (0..here.len()).map(|k| -stepped(k).dot(moved(k))).sum();
        let longest = (0..here.len()).fold(0.0_f64, |most, k| most.max(moved(k).norm()));
        if longest <= STILL * limits.size {
            room.evaluate(pose, work);
            return room.outcome(Status::BestFit, n + 1);
        }
        let next = if uphill > 0.0 { 1.0 } else { 0.5 + (0.25 + momentum * momentum).sqrt() };
        let beta = if uphill > 0.0 { 0.0 } else { (momentum - 1.0) / next };
        momentum = next;
        for (k, &p) in room.equations.points().iter().enumerate() {
            pose.x[p as usize] = here[k] + moved(k) * beta;
        }
        std::mem::swap(&mut last, &mut here);
        room.evaluate(pose, work);
        if room.rows.energy < energy_at_best {
            energy_at_best = room.rows.energy;
            room.equations.gather(pose.x, &mut best);
        }
    }
    // The pose it stands for is the one without the momentum, if that is better.
    let extrapolated = room.rows.worst;
    room.equations.gather(pose.x, &mut here);
    room.equations.scatter(&last, pose.x);
    room.evaluate(pose, work);
    if extrapolated < room.rows.worst {
        room.equations.scatter(&here, pose.x);
        room.evaluate(pose, work);
    }
    if room.rows.energy.is_nan() || room.rows.energy > energy_at_start {
        room.equations.scatter(&best, pose.x);
        room.evaluate(pose, work);
    }
    let status = if room.is_met(limits) { Status::Converged } else { Status::Stalled };
    room.outcome(status, limits.n_iterations)
}
