//! The run that makes a reference, and what keeps it from being one.

use super::host::StudyHost;
use super::reference::Reference;
use super::repeatable_motion::{RepeatableMotion, Replay};
use super::sample::Subject;
use crate::constraint::{Constraint, Point};
use crate::diag::{Diagnostic, format_counted, format_digits};
use crate::mobility::{self, Analysis, ConstraintSystem, Directions, analyse, freedom};
use crate::solve::{Budget, Method, Report, Settings, Status, verdict};
use crate::world::{PointId, World};

/// Tolerances to ask for, until one is reached in every frame. Rounding of coordinates keeps
/// the first from being reached on some scenes; the last is what is promised elsewhere.
const TOLERANCES: [f64; 4] = [1e-15, 1e-14, 1e-13, 1e-12];
/// A run that is worse than this will not be better for a looser tolerance.
const HOPELESS: f64 = 1e-9;
/// Points that move less, relative to the size, after the first frame, do not move.
const STILL: f64 = 1e-9;
/// Two references that differ by more, relative to the size, are on different branches;
/// differences of rounding are below 1e-9 on all scenes tried.
const BRANCHES: f64 = 1e-6;
/// Places kept, at most: 16 bytes each.
const MOST_PLACES: u64 = 8_000_000;
/// Points beyond which it is not worked out which of them are free: each takes a factorisation.
const MOST_POINTS: usize = 300;

/// What came of the search for a reference.
#[derive(Debug)]
pub(super) struct FoundReference {
    /// It, if there is one.
    pub reference: Option<Reference>,
    /// What has to be said about it.
    pub notes: Vec<String>,
    /// The frames that can be studied.
    pub n_frames: u64,
    /// The motion is none.
    pub is_still: bool,
}

/// A run by `auto` with all places kept.
struct Recording {
    reference: Reference,
    n_frames: u64,
    n_bad: u64,
    worst: Report,
    seconds: f64,
    /// The world at its end.
    world: World,
}

/// Repeats the motion as exactly as possible; `seconds` is what that may take.
///
/// # Errors
/// A live expression that has no value at some frame.
pub(super) fn of_motion(
    motion: &RepeatableMotion,
    host: &StudyHost,
    seconds: f64,
) -> Result<FoundReference, Diagnostic> {
    let points = movable(motion.world());
    let most = (MOST_PLACES / points.len().max(1) as u64).max(1);
    let n_asked = motion.n_frames;
    let mut best: Option<Recording> = None;
    for tolerance in TOLERANCES {
        let n = best.as_ref().map_or(n_asked.min(most), |best| best.n_frames);
        let run = record(motion, &points, tolerance, n, 1, host, seconds)?;
        let is_better = best.as_ref().is_none_or(|best| run.n_bad < best.n_bad);
        if is_better && run.n_frames > 0 {
            best = Some(run);
        }
        let done = best.as_ref().is_none_or(|b| b.n_bad == 0 || b.worst.residual > HOPELESS);
        if done || (host.stop)() {
            break;
        }
    }
    let Some(best) = best else {
        let notes = vec!["not even one frame could be solved in the time there is".to_owned()];
        return Ok(FoundReference { reference: None, notes, n_frames: 0, is_still: false });
    };
    let mut found = FoundReference {
        reference: None,
        notes: Vec::new(),
        n_frames: best.n_frames,
        is_still: best.is_still(),
    };
    if best.n_frames < n_asked && !(host.stop)() {
        found.notes.push(format!(
            "only the first {} of {n_asked} frames are studied: more take too long",
            best.n_frames
        ));
    }
    if found.is_still {
        return Ok(found);
    }
    if best.n_bad > 0 {
        found.notes.push(format!(
            "there is no reference: {} of its {} ended as {}, with residuals up to {}; \
             position errors are left out",
            best.n_bad,
            best.n_frames,
            best.worst.status.phrase(),
            format_digits(best.worst.residual, 2)
        ));
        return Ok(found);
    }
    let held: Vec<PointId> = motion.held().collect();
    let Some(mut reference) = compared(best.reference, &best.world, &held, &mut found.notes) else {
        return Ok(found);
    };
    if motion.has_velocity_cogs() {
        found.notes.push(
            "cog wheels in velocity form go astray by the length of a frame; the reference has \
             the same frames and goes astray with them"
                .to_owned(),
        );
        found.reference = Some(reference);
        return Ok(found);
    }
    if 2.0 * best.seconds < seconds {
        let finer =
            record(motion, &reference.points, 1e-12, best.n_frames, 2, host, seconds)?.reference;
        let pairs = reference.at.iter().zip(&finer.at);
        let off = pairs.map(|(a, b)| a.distance(*b)).fold(0.0, f64::max) / reference.size;
        if off > BRANCHES {
            found.notes.push(format!(
                "there is no reference: with frames half as long points come out elsewhere, by \
                 {} of the scene's size; the motion goes through a pose where it has several \
                 branches, or past one where it has none; position errors are left out",
                format_digits(off, 2)
            ));
            return Ok(found);
        }
        reference.error = reference.error.max(off);
    }
    found.reference = Some(reference);
    Ok(found)
}

