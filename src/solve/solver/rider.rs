//! An island on its way through frames that pass at once.

use crate::solve::closed_form::{ClosedForm, Compiled, Found, Lanes, WIDE};
use crate::solve::dispatch::write_back;
use crate::solve::frame::predict::Doubt;
use crate::solve::island::Island;
use crate::world::{ParameterId, PointId, World};

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

/// What is kept of each frame.
#[derive(Clone, Copy)]
pub(super) struct Kept {
    pub is_traced: bool,
    pub is_measured: bool,
}

/// What all frames of a stretch have in common.
pub(super) struct Course {
    pub dt: f64,
    pub tolerance: f64,
    /// The tolerance that was promised, if one was.
    pub promised: Option<f64>,
}

impl Course {
    /// Which position errors of an island of this size are to be worked out.
    fn doubt(&self, size: f64, known: &Stretch) -> Doubt {
        Doubt { known: known.position_error, tolerance: self.tolerance * size }
    }

    /// Whether a pose keeps the tolerance that was promised, if one was, whatever rounding allows.
    fn is_promised(&self, found: &Found, island: &Island) -> bool {
        self.promised.is_none_or(|tolerance| found.worst <= tolerance * island.wanted())
    }
}

/// An island on its way through a stretch, with what it is driven by.
pub(super) struct Rider {
    /// Its number.
    pub k: u32,
    pub island: Box<Island>,
    pub form: Box<ClosedForm>,
    /// What its size is at least.
    least_size: f64,
    /// How many motors turn in it, and how many of its constraints follow time.
    pub n_driving: [usize; 2],
    /// What the last frame came to.
    found: Found,
    /// Its next frames, once many pass.
    lanes: Option<Box<Lanes>>,
    /// Its points that are traced.
    traced: Vec<(usize, PointId)>,
    /// How many blocks of frames of a leg it went through, and whether into one that does not count.
    ridden: (u64, bool),
    /// What these came to, with what was known before.
    noted: Stretch,
}

