//! Running the list of steps for a frame.

use super::abreast::{Abreast, Meeting as _, Places, Poses, Turned, put_each};
use super::found::Found;
use super::length::{Length, Values, bar};
use super::nearest::{self, Nearest};
use super::schedule::{Driven, place};
use super::{ClosedForm, Crank, Schedule, Step};
use crate::constraint::{
    Constraint, ConstraintKind as _, Field, Heading, Motor, Point, Stateful as _, Vector,
};
use crate::solve::island::history::History;
use crate::solve::island::inputs::Inputs;
use crate::world::{ConstraintId, ParameterId, World};

impl ClosedForm {
    /// Whether it is known of the pose of now what has to be.
    pub fn knows_pose(&self) -> bool {
        self.knows_pose
    }

    /// Looks at a pose that counts. False if a body has another shape there than it had: the list is
    /// to be compiled anew.
    pub fn look(&mut self, x: &[Point], constraints: &[Constraint]) -> bool {
        let mut fits = true;
        for step in &mut self.steps {
            match step {
                Step::Circles(circles) => circles.look(x),
                Step::CircleLine(meeting) => meeting.look(x),
                Step::CircleMovingLine(meeting) => meeting.look(x),
                Step::Ray(ray) => ray.look(x),
                Step::Direction(link) => link.look(x),
                Step::Body(body) => fits &= body.fits(x),
                Step::Block(block) => block.look(x, constraints),
                Step::Crank(_)
                | Step::Place { .. }
                | Step::Crossing(_)
                | Step::Wheel(_)
                | Step::Sum(_)
                | Step::Bar(_)
                | Step::Firm(_)
                | Step::Nearest(_) => {}
            }
        }
        self.knows_pose = fits;
        fits
    }

    /// The pose was, or is to be, reached in another way.
    pub fn forget_pose(&mut self) {
        (self.knows_pose, self.knows_lengths) = (false, false);
    }

    /// Takes in how long bars are in this frame, and what they were before it.
    fn measure(&mut self, constraints: &[Constraint], inputs: Option<&Inputs>) {
        let values = Values { constraints, inputs };
        for step in &mut self.steps {
            match step {
                Step::Circles(circles) => circles.drive(&values),
                Step::CircleLine(meeting) => meeting.drive(&values),
                Step::CircleMovingLine(meeting) => meeting.drive(&values),
                Step::Ray(ray) => ray.drive(&values),
                Step::Direction(link) => link.drive(&values),
                Step::Bar(bar) => bar.drive(&values),
                Step::Block(block) => block.drive(&values),
                Step::Nearest(points) => {
                    let lengths = points.iter_mut().filter_map(Nearest::length_mut);
                    lengths.for_each(|length| length.drive(&values));
                }
                Step::Crank(_)
                | Step::Place { .. }
                | Step::Crossing(_)
                | Step::Wheel(_)
                | Step::Sum(_)
                | Step::Firm(_)
                | Step::Body(_) => {}
            }
        }
        // What just changed does not in the frame that comes next, unless it is said again.
        self.knows_lengths = inputs.is_none_or(|inputs| !changes_lengths(inputs));
    }

    /// Whether frames may be found side by side.
    pub fn is_for_lanes(&self) -> bool {
        !self.has_blocks
    }

    /// How many constraints a frame evaluates.
    pub fn n_constraints(&self) -> u32 {
        self.n_constraints
    }

