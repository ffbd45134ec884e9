//! Points that constraints tie together, with everything the solver keeps about them.

pub mod before;
pub mod closed;
pub mod fingerprint;
pub mod history;
pub mod inputs;
pub mod known_sides;
pub mod member;
pub mod memory;
mod packed;
pub mod partition;
pub mod postponed;
pub mod recall;
pub mod rest;
pub mod sides;
pub mod snapshot;
pub mod structure;
pub mod workspaces;

use std::sync::{Arc, OnceLock};

use super::closed_form::Compiled;
use super::frame::branch::Watch;
use super::frame::decomposition::{Plan, Side};
use super::method::spectrum::Spectrum;
use super::method::{Limits, Workspace};
use super::report::{Budget, Status};
use super::settings::Settings;
use crate::constraint::{Carried, Constraint, ConstraintKind, Point};
use crate::world::{ConstraintId, PointId, Record};
use before::Before;
use history::History;
use inputs::Inputs;
use member::Member;
use snapshot::Snapshot;
use structure::Structure;

/// A set of points that are not frozen, connected by constraints, and the frozen points that
/// these constraints hold too. Points have local indices here: free ones first, each group by
/// handle; constraints lie by kind, then points, then values that do not change by themselves. So an
/// island does not know in what order its constraints were made.
#[allow(clippy::struct_excessive_bools, reason = "each is a fact of its own")]
pub(crate) struct Island {
    /// The handles of the points, by local index.
    pub points: Vec<PointId>,
    /// How many of them are free.
    pub n_free: usize,
    /// Where they are.
    pub x: Vec<Point>,
    /// Their inverse masses; 0 for frozen ones.
    pub w: Vec<f64>,
    /// The constraints, over local indices.
    pub constraints: Vec<Constraint>,
    /// Their handles.
    pub ids: Vec<ConstraintId>,
    /// The coefficients of those that have one of their own; empty if none has.
    pub own_rho: Vec<Option<f64>>,
    /// Those that carry something on from pose to pose: unwrapped angles and the like.
    pub stateful: Vec<u32>,
    /// These, and motors: those that time and motion change.
    moving: Box<[u32]>,
    /// What can be found point by point.
    pub plan: Plan,
    /// The list of steps that finds its pose, if there is one; once it was asked for.
    pub closed_form: Compiled,
    /// Whether the pose was reached by that list since it was last worked out on which side of its
    /// singular pose each block is.
    are_sides_old: bool,
    /// Up to which degree the motion of each free point is smooth enough to extrapolate.
    pub degree: Vec<u8>,
    /// Whether `degree` was worked out at a pose.
    pub has_degree: bool,
    /// Where the free points were.
    pub history: History,
    /// How the last solve ended.
    pub status: Status,
    /// The largest distance to satisfaction it left, relative to the size.
    pub residual: f64,
    /// The last pose that met everything, kept while none does.
    pub feasible: Option<Box<[Point]>>,
    /// The work of its last visit: evaluations of constraints, and what takes as long.
    pub n_evaluations: u32,
    /// Whether it was never solved.
    pub is_new: bool,
    /// Whether everything held when it was made, and nothing was solved since: nothing has to be
    /// remembered of it, as it would be made anew the same.
    pub is_blank: bool,
    /// Whether it stands for what edits made of it, until that is put together.
    pub is_outdated: bool,
    /// Whether the user edited it since it was solved: it is solved as it is before time
    /// goes on.
    pub is_edited: bool,
    /// Whether it is to be visited in the next frame: what is brought back sleeps on otherwise.
    pub is_awake: bool,
    /// The energy at which a way off a saddle was last looked for; 0 if not since the last
    /// converged pose.
    pub probed_at: f64,
    /// What tells when a part that is solved as a whole turned over.
    pub watch: Watch,
    /// A point that may be on another branch since this frame.
    pub turned_over: Option<u32>,
    /// A point with several branches, all of which led on from where this frame began.
    pub chosen: Option<u32>,
    /// How far points may be from where they belong after this frame, length units, if it ended
    /// next to a singular pose; else 0.
    pub position_error: f64,
    /// What drives the island in this frame, as it was before.
    pub inputs: Inputs,
    /// How it was before the last frame, if that could not be solved and the one before could.
    pub before: Option<Box<Before>>,
    /// The longest length that a constraint asks for; none once it may have changed.
    wanted: Option<f64>,
    /// The room for the island as a whole, while it is needed.
    pub workspace: Option<Box<Workspace>>,
    /// The room for each part the plan leaves to be solved as a whole; once needed.
    pub part_workspaces: Vec<Workspace>,
    /// What is remembered of it, once asked for since the last visit.
    pub remembered: OnceLock<Arc<Snapshot>>,
    /// The hash of what it is built on, which stays; once asked for.
    pub(super) structure: OnceLock<u64>,
    /// The hash of what drives it and stays until it is edited; once asked for.
    still: OnceLock<u64>,
    /// What limits the relaxation coefficient; once relaxation ran.
    pub spectrum: Option<Box<Spectrum>>,
}