/// Solves the pose as exactly as possible.
pub(super) fn of_pose(subject: &Subject, host: &StudyHost) -> Result<FoundReference, Diagnostic> {
    let motion = subject.motion;
    let points = movable(motion.world());
    let mut found =
        FoundReference { reference: None, notes: Vec::new(), n_frames: 1, is_still: true };
    let mut last = None;
    for tolerance in TOLERANCES {
        let settings = Settings { method: Method::Auto, tolerance, ..motion.settings };
        let (world, report) = subject.solve_pose(&settings, host)?;
        let found = verdict(&world, &settings);
        let status = found.ending(report.status);
        let is_done = status == Status::Converged || found.residual > HOPELESS;
        last = Some((world, status, found.residual));
        if is_done {
            break;
        }
    }
    let Some((world, status, residual)) = last else { return Ok(found) };
    if status != Status::Converged {
        found.notes.push(format!(
            "there is no reference: it ended as {}, with a residual of {}; position errors are \
             left out",
            status.phrase(),
            format_digits(residual, 2)
        ));
        return Ok(found);
    }
    let at: Vec<Point> = points.iter().map(|&p| world.points().at(p)).collect();
    let reference = Reference { size: size_of(&world, &at), points, at, error: 0.0 };
    let held: Vec<PointId> = motion.held().collect();
    found.reference = compared(reference, &world, &held, &mut found.notes);
    Ok(found)
}

/// Leaves of a reference the points that constraints determine; none where too few are.
fn compared(
    mut reference: Reference,
    world: &World,
    held: &[PointId],
    notes: &mut Vec<String>,
) -> Option<Reference> {
    let analysis = freedoms(world, held);
    // Rounding of coordinates, carried on to where it hurts most.
    let rounding = 4.0 * f64::EPSILON;
    reference.error = analysis.position_error(rounding).unwrap_or(rounding).max(rounding);
    let n_free = analysis.degrees_of_freedom;
    if n_free == 0 {
        return Some(reference);
    }
    let freedoms = format_counted(n_free as u64, "freedom");
    let n_points = reference.points.len();
    if n_points <= MOST_POINTS {
        with_scene(world, held, |scene| {
            reference.keep(|p| freedom(scene, p.0).directions == Directions::None);
        });
        let n_left = reference.points.len();
        if 2 * n_left >= n_points {
            notes.push(format!(
                "the scene has {freedoms} left that nothing drives; position errors are those of \
                 the {n_left} points of {n_points} that have none"
            ));
            return Some(reference);
        }
    }
    notes.push(format!(
        "there is no reference: the scene has {freedoms} left that nothing drives, so where its \
         points go is a matter of the method; position errors are left out"
    ));
    None
}

/// What a world can do at its pose, with some more points held.
pub fn freedoms(world: &World, held: &[PointId]) -> Analysis {
    with_scene(world, held, |scene| analyse(scene, 1e-9))
}

fn with_scene<T>(
    world: &World,
    held: &[PointId],
    f: impl FnOnce(&mobility::ConstraintSystem) -> T,
) -> T {
    let points = world.points();
    let mut w = points.inverse_masses();
    held.iter().for_each(|p| w[p.idx()] = 0.0);
    let constraints: Vec<&Constraint> =
        world.constraints().filter(|(_, r)| r.is_on).map(|(_, r)| &r.constraint).collect();
    f(&ConstraintSystem { constraints: &constraints, x: points.column(), w: &w })
}

fn movable(world: &World) -> Vec<PointId> {
    world.points().ids().filter(|&p| !world.points().is_frozen(p)).collect()
}

/// The extent of the scene and of all places in it; never 0.
fn size_of(world: &World, at: &[Point]) -> f64 {
    let all = world.points().ids().map(|p| world.points().at(p)).chain(at.iter().copied());
    let (lo, hi) = all.fold(
        (Point::new(f64::INFINITY, f64::INFINITY), Point::new(-f64::INFINITY, -f64::INFINITY)),
        |(lo, hi), p| {
            (Point::new(lo.x.min(p.x), lo.y.min(p.y)), Point::new(hi.x.max(p.x), hi.y.max(p.y)))
        },
    );
    let size = (hi.x - lo.x).max(hi.y - lo.y);
    if size > 0.0 { size } else { 1.0 }
}

fn record(
    motion: &RepeatableMotion,
    points: &[PointId],
    tolerance: f64,
    n_frames: u64,
    n_parts: u32,
    host: &StudyHost,
    seconds: f64,
) -> Result<Recording, Diagnostic> {
    let begun = (host.now)();
    let settings = Settings { method: Method::Auto, tolerance, ..motion.settings };
    let is_over = || (host.stop)() || (host.now)() - begun > seconds;
    let budget = Budget { tolerance: None, stop: Some(&is_over), ..Budget::default() };
    let mut replay = Replay::new(motion, n_parts);
    let mut at = Vec::new();
    let (mut n_done, mut n_bad) = (0, 0);
    let mut worst = Report::default();
    while n_done < n_frames {
        let report = replay.frame(&settings, &budget)?;
        if is_over() {
            break;
        }
        n_done += 1;
        n_bad += u64::from(report.status != Status::Converged);
        worst.status = worst.status.max(report.status);
        worst.residual = worst.residual.max(report.residual);
        at.extend(points.iter().map(|&p| replay.world.points().at(p)));
    }
    let size = size_of(&replay.world, &at);
    let reference = Reference { points: points.to_vec(), at, size, error: 0.0 };
    let seconds = (host.now)() - begun;
    Ok(Recording { reference, n_frames: n_done, n_bad, worst, seconds, world: replay.world })
}

impl Recording {
    /// Whether nothing moved after the first frame.
    fn is_still(&self) -> bool {
        let Reference { points, at, size, .. } = &self.reference;
        let n = points.len();
        n == 0
            || at.chunks(n).skip(1).all(|frame| {
                let first = &at[..n];
                frame.iter().zip(first).all(|(p, q)| p.distance(*q) <= STILL * size)
            })
    }
}
