//! Many frames at once, where nothing but motors drives the scene and each pose has a closed form.
//!
//! The first is found by itself, and so is one that those side by side came to and could not vouch for;
//! the others are found [side by side](Lanes), and looked at one after the other only where something is
//! kept of each.

use super::Solver;
use crate::constraint::Vector;
use crate::diag::Diagnostic;
use crate::solve::closed_form::{ClosedForm, Compiled, Found, Lanes, WIDE};
use crate::solve::dispatch::write_back;
use crate::solve::frame::predict::may_exceed;
use crate::solve::island::Island;
use crate::solve::report::Budget;
use crate::solve::settings::{Method, Settings};
use crate::solve::velocity;
use crate::world::{ConstraintId, Extremes, Measuring, PointId, Rates, World};

/// What frames came to that passed at once. Each was solved.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Stretch {
    /// How many frames passed.
    pub n_frames: u64,
    /// The iterations of all together.
    pub iterations: u64,
    /// The largest distance to satisfaction in any, relative to the size.
    pub residual: f64,
    /// The largest position error that was found next to a singular pose; else what was known.
    pub position_error: f64,
}

/// How far a stretch goes, and what is kept on the way.
pub struct Along<'a> {
    /// The most frames.
    pub n: u64,
    /// How the extremes of measures are found.
    pub extremes: Extremes,
    /// Whether it goes on, asked after each frame, or after those that were found side by side.
    pub goes_on: &'a dyn Fn() -> bool,
}

/// An island on its way through a stretch, with what it is driven by.
struct Rider {
    /// Its number.
    k: u32,
    island: Box<Island>,
    form: Box<ClosedForm>,
    /// What its size is at least.
    least_size: f64,
    /// How many motors turn in it.
    n_turning: usize,
    /// What the last frame came to.
    found: Found,
    /// Its next frames, once many pass.
    lanes: Option<Box<Lanes>>,
    /// Its points that are traced.
    traced: Vec<(usize, PointId)>,
}

/// What is kept of each frame.
#[derive(Clone, Copy)]
struct Kept {
    is_traced: bool,
    is_measured: bool,
}

impl Solver {
    /// Lets frames pass as long as each goes as most do: motors turn, and the closed
    /// forms of what they drive give the pose. Ends before the first that does not, and where
    /// `goes_on` says no. What comes out is what frame by frame would.
    ///
    /// # Errors
    /// Where a measure has no value in a frame.
    pub fn stretch(
        &mut self,
        world: &mut World,
        settings: &Settings,
        budget: &Budget,
        on: &Along,
    ) -> Result<Stretch, Diagnostic> {
        let mut stretch = Stretch { position_error: budget.known_error, ..Stretch::default() };
        let is_plain = settings.method == Method::Auto
            && self.is_up_to_date(world, settings)
            && self.unsolved.is_empty()
            && self.unsatisfiable.is_empty();
        if !is_plain {
            return Ok(stretch);
        }
        let dt = world.clock().dt;
        let mut riders = self.riders(world, dt);
        if riders.is_empty() {
            return Ok(stretch);
        }
        let is_measured = world.has_measures();
        let kept = Kept { is_traced: !world.traces().is_empty() || is_measured, is_measured };
        let mut failure = None;
        let course = Course { dt, tolerance: budget.tolerance_of(settings), budget };
        let mut is_side_by_side = false;
        while stretch.n_frames < on.n && failure.is_none() {
            let before = stretch.n_frames;
            if is_side_by_side && on.n - before >= WIDE as u64 {
                let n = course.find_side_by_side(&mut riders);
                failure = course.accept(n, &mut riders, &mut stretch, world, kept, on).err();
                is_side_by_side = n == WIDE;
            } else if course.frame(&mut riders, &mut stretch) {
                stretch.n_frames += 1;
                if kept.is_traced {
                    riders.iter().for_each(|rider| rider.write_back(world, kept));
                    failure = keep(&mut riders, None, world, kept, on).err();
                }
                is_side_by_side = riders.iter().all(|rider| rider.form.is_for_lanes());
            } else {
                break;
            }
            if stretch.n_frames > before && !(on.goes_on)() {
                break;
            }
        }
        stretch.iterations = stretch.n_frames;
        if stretch.n_frames > 0 {
            self.missed.clear();
            world.pass(if kept.is_traced { 0 } else { stretch.n_frames });
        }
        self.counts.closed += stretch.n_frames * riders.len() as u64;
        for rider in riders {
            let k = rider.k;
            self.partition.give_back(k, rider.dismount(stretch.n_frames, world));
        }
        failure.map_or(Ok(stretch), Err)
    }