/// The evaluations of a constraint that a first visit is expected to make.
const FIRST_VISIT: u32 = 20;

impl Island {
    /// The island of these constraints; `at` and `w` are the columns of all points, and `local` one
    /// that it writes over.
    pub fn new(
        members: &mut [Member],
        at: impl Fn(PointId) -> Point,
        w: impl Fn(PointId) -> f64,
        local: &mut [u32],
    ) -> Self {
        members.sort_by(Member::order);
        let mut handles: Vec<u32> =
            members.iter().flat_map(|m| m.constraint.points().iter().copied()).collect();
        handles.sort_unstable();
        handles.dedup();
        let (free, frozen): (Vec<u32>, Vec<u32>) =
            handles.into_iter().partition(|&p| w(PointId(p)) > 0.0);
        for (k, &p) in free.iter().chain(&frozen).enumerate() {
            local[p as usize] = k as u32;
        }
        let mut constraints = Vec::with_capacity(members.len());
        for member in members.iter() {
            let mut constraint = member.constraint.clone();
            constraint.map_points(|p| local[p as usize]);
            constraints.push(constraint);
        }
        let own_rho = if members.iter().any(|m| m.rho.is_some()) {
            members.iter().map(|m| m.rho).collect()
        } else {
            Vec::new()
        };
        let n_free = free.len();
        let points: Vec<PointId> = free.iter().chain(&frozen).map(|&p| PointId(p)).collect();
        let plan = Plan::new(&constraints, n_free, points.len());
        let stateful = constraints.iter().enumerate().filter(|(_, c)| is_stateful(c));
        let stateful = stateful.map(|(c, _)| c as u32);
        let moving = constraints.iter().enumerate();
        let moving = moving.filter(|(_, c)| c.traits().carried != Carried::Nothing);
        let mut island = Self {
            n_free,
            stateful: stateful.collect(),
            moving: moving.map(|(c, _)| c as u32).collect(),
            x: points.iter().map(|&p| at(p)).collect(),
            w: points.iter().map(|&p| w(p)).collect(),
            ids: members.iter().map(|m| m.id).collect(),
            own_rho,
            degree: vec![1; n_free],
            has_degree: plan.is_complete(),
            watch: Watch::new(&plan, &constraints),
            turned_over: None,
            chosen: None,
            position_error: 0.0,
            constraints,
            plan,
            closed_form: Compiled::NotYet,
            are_sides_old: false,
            points,
            history: History::default(),
            status: Status::Stalled,
            residual: f64::INFINITY,
            feasible: None,
            n_evaluations: FIRST_VISIT * members.len() as u32,
            is_new: true,
            is_blank: false,
            is_outdated: false,
            is_edited: false,
            is_awake: true,
            probed_at: 0.0,
            inputs: Inputs::default(),
            before: None,
            wanted: None,
            workspace: None,
            part_workspaces: Vec::new(),
            remembered: OnceLock::new(),
            structure: OnceLock::new(),
            still: OnceLock::new(),
            spectrum: None,
        };
        for block in &island.plan.blocks {
            // A single point with freedom left is as easily found from where it is.
            island.degree[block.point as usize] = if block.is_determined { 3 } else { 0 };
        }
        island.update_sides();
        island
    }

    /// The local index of a point of this island.
    pub fn local_point(&self, id: PointId) -> Option<usize> {
        let (free, frozen) = self.points.split_at(self.n_free);
        free.binary_search(&id).ok().or_else(|| Some(self.n_free + frozen.binary_search(&id).ok()?))
    }

