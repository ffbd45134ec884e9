//! How far a driver can go: its mechanism is followed both ways until the motion folds back, runs
//! into a stop, or comes round.

use std::f64::consts::TAU;

use super::driver::Driver;
use super::system::ConstraintSystem;
use super::travel::{Mechanism, NoValue, Waypoint};
use crate::constraint::{Constraint, Field, Flaw, Point};

/// What ends the way of a driver in one direction, and at which value of it; that of an angle is in
/// radians, whole turns included.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum RangeEnd {
    /// The motion folds back: the driver is at its farthest.
    DeadPoint(f64),
    /// An inequality comes into play, the constraint at this place of the scene.
    Stop(f64, usize),
    /// Beyond it a value of a constraint is one that no pose could have, or none at all.
    NoValue(f64, Option<Flaw>),
    /// This is as far as the motion could be followed; what comes after is not known.
    Lost(f64),
    /// It was followed so far and met no end; an angle never came back to where it began.
    Endless(f64),
}

impl RangeEnd {
    /// The value of the driver.
    pub const fn value(self) -> f64 {
        match self {
            Self::DeadPoint(value)
            | Self::Stop(value, _)
            | Self::NoValue(value, _)
            | Self::Lost(value)
            | Self::Endless(value) => value,
        }
    }

    /// The same end at another value.
    const fn at(self, value: f64) -> Self {
        match self {
            Self::DeadPoint(_) => Self::DeadPoint(value),
            Self::Stop(_, by) => Self::Stop(value, by),
            Self::NoValue(_, flaw) => Self::NoValue(value, flaw),
            Self::Lost(_) => Self::Lost(value),
            Self::Endless(_) => Self::Endless(value),
        }
    }
}

/// How far a driver can go.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Reach {
    /// All the way round; after this many turns the pose is the one it began with.
    Full(u32),
    /// From here down, of an angle clockwise, to there.
    Between(RangeEnd, RangeEnd),
    /// What it drives does not satisfy its constraints now.
    Unsatisfied,
    /// It cannot change at all: what it drives is rigid.
    Rigid,
    /// It does not say where everything goes: so many other freedoms are left.
    Open(usize),
    /// It holds wheels whose motion depends on how they got there.
    Nonholonomic,
}

impl Reach {
    /// One word for it, for other programs.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Full(_) => "full",
            Self::Between(..) => "between",
            Self::Unsatisfied => "unsatisfied",
            Self::Rigid => "rigid",
            Self::Open(_) => "open",
            Self::Nonholonomic => "nonholonomic",
        }
    }
}

/// What is known of a driver's way.
#[derive(Debug, Clone, PartialEq)]
pub struct DriverRange {
    /// What it is now; an angle in radians, that of a motor in (-pi, pi].
    pub now: f64,
    /// How far it can go.
    pub reach: Reach,
    /// Where several motions cross, as values like those of the ends; ascending.
    pub change_points: Vec<f64>,
}

/// The farthest turn in one step, radians or other units of the driver: a dead point and the return from it do not fit in.
const LONGEST_TURN: f64 = 0.05;
/// The most that the direction of the motion may change in one step, as the sine of the angle.
const SHARPEST_BEND: f64 = 0.1;
/// The longest correction, as a part of the step.
const LONGEST_CORRECTION: f64 = 0.05;
/// Steps shorter than this part of the size get nowhere: something stops the motion.
const SHORTEST_STEP: f64 = 1e-13;
/// How far one that is no angle is followed, in its units: so many times as far as the mechanism is
/// large. It may go on for ever.
const FARTHEST: f64 = 100.0;
/// Ends nearer than this are one, in units of the driver.
const SAME_END: f64 = 1e-7;
/// Branches nearer than this, in radians of a motor, count as crossing: the squares of singular values
/// below 1e-5 are rounding. A four-bar off by 1e-8 from one that folds flat keeps them apart.
const CROSSING: f64 = 1e-4;
/// Crossings are looked for only where rows are as nearly dependent as that.
const NEARLY_SINGULAR: f64 = 1e-2;
/// The step, as a part of the size, that leads across a change point.
const LEAP: f64 = 1e-3;
/// Turns after which it is given up to wait for the first pose to come again.
const MOST_TURNS: u32 = 100;
const MOST_STEPS: usize = 15_000;
/// Poses nearer than this part of the size are the same.
const SAME: f64 = 1e-6;