    /// All islands that are awake, if each is at rest but for motors, and these are all that turn;
    /// else none.
    fn riders(&mut self, world: &mut World, dt: f64) -> Vec<Rider> {
        let mut riders = Vec::with_capacity(self.awake.len());
        let Some(n_motors) = world.motors_alone().map(<[ConstraintId]>::len) else {
            return riders;
        };
        let mut n_turning = 0;
        let Self { awake, partition, notes, .. } = self;
        for &k in awake.iter() {
            let Some(island) = partition.lend(k) else { break };
            notes.note(&island);
            match Rider::mount(k, island, world, dt) {
                Ok(rider) => {
                    n_turning += rider.n_turning;
                    riders.push(rider);
                }
                Err(island) => {
                    partition.give_back(k, island);
                    break;
                }
            }
        }
        if riders.len() != awake.len() || n_turning != n_motors {
            for rider in riders.drain(..) {
                partition.give_back(rider.k, rider.dismount(0, world));
            }
        }
        riders
    }
}

/// Keeps of a frame what is kept of each, of the one in this lane or of that which the islands are at; the
/// world has all that is looked at.
fn keep(
    riders: &mut [Rider],
    lane: Option<usize>,
    world: &mut World,
    kept: Kept,
    on: &Along,
) -> Result<(), Diagnostic> {
    world.pass(1);
    world.sample_traces(false);
    if kept.is_measured { measure(riders, lane, world, on.extremes) } else { Ok(()) }
}

/// Measures the pose of a frame; the islands are shown to be at it where it is asked how they move.
fn measure(
    riders: &mut [Rider],
    lane: Option<usize>,
    world: &mut World,
    extremes: Extremes,
) -> Result<(), Diagnostic> {
    let mut rates = |world: &mut World| {
        let still = || vec![Vector::ZERO; world.points().column().len()];
        let mut rates = Rates { velocity: still(), acceleration: still() };
        for rider in riders.iter_mut() {
            if let Some(l) = lane {
                rider.show(l);
            }
            // Nothing but motors changes in time.
            velocity::add_rates(&mut rider.island, &[], &mut rates);
        }
        Ok(rates)
    };
    world.take_readings(false, &mut Measuring { extremes, is_met: true, rates: &mut rates })
}

/// What all frames of a stretch have in common.
struct Course<'a> {
    dt: f64,
    tolerance: f64,
    budget: &'a Budget<'a>,
}