    /// Whether a record differs from the constraint `c` that stands here for it at most in its
    /// values: same points, equality or not as before, same coefficient; and it stands alone here,
    /// as where there are two of a kind on the same points their values tell which comes first.
    pub fn has_same(&self, c: usize, record: &Record) -> bool {
        let is_alike = |k: usize| {
            let (one, other) = (&self.constraints[c], &self.constraints[k]);
            one.kind() == other.kind() && one.points() == other.points()
        };
        if c > 0 && is_alike(c - 1) || c + 1 < self.constraints.len() && is_alike(c + 1) {
            return false;
        }
        let here = Structure {
            constraint: &self.constraints[c],
            rho: self.own_rho.get(c).copied().flatten(),
        };
        let there = Structure { constraint: &record.constraint, rho: record.rho() };
        here.words(|p| self.points[p as usize].0).eq(there.words(|p| p))
    }

    /// Puts a constraint's values in place of those it has; it has the same points as before. False
    /// if they are the same.
    pub fn set_values(&mut self, c: usize, constraint: &Constraint) -> bool {
        if let (Constraint::Motor(here), Constraint::Motor(there)) =
            (&mut self.constraints[c], constraint)
            && here.is_copy(there)
        {
            let before = here.heading();
            let has_turned = before != there.heading();
            if has_turned {
                here.set_heading(there.heading());
                self.remembered.take();
                self.inputs.note_turn(c as u32, before);
            }
            return has_turned;
        }
        let mut new = constraint.clone();
        new.set_points(self.constraints[c].points());
        if fingerprint::of_content(&new) == fingerprint::of_content(&self.constraints[c]) {
            // Deleted and brought back, set to what it was, or said in another way, a ratio by teeth: it
            // asks for the same to the bit, the sign of a zero included.
            self.constraints[c] = new;
            return false;
        }
        self.remembered.take();
        if new.nominal_length() != self.constraints[c].nominal_length() {
            self.wanted = None;
        }
        self.still.take();
        self.closed_form.note_values(c as u32, [&self.constraints[c], &new]);
        let old = std::mem::replace(&mut self.constraints[c], new);
        self.inputs.note_values(c as u32, old);
        true
    }

    /// Puts a point elsewhere, from outside.
    pub fn set_point(&mut self, p: usize, at: Point) {
        self.remembered.take();
        let old = std::mem::replace(&mut self.x[p], at);
        if p >= self.n_free {
            self.still.take();
            self.inputs.points.push((p as u32, old));
        } else {
            self.inputs.is_disturbed = true;
        }
    }

    /// Notes whether the parts that are solved as a whole have no freedom left, so that their
    /// motion is as smooth as what drives them.
    pub fn set_smooth(&mut self, is_smooth: bool) {
        self.has_degree = true;
        let free_to_choose = self.plan.rest.iter().flat_map(|part| &part.points);
        for &p in free_to_choose {
            self.degree[p as usize] = if is_smooth { 3 } else { 1 };
        }
    }

    /// Up to which degree the motion of any point is smooth enough to extrapolate.
    pub fn highest_degree(&self) -> u8 {
        self.degree.iter().copied().max().unwrap_or(0)
    }

    /// Whether the motion of what is solved as a whole counts as smooth.
    pub fn is_smooth(&self) -> bool {
        let first = self.plan.rest.first().and_then(|part| part.points.first());
        first.is_some_and(|&p| self.degree[p as usize] > 1)
    }

    /// Keeps how it was before a frame that was just tried in vain.
    pub fn note_halt(&mut self, is_first: bool) {
        if self.history.origin().len() != self.n_free {
            return;
        }
        let constraints = self.inputs.constraints_before(&self.constraints);
        let mut x = self.x.clone();
        x[..self.n_free].copy_from_slice(self.history.origin());
        for &(p, before) in &self.inputs.points {
            x[p as usize] = before;
        }
        self.before = Some(Box::new(Before { x, constraints, is_first }));
    }

    /// Exchanges the values that drive the island with those before.
    pub fn swap_inputs(&mut self) {
        self.inputs.swap(&mut self.constraints, &mut self.x);
    }

    /// The frame is over: its inputs are those of the present pose.
    pub fn settle_inputs(&mut self) {
        self.inputs.clear();
    }

    /// How large the island is: its extent, or the lengths it is to have. Never 0.
    pub fn size(&self) -> f64 {
        self.size_between(self.corners())
    }

    fn size_between(&self, (lo, hi): (Point, Point)) -> f64 {
        let extent = (hi.x - lo.x).max(hi.y - lo.y);
        let size = extent.max(self.wanted());
        if size > 0.0 && size.is_finite() { size } else { 1.0 }
    }