    /// Makes ready for frames that motors drive, and what [follows time](Self::follow_time); none if some of the
    /// motors is not on its way, or is not the one that `there` shows of the constraint of a number. Gives how many
    /// turn.
    pub fn begin<'a>(
        &mut self,
        x: &[Point],
        constraints: &[Constraint],
        there: impl Fn(usize) -> Option<&'a Constraint>,
        dt: f64,
    ) -> Option<usize> {
        let mut n_turning = 0;
        for crank in &self.cranks {
            let c = crank.motor as usize;
            let (Constraint::Motor(here), Some(Constraint::Motor(there))) =
                (&constraints[c], there(c))
            else {
                return None;
            };
            if !here.is_copy(there) || !here.is_under_way(dt) {
                return None;
            }
            n_turning += usize::from(here.turns());
        }
        if !self.knows_lengths {
            self.measure(constraints, None);
        }
        self.one.ways.fill([0.0]);
        for step in &mut self.steps {
            match step {
                Step::Place { constraint, drive, .. } => {
                    let place = place(&constraints[*constraint as usize]);
                    self.one.turned[*drive as usize].set(0, place.to_vector(), 0.0);
                }
                Step::Direction(link) => {
                    let of = &constraints[link.constraint as usize];
                    let (target, way) = link.target(of, std::iter::empty());
                    self.one.turned[link.drive as usize].set(0, target, way);
                }
                _ => {}
            }
        }
        (self.knows_pose || self.look(x, constraints)).then_some(n_turning)
    }

    /// Turns the motors on by a frame.
    #[inline]
    pub fn turn_on(&mut self, constraints: &mut [Constraint], dt: f64) {
        for (crank, turned) in self.cranks.iter_mut().zip(&mut self.one.turned) {
            if let Some(motor) = crank.motor(constraints) {
                crank.before = motor.heading();
                motor.advance(dt);
                turned.set(0, motor.target(), motor.way_since(crank.before));
            }
        }
    }

    /// Turns the motors back to where they pointed before.
    pub fn turn_back(&self, constraints: &mut [Constraint]) {
        for crank in &self.cranks {
            if let Some(motor) = crank.motor(constraints) {
                motor.set_heading(crank.before);
            }
        }
    }

    /// Makes ready for frames that follow motors and time, in lanes, and in which some parameters are looked at
    /// besides; gives how many constraints follow time, none if some of their values are not asked for by a step.
    pub fn follow_time(
        &mut self,
        constraints: &[Constraint],
        ids: &[ConstraintId],
        world: &World,
        also: &[ParameterId],
        is_turned: bool,
    ) -> Option<usize> {
        let driven = self.driven(constraints);
        let schedule = Schedule::new(driven, constraints, ids, world, also, is_turned)?;
        let n = schedule.n_constraints();
        if !schedule.lengths().is_empty() {
            self.lengths_mut(|length| length.set_timed(schedule.lengths()));
        }
        self.schedule = (!schedule.is_empty()).then(|| Box::new(schedule));
        Some(n)
    }

    /// What each constraint of an island says to a step by itself.
    fn driven(&self, constraints: &[Constraint]) -> Vec<Option<Driven>> {
        let is_followed = |(c, constraint)| bar(constraint).is_some() && self.takes(c);
        let length = |is_followed: bool| is_followed.then_some(Driven::Length { k: 0 });
        let mut all: Vec<_> = (0..).zip(constraints).map(is_followed).map(length).collect();
        for step in &self.steps {
            match step {
                Step::Place { to, constraint, drive } => {
                    all[*constraint as usize] = Some(Driven::Place { to: *to, drive: *drive });
                }
                Step::Direction(link) => {
                    let ([length, sense], drive) = (link.factors(), link.drive);
                    let angle = Driven::Angle { link: length, sense, drive };
                    all[link.constraint as usize] = Some(angle);
                    // Where the end of a link is that changes follows from two values.
                    if let Some(bar) = link.bar() {
                        all[bar as usize] = None;
                    }
                }
                _ => {}
            }
        }
        all
    }

    /// What follows time does no more.
    pub fn end_schedule(&mut self) {
        let Some(schedule) = self.schedule.take() else { return };
        if !schedule.lengths().is_empty() {
            self.lengths_mut(|length| length.set_timed(&[]));
            // What it was before the frame that comes next is to be asked.
            self.knows_lengths = false;
        }
    }

    /// The constraints of an island that are lengths which follow time, by their numbers, ascending.
    pub fn timed_lengths(&self) -> &[u32] {
        self.schedule.as_ref().map_or(&[], |schedule| schedule.lengths())
    }

    /// The longest of these in a lane; 0 if there is none.
    pub fn longest(&self, l: usize) -> f64 {
        self.schedule.as_ref().map_or(0.0, |schedule| schedule.longest(l))
    }

    /// Calls `visit` for each length that steps keep to.
    fn lengths_mut(&mut self, mut visit: impl FnMut(&mut Length)) {
        for step in &mut self.steps {
            match step {
                Step::Circles(circles) => circles.radii_mut().iter_mut().for_each(&mut visit),
                Step::CircleLine(meeting) => visit(meeting.radius_mut()),
                Step::CircleMovingLine(meeting) => visit(meeting.radius_mut()),
                Step::Ray(ray) => visit(ray.length_mut()),
                Step::Direction(link) => visit(link.length_mut()),
                Step::Bar(bar) => visit(bar.length_mut()),
                Step::Nearest(points) => {
                    points.iter_mut().filter_map(Nearest::length_mut).for_each(&mut visit);
                }
                // Blocks are not found in lanes.
                Step::Block(_)
                | Step::Crank(_)
                | Step::Place { .. }
                | Step::Crossing(_)
                | Step::Wheel(_)
                | Step::Sum(_)
                | Step::Firm(_)
                | Step::Body(_) => {}
            }
        }
    }

    /// Points the motors of a world, which have these handles, as those here, and says the values that follow
    /// time.
    pub fn hand_over(&self, constraints: &[Constraint], ids: &[ConstraintId], world: &mut World) {
        for crank in &self.cranks {
            if let Some(heading) = crank.heading(constraints) {
                crank.point_in(world, ids, heading);
            }
        }
        if let Some(schedule) = &self.schedule {
            schedule.tell(constraints, ids, world);
        }
    }

    /// Takes in what drove points and constraints in this frame, and how far that went.
    pub fn drive(&mut self, inputs: &Inputs, x: &[Point], constraints: &[Constraint]) {
        if !self.knows_lengths || changes_lengths(inputs) {
            self.measure(constraints, Some(inputs));
        }
        self.one.ways.fill([0.0]);
        for &(p, before) in &inputs.points {
            self.one.ways[p as usize] = [x[p as usize].distance(before)];
        }
        for (crank, to) in self.cranks.iter().zip(&mut self.one.turned) {
            let Constraint::Motor(now) = &constraints[crank.motor as usize] else {
                continue;
            };
            let turns = inputs.turns().iter().filter(|(c, _)| *c == crank.motor);
            let turned: f64 = turns.map(|&(_, before)| now.way_since(before)).sum();
            let values = inputs.values_before(crank.motor);
            let changed: f64 = values.map(|before| way_between(before, now)).sum();
            to.set(0, now.target(), turned + changed);
        }
        for step in &mut self.steps {
            match step {
                Step::Place { to, constraint, drive } => {
                    let is_moved = inputs.values_before(*constraint).next().is_some();
                    let place = place(&constraints[*constraint as usize]);
                    // The point still is where it was at the beginning of the frame.
                    let way = if is_moved { place.distance(x[*to as usize]) } else { 0.0 };
                    self.one.turned[*drive as usize].set(0, place.to_vector(), way);
                }
                Step::Direction(link) => {
                    let of = &constraints[link.constraint as usize];
                    let (target, way) = link.target(of, inputs.values_before(link.constraint));
                    self.one.turned[link.drive as usize].set(0, target, way);
                }
                _ => {}
            }
        }
    }

    /// Takes in where the frames before let points be expected.
    pub fn expect(&mut self, history: &History, x: &[Point]) {
        for step in &mut self.steps {
            if let Step::Block(block) = step {
                block.expect(history, x);
            }
        }
    }

    /// Puts the points where they are at the end of the frame. Where the pose is to be found in
    /// another way the distance to satisfaction is not a number, and they are anywhere.
    #[inline]
    pub fn run(&mut self, x: &mut [Point], constraints: &[Constraint]) -> Found {
        let Self { steps, cranks, one, .. } = self;
        make(steps, cranks, constraints, x, one);
        one.found(0)
    }
}

