//! Many frames at once, where nothing but motors and time drives the scene and each pose has a closed form.
//!
//! The first is found by itself, and so is one that those side by side came to and could not vouch for; the others
//! are found [side by side](Lanes), and looked at one after the other only where something is kept of each. Where
//! something follows time, frames are found side by side or not here.

use super::Solver;
use super::rider::{Course, Kept, Rider, Stretch};
use crate::constraint::{Point, Vector};
use crate::diag::Diagnostic;
use crate::solve::closed_form::WIDE;
use crate::solve::parallel::{ISLANDS, map_reduce, n_cores};
use crate::solve::report::Budget;
use crate::solve::settings::{Method, Settings};
use crate::solve::velocity;
use crate::world::{Extremes, Gauges, Measuring, ParameterId, Rates, World};

/// How far a stretch goes, and what is kept on the way.
pub struct Along<'a> {
    /// The most frames.
    pub n: u64,
    /// How the extremes of measures are found.
    pub extremes: Extremes,
    /// Whether it goes on, asked after each frame, or after those that were found side by side.
    pub goes_on: &'a dyn Fn() -> bool,
}

/// How many constraints of riders are evaluated in eight frames each before it is asked whether to go on.
const LEG: u64 = 1 << 21;

/// Blocks of a first leg, at most.
const FIRST_LEG: u64 = 16;

/// So many islands are shared out to all cores.
const MANY: usize = 100;

/// Blocks of frames through which each island goes by itself, so that what it is made of is at hand.
struct Leg {
    /// How many there were to be in the last.
    n_blocks: u64,
    /// How many there may be.
    most: u64,
    /// Whether some island did not go through all of them.
    has_ended: bool,
    /// Whether it pays to do it on all cores.
    is_shared: bool,
}

impl Leg {
    fn new(riders: &[Rider]) -> Self {
        let n_constraints: u64 = riders.iter().map(Rider::n_constraints).sum();
        let most = (LEG / n_constraints.max(1)).max(1);
        Self {
            n_blocks: FIRST_LEG / 2,
            most,
            has_ended: false,
            is_shared: riders.len() >= MANY && n_cores() > 1,
        }
    }

    /// Whether there is a next one, of so many blocks at most: the block in which the last one ended is to be
    /// looked at frame by frame.
    fn is_on(&mut self, n_left: u64) -> bool {
        if std::mem::take(&mut self.has_ended) {
            self.n_blocks = 1;
            return false;
        }
        self.n_blocks = (2 * self.n_blocks).min(self.most).min(n_left);
        true
    }

    /// Lets all islands go through it; gives how many blocks passed.
    fn ride(&mut self, course: &Course, riders: &mut [Rider], stretch: &mut Stretch) -> u64 {
        let known = *stretch;
        let n = if self.is_shared {
            let ride = |rider: &mut Rider| rider.ride(self.n_blocks, course, &known);
            map_reduce(riders, ISLANDS, ride, self.n_blocks, u64::min)
        } else {
            // None goes farther than those before it.
            let ride = |n, rider: &mut Rider| rider.ride(n, course, &known).min(n);
            riders.iter_mut().fold(self.n_blocks, ride)
        };
        for rider in riders {
            rider.arrive(n, course, stretch);
        }
        self.has_ended = n < self.n_blocks;
        n
    }
}