/// How far a driver of a scene can go, everything else standing as it is. Distances up to
/// `tolerance`, a part of the size of what it drives, count as none.
pub fn range(scene: &ConstraintSystem, driver: &Driver, tolerance: f64) -> DriverRange {
    let now = driver.now;
    let mut range = DriverRange { now, reach: Reach::Full(1), change_points: Vec::new() };
    let mut mechanism = Mechanism::new(scene, driver);
    if !mechanism.can_move() {
        range.reach = Reach::Rigid;
        return range;
    }
    if mechanism.has_velocities() {
        range.reach = Reach::Nonholonomic;
        return range;
    }
    let Some(first) = mechanism.begin() else {
        let is_solved = mechanism.holds(10.0 * tolerance);
        range.reach = if is_solved { Reach::Rigid } else { Reach::Unsatisfied };
        return range;
    };
    let value = |turn: f64| now + turn * mechanism.unit;
    let farthest = if driver.is_angle { f64::INFINITY } else { FARTHEST };
    let mut ends = [RangeEnd::Lost(0.0); 2];
    for (end, way) in ends.iter_mut().zip([1.0, -1.0]) {
        let mut tour = Tour::new(Mechanism::new(scene, driver), first.clone(), way);
        let arrived = tour.go(farthest);
        let crossed = tour.change_points.iter().map(|turn| value(*turn));
        range.change_points.extend(crossed);
        match arrived {
            Arrival::Home(turns) => {
                range.reach = Reach::Full(turns);
                range.change_points = tour.change_points.iter().map(|turn| value(*turn)).collect();
                range.change_points.sort_by(f64::total_cmp);
                return range;
            }
            Arrival::Open(n) => {
                range.reach = Reach::Open(n);
                return range;
            }
            Arrival::End(found) => *end = found.at(value(found.value())),
        }
    }
    range.change_points.sort_by(f64::total_cmp);
    range.change_points.dedup_by(|a, b| (*a - *b).abs() < 1e-6 * mechanism.unit);
    let [upper, lower] = ends;
    let is_stuck = |end: RangeEnd| matches!(end, RangeEnd::DeadPoint(_) | RangeEnd::Lost(_));
    let width = (upper.value() - lower.value()).abs();
    range.reach = if is_stuck(lower) && is_stuck(upper) && width < SAME_END * mechanism.unit {
        Reach::Rigid
    } else {
        Reach::Between(lower, upper)
    };
    range
}

/// What stops the motor at place `motor` within the turn `way`, radians, from this pose; none
/// if nothing does, or if it cannot be told. Its angle is counted with whole turns.
pub fn dead_end(scene: &ConstraintSystem, motor: usize, way: f64) -> Option<RangeEnd> {
    let Constraint::Motor(it) = scene.constraints[motor].stated() else { return None };
    let total = it.total();
    let driver = Driver::of_values(scene.constraints[motor], motor, &[Field::Phase], total, true);
    let mut mechanism = Mechanism::new(scene, &driver);
    if !mechanism.can_move() || mechanism.has_velocities() {
        return None;
    }
    let first = mechanism.begin()?;
    let mut tour = Tour::new(mechanism, first, way.signum());
    match tour.go(way.abs()) {
        Arrival::End(end @ (RangeEnd::DeadPoint(turn) | RangeEnd::Stop(turn, _))) => {
            Some(end.at(total + turn))
        }
        _ => None,
    }
}

/// Where following a driver led.
enum Arrival {
    /// To the first pose again, after so many turns.
    Home(u32),
    /// To an end, so far from the start in units of the driver.
    End(RangeEnd),
    /// To where so many freedoms decide what comes next.
    Open(usize),
}

/// The way of a driver in one direction.
struct Tour<'a> {
    mechanism: Mechanism<'a>,
    home: Vec<Point>,
    waypoint: Waypoint,
    way: f64,
    /// The step to be tried next.
    h: f64,
    /// How far it was, and the regularity, at the poses before this one.
    trail: Vec<(f64, f64)>,
    n_turns: u32,
    change_points: Vec<f64>,
}