impl Course<'_> {
    /// Whether a pose keeps the tolerance that was promised, if one was, whatever rounding allows.
    fn is_promised(&self, found: &Found, island: &Island) -> bool {
        self.budget.tolerance.is_none_or(|tolerance| found.worst <= tolerance * island.wanted())
    }

    /// Lets a frame pass; false if it does not, and everything is as before.
    #[inline]
    fn frame(&self, riders: &mut [Rider], stretch: &mut Stretch) -> bool {
        for j in 0..riders.len() {
            if !riders[j].advance(self) {
                riders[..j].iter_mut().for_each(Rider::take_back);
                return false;
            }
        }
        for rider in riders {
            rider.accept(stretch);
        }
        true
    }

    /// Finds the next frames of all side by side; gives how many of them count.
    fn find_side_by_side(&self, riders: &mut [Rider]) -> usize {
        let mut n = WIDE;
        for rider in riders {
            n = n.min(rider.find_side_by_side(self));
        }
        n
    }

    /// The first `n` frames that were found side by side count, unless measuring one of them fails.
    fn accept(
        &self,
        n: usize,
        riders: &mut [Rider],
        stretch: &mut Stretch,
        world: &mut World,
        kept: Kept,
        on: &Along,
    ) -> Result<(), Diagnostic> {
        let mut result = Ok(());
        let is_looked_at = riders.iter().any(|rider| rider.is_looked_at(n, stretch));
        let mut n_done = n;
        if is_looked_at || kept.is_traced {
            for l in 0..n {
                riders.iter_mut().for_each(|rider| rider.accept_side_by_side(l, stretch));
                if kept.is_traced {
                    riders.iter().for_each(|rider| rider.tell(l, world, kept));
                    result = keep(riders, Some(l), world, kept, on);
                }
                if result.is_err() {
                    n_done = l + 1;
                    break;
                }
            }
        }
        riders.iter_mut().for_each(|rider| rider.end_side_by_side(n_done));
        stretch.n_frames += n_done as u64;
        result
    }
}

impl Rider {
    /// Makes an island ready, if nothing but motors drives it; gives it back otherwise.
    fn mount(k: u32, mut island: Box<Island>, world: &World, dt: f64) -> Result<Self, Box<Island>> {
        if !island.is_under_way() || !island.inputs.is_empty() {
            return Err(island);
        }
        let Some(mut form) = island.take_closed_form() else { return Err(island) };
        let there = |c: usize| world.constraint(island.ids[c]).map(|record| &record.constraint);
        match form.begin(&island.x, &island.constraints, there, dt) {
            Some(n_turning) if n_turning > 0 => {
                island.prepare();
                let traces = world.traces().iter();
                let traced = traces
                    .filter_map(|trace| island.local_point(trace.point).map(|p| (p, trace.point)));
                let traced = traced.filter(|&(p, _)| p < island.n_free).collect();
                let (lanes, found) = (None, Found::NOTHING);
                Ok(Self {
                    k,
                    least_size: island.least_size(),
                    island,
                    form,
                    n_turning,
                    found,
                    lanes,
                    traced,
                })
            }
            _ => {
                island.closed_form = Compiled::List(form);
                Err(island)
            }
        }
    }

    /// Finds the pose of the next frame; false if that is to be found in another way, and
    /// everything is as before.
    #[inline]
    fn advance(&mut self, course: &Course) -> bool {
        let Self { island, form, found, .. } = self;
        form.turn_on(&mut island.constraints, course.dt);
        match island.run_closed(form, course.tolerance) {
            Some(now) if course.is_promised(&now, island) => *found = now,
            Some(_) => {
                self.take_back();
                return false;
            }
            None => {
                form.turn_back(&mut island.constraints);
                return false;
            }
        }
        true
    }

    /// Puts everything as it was before the frame.
    fn take_back(&mut self) {
        self.island.put_back(&mut self.form);
        self.form.turn_back(&mut self.island.constraints);
    }

    /// The frame counts.
    #[inline]
    fn accept(&mut self, stretch: &mut Stretch) {
        let Self { island, found, least_size, .. } = self;
        island.history.advance();
        island.accept_pose();
        island.position_error = 0.0;
        if found.is_sensitive() {
            let size = island.size_before();
            island.note_closed_form(found, size, stretch.position_error);
            stretch.position_error = stretch.position_error.max(island.position_error);
        }
        // The size is at least that, and asked for only where it might matter.
        if found.worst > stretch.residual * *least_size {
            stretch.residual = stretch.residual.max(found.worst / island.size_before());
        }
    }

