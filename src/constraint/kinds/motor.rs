//! The motor constraint, section 3.7: a point that circulates around another.

use std::sync::Arc;

use crate::constraint::parts::content::add_all;
use crate::constraint::parts::linear::Linear;
use crate::constraint::{
    Activity, Carried, ConstraintKind, Culprit, Declared, Field, Flaw, Given, Point, PointIdx,
    Quantity, Real, Refusal, Row, Stateful, Traits, Turns, Vec2, Vector,
};

/// The second point lies at distance `radius` from the first, at the angle `phase + turned`
/// against the x axis.
///
/// The radius makes it a vector equation: linear, exact in one step and without the pole of
/// an angle where the points coincide.
#[derive(Debug, Clone, PartialEq)]
pub struct Motor {
    /// The centre and the point driven around it.
    pub points: [PointIdx; 2],
    heading: Heading,
    /// What stays from frame to frame: shared by copies, so that each is small and made at once.
    drive: Arc<Drive>,
}

/// All that time changes of a motor.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Heading {
    /// How far it has turned since it was made.
    turned: Turns,
    /// Where the driven point belongs, from the centre.
    target: Vector,
}

/// The values of a motor.
#[derive(Debug, Clone, PartialEq)]
struct Drive {
    radius: f64,
    phase: f64,
    speed: f64,
    /// The mean of the speed over the present frame, where it changes in time.
    mean_speed: f64,
    /// The angle that the last step of time made at this speed, and the same in turns.
    step: (f64, Turns),
}

impl Motor {
    /// A motor of a radius, a phase in radians and a speed in radians per time unit, that
    /// has not turned yet.
    pub fn new(points: [PointIdx; 2], radius: f64, phase: f64, speed: f64) -> Self {
        let target = Vector::polar(radius, phase);
        let step = (0.0, Turns::default());
        let drive = Arc::new(Drive { radius, phase, speed, mean_speed: speed, step });
        Self { points, heading: Heading { turned: Turns::default(), target }, drive }
    }

    /// How far it has turned, and where that leads.
    pub const fn heading(&self) -> Heading {
        self.heading
    }

    /// Puts it where a copy of it was, or will be.
    pub fn set_heading(&mut self, heading: Heading) {
        self.heading = heading;
    }

    /// Whether another is a copy of it that differs at most in how far it has turned. Says no
    /// where that is not seen at once.
    pub fn is_copy(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.drive, &other.drive)
    }

    /// The angle against the x axis without whole turns, radians.
    pub fn angle(&self) -> f64 {
        crate::constraint::parts::geometry::wrap(self.drive.phase + self.heading.turned.angle())
    }

    /// The angle with whole turns, `phase + turned`, radians.
    pub fn total(&self) -> f64 {
        self.drive.phase + self.heading.turned.total()
    }

    /// How far it has turned since it was made.
    pub const fn turned(&self) -> Turns {
        self.heading.turned
    }

    /// Sets how far it has turned: the clock goes back to where it was.
    pub fn set_turned(&mut self, turned: Turns) {
        self.heading.turned = turned;
        self.aim();
    }

    /// Where the driven point belongs, from the centre.
    pub const fn target(&self) -> Vector {
        self.heading.target
    }

    /// Says what the speed was on the average over the frame that it advances by next: that is how
    /// far it turns. Setting the speed makes it the mean too.
    pub fn set_mean_speed(&mut self, mean: f64) {
        if mean != self.drive.mean_speed {
            Arc::make_mut(&mut self.drive).mean_speed = mean;
        }
    }

    fn aim(&mut self) {
        self.heading.target = Vector::polar(self.drive.radius, self.angle());
    }

    fn linear(&self) -> Linear {
        let [a, b] = self.points;
        Linear::new().with_real(a, -1.0).with_real(b, 1.0)
    }

    fn value(&self, x: &[Point]) -> Vector {
        let [x1, x2] = self.points.map(|p| x[p as usize]);
        (x2 - x1) - self.heading.target
    }
}

