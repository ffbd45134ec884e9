//! The motor constraint, section 3.7: a point that circulates around another, its angle measured
//! against the x axis, or between two links.

use std::sync::Arc;

use crate::constraint::parts::carried_crank::CarriedCrank;
use crate::constraint::parts::content::add_all;
use crate::constraint::parts::drive::Drive;
use crate::constraint::parts::geometry::has_direction;
use crate::constraint::parts::heading::Heading;
use crate::constraint::parts::linear::Linear;
use crate::constraint::parts::two_rows;
use crate::constraint::{
    Activity, Carried, ConstraintKind, Culprit, Declared, Field, Flaw, Given, Point, PointIdx,
    Quantity, Real, Refusal, Row, Stateful, Traits, Turns, Vec2, Vector,
};

/// The second point lies at distance `radius` from the first, at the angle `phase + turned`
/// against the x axis, or against the direction from a third point to a fourth.
///
/// The radius makes it a vector equation, without the pole of an angle where the points coincide.
/// Against the x axis it is linear, so exact in one step. Between two links it asks for nothing
/// while the points that the angle is measured from coincide.
#[derive(Debug, Clone, PartialEq)]
pub struct Motor {
    points: Points,
    heading: Heading,
    /// What stays from frame to frame: shared by copies, so that each is small and made at once.
    drive: Arc<Drive>,
}

/// The centre and the point driven around it, and where the angle is measured from.
#[derive(Debug, Clone, PartialEq)]
enum Points {
    /// The x axis.
    Fixed([PointIdx; 2]),
    /// The direction from the third to the fourth. In a box, since most motors have none.
    Between(Box<[PointIdx; 4]>),
}

impl Motor {
    /// A motor of a radius, a phase in radians and a speed in radians per time unit, that
    /// has not turned yet.
    pub fn new(points: [PointIdx; 2], radius: f64, phase: f64, speed: f64) -> Self {
        let target = Vector::polar(radius, phase);
        let drive = Arc::new(Drive::new(radius, phase, speed));
        let points = Points::Fixed(points);
        Self { points, heading: Heading { turned: Turns::default(), target }, drive }
    }

    /// The same, its angles measured from the direction from one point to another.
    #[must_use]
    pub fn between(self, [s, e]: [PointIdx; 2]) -> Self {
        let [a, b] = self.crank();
        Self { points: Points::Between(Box::new([a, b, s, e])), ..self }
    }

    /// The centre and the point driven around it.
    pub fn crank(&self) -> [PointIdx; 2] {
        match &self.points {
            Points::Fixed(crank) => *crank,
            Points::Between(points) => [points[0], points[1]],
        }
    }

    /// The points of the direction that its angles are measured from; none if from the x axis.
    pub fn measured_from(&self) -> Option<[PointIdx; 2]> {
        match &self.points {
            Points::Fixed(_) => None,
            Points::Between(points) => Some([points[2], points[3]]),
        }
    }

    /// How far it has turned, and where that leads.
    pub const fn heading(&self) -> Heading {
        self.heading
    }

    /// How far the driven point went around the centre since it pointed elsewhere.
    pub fn way_since(&self, before: Heading) -> f64 {
        self.way_between(before, self.heading)
    }

