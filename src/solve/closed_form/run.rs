//! Running the list of steps for a frame.

use super::found::Found;
use super::{ClosedForm, Crank, Radius, Step};
use crate::constraint::{
    Constraint, ConstraintKind as _, Field, Motor, Point, PointIdx, Stateful as _,
};
use crate::solve::island::inputs::Inputs;
use crate::world::{ConstraintId, World};

impl ClosedForm {
    /// Whether it is known of the pose of now what has to be.
    pub fn knows_pose(&self) -> bool {
        self.knows_pose
    }

    /// Looks at a pose that counts.
    pub fn look(&mut self, x: &[Point]) {
        for step in &mut self.steps {
            match step {
                Step::Circles(circles) => circles.look(x),
                Step::CircleLine(meeting) => meeting.look(x),
                Step::Ray(ray) => ray.look(x),
                Step::Crank(_) | Step::Place { .. } | Step::Sum(_) | Step::Nearest { .. } => {}
            }
        }
        self.knows_pose = true;
    }

    /// The pose was, or is to be, reached in another way.
    pub fn forget_pose(&mut self) {
        self.knows_pose = false;
    }

    /// How many constraints a frame evaluates.
    pub fn n_constraints(&self) -> u32 {
        self.n_constraints
    }

    /// Makes ready for frames in which nothing but motors turns; none if some of these is not on
    /// its way, or is not the one that `there` shows of the constraint of a number. Gives how many
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
        self.ways.fill(0.0);
        if !self.knows_pose {
            self.look(x);
        }
        Some(n_turning)
    }

    /// Turns the motors on by a frame.
    #[inline]
    pub fn turn_on(&mut self, constraints: &mut [Constraint], dt: f64) {
        for crank in &mut self.cranks {
            if let Constraint::Motor(motor) = &mut constraints[crank.motor as usize] {
                crank.before = motor.heading();
                motor.advance(dt);
                crank.way = motor.way_since(crank.before);
            }
        }
    }

    /// Turns the motors back to where they pointed before.
    pub fn turn_back(&self, constraints: &mut [Constraint]) {
        for crank in &self.cranks {
            if let Constraint::Motor(motor) = &mut constraints[crank.motor as usize] {
                motor.set_heading(crank.before);
            }
        }
    }

    /// Points the motors of a world, which have these handles, as those here.
    pub fn hand_over(&self, constraints: &[Constraint], ids: &[ConstraintId], world: &mut World) {
        for crank in &self.cranks {
            let c = crank.motor as usize;
            if let (Constraint::Motor(here), Constraint::Motor(there)) =
                (&constraints[c], world.constraint_state_mut(ids[c]))
            {
                there.set_heading(here.heading());
            }
        }
    }

    /// Takes in what drove points and constraints in this frame, and how far that went.
    pub fn drive(&mut self, inputs: &Inputs, x: &[Point], constraints: &[Constraint]) {
        self.ways.fill(0.0);
        for &(p, before) in &inputs.points {
            self.ways[p as usize] = x[p as usize].distance(before);
        }
        for crank in &mut self.cranks {
            let Constraint::Motor(now) = &constraints[crank.motor as usize] else {
                continue;
            };
            let turns = inputs.turns().iter().filter(|(c, _)| *c == crank.motor);
            let turned: f64 = turns.map(|&(_, before)| now.way_since(before)).sum();
            let values = inputs.values_before(crank.motor);
            let changed: f64 = values.map(|before| way_between(before, now)).sum();
            crank.way = turned + changed;
        }
        for step in &mut self.steps {
            if let Step::Place { to, constraint, way } = step {
                let is_moved = inputs.values_before(*constraint).next().is_some();
                let place = place(&constraints[*constraint as usize]);
                // The point still is where it was at the beginning of the frame.
                *way = if is_moved { place.distance(x[*to as usize]) } else { 0.0 };
            }
        }
    }

    /// Puts the points where they are at the end of the frame; none where they are to be found in
    /// another way, and then they are anywhere.
    #[inline]
    pub fn run(&mut self, x: &mut [Point], constraints: &[Constraint]) -> Option<Found> {
        let Self { steps, cranks, ways, .. } = self;
        let mut found = Found::NOTHING;
        for step in steps {
            match step {
                Step::Crank(k) => cranks[*k as usize].run(x, ways, constraints, &mut found),
                Step::Circles(circles) => circles.run(x, ways, &mut found)?,
                Step::CircleLine(meeting) => meeting.run(x, ways, &mut found)?,
                Step::Ray(ray) => ray.run(x, ways, &mut found)?,
                Step::Sum(sum) => sum.run(x, ways, constraints, &mut found),
                Step::Place { to, constraint, way } => {
                    x[*to as usize] = place(&constraints[*constraint as usize]);
                    ways[*to as usize] = *way;
                }
                Step::Nearest { to, from, radius } => {
                    nearest(*to, *from, radius.at(x), x, &mut found);
                }
            }
        }
        Some(found)
    }
}

impl Crank {
    #[inline]
    fn run(
        &self,
        x: &mut [Point],
        ways: &mut [f64],
        constraints: &[Constraint],
        found: &mut Found,
    ) {
        let (to, from) = (self.to as usize, self.from as usize);
        if let Constraint::Motor(motor) = &constraints[self.motor as usize] {
            x[to] = x[from] + motor.target();
            ways[to] = ways[from] + self.way;
            // It is there by definition, unless there is out of all numbers.
            found.add(0.0 * x[to].x + 0.0 * x[to].y);
        }
    }
}

impl Radius {
    fn at(self, x: &[Point]) -> f64 {
        match self {
            Self::Fixed(radius) => radius,
            Self::Measured { between: [p, q], factor, offset } => {
                factor * x[p as usize].distance(x[q as usize]) + offset
            }
        }
    }
}

/// Puts a point on a circle, where it is nearest to.
fn nearest(to: PointIdx, from: PointIdx, radius: f64, x: &mut [Point], found: &mut Found) {
    let centre = x[from as usize];
    let arm = x[to as usize] - centre;
    let p = centre + arm * (radius / arm.norm());
    x[to as usize] = p;
    let off = (p - centre).norm() - radius;
    found.add(if radius >= 0.0 { off } else { f64::NAN });
}

/// Where a constraint says that its point is.
fn place(constraint: &Constraint) -> Point {
    match constraint {
        Constraint::Coordinate(coordinate) => coordinate.target,
        _ => Point::new(f64::NAN, f64::NAN),
    }
}

/// How far the end of a motor goes around its centre from some values to others, at most.
fn way_between(before: &Constraint, now: &Motor) -> f64 {
    let Constraint::Motor(before) = before else { return f64::NAN };
    let radii = [before, now].map(|motor| motor.get(Field::Radius).unwrap_or_default());
    let turned = (now.total() - before.total()).abs();
    turned * radii[0].max(radii[1]) + (radii[1] - radii[0]).abs()
}