impl<'a> Tour<'a> {
    fn new(mechanism: Mechanism<'a>, first: Waypoint, way: f64) -> Self {
        let mut waypoint = first;
        let k = if waypoint.pace() == 0.0 { way } else { way * waypoint.pace().signum() };
        waypoint.tangent.iter_mut().for_each(|t| *t *= k);
        Self {
            h: 0.01 * mechanism.size,
            home: waypoint.stand.x.clone(),
            mechanism,
            waypoint,
            way,
            trail: Vec::new(),
            n_turns: 0,
            change_points: Vec::new(),
        }
    }

    /// Follows the motion for at most so many units of the driver.
    fn go(&mut self, most: f64) -> Arrival {
        let size = self.mechanism.size;
        for _ in 0..MOST_STEPS {
            if self.waypoint.stand.turn * self.way > most {
                return Arrival::End(RangeEnd::Endless(self.waypoint.stand.turn));
            }
            let is_leap = self.note_change_point();
            let pace = self.waypoint.pace().abs() / size;
            let h = if is_leap { LEAP * size } else { self.h.min(LONGEST_TURN / pace.max(1e-3)) };
            let Some(next) = self.try_step(h, is_leap) else {
                if is_leap {
                    let crossing = self.change_points[self.change_points.len() - 1];
                    return self.stopped(crossing, h);
                }
                self.h = 0.5 * h;
                if self.h < SHORTEST_STEP * size {
                    // A little beyond, what comes into play is seen.
                    return self.stopped(self.waypoint.stand.turn, 1e-6 * size);
                }
                continue;
            };
            if next.pace() * self.way <= 0.0 {
                return match next.n_freedoms {
                    1 => Arrival::End(RangeEnd::DeadPoint(self.fold(h))),
                    n => Arrival::Open(n - 1),
                };
            }
            if next.n_freedoms > 1 && next.pace().abs() < 1e-3 && !is_leap {
                return Arrival::Open(next.n_freedoms - 1);
            }
            if let Some(home) = self.passes_home(h, &next) {
                return home;
            }
            self.trail.push((self.waypoint.stand.turn, self.waypoint.regularity));
            if is_leap {
                self.trail.clear();
                self.h = LEAP * size;
            } else {
                self.h = (1.5 * h).min(self.distance_to_crossing(&next, h));
            }
            self.mechanism.accept(&next.stand);
            self.waypoint = next;
        }
        self.lost()
    }

    /// The waypoint a step on, if it is safe to say that it lies on the same motion.
    fn try_step(&mut self, h: f64, is_leap: bool) -> Option<Waypoint> {
        let (next, correction) = self.mechanism.step(&self.waypoint, h)?;
        if is_leap {
            return Some(next);
        }
        if next.n_freedoms < self.waypoint.n_freedoms && self.trail.is_empty() {
            // It began at a change point, and any way on is as good.
            self.change_points.push(self.waypoint.stand.turn);
            return Some(next);
        }
        let along: f64 = next.tangent.iter().zip(&self.waypoint.tangent).map(|(a, b)| a * b).sum();
        let is_straight = along * along > 1.0 - SHARPEST_BEND * SHARPEST_BEND && along > 0.0;
        // Freedoms besides the driver's turn the motion as they like.
        let is_safe = is_straight || next.n_freedoms > 1;
        // A step that rounding could take back is none.
        let longest = (LONGEST_CORRECTION * h).max(self.mechanism.noise().min(0.5 * h));
        (is_safe && correction <= longest).then_some(next)
    }

    /// Notes a change point that lies right ahead; whether there is one.
    fn note_change_point(&mut self) -> bool {
        let &[.., (turn0, g0), (turn1, g1)] = &self.trail[..] else { return false };
        let (turn2, g2) = (self.waypoint.stand.turn, self.waypoint.regularity);
        if g2 >= g1 || g1 >= g0 || g2 > NEARLY_SINGULAR || self.waypoint.n_freedoms > 1 {
            return false;
        }
        if (turn2 - turn1).abs() * g2 / (g1 - g2) > CROSSING {
            return false;
        }
        // The turn as a function of what goes to 0, at 0.
        let term = |t: f64, g: f64, a: f64, b: f64| t * a * b / ((g - a) * (g - b));
        let at = term(turn0, g0, g1, g2) + term(turn1, g1, g0, g2) + term(turn2, g2, g0, g1);
        self.change_points.push(at);
        true
    }