impl Declared for Motor {
    const WORDS: &'static [&'static str] = &["motor"];

    fn declare(given: &Given) -> Result<Self, Refusal> {
        let points = given.pair(0)?;
        let [o, p] = points.map(|p| given.at(p));
        let radius = match given.value(Field::Radius) {
            Some(radius) => radius,
            None if o == p => {
                return Err(Refusal {
                    message: "the motor's points coincide, so it has no radius",
                    at: Culprit::Group(0),
                    label: "",
                    help: Some("say how far apart they belong: `radius 1`"),
                });
            }
            None => o.distance(p),
        };
        let phase = given.value(Field::Phase).unwrap_or_else(|| (p - o).angle());
        let speed = given.value(Field::Speed).unwrap_or(0.0);
        Ok(Self::new(points, radius, phase, speed))
    }
}

impl ConstraintKind for Motor {
    fn points(&self) -> &[PointIdx] {
        &self.points
    }

    fn points_mut(&mut self) -> &mut [PointIdx] {
        &mut self.points
    }

    fn n_rows(&self) -> usize {
        2
    }

    fn residual(&self, x: &[Point]) -> f64 {
        self.value(x).norm()
    }

    fn correct(&self, x: &[Point], w: &[f64], move_by: &mut impl FnMut(PointIdx, Vector)) {
        self.linear().correct(self.value(x), w, move_by);
    }

    fn jacobian(&self, x: &[Point], row: &mut impl FnMut(Row)) {
        self.linear().rows(self.value(x), row);
    }

    fn equations<T: Real>(
        &self,
        x: &impl Fn(PointIdx) -> Vec2<T>,
        field: &impl Fn(Field, f64) -> T,
        equation: &mut impl FnMut(T),
    ) {
        let [x1, x2] = self.points.map(x);
        let turned =
            T::integral(self.heading.turned.angle(), field(Field::Speed, self.drive.speed));
        let angle = field(Field::Phase, self.drive.phase) + turned;
        let radius = field(Field::Radius, self.drive.radius);
        let v = x2 - x1;
        equation(v.x - radius * angle.cos());
        equation(v.y - radius * angle.sin());
    }

    fn get(&self, field: Field) -> Option<f64> {
        match field {
            Field::Radius => Some(self.drive.radius),
            Field::Phase => Some(self.drive.phase),
            Field::Speed => Some(self.drive.speed),
            _ => None,
        }
    }

    fn set(&mut self, field: Field, value: f64) -> bool {
        match field {
            Field::Radius => Arc::make_mut(&mut self.drive).radius = value,
            Field::Phase => Arc::make_mut(&mut self.drive).phase = value,
            // The angle so far stays: a change of speed is no jump.
            Field::Speed => {
                let drive = Arc::make_mut(&mut self.drive);
                (drive.speed, drive.mean_speed) = (value, value);
            }
            _ => return false,
        }
        self.aim();
        true
    }

    fn nominal_length(&self) -> f64 {
        self.drive.radius.abs()
    }

    fn traits(&self) -> Traits {
        Traits {
            word: "motor",
            quantity: Quantity::Length,
            bounds: None,
            activity: Activity::Always,
            n_firm_rows: 2,
            is_linear: true,
            is_wheel: false,
            carried: Carried::ByClock,
            flags: &[],
            flaw: (self.drive.radius < 0.0).then_some(Flaw::NegativeRadius),
        }
    }

    fn content(&self, word: &mut impl FnMut(u64)) {
        // The target follows from the rest, and the mean speed and the step of time are made anew
        // where they differ.
        let Self { points: _, heading: Heading { turned, target: _ }, drive } = self;
        let Drive { radius, phase, speed, mean_speed: _, step: _ } = &**drive;
        add_all([*radius, *speed, *phase], word);
        add_all(turned.to_numbers(), word);
    }
}

impl Stateful for Motor {
    fn state(&self) -> Option<Vec<f64>> {
        Some(self.heading.turned.to_numbers().to_vec())
    }

    fn set_state(&mut self, state: &[f64]) {
        if let &[whole, hi, lo] = state {
            self.set_turned(Turns::from_numbers([whole, hi, lo]));
        }
    }

    fn captured(&self) -> Vec<f64> {
        Vec::new()
    }

    fn set_captured(&mut self, _captured: &[f64]) {}