impl Solver {
    /// Lets frames pass as long as each goes as most do: motors turn, values follow time, and the closed
    /// forms of what these drive give the pose. Ends before the first that does not, and where
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
        let mut riders = self.riders(world, dt, on.n);
        if riders.is_empty() {
            return Ok(stretch);
        }
        let is_measured = world.has_measures();
        let kept = Kept { is_traced: !world.traces().is_empty() || is_measured, is_measured };
        let mut failure = None;
        let tolerance = budget.tolerance_of(settings);
        let course = Course { dt, tolerance, promised: budget.tolerance };
        let mut watch = Watch { kept, dials: Dials::new(&riders, world, kept, on.n) };
        let follows_time = world.has_timetable();
        let are_for_lanes = |riders: &[Rider]| riders.iter().all(|it| it.form.is_for_lanes());
        let mut is_side_by_side = follows_time && are_for_lanes(&riders);
        let mut leg = Leg::new(&riders);
        let mut n_abreast = 0;
        while stretch.n_frames < on.n && failure.is_none() {
            let before = stretch.n_frames;
            let n_blocks = (on.n - before) / WIDE as u64;
            if is_side_by_side && n_blocks > 0 && !kept.is_traced && leg.is_on(n_blocks) {
                let n = WIDE as u64 * leg.ride(&course, &mut riders, &mut stretch);
                stretch.n_frames += n;
                n_abreast += n;
            } else if is_side_by_side && n_blocks > 0 {
                let n = course.find_side_by_side(&mut riders);
                failure = course.accept(n, &mut riders, &mut stretch, world, &mut watch, on).err();
                n_abreast += stretch.n_frames - before;
                is_side_by_side = n == WIDE;
            } else if !follows_time && course.frame(&mut riders, &mut stretch) {
                stretch.n_frames += 1;
                if kept.is_traced {
                    riders.iter().for_each(|rider| rider.write_back(world, kept));
                    failure = keep(&mut riders, None, world, kept, on).err();
                }
                is_side_by_side = are_for_lanes(&riders);
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
        self.counts.abreast += n_abreast * riders.len() as u64;
        for rider in riders {
            let k = rider.k;
            self.partition.give_back(k, rider.dismount(stretch.n_frames, world));
        }
        failure.map_or(Ok(stretch), Err)
    }

    /// All islands that are awake, if each is at rest but for motors and what follows time, and these are
    /// all that drives the scene; else none.
    fn riders(&mut self, world: &mut World, dt: f64, n_frames: u64) -> Vec<Rider> {
        let mut riders = Vec::new();
        let is_too_short = n_frames < WIDE as u64;
        if !world.is_known_ahead() || is_too_short && world.has_timetable() {
            return riders;
        }
        riders.reserve(self.awake.len());
        let spare: Vec<ParameterId> = world.spare_parameters().collect();
        let n_drivers = [world.motors().len(), world.driven().len()];
        let mut n_driving = [0; 2];
        let Self { awake, partition, notes, .. } = self;
        for &k in awake.iter() {
            let Some(island) = partition.lend(k) else { break };
            notes.note_visit(&island, world);
            // The first looks at what drives none.
            let also = if riders.is_empty() { &*spare } else { &[] };
            match Rider::mount(k, island, world, also, dt) {
                Ok(rider) => {
                    n_driving = std::array::from_fn(|k| n_driving[k] + rider.n_driving[k]);
                    riders.push(rider);
                }
                Err(island) => {
                    partition.give_back(k, island);
                    break;
                }
            }
        }
        if riders.len() != awake.len() || n_driving != n_drivers {
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
        let fields = velocity::field_rates(world, &rates)?;
        for rider in riders.iter_mut() {
            if let Some(l) = lane {
                rider.show(l);
            }
            velocity::add_rates(&mut rider.island, &fields, &mut rates);
        }
        Ok(rates)
    };
    world.take_readings(false, &mut Measuring { extremes, is_met: true, rates: &mut rates })
}

/// What is kept of frames that are found side by side, and how.
struct Watch {
    kept: Kept,
    /// None where more than values is kept.
    dials: Option<Dials>,
}

/// What is measured of frames that are found side by side, where that is all that is kept of them.
struct Dials {
    gauges: Gauges<WIDE>,
    /// Which rider has each of the points that are measured, and as which of its own; where those are that none
    /// moves.
    points: Vec<Result<(usize, usize), Point>>,
}

impl Dials {
    /// Those of all islands that are awake.
    fn new(riders: &[Rider], world: &World, kept: Kept, n_frames: u64) -> Option<Self> {
        let is_all = kept.is_measured && world.traces().is_empty();
        if !is_all || n_frames < WIDE as u64 {
            return None;
        }
        let gauges = world.gauges::<WIDE>()?;
        let local = |(k, rider): (usize, &Rider), id| {
            let p = rider.island.local_point(id).filter(|&p| p < rider.island.n_free)?;
            Some((k, p))
        };
        let of = |id| {
            let mut found = riders.iter().enumerate().filter_map(|rider| local(rider, id));
            found.next().ok_or_else(|| world.points().at(id))
        };
        let points = gauges.points().map(of).collect();
        Some(Self { gauges, points })
    }

    /// Looks at the frames that were found.
    fn read(&mut self, riders: &[Rider]) {
        let points = &self.points;
        self.gauges.evaluate(|k| match points[k] {
            Ok((rider, p)) => riders[rider].places(p),
            Err(at) => [[at.x; WIDE], [at.y; WIDE]],
        });
    }
}

impl Course {
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
            rider.accept(self, stretch);
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
        watch: &mut Watch,
        on: &Along,
    ) -> Result<(), Diagnostic> {
        let Watch { kept, dials } = watch;
        let mut result = Ok(());
        let is_looked_at = riders.iter().any(|rider| rider.is_looked_at(n, stretch));
        let mut n_done = n;
        if let Some(dials) = dials {
            dials.read(riders);
        }
        if is_looked_at || kept.is_traced {
            for l in 0..n {
                if is_looked_at {
                    riders.iter_mut().for_each(|rider| rider.accept_side_by_side(l, self, stretch));
                }
                let is_kept = dials
                    .as_ref()
                    .is_some_and(|dials| world.pass_gauged(&dials.gauges, l, on.extremes));
                if kept.is_traced && !is_kept {
                    riders.iter().for_each(|rider| rider.tell(l, world, *kept));
                    result = keep(riders, Some(l), world, *kept, on);
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
