//! The motion to be repeated: where it starts, how long it takes, and what a hand moves.

use super::hand::{Hand, move_by};
use crate::constraint::{Carried, Constraint, ConstraintKind as _};
use crate::diag::Diagnostic;
use crate::solve::{Budget, Memory, Report, Settings, Solver};
use crate::world::{Edit, Moment, PointId, World};

/// A motion that can be done again: a world as it was before, and what happened then.
#[derive(Debug, Clone)]
pub struct RepeatableMotion {
    /// The world before the first frame; without traces, which nobody looks at here.
    world: World,
    /// What the solver remembered then.
    memory: Memory,
    /// The settings that are not under study.
    pub settings: Settings,
    /// What happens, one after the other; after the last, time goes on alone.
    legs: Vec<Leg>,
    /// How many frames to do.
    pub n_frames: u64,
}

/// Frames in which the same hands are at work.
#[derive(Debug, Clone, PartialEq)]
pub struct Leg {
    /// How many frames.
    pub n_frames: u64,
    /// The points moved from outside.
    pub hands: Vec<Hand>,
}

impl RepeatableMotion {
    /// The motion of `world` from now on: time passes and nothing else happens.
    pub fn ahead(world: &World, memory: Memory, settings: Settings, n_frames: u64) -> Self {
        Self::back(world, world.moment(), memory, settings, Vec::new()).with_frames(n_frames)
    }

    /// What happened in `world` since `moment`: `legs`, one after the other.
    pub fn back(
        world: &World,
        moment: Moment,
        memory: Memory,
        settings: Settings,
        legs: Vec<Leg>,
    ) -> Self {
        let mut world = world.clone();
        world.go_to(moment);
        Self::from(world, memory, settings, legs)
    }

    /// What happened in a world after it was this one: `legs`, one after the other.
    pub fn from(mut world: World, memory: Memory, settings: Settings, legs: Vec<Leg>) -> Self {
        while !world.ghosts().is_empty() {
            world.apply(Edit::Ghost(None));
        }
        for k in (0..world.traces().len()).rev() {
            world.apply(Edit::Trace(k, None));
        }
        let n_frames = legs.iter().map(|leg| leg.n_frames).sum();
        Self { world, memory, settings, legs, n_frames }
    }

    /// The same motion for another number of frames.
    #[must_use]
    pub fn with_frames(self, n_frames: u64) -> Self {
        Self { n_frames, ..self }
    }

    /// The world before the first frame.
    pub const fn world(&self) -> &World {
        &self.world
    }

    /// Whether nothing is moved from outside.
    pub fn is_without_hands(&self) -> bool {
        self.legs.iter().all(|leg| leg.hands.is_empty())
    }

    /// The points that hands hold at some time.
    pub(super) fn held(&self) -> impl Iterator<Item = PointId> {
        self.legs.iter().flat_map(|leg| leg.hands.iter().map(|hand| hand.point))
    }

    /// Whether some cog wheels are in the form that depends on the length of a frame.
    pub(super) fn has_velocity_cogs(&self) -> bool {
        let is_one = |c: &Constraint| c.traits().carried == Carried::ByFrame;
        self.world.constraints().any(|(_, record)| record.is_on && is_one(&record.constraint))
    }

    /// The pose the scene was given: every point that can move where it stood when the clock
    /// left 0, or where it was made.
    pub(super) fn at_the_start(&self) -> Self {
        let mut motion = Self { legs: Vec::new(), n_frames: 1, ..self.clone() };
        let points = motion.world.points().ids();
        let free: Vec<PointId> = points.filter(|&p| !motion.world.points().is_frozen(p)).collect();
        for p in free {
            let start = motion.world.points().start(p);
            motion.world.apply(Edit::Move(p, start));
        }
        motion
    }
}

/// A motion being done once more.
pub(super) struct Replay<'a> {
    motion: &'a RepeatableMotion,
    /// The copy that moves.
    pub world: World,
    solver: Solver,
    leg: usize,
    /// Frames of the leg that are done.
    n_done: u64,
    /// Into how many equal parts each frame is divided.
    n_parts: u32,
}

impl<'a> Replay<'a> {
    /// At the beginning, with frames divided into `n_parts`.
    pub fn new(motion: &'a RepeatableMotion, n_parts: u32) -> Self {
        let mut world = motion.world.clone();
        let mut solver = Solver::new();
        if n_parts == 1 {
            solver.set_memory(motion.memory.clone());
        } else {
            // What the solver remembers is from frames of another length.
            let clock = *world.clock();
            world.apply(Edit::Clock(Box::new(clock.with_dt(clock.dt / f64::from(n_parts)))));
        }
        let mut replay = Self { motion, world, solver, leg: 0, n_done: 0, n_parts };
        replay.take_up();
        replay
    }

    /// The hands at work now.
    fn hands(&self) -> &'a [Hand] {
        self.motion.legs.get(self.leg).map_or(&[], |leg| &leg.hands)
    }

    fn take_up(&mut self) {
        for hand in self.hands() {
            if !self.motion.world.points().is_frozen(hand.point) {
                self.world.apply(Edit::Freeze(hand.point, true));
            }
        }
    }

    fn let_go(&mut self) {
        for hand in self.hands() {
            if !self.motion.world.points().is_frozen(hand.point) {
                self.world.apply(Edit::Freeze(hand.point, false));
            }
        }
    }

    /// One frame.
    ///
    /// # Errors
    /// A live expression that has no value then.
    pub fn frame(&mut self, settings: &Settings, budget: &Budget) -> Result<Report, Diagnostic> {
        let leg = self.motion.legs.get(self.leg);
        let hands = self.hands();
        let mut all: Option<Report> = None;
        for part in 1..=self.n_parts {
            let share = leg.map_or(0.0, |leg| {
                let done = self.n_done as f64 + f64::from(part) / f64::from(self.n_parts);
                done / leg.n_frames as f64
            });
            let report = self.solver.step(&mut self.world, settings, budget, |world| {
                move_by(hands, share, world);
            })?;
            let worst = all.get_or_insert(report);
            worst.status = worst.status.max(report.status);
            worst.residual = worst.residual.max(report.residual);
        }
        self.n_done += 1;
        if leg.is_some_and(|leg| self.n_done >= leg.n_frames) {
            self.let_go();
            self.leg += 1;
            self.n_done = 0;
            self.take_up();
        }
        Ok(all.expect("a frame has at least one part"))
    }
}