    /// Goes on from where the driven point is now, by less than half a turn; a point at the
    /// centre changes nothing.
    fn pick_up(&mut self, x: &[Point]) {
        let [x1, x2] = self.points.map(|p| x[p as usize]);
        if x1 != x2 {
            self.heading.turned = self.heading.turned.pick_up((x2 - x1).angle() - self.drive.phase);
            self.aim();
        }
    }

    /// Turns on by `dt` times the mean speed; `-dt` takes the frame back that `dt` was.
    fn advance(&mut self, dt: f64) -> bool {
        let step = self.drive.mean_speed * dt;
        if step == 0.0 {
            return false;
        }
        if step != self.drive.step.0 {
            Arc::make_mut(&mut self.drive).step = (step, Turns::from_radians(step));
        }
        self.heading.turned = self.heading.turned.plus(self.drive.step.1);
        self.aim();
        true
    }

    fn accept(&mut self, _x: &[Point]) {}
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::constraint::Jet;
    use std::f64::consts::{FRAC_PI_2, TAU};

    #[test]
    fn a_positive_speed_turns_to_the_left() {
        let mut motor = Motor::new([0, 1], 2.0, 0.0, TAU);
        (0..15).for_each(|_| _ = motor.advance(1.0 / 60.0));
        assert!((motor.target() - Vector::new(0.0, 2.0)).norm() < 1e-15);
    }

    #[test]
    fn a_revolution_in_360_frames_ends_where_it_began() {
        let mut motor = Motor::new([0, 1], 1.0, FRAC_PI_2, TAU);
        let start = motor.target();
        for _ in 0..1000 {
            (0..360).for_each(|_| _ = motor.advance(1.0 / 360.0));
            assert_eq!(motor.target(), start);
        }
        assert_eq!(motor.total(), FRAC_PI_2 + 1000.0 * TAU);
    }

    #[test]
    fn a_change_of_speed_is_no_jump() {
        let mut motor = Motor::new([0, 1], 1.0, 0.3, 5.0);
        motor.advance(10.0);
        let before = motor.target();
        assert!(motor.set(Field::Speed, -1e9));
        assert_eq!(motor.target(), before);
    }

    #[test]
    fn a_frame_of_a_changing_speed_is_taken_back() {
        let mut motor = Motor::new([0, 1], 1.0, 0.3, 5.0);
        motor.advance(0.1);
        let before = motor.clone();
        motor.set(Field::Speed, 7.0);
        motor.set_mean_speed(6.2);
        motor.advance(0.1);
        assert!((motor.total() - before.total() - 0.62).abs() < 1e-15);
        assert_eq!(motor.get(Field::Speed), Some(7.0));
        motor.advance(-0.1);
        assert!((motor.total() - before.total()).abs() < 1e-16);
        motor.set(Field::Speed, 7.0);
        motor.advance(0.1);
        assert!((motor.total() - before.total() - 0.7).abs() < 1e-15);
    }

    #[test]
    fn switched_on_again_it_goes_on_from_the_point() {
        let mut motor = Motor::new([0, 1], 1.0, 0.3, 5.0);
        motor.advance(10.0);
        let total = motor.total();
        let x = [Point::new(1.0, 1.0), Point::new(1.0, -2.0)];
        motor.pick_up(&x);
        assert!((motor.target() - Vector::new(0.0, -1.0)).norm() < 1e-15);
        assert!((motor.total() - total).abs() <= 0.5 * TAU);
        motor.pick_up(&[x[0], x[0]]);
        assert!((motor.target() - Vector::new(0.0, -1.0)).norm() < 1e-15);
    }

    #[test]
    fn equations_turn_at_the_speed() {
        let motor = Motor::new([0, 1], 2.0, 0.0, 3.0);
        let still = |p: PointIdx| Vec2::constant(Vector::new(2.0 * f64::from(p), 0.0));
        let mut rates = Vec::new();
        motor.equations(&still, &|_, v| Jet::constant(v), &mut |f: Jet| rates.push(f));
        // The point would have to move up at r omega and inward at r omega^2.
        assert_eq!([rates[0].d, rates[1].d], [0.0, -6.0]);
        assert_eq!([rates[0].dd, rates[1].dd], [18.0, 0.0]);
    }
}