    /// A step that does not pass a crossing that lies ahead.
    fn distance_to_crossing(&self, next: &Waypoint, h: f64) -> f64 {
        let (here, there) = (self.waypoint.regularity, next.regularity);
        if there >= here {
            return f64::INFINITY;
        }
        (0.5 * there * h / (here - there)).max(0.4 * CROSSING * self.mechanism.size)
    }

    /// The turn at which the motion folds back within a step of `h`.
    fn fold(&mut self, h: f64) -> f64 {
        let h = root(h, self.waypoint.pace(), |h| {
            Some(self.mechanism.step(&self.waypoint, h)?.0.pace())
        });
        self.mechanism
            .step(&self.waypoint, h)
            .map_or(self.waypoint.stand.turn, |(waypoint, _)| waypoint.stand.turn)
    }

    /// Whether a whole turn ends within this step, and that is the end of the way.
    fn passes_home(&mut self, h: f64, next: &Waypoint) -> Option<Arrival> {
        if !self.mechanism.is_turned() {
            return None;
        }
        let goal = TAU * f64::from(self.n_turns + 1);
        let left = |waypoint: &Waypoint| waypoint.stand.turn.abs() - goal;
        if left(next) < 0.0 {
            return None;
        }
        self.n_turns += 1;
        if next.n_freedoms > 1 {
            // The other freedoms do not come home, but the driver did.
            return Some(Arrival::Home(1));
        }
        let (mechanism, waypoint) = (&mut self.mechanism, &self.waypoint);
        let h = root(h, left(waypoint), |h| Some(left(&mechanism.step(waypoint, h)?.0)));
        let at = mechanism.step(waypoint, h).map_or_else(|| next.clone(), |(waypoint, _)| waypoint);
        let farthest = at.stand.x.iter().zip(&self.home).map(|(a, b)| (*a - *b).norm());
        if farthest.fold(0.0, f64::max) <= SAME * mechanism.size {
            return Some(Arrival::Home(self.n_turns));
        }
        (self.n_turns == MOST_TURNS).then_some(Arrival::End(RangeEnd::Endless(next.stand.turn)))
    }

    /// What to say of an end so far from the start, where no step is short enough, by what comes into
    /// play within a step of `h`.
    fn stopped(&mut self, turn: f64, h: f64) -> Arrival {
        let active = match self.mechanism.active_beyond(&self.waypoint, h) {
            Ok(active) => active,
            Err(NoValue { flaw }) => {
                let last = self.mechanism.last_value(&self.waypoint, h);
                return Arrival::End(RangeEnd::NoValue(last, flaw));
            }
        };
        let new = active.into_iter().find(|row| !self.waypoint.active.contains(row));
        match new {
            Some((constraint, _)) => Arrival::End(RangeEnd::Stop(turn, constraint)),
            None => self.lost(),
        }
    }

    /// The motion cannot be followed any farther; where several freedoms are left, because it
    /// is not said which of them goes on.
    fn lost(&self) -> Arrival {
        match self.waypoint.n_freedoms {
            0 | 1 => Arrival::End(RangeEnd::Lost(self.waypoint.stand.turn)),
            n => Arrival::Open(n - 1),
        }
    }
}

/// Where a function of a step is 0, between 0, where it is `at_0`, and `h`, where it has the
/// other sign: false position with the weight of an end that stays halved (Illinois).
fn root(h: f64, at_0: f64, mut f: impl FnMut(f64) -> Option<f64>) -> f64 {
    let (mut a, mut fa) = (0.0, at_0);
    let Some(at_h) = f(h) else { return h };
    let (mut b, mut fb) = (h, at_h);
    for _ in 0..60 {
        if fa == fb || (b - a).abs() <= 1e-15 * h.abs() {
            break;
        }
        let c = (a * fb - b * fa) / (fb - fa);
        let Some(fc) = f(c) else { break };
        if fc == 0.0 {
            return c;
        }
        if fc * fb < 0.0 {
            (a, fa) = (b, fb);
        } else {
            fa *= 0.5;
        }
        (b, fb) = (c, fc);
    }
    b
}