    /// The longest length that a constraint asks for, 0 if none does. The size is no less.
    pub fn wanted(&self) -> f64 {
        self.wanted.unwrap_or_else(|| {
            let lengths = self.constraints.iter().map(ConstraintKind::nominal_length);
            lengths.fold(0.0, f64::max)
        })
    }

    /// Keeps what is asked of it often and does not change until its values do.
    pub fn prepare(&mut self) {
        self.wanted = Some(self.wanted());
    }

    /// The same while the lengths of these numbers, ascending, change from frame to frame: they do not count.
    pub fn prepare_without(&mut self, changing: &[u32]) {
        let all = self.constraints.iter().zip(0..);
        let lengths = all.filter(|(_, c)| changing.binary_search(c).is_err());
        let lengths = lengths.map(|(constraint, _)| constraint.nominal_length());
        self.wanted = Some(lengths.fold(0.0, f64::max));
    }

    /// And after that: all count again.
    pub fn prepare_anew(&mut self) {
        self.wanted = None;
        self.prepare();
    }

    /// The least and the greatest coordinates of its points.
    fn corners(&self) -> (Point, Point) {
        corners(self.x.iter().copied())
    }

    /// How far a method is to go on this island.
    pub fn limits<'a>(&self, settings: &Settings, budget: &'a Budget<'a>) -> Limits<'a> {
        let (lo, hi) = self.corners();
        let size = self.size_between((lo, hi));
        let farthest = lo.x.abs().max(lo.y.abs()).max(hi.x.abs()).max(hi.y.abs());
        let tolerance = budget.tolerance_of(settings) * size;
        let tolerance = tolerance.max(rounding(farthest));
        Limits { size, tolerance, n_iterations: settings.iterations, budget }
    }

    /// The blocks are on the sides they were found on.
    pub fn keep_sides(&mut self) {
        for block in &mut self.plan.blocks {
            block.side = block.next_side;
        }
        self.watch.update(&self.x);
        self.watch.keep_part_sides();
    }

    /// Tells the constraints that this pose counts: angles are unwrapped from here on.
    pub fn accept_pose(&mut self) {
        for &c in &self.stateful {
            self.constraints[c as usize].accept(&self.x);
        }
    }

    /// Whether displacements in a frame stand for velocities here: its length matters then, and
    /// a frame in smaller steps would be another motion.
    pub fn has_velocities(&self) -> bool {
        self.stateful.iter().any(|&c| has_velocities(&self.constraints[c as usize]))
    }

    /// The next displacements, which stand for velocities, begin at this pose.
    pub fn begin_velocities(&mut self) {
        for &c in &self.stateful {
            let constraint = &mut self.constraints[c as usize];
            if has_velocities(constraint) {
                constraint.accept(&self.x);
            }
        }
    }

    /// On which side of its singular pose a block is.
    pub fn side_of_block(&self, k: usize) -> Side {
        let block = &self.plan.blocks[k];
        let which = &self.plan.constraints[block.first as usize..block.end as usize];
        super::frame::dyad::side(block, which, &self.constraints, &self.x)
    }

    /// Works out on which side of its singular pose each block is.
    pub fn update_sides(&mut self) {
        for k in 0..self.plan.blocks.len() {
            self.plan.blocks[k].side = self.side_of_block(k);
        }
        self.watch.update(&self.x);
        self.watch.forget_part_sides();
    }
}

/// The least and the greatest coordinates of points.
fn corners(points: impl Iterator<Item = Point>) -> (Point, Point) {
    let far = Point::new(f64::INFINITY, f64::INFINITY);
    let (mut lo, mut hi) = (far, Point::new(-far.x, -far.y));
    for p in points {
        lo.x = if p.x < lo.x { p.x } else { lo.x };
        lo.y = if p.y < lo.y { p.y } else { lo.y };
        hi.x = if p.x > hi.x { p.x } else { hi.x };
        hi.y = if p.y > hi.y { p.y } else { hi.y };
    }
    (lo, hi)
}

/// Whether the poses that count move on what a constraint carries.
fn is_stateful(constraint: &Constraint) -> bool {
    matches!(constraint.traits().carried, Carried::ByPose | Carried::ByFrame)
}

fn has_velocities(constraint: &Constraint) -> bool {
    constraint.traits().carried == Carried::ByFrame
}

/// A distance between coordinates of this magnitude is not known any better.
pub(crate) const fn rounding(magnitude: f64) -> f64 {
    8.0 * f64::EPSILON * magnitude
}