/// Makes all steps, for as many frames as there are side by side.
#[inline(always)]
pub(super) fn make<const N: usize>(
    steps: &mut [Step],
    cranks: &[Crank],
    constraints: &[Constraint],
    x: &mut (impl Poses<N> + ?Sized),
    abreast: &mut Abreast<N>,
) {
    abreast.begin();
    for step in steps {
        match step {
            Step::Crank(k) => cranks[*k as usize].run(*k, x, abreast),
            Step::Circles(circles) => circles.run(x, abreast),
            Step::CircleLine(meeting) => meeting.run(x, abreast),
            Step::CircleMovingLine(meeting) => meeting.run(x, abreast),
            Step::Crossing(meeting) => meeting.run(x, abreast),
            Step::Ray(ray) => ray.run(x, abreast),
            Step::Direction(link) => link.run(x, abreast),
            Step::Wheel(wheel) => wheel.run(x, constraints, abreast),
            Step::Sum(sum) => sum.run(x, abreast),
            Step::Body(body) => body.run(x, abreast),
            Step::Block(block) => block.run(x, constraints, abreast),
            Step::Firm(firm) => firm.check(x, constraints, abreast),
            Step::Bar(bar) => bar.check(x, abreast),
            Step::Place { to, drive, .. } => {
                let Turned { x: at_x, y: at_y, way } = abreast.turned[*drive as usize];
                x.put(*to, Places { x: at_x, y: at_y });
                abreast.ways[*to as usize] = way;
            }
            Step::Nearest(points) => nearest::run(points, x, abreast),
        }
    }
}