impl Rider {
    /// Makes an island ready, if nothing but motors and time drives it; gives it back otherwise. It looks at some
    /// parameters besides.
    pub fn mount(
        k: u32,
        mut island: Box<Island>,
        world: &World,
        also: &[ParameterId],
        dt: f64,
    ) -> Result<Self, Box<Island>> {
        if !island.is_under_way() || !island.inputs.is_empty() {
            return Err(island);
        }
        let Some(mut form) = island.take_closed_form() else { return Err(island) };
        let there = |c: usize| world.constraint(island.ids[c]).map(|record| &record.constraint);
        let n_turning = form.begin(&island.x, &island.constraints, there, dt);
        let n_followed = n_turning.and_then(|n| {
            if world.driven().is_empty() && also.is_empty() {
                return Some(0);
            }
            form.follow_time(&island.constraints, &island.ids, world, also, n > 0)
        });
        match n_turning.zip(n_followed) {
            Some((n_turning, n_followed)) if n_turning + n_followed > 0 => {
                match form.timed_lengths() {
                    [] => island.prepare(),
                    lengths => island.prepare_without(lengths),
                }
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
                    n_driving: [n_turning, n_followed],
                    found,
                    lanes,
                    traced,
                    ridden: (0, false),
                    noted: Stretch::default(),
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
    pub fn advance(&mut self, course: &Course) -> bool {
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
    pub fn take_back(&mut self) {
        self.island.put_back(&mut self.form);
        self.form.turn_back(&mut self.island.constraints);
    }

    /// The frame counts.
    #[inline]
    pub fn accept(&mut self, course: &Course, stretch: &mut Stretch) {
        let Self { island, found, least_size, .. } = self;
        island.history.advance();
        island.accept_pose();
        island.position_error = 0.0;
        if found.is_sensitive() {
            let size = island.size_before();
            island.note_closed_form(found, size, &course.doubt(size, stretch));
            stretch.position_error = stretch.position_error.max(island.position_error);
        }
        // The size is at least that, and asked for only where it might matter.
        if found.worst > stretch.residual * *least_size {
            stretch.residual = stretch.residual.max(found.worst / island.size_before());
        }
    }

    /// How many constraints it has.
    pub fn n_constraints(&self) -> u64 {
        self.form.n_constraints().into()
    }

    /// Goes through so many blocks of frames, or as far as all frames of each count; gives how many it was.
    pub fn ride(&mut self, n: u64, course: &Course, known: &Stretch) -> u64 {
        let mut lanes = self.take_lanes();
        lanes.set_out(&mut self.form, &self.island);
        (self.ridden, self.noted) = ((0, false), *known);
        let (enough, size) = (self.enough(course), self.island.size());
        while self.ridden.0 < n {
            lanes.find(&mut self.form, &mut self.island, course.dt);
            let all = lanes.found_in_all();
            if !(all.worst <= enough && course.is_promised(&all, &self.island)) {
                self.ridden.1 = true;
                break;
            }
            self.ridden.0 += 1;
            let error = course.doubt(size, &self.noted).roughly(all.worst, all.least_side(), size);
            let mut noted = self.noted;
            if all.worst > noted.residual * self.least_size {
                (0..WIDE).for_each(|l| self.note_residual(l, &lanes, &mut noted));
            }
            if let Some(error) = error {
                noted.position_error = noted.position_error.max(error);
            } else {
                (0..WIDE).for_each(|l| self.note_error(l, &lanes, course, &mut noted));
                lanes.show(WIDE - 1, &self.form, &mut self.island);
            }
            self.noted = noted;
        }
        self.lanes = Some(lanes);
        self.ridden.0
    }

    /// The first `n` blocks of those count.
    pub fn arrive(&mut self, n: u64, course: &Course, stretch: &mut Stretch) {
        if self.ridden != (n, false) {
            let Self { island, form, lanes, .. } = self;
            if let Some(lanes) = lanes {
                lanes.go_back(form, island);
            }
            if n > 0 {
                self.ride(n, course, stretch);
            }
        }
        if n > 0 {
            self.end_side_by_side(WIDE);
            stretch.residual = stretch.residual.max(self.noted.residual);
            stretch.position_error = stretch.position_error.max(self.noted.position_error);
        }
    }

    /// Its next frames, side by side.
    fn take_lanes(&mut self) -> Box<Lanes> {
        self.lanes.take().unwrap_or_else(|| Box::new(Lanes::new(&self.form, &self.island)))
    }

    /// The distance to satisfaction that is met.
    fn enough(&self, course: &Course) -> f64 {
        self.island.enough(&self.form, course.tolerance).max(self.island.rounding())
    }

    /// Finds its next frames side by side; gives how many count, as far as it is asked.
    pub fn find_side_by_side(&mut self, course: &Course) -> usize {
        let mut lanes = self.take_lanes();
        lanes.find(&mut self.form, &mut self.island, course.dt);
        let enough = self.enough(course);
        let counts = |l: &usize| {
            let found = lanes.found(*l);
            found.worst <= enough && course.is_promised(&found, &self.island)
        };
        let n = (0..WIDE).take_while(counts).count();
        self.lanes = Some(lanes);
        n
    }

    /// Whether one of the first frames side by side has an error that may matter.
    pub fn is_looked_at(&self, n: usize, stretch: &Stretch) -> bool {
        let enough = stretch.residual * self.least_size;
        let lanes = self.lanes.as_deref();
        let found = |l: usize| lanes.map_or(Found::NOTHING, |lanes| lanes.found(l));
        (0..n).map(found).any(|found| found.is_sensitive() || found.worst > enough)
    }

    /// A frame that was found beside others counts.
    pub fn accept_side_by_side(&mut self, l: usize, course: &Course, stretch: &mut Stretch) {
        if let Some(lanes) = self.lanes.take() {
            self.note_residual(l, &lanes, stretch);
            self.note_error(l, &lanes, course, stretch);
            self.lanes = Some(lanes);
        }
    }

    /// Takes in how far a frame that was found beside others is from satisfaction.
    fn note_residual(&self, l: usize, lanes: &Lanes, stretch: &mut Stretch) {
        let worst = lanes.found(l).worst;
        if worst > stretch.residual * self.least_size {
            stretch.residual = stretch.residual.max(worst / self.size_in(l, lanes));
        }
    }

    /// How large the island was where a frame began, of those that were found side by side.
    fn size_in(&self, l: usize, lanes: &Lanes) -> f64 {
        self.island.size_at(lanes.origin(l)).max(self.form.longest(l))
    }

    /// Takes in its position error, for which the island may be put to where it is then.
    fn note_error(&mut self, l: usize, lanes: &Lanes, course: &Course, stretch: &mut Stretch) {
        let found = lanes.found(l);
        if !found.is_sensitive() {
            return;
        }
        let size = self.size_in(l, lanes);
        let Self { island, form, .. } = self;
        let doubt = course.doubt(size, stretch);
        let error = doubt.roughly(found.worst, found.least_side(), size).unwrap_or_else(|| {
            lanes.show(l, form, island);
            island.note_closed_form(&found, size, &doubt);
            island.position_error
        });
        stretch.position_error = stretch.position_error.max(error);
    }

    /// Tells the world of the frame that the island is at what is kept of it.
    pub fn write_back(&self, world: &mut World, kept: Kept) {
        write_back(&self.island, world);
        if kept.is_measured {
            self.form.hand_over(&self.island.constraints, &self.island.ids, world);
        }
    }

    /// Puts the island to where it is at the end of a frame that was found beside others.
    pub fn show(&mut self, l: usize) {
        if let Some(lanes) = &self.lanes {
            lanes.show(l, &self.form, &mut self.island);
        }
    }

    /// Tells the world of a frame that was found beside others what is kept of it.
    pub fn tell(&self, l: usize, world: &mut World, kept: Kept) {
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

    /// Where one of its points is in all frames that were found side by side.
    pub fn places(&self, p: usize) -> [[f64; WIDE]; 2] {
        self.lanes.as_deref().map_or([[f64::NAN; WIDE]; 2], |lanes| lanes.places(p))
    }

    /// The first `n` frames that were found side by side count, and no other.
    pub fn end_side_by_side(&mut self, n: usize) {
        let Self { island, form, found, lanes: Some(lanes), .. } = self else { return };
        lanes.accept(n, form, island);
        if let Some(last) = n.checked_sub(1) {
            // The side of an angle is that of the last pose; turns were counted already.
            island.accept_pose();
            lanes.count(last, form, island);
            *found = lanes.found(last);
        }
    }

    /// Gives back the island after so many frames, and tells the world where it is.
    pub fn dismount(self, n_frames: u64, world: &mut World) -> Box<Island> {
        let Self { mut island, mut form, found, .. } = self;
        if !form.timed_lengths().is_empty() {
            island.prepare_anew();
        }
        if n_frames > 0 {
            island.end_stretch(found.worst, form.n_constraints());
            write_back(&island, world);
            form.hand_over(&island.constraints, &island.ids, world);
        }
        form.end_schedule();
        island.closed_form = Compiled::List(form);
        island
    }
}