    /// How far the driven point goes around the centre from where it points at to there.
    #[inline]
    pub fn way_between(&self, before: Heading, now: Heading) -> f64 {
        now.turned.apart(before.turned) * self.drive.radius
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

    /// Whether its last frame was as long as that, so that the next needs nothing but to turn on;
    /// one that stands still needs nothing at all.
    pub fn is_under_way(&self, dt: f64) -> bool {
        self.drive.is_under_way(dt)
    }

    /// Whether it turns.
    pub fn turns(&self) -> bool {
        self.drive.turns()
    }

    /// The angle without whole turns, radians.
    pub fn angle(&self) -> f64 {
        self.drive.angle_at(self.heading.turned)
    }

    /// The angle with whole turns, `phase + turned`, radians.
    pub fn total(&self) -> f64 {
        self.drive.phase + self.heading.turned.total()
    }

    /// How far it has turned since it was made.
    pub const fn turned(&self) -> Turns {
        self.heading.turned
    }

    /// Sets how far it has turned, as where the clock goes back to where it was.
    pub fn set_turned(&mut self, turned: Turns) {
        self.heading = self.drive.heading_at(turned);
    }

    /// Where the driven point belongs, from the centre, if the angle is measured from the x axis.
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

    /// Advances so many times by `dt`; how far it turns in each, and the coordinates of where it points then.
    #[allow(clippy::inline_always, reason = "it becomes part of who calls it, with its vectors")]
    #[inline(always)]
    pub fn advance_each<const N: usize>(&mut self, dt: f64) -> (Turns, [[f64; N]; 2]) {
        let Heading { turned, target } = self.heading;
        let Some(step) = self.drive.step(dt) else {
            return (Turns::default(), [[target.x; N], [target.y; N]]);
        };
        let [x, y] = self.drive.targets(turned, step);
        let turned = turned.plus_times(step, N);
        self.heading = Heading { turned, target: Vector::new(x[N - 1], y[N - 1]) };
        (step, [x, y])
    }

    /// How far the driven point goes around the centre where the motor turns as far as that.
    pub fn way_of(&self, turned: Turns) -> f64 {
        turned.total().abs() * self.drive.radius
    }

    fn linear(&self) -> Linear {
        let [a, b] = self.crank();
        Linear::new().with_real(a, -1.0).with_real(b, 1.0)
    }

    /// The value of the vector equation where the angle is measured from the x axis.
    fn value(&self, x: &[Point]) -> Vector {
        let [x1, x2] = self.crank().map(|p| x[p as usize]);
        (x2 - x1) - self.heading.target
    }

    /// The rows of a motor between two links.
    fn rows(&self, points: [PointIdx; 4], x: &[Point]) -> Option<[Row<'static>; 2]> {
        Some(CarriedCrank::new(points, self.angle(), x)?.rows(self.drive.radius))
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
        let speed = given.value(Field::Speed).unwrap_or(0.0);
        let said = given.value(Field::Phase);
        if given.groups.len() == 1 {
            let phase = said.unwrap_or_else(|| (p - o).angle());
            return Ok(Self::new(points, radius, phase, speed));
        }
        let from = given.two(1, "a direction needs two different points")?;
        if from == points || from == [points[1], points[0]] {
            return Err(Refusal {
                message: "the angle of a crank against itself is always the same",
                at: Culprit::Group(1),
                label: "the same two points again",
                help: Some("name the link that carries the motor"),
            });
        }
        let [s, e] = from.map(|p| given.at(p));
        if said.is_none() && !has_direction(s, e) {
            return Err(Refusal {
                message: "there is no direction between points that coincide",
                at: Culprit::Group(1),
                label: "so the motor has no angle now",
                help: Some("say which it is to have: `phase 90deg`"),
            });
        }
        let phase = said.unwrap_or_else(|| (e - s).angle_to(p - o));
        Ok(Self::new(points, radius, phase, speed).between(from))
    }
}

impl ConstraintKind for Motor {
    fn points(&self) -> &[PointIdx] {
        match &self.points {
            Points::Fixed(points) => points,
            Points::Between(points) => &**points,
        }
    }

    fn points_mut(&mut self) -> &mut [PointIdx] {
        match &mut self.points {
            Points::Fixed(points) => points,
            Points::Between(points) => &mut **points,
        }
    }

    fn n_rows(&self) -> usize {
        2
    }

    fn residual(&self, x: &[Point]) -> f64 {
        match &self.points {
            Points::Fixed(_) => self.value(x).norm(),
            Points::Between(points) => self
                .rows(**points, x)
                .map_or(0.0, |[along, across]| Vector::new(along.f, across.f).norm()),
        }
    }

    /// Exact against the x axis; to first order between two links, of which both turn.
    fn correct(&self, x: &[Point], w: &[f64], move_by: &mut impl FnMut(PointIdx, Vector)) {
        match &self.points {
            Points::Fixed(_) => self.linear().correct(self.value(x), w, move_by),
            Points::Between(points) => {
                if let Some(rows) = self.rows(**points, x) {
                    two_rows::correct(&rows, w, move_by);
                }
            }
        }
    }