impl Crank {
    /// Its motor, among the constraints of its island.
    #[inline(always)]
    pub fn motor<'a>(&self, constraints: &'a mut [Constraint]) -> Option<&'a mut Motor> {
        match &mut constraints[self.motor as usize] {
            Constraint::Motor(motor) => Some(motor),
            _ => None,
        }
    }

    /// How its motor points.
    pub fn heading(&self, constraints: &[Constraint]) -> Option<Heading> {
        match &constraints[self.motor as usize] {
            Constraint::Motor(motor) => Some(motor.heading()),
            _ => None,
        }
    }

    /// Points its motor, in a world where the constraints of its island have these handles.
    pub fn point_in(&self, world: &mut World, ids: &[ConstraintId], heading: Heading) {
        if let Constraint::Motor(there) = world.constraint_state_mut(ids[self.motor as usize]) {
            there.set_heading(heading);
        }
    }

    #[inline(always)]
    fn run<const N: usize>(
        &self,
        k: u32,
        x: &mut (impl Poses<N> + ?Sized),
        abreast: &mut Abreast<N>,
    ) {
        let centre = x.get(self.from);
        let Turned { x: along, y: across, way } = abreast.turned[k as usize];
        let before = abreast.ways[self.from as usize];
        put_each(self.to, x, abreast, |l| {
            let at = centre.at(l) + Vector::new(along[l], across[l]);
            // It is there by definition, unless there is out of all numbers.
            (at, before[l] + way[l], 0.0 * at.x + 0.0 * at.y)
        });
    }
}

/// Whether a bar is among what drives a frame.
fn changes_lengths(inputs: &Inputs) -> bool {
    inputs.constraints().iter().any(|(_, before)| matches!(before, Constraint::Length(_)))
}

/// How far the end of a motor goes around its centre from some values to others, at most.
fn way_between(before: &Constraint, now: &Motor) -> f64 {
    let Constraint::Motor(before) = before else { return f64::NAN };
    let radii = [before, now].map(|motor| motor.get(Field::Radius).unwrap_or_default());
    let turned = (now.total() - before.total()).abs();
    turned * radii[0].max(radii[1]) + (radii[1] - radii[0]).abs()
}