    /// Finds its next frames side by side; gives how many count, as far as it is asked.
    fn find_side_by_side(&mut self, course: &Course) -> usize {
        let Self { island, form, lanes, .. } = self;
        let lanes = lanes.get_or_insert_with(|| Box::new(Lanes::new(form, island)));
        lanes.find(form, island, course.dt);
        let enough = island.enough(form, course.tolerance).max(island.rounding());
        let counts = |l: &usize| {
            let found = lanes.found(*l);
            found.worst <= enough && course.is_promised(&found, island)
        };
        (0..WIDE).take_while(counts).count()
    }

    /// Whether one of the first frames side by side has an error that may matter.
    fn is_looked_at(&self, n: usize, stretch: &Stretch) -> bool {
        let enough = stretch.residual * self.least_size;
        let lanes = self.lanes.as_deref();
        let found = |l: usize| lanes.map_or(Found::NOTHING, |lanes| lanes.found(l));
        (0..n).map(found).any(|found| found.is_sensitive() || found.worst > enough)
    }

    /// A frame that was found beside others counts.
    fn accept_side_by_side(&mut self, l: usize, stretch: &mut Stretch) {
        let Self { island, form, lanes: Some(lanes), least_size, .. } = self else { return };
        let found = lanes.found(l);
        let is_large = found.worst > stretch.residual * *least_size;
        if !found.is_sensitive() && !is_large {
            return;
        }
        let size = island.size_at(lanes.origin(l));
        let least_side = found.least_side_squared.sqrt();
        if found.is_sensitive() && may_exceed(found.worst, least_side, size, stretch.position_error)
        {
            lanes.show(l, form, island);
            island.position_error = 0.0;
            island.note_closed_form(&found, size, stretch.position_error);
            stretch.position_error = stretch.position_error.max(island.position_error);
        }
        if is_large {
            stretch.residual = stretch.residual.max(found.worst / size);
        }
    }

    /// Tells the world of the frame that the island is at what is kept of it.
    fn write_back(&self, world: &mut World, kept: Kept) {
        write_back(&self.island, world);
        if kept.is_measured {
            self.form.hand_over(&self.island.constraints, &self.island.ids, world);
        }
    }

    /// Puts the island to where it is at the end of a frame that was found beside others.
    fn show(&mut self, l: usize) {
        if let Some(lanes) = &self.lanes {
            lanes.show(l, &self.form, &mut self.island);
        }
    }

    /// Tells the world of a frame that was found beside others what is kept of it: nothing in it has a
    /// state but its motors.
    fn tell(&self, l: usize, world: &mut World, kept: Kept) {
        let Self { island, form, lanes: Some(lanes), traced, .. } = self else { return };
        if kept.is_measured {
            for (p, &id) in island.points[..island.n_free].iter().enumerate() {
                world.set_position(id, lanes.at(p, l));
            }
            lanes.hand_over(l, form, &island.ids, world);
        } else {
            traced.iter().for_each(|&(p, id)| world.set_position(id, lanes.at(p, l)));
        }
    }

    /// The first `n` frames that were found side by side count, and no other.
    fn end_side_by_side(&mut self, n: usize) {
        let Self { island, form, found, lanes: Some(lanes), .. } = self else { return };
        lanes.accept(n, form, island);
        if n > 0 {
            // Nothing counts turns here, and the side of an angle is that of the last pose.
            island.accept_pose();
        }
        if let Some(last) = n.checked_sub(1) {
            *found = lanes.found(last);
        }
    }

    /// Gives back the island after so many frames, and tells the world where it is.
    fn dismount(self, n_frames: u64, world: &mut World) -> Box<Island> {
        let Self { mut island, form, found, .. } = self;
        if n_frames > 0 {
            island.end_stretch(found.worst, form.n_constraints());
            write_back(&island, world);
            form.hand_over(&island.constraints, &island.ids, world);
        }
        island.closed_form = Compiled::List(form);
        island
    }
}
