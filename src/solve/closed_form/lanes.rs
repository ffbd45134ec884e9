//! Many frames at a time, where nothing but motors and time drives an island.

use super::ClosedForm;
use super::abreast::{Abreast, Places, Turned, WIDE};
use super::found::Found;
use super::length::Timed;
use super::run::make;
use super::wheel;
use crate::constraint::{Constraint, Counts, Heading, Point, Turns};
use crate::solve::island::Island;
use crate::world::{ConstraintId, World};

/// No more poses than these are remembered before the present one.
const MOST_PAST: usize = 3;

/// The next frames of an island, side by side.
pub(crate) struct Lanes {
    /// Where its points are in each.
    places: Vec<Places<WIDE>>,
    /// What drives them, and what they came to.
    abreast: Abreast<WIDE>,
    /// The worst of what they came to.
    all: Found,
    /// Where the free points were before the first.
    origin: Vec<Point>,
    /// Where cranks pointed before the first, and how far each turns in a frame.
    before: Vec<(Heading, Turns)>,
    /// Where the island set out: its free points, how its cranks pointed, and how far its wheels had turned.
    start: (Vec<Point>, Vec<Heading>, Vec<Counts>),
    /// Whether `places` are those at which the last of them ended.
    is_up_to_date: bool,
}

impl Lanes {
    /// For the frames of an island that this list finds.
    pub fn new(form: &ClosedForm, island: &Island) -> Self {
        let n_cranks = form.cranks.len();
        let mut abreast = Abreast::new(island.x.len(), form.one.turned.len());
        // What is no crank points where it points.
        for (to, turned) in abreast.turned.iter_mut().zip(&form.one.turned) {
            (0..WIDE).for_each(|l| to.set(l, turned.at(0).0, 0.0));
        }
        abreast.lengths = vec![Timed::NOT; form.timed_lengths().len()];
        abreast.counts = vec![[Counts::default(); WIDE]; form.wheels.len()];
        Self {
            places: vec![Places::all(Point::ORIGIN); island.x.len()],
            abreast,
            all: Found::NOTHING,
            origin: Vec::with_capacity(island.n_free),
            before: Vec::with_capacity(n_cranks),
            start: (Vec::with_capacity(island.n_free), Vec::with_capacity(n_cranks), Vec::new()),
            is_up_to_date: false,
        }
    }