    fn jacobian(&self, x: &[Point], row: &mut impl FnMut(Row)) {
        match &self.points {
            Points::Fixed(_) => self.linear().rows(self.value(x), row),
            Points::Between(points) => {
                let idle = || [Row::inactive(&**points); 2];
                self.rows(**points, x).unwrap_or_else(idle).into_iter().for_each(row);
            }
        }
    }

    fn equations<T: Real>(
        &self,
        x: &impl Fn(PointIdx) -> Vec2<T>,
        field: &impl Fn(Field, f64) -> T,
        equation: &mut impl FnMut(T),
    ) {
        let [x1, x2] = self.crank().map(x);
        let turned =
            T::integral(self.heading.turned.angle(), field(Field::Speed, self.drive.speed));
        let angle = field(Field::Phase, self.drive.phase) + turned;
        let radius = field(Field::Radius, self.drive.radius);
        let v = x2 - x1;
        let u = Vec2 { x: angle.cos(), y: angle.sin() };
        let Some(from) = self.measured_from() else {
            equation(v.x - radius * u.x);
            return equation(v.y - radius * u.y);
        };
        let [s, e] = from.map(x);
        if !has_direction(s.value().to_point(), e.value().to_point()) {
            equation(T::constant(0.0));
            return equation(T::constant(0.0));
        }
        let link = e - s;
        let u = u.times(link.scale(T::constant(1.0) / link.norm()));
        equation(u.dot(v) - radius);
        equation(u.cross(v));
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
        self.set_turned(self.heading.turned);
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
            // What the angle is measured from feels only how it turns.
            n_firm_rows: if self.measured_from().is_some() { 1 } else { 2 },
            is_linear: self.measured_from().is_none(),
            is_wheel: false,
            carried: Carried::ByClock,
            flags: &[],
            flaw: (self.drive.radius < 0.0).then_some(Flaw::NegativeRadius),
        }
    }

    fn content(&self, word: &mut impl FnMut(u64)) {
        // The target follows from the rest; the drive says what of it matters.
        let Self { points: _, heading: Heading { turned, target: _ }, drive } = self;
        drive.content(word);
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
        let [x1, x2] = self.crank().map(|p| x[p as usize]);
        let angle = match self.measured_from() {
            None => Some((x2 - x1).angle()),
            Some(from) => {
                let [s, e] = from.map(|p| x[p as usize]);
                has_direction(s, e).then(|| (e - s).angle_to(x2 - x1))
            }
        };
        if let Some(angle) = angle.filter(|_| x1 != x2) {
            self.set_turned(self.heading.turned.pick_up(angle - self.drive.phase));
        }
    }

    /// Turns on by `dt` times the mean speed; `-dt` takes the frame back that `dt` was.
    fn advance(&mut self, dt: f64) -> bool {
        let Some(step) = self.drive.step(dt) else { return false };
        self.set_turned(self.heading.turned.plus(step));
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
    fn between_two_links_both_give_way() {
        // E H is to stand at a right angle on S E; both turn, and the length comes right too.
        let motor = Motor::new([1, 2], 2.0, FRAC_PI_2, 0.0).between([0, 1]);
        let mut x = [Point::ORIGIN, Point::new(3.0, 0.2), Point::new(4.0, 1.5)];
        for _ in 0..20 {
            motor.correct(&x.clone(), &[1.0, 1.0, 1.0], &mut |p, d| x[p as usize] += d);
        }
        let (upper, lower) = (x[1] - x[0], x[2] - x[1]);
        assert!((lower.norm() - 2.0).abs() < 1e-14 && upper.dot(lower).abs() < 1e-13);
        assert!(upper.cross(lower) > 0.0 && x[0] != Point::ORIGIN);
    }

    #[test]
    fn switched_on_again_between_links_it_goes_on_from_the_point() {
        let mut motor = Motor::new([1, 2], 1.0, 0.0, 1.0).between([0, 1]);
        let x = [Point::ORIGIN, Point::new(0.0, 3.0), Point::new(1.0, 3.0)];
        motor.pick_up(&x);
        assert!((motor.angle() + FRAC_PI_2).abs() < 1e-15);
        assert!(motor.residual(&x) < 1e-15);
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