    /// Finds the next frames, of which each is as long as that. The island stays where it is, but for where its
    /// motors point: that is where they do at the end of the last.
    pub fn find(&mut self, form: &mut ClosedForm, island: &mut Island, dt: f64) {
        self.origin.clear();
        if std::mem::replace(&mut self.is_up_to_date, true) {
            let last = self.places[..island.n_free].iter().map(|places| places.at(WIDE - 1));
            self.origin.extend(last);
        } else {
            self.origin.extend_from_slice(&island.x[..island.n_free]);
            self.places.clear();
            self.places.extend(island.x.iter().map(|&at| Places::all(at)));
            for (to, counts) in self.abreast.counts.iter_mut().zip(form.counts(&island.constraints))
            {
                to[WIDE - 1] = counts;
            }
        }
        #[cfg(target_arch = "x86_64")]
        if is_x86_feature_detected!("avx512f")
            && is_x86_feature_detected!("avx512dq")
            && is_x86_feature_detected!("avx512vl")
            && is_x86_feature_detected!("fma")
        {
            // Vectors of all eight numbers. The bits are the same as with others: what is fused is so where
            // it says so, and then it is on all machines.
            #[allow(unsafe_code)]
            // SAFETY: the instructions exist, as was just asked.
            return unsafe { self.run_avx512(form, &mut island.constraints, dt) };
        }
        #[cfg(target_arch = "x86_64")]
        if is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma") {
            // Vectors of four numbers instead of two.
            #[allow(unsafe_code)]
            // SAFETY: the instructions exist, as was just asked.
            return unsafe { self.run_avx2(form, &mut island.constraints, dt) };
        }
        self.run(form, &mut island.constraints, dt);
    }

    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx512f,avx512dq,avx512vl,fma")]
    fn run_avx512(&mut self, form: &mut ClosedForm, constraints: &mut [Constraint], dt: f64) {
        self.run(form, constraints, dt);
    }

    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2,fma")]
    fn run_avx2(&mut self, form: &mut ClosedForm, constraints: &mut [Constraint], dt: f64) {
        self.run(form, constraints, dt);
    }

    #[inline(always)]
    fn run(&mut self, form: &mut ClosedForm, constraints: &mut [Constraint], dt: f64) {
        self.turn_on(form, constraints, dt);
        let Self { places, abreast, origin, .. } = self;
        let n_known = form
            .schedule
            .as_mut()
            .map(|schedule| schedule.turn_on(|p| origin[p as usize], abreast));
        make(&mut form.steps, &form.cranks, constraints, &mut places[..], abreast);
        if let Some(n) = n_known {
            abreast.end_at(n);
        }
        self.all = self.abreast.found_in_all();
    }

    /// Turns the cranks on by all frames.
    #[inline(always)]
    fn turn_on(&mut self, form: &ClosedForm, constraints: &mut [Constraint], dt: f64) {
        self.before.clear();
        for (crank, turned) in form.cranks.iter().zip(&mut self.abreast.turned) {
            let Some(motor) = crank.motor(constraints) else { continue };
            let before = motor.heading();
            let (step, [x, y]) = motor.advance_each::<WIDE>(dt);
            *turned = Turned { x, y, way: [motor.way_of(step); WIDE] };
            self.before.push((before, step));
        }
    }

    /// How the cranks point at the end of a frame.
    fn headings(&self, l: usize) -> impl Iterator<Item = Heading> + '_ {
        self.before.iter().zip(&self.abreast.turned).map(move |((before, step), turned)| Heading {
            turned: before.turned.plus_times(*step, l + 1),
            target: turned.at(l).0,
        })
    }

    /// How far the wheels have turned at the end of a frame.
    fn counts(&self, l: usize) -> impl Iterator<Item = Counts> + '_ {
        self.abreast.counts.iter().map(move |counts| counts[l])
    }

    /// Sets out from where an island is.
    pub fn set_out(&mut self, form: &mut ClosedForm, island: &Island) {
        let (x, headings, counts) = &mut self.start;
        x.clear();
        x.extend_from_slice(&island.x[..island.n_free]);
        headings.clear();
        headings.extend(form.cranks.iter().filter_map(|crank| crank.heading(&island.constraints)));
        counts.clear();
        counts.extend(form.counts(&island.constraints));
        if let Some(schedule) = &mut form.schedule {
            schedule.set_out(&island.constraints);
        }
    }

    /// Puts an island back where it set out.
    pub fn go_back(&mut self, form: &mut ClosedForm, island: &mut Island) {
        let (x, headings, counts) = &self.start;
        island.x[..x.len()].copy_from_slice(x);
        point(form, &mut island.constraints, headings.iter().copied());
        form.set_counts(&mut island.constraints, counts.iter().copied());
        if let Some(schedule) = &mut form.schedule {
            schedule.go_back(&mut island.constraints);
        }
        self.is_up_to_date = false;
        form.look(&island.x, &island.constraints);
    }

    /// The worst of what all frames came to.
    pub fn found_in_all(&self) -> Found {
        self.all
    }

    /// What a frame came to.
    pub fn found(&self, l: usize) -> Found {
        self.abreast.found(l)
    }

    /// Where a point is in all frames.
    pub fn places(&self, p: usize) -> [[f64; WIDE]; 2] {
        let Places { x, y } = self.places[p];
        [x, y]
    }

    /// Where a point is in a frame.
    pub fn at(&self, p: usize, l: usize) -> Point {
        self.places[p].at(l)
    }

    /// Where the free points were at the beginning of a frame.
    pub fn origin(&self, l: usize) -> impl ExactSizeIterator<Item = Point> + '_ {
        let before =
            move |(p, first): (usize, &Point)| if l == 0 { *first } else { self.at(p, l - 1) };
        self.origin.iter().enumerate().map(before)
    }

    /// Puts an island to where it is at the end of a frame.
    pub fn show(&self, l: usize, form: &ClosedForm, island: &mut Island) {
        for (to, places) in island.x[..self.origin.len()].iter_mut().zip(&self.places) {
            *to = places.at(l);
        }
        point(form, &mut island.constraints, self.headings(l));
        self.count(l, form, island);
        if let Some(schedule) = &form.schedule {
            schedule.show(l, &mut island.constraints);
        }
    }

    /// Wheels of an island have turned as far as at the end of a frame.
    pub fn count(&self, l: usize, form: &ClosedForm, island: &mut Island) {
        form.set_counts(&mut island.constraints, self.counts(l));
    }

    /// Tells the world how the cranks point at the end of a frame, how far wheels have turned, and the values that
    /// follow time.
    pub fn hand_over(&self, l: usize, form: &ClosedForm, ids: &[ConstraintId], world: &mut World) {
        for (crank, heading) in form.cranks.iter().zip(self.headings(l)) {
            crank.point_in(world, ids, heading);
        }
        for (&by, counts) in form.wheels.iter().zip(self.counts(l)) {
            wheel::set_counts(world.constraint_state_mut(ids[by as usize]), counts);
        }
        if let Some(schedule) = &form.schedule {
            schedule.hand_over(l, ids, world);
        }
    }

    /// The first `n` frames count, and those after them do not.
    pub fn accept(&mut self, n: usize, form: &mut ClosedForm, island: &mut Island) {
        for l in n.saturating_sub(MOST_PAST)..n {
            island.history.begin_with(self.origin(l), form.degree);
            island.history.advance();
        }
        match n.checked_sub(1) {
            Some(last) => self.show(last, form, island),
            None => {
                point(form, &mut island.constraints, self.before.iter().map(|(before, _)| *before));
            }
        }
        if n < WIDE {
            self.is_up_to_date = false;
            form.look(&island.x, &island.constraints);
            if let Some(schedule) = &mut form.schedule {
                schedule.take_back(WIDE - n, &island.constraints);
            }
        }
    }
}

/// Points the motors of cranks elsewhere.
fn point(
    form: &ClosedForm,
    constraints: &mut [Constraint],
    headings: impl Iterator<Item = Heading>,
) {
    for (crank, heading) in form.cranks.iter().zip(headings) {
        if let Some(motor) = crank.motor(constraints) {
            motor.set_heading(heading);
        }
    }
}

impl ClosedForm {
    /// How far its wheels have turned.
    fn counts(&self, constraints: &[Constraint]) -> impl Iterator<Item = Counts> {
        self.wheels.iter().map(|&by| wheel::counts(&constraints[by as usize]))
    }

    /// They have turned so far.
    fn set_counts(&self, constraints: &mut [Constraint], counts: impl Iterator<Item = Counts>) {
        for (&by, counts) in self.wheels.iter().zip(counts) {
            wheel::set_counts(&mut constraints[by as usize], counts);
        }
    }
}
