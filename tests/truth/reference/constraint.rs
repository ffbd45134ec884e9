//! Every kind of constraint by formulas of this reference's own, written from the manual.

use std::f64::consts::{PI, TAU};
use std::fmt::Write;

use super::number::Number;
use super::plane::{Place, polar};

/// Allowed values, ends included.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    pub lo: f64,
    pub hi: f64,
}

/// What a constraint asks for, with its values.
#[derive(Clone, Debug, PartialEq)]
pub enum Kind {
    Coordinate(Place),
    Coincidence,
    Equivalence,
    Equal(Range),
    /// The first length is so many times the second.
    Multiple(f64),
    Length(Range),
    Orientation(Range),
    Motor {
        radius: f64,
        phase: f64,
        speed: f64,
    },
    Glider {
        is_bounded: bool,
    },
    Hinge(f64),
    /// The ratio, and the angles of the two markers and of the line of centres when it was made.
    Cog {
        ratio: f64,
        made_at: [f64; 3],
    },
    Distance(Range),
    Parallel,
    Perpendicular,
    /// The places of its points when it was made.
    Rigid(Vec<Place>),
    /// How far along the line, how high above it, and at which angle its wheel was when it was
    /// made.
    Rack {
        along: f64,
        /// The pitch radius, positive on the left: the height above it unless it is said.
        radius: f64,
        is_said: bool,
        angle: f64,
    },
    /// A motor that stands, its angle measured from the direction of two more points.
    Elbow {
        radius: f64,
        phase: f64,
    },
    Horizontal,
    Vertical,
    Symmetric,
    /// The radii, the second's negative in a crossed belt, and the angles as for a cog.
    Belt {
        radii: [f64; 2],
        made_at: [f64; 3],
    },
}

/// A constraint of a scene; its points are places in the list of the scene's points.
#[derive(Clone, Debug, PartialEq)]
pub struct Constraint {
    pub name: String,
    pub points: Vec<usize>,
    pub kind: Kind,
    pub is_on: bool,
}

/// One equation at a pose: its value, and whether it asks for anything there. A limit that is
/// kept does not.
pub struct Equation<T> {
    pub f: T,
    pub is_active: bool,
}

/// The words of the kinds, each a different one.
pub const WORDS: [&str; 19] = [
    "coordinate",
    "coincidence",
    "equivalence",
    "equal",
    "length",
    "orientation",
    "motor",
    "glider",
    "hinge",
    "cog",
    "distance",
    "parallel",
    "perpendicular",
    "rigid",
    "rack",
    "horizontal",
    "vertical",
    "symmetric",
    "belt",
];

impl Range {
    /// One value.
    pub const fn exactly(value: f64) -> Self {
        Self { lo: value, hi: value }
    }

    /// Whether it allows one value only.
    pub fn is_exact(self) -> bool {
        self.lo == self.hi
    }

    /// The part of a statement that says so.
    fn text(self, least: f64, most: f64) -> String {
        let Self { lo, hi } = self;
        match (lo <= least, hi >= most) {
            _ if lo == hi => format!(" = {lo}"),
            (true, _) => format!(" <= {hi}"),
            (_, true) => format!(" >= {lo}"),
            _ => format!(" in {lo}..{hi}"),
        }
    }

    /// How far a value lies outside.
    fn outside<T: Number>(self, value: T) -> Equation<T> {
        let v = value.value();
        if v > self.hi || self.is_exact() {
            active(value - T::constant(self.hi))
        } else if v < self.lo {
            active(value - T::constant(self.lo))
        } else {
            idle()
        }
    }
}

fn active<T>(f: T) -> Equation<T> {
    Equation { f, is_active: true }
}

fn idle<T: Number>() -> Equation<T> {
    Equation { f: T::constant(0.0), is_active: false }
}

fn minus<T: Number>(a: Place<T>, b: Place<T>) -> Place<T> {
    [a[0] - b[0], a[1] - b[1]]
}

fn times<T: Number>(v: Place<T>, z: Place) -> Place<T> {
    let [re, im] = z.map(T::constant);
    [v[0] * re - v[1] * im, v[0] * im + v[1] * re]
}

fn dot<T: Number>(a: Place<T>, b: Place<T>) -> T {
    a[0] * b[0] + a[1] * b[1]
}

fn cross<T: Number>(a: Place<T>, b: Place<T>) -> T {
    a[0] * b[1] - a[1] * b[0]
}

fn norm<T: Number>(v: Place<T>) -> T {
    dot(v, v).sqrt()
}

fn angle<T: Number>(v: Place<T>) -> T {
    v[1].atan2(v[0])
}

fn angle_between<T: Number>(a: Place<T>, b: Place<T>) -> T {
    cross(a, b).atan2(dot(a, b))
}

fn values<T: Number>(v: Place<T>) -> Place {
    v.map(T::value)
}

/// The same angle up to whole periods, as near to 0 as can be.
pub fn wrapped(angle: f64, period: f64) -> f64 {
    angle - period * (angle / period).round()
}

/// An angle less the one it had, less than half a turn from it.
fn turned<T: Number>(angle: T, from: f64) -> T {
    let by = wrapped(angle.value() - from, TAU);
    angle + T::constant(by - angle.value())
}

/// Whether two places are one but for rounding: no direction leads from one to the other.
fn is_one_place<T: Number>(a: Place<T>, b: Place<T>) -> bool {
    let (a, b) = (values(a), values(b));
    let size = a.iter().chain(&b).fold(0.0, |size: f64, c| size.max(c.abs()));
    norm(minus(a, b)) <= 4.0 * f64::EPSILON * size
}

/// The place in units of the way from `a` to `b`, as a complex number.
fn place_in_frame(p: Place, a: Place, b: Place) -> Place {
    let (v, w) = (minus(b, a), minus(p, a));
    let l2 = dot(v, v);
    [dot(v, w) / l2, cross(v, w) / l2]
}

/// The two of some places that are farthest apart, the first such pair.
pub fn farthest_pair(places: &[Place]) -> [usize; 2] {
    let mut best = ([0, 1], -1.0);
    for j in 1..places.len() {
        for i in 0..j {
            let l = norm(minus(places[i], places[j]));
            if l > best.1 {
                best = ([i, j], l);
            }
        }
    }
    best.0
}

impl Kind {
    /// A wheel pair in mesh as it stands: centre and marker, centre and marker.
    pub fn cog(ratio: f64, x: [Place; 4]) -> Self {
        let [o, a, q, b] = x;
        Self::Cog { ratio, made_at: [angle(minus(a, o)), angle(minus(q, o)), angle(minus(b, q))] }
    }

    /// Wheels with a belt around them as they stand, as for a cog.
    pub fn belt(radii: [f64; 2], x: [Place; 4]) -> Self {
        let [o, a, q, b] = x;
        Self::Belt { radii, made_at: [angle(minus(a, o)), angle(minus(q, o)), angle(minus(b, q))] }
    }

    /// A wheel on a line as it stands: centre, marker, and two points of the line.
    pub fn rack(x: [Place; 4]) -> Self {
        let [o, a, p, q] = x;
        let v = minus(q, p);
        let arm = minus(o, p);
        Self::Rack {
            along: dot(v, arm) / norm(v),
            radius: cross(v, arm) / norm(v),
            is_said: false,
            angle: angle_between(v, minus(a, o)),
        }
    }

    /// The same of a pitch radius that is said.
    pub fn pinion(said: f64, x: [Place; 4]) -> Self {
        match Self::rack(x) {
            Self::Rack { along, radius, angle, .. } => {
                let radius = if radius < 0.0 { -said } else { said };
                Self::Rack { along, radius, is_said: true, angle }
            }
            other => other,
        }
    }

    /// Its place among the words.
    pub const fn word(&self) -> &'static str {
        WORDS[match self {
            Self::Coordinate(_) => 0,
            Self::Coincidence => 1,
            Self::Equivalence => 2,
            Self::Equal(_) | Self::Multiple(_) => 3,
            Self::Length(_) => 4,
            Self::Orientation(_) => 5,
            Self::Motor { .. } | Self::Elbow { .. } => 6,
            Self::Glider { .. } => 7,
            Self::Hinge(_) => 8,
            Self::Cog { .. } => 9,
            Self::Distance(_) => 10,
            Self::Parallel => 11,
            Self::Perpendicular => 12,
            Self::Rigid(_) => 13,
            Self::Rack { .. } => 14,
            Self::Horizontal => 15,
            Self::Vertical => 16,
            Self::Symmetric => 17,
            Self::Belt { .. } => 18,
        }]
    }

    /// Whether it keeps something of the pose at which it was stated.
    pub const fn is_captured(&self) -> bool {
        matches!(self, Self::Cog { .. } | Self::Belt { .. } | Self::Rigid(_) | Self::Rack { .. })
    }

    /// Its equations where its points are at `x` (at most four count), at a time.
    pub fn equations<T: Number>(&self, x: &[Place<T>], time: f64) -> Vec<Equation<T>> {
        let vector = |v: Place<T>| v.map(active).into();
        let constant = |v: Place| v.map(T::constant);
        match self {
            Self::Coordinate(at) => vector(minus(x[0], constant(*at))),
            Self::Coincidence => vector(minus(x[0], x[1])),
            Self::Equivalence => vector(minus(minus(x[1], x[0]), minus(x[3], x[2]))),
            Self::Equal(range) => {
                vec![range.outside(norm(minus(x[1], x[0])) - norm(minus(x[3], x[2])))]
            }
            Self::Multiple(ratio) => {
                let [first, second] = [norm(minus(x[1], x[0])), norm(minus(x[3], x[2]))];
                vec![active(first - second * T::constant(*ratio))]
            }
            Self::Length(range) => vec![range.outside(norm(minus(x[1], x[0])))],
            Self::Orientation(range) => vec![turn(x, *range, TAU)],
            Self::Horizontal => vec![active(x[1][1] - x[0][1])],
            Self::Vertical => vec![active(x[1][0] - x[0][0])],
            Self::Symmetric => {
                if is_one_place(x[2], x[3]) {
                    return vec![idle(), idle()];
                }
                // The way from A to B has no part along the axis, and their middle none across.
                let v = minus(x[3], x[2]);
                let middle = [0, 1].map(|k| (x[0][k] + x[1][k]) * T::constant(0.5));
                let across = cross(v, minus(middle, x[2])) / norm(v);
                let along = dot(v, minus(x[1], x[0])) / norm(v);
                vec![active(along), active(across * T::constant(2.0))]
            }
            Self::Parallel => vec![turn(x, Range::exactly(0.0), PI)],
            Self::Perpendicular => vec![turn(x, Range::exactly(0.5 * PI), PI)],
            Self::Motor { radius, phase, speed } => {
                let phi = phase + speed * time;
                vector(minus(minus(x[1], x[0]), constant(polar(*radius, phi))))
            }
            Self::Elbow { radius, phase } => {
                if is_one_place(x[2], x[3]) {
                    return vec![idle(), idle()];
                }
                // Along where it belongs, and across.
                let (link, crank) = (minus(x[3], x[2]), minus(x[1], x[0]));
                let belongs = times(link, polar(1.0, *phase));
                let along = dot(belongs, crank) / norm(link);
                let across = cross(belongs, crank) / norm(link);
                vec![active(along - T::constant(*radius)), active(across)]
            }
            Self::Glider { is_bounded } => glider(x, *is_bounded),
            Self::Hinge(ratio) => {
                vector(minus(minus(x[0], x[1]), times(minus(x[2], x[1]), [*ratio, 0.0])))
            }
            Self::Cog { ratio, made_at } => {
                if is_one_place(x[0], x[1]) || is_one_place(x[2], x[3]) {
                    return vec![idle()];
                }
                let spokes = [minus(x[1], x[0]), minus(x[2], x[0]), minus(x[3], x[2])];
                let mut by = [0, 1, 2].map(|k| turned(angle(spokes[k]), made_at[k]));
                if is_one_place(x[0], x[2]) {
                    by[1] = T::constant(0.0);
                }
                let ratio = T::constant(*ratio);
                vec![active((by[0] - by[1]) + ratio * (by[2] - by[1]))]
            }
            Self::Belt { radii, made_at } => {
                if is_one_place(x[0], x[1]) || is_one_place(x[2], x[3]) {
                    return vec![idle()];
                }
                // How far each wheel has turned against the line of centres, along its rim, over
                // the first radius.
                let spokes = [minus(x[1], x[0]), minus(x[2], x[0]), minus(x[3], x[2])];
                let mut by = [0, 1, 2].map(|k| turned(angle(spokes[k]), made_at[k]));
                if is_one_place(x[0], x[2]) {
                    by[1] = T::constant(0.0);
                }
                let [first, second] = [by[0] - by[1], by[2] - by[1]];
                vec![active(first - second * T::constant(radii[1] / radii[0]))]
            }
            Self::Distance(range) => {
                if is_one_place(x[1], x[2]) {
                    return vec![idle()];
                }
                let v = minus(x[2], x[1]);
                vec![range.outside(cross(v, minus(x[0], x[1])) / norm(v))]
            }
            Self::Rigid(made_at) => rigid(x, made_at),
            Self::Rack { along, radius, angle, .. } => {
                if is_one_place(x[0], x[1]) || is_one_place(x[2], x[3]) {
                    return vec![idle()];
                }
                let v = minus(x[3], x[2]);
                let s = dot(v, minus(x[0], x[2])) / norm(v) - T::constant(*along);
                let by = turned(angle_between(v, minus(x[1], x[0])), *angle);
                vec![active(s + T::constant(*radius) * by)]
            }
        }
    }

    /// The derivatives of its values by time, for the same equations.
    pub fn rates(&self, n_equations: usize, time: f64) -> Vec<f64> {
        match self {
            Self::Motor { radius, phase, speed } => {
                let [x, y] = polar(radius * speed, phase + speed * time);
                vec![y, -x]
            }
            _ => vec![0.0; n_equations],
        }
    }

    /// The statement that makes it hold these points, without a label.
    pub fn statement(&self, p: &[String]) -> String {
        let word = self.word();
        let far = f64::INFINITY;
        match self {
            Self::Coordinate([x, y]) => format!("{word} {} at ({x}, {y})", p[0]),
            Self::Coincidence | Self::Horizontal | Self::Vertical => {
                format!("{word} {} {}", p[0], p[1])
            }
            Self::Equivalence | Self::Parallel | Self::Perpendicular => {
                format!("{word} {} {}, {} {}", p[0], p[1], p[2], p[3])
            }
            Self::Equal(range) => {
                format!("{word} {} {}, {} {}{}", p[0], p[1], p[2], p[3], range.text(-far, far))
            }
            Self::Orientation(range) => {
                format!("{word} {} {}, {} {}{}", p[0], p[1], p[2], p[3], range.text(-PI, PI))
            }
            Self::Length(range) => format!("{word} {} {}{}", p[0], p[1], range.text(0.0, far)),
            Self::Motor { radius, phase, speed } => {
                format!("{word} {} {} radius {radius} speed {speed} phase {phase}", p[0], p[1])
            }
            Self::Elbow { radius, phase } => {
                let [o, h, s, e] = [&p[0], &p[1], &p[2], &p[3]];
                format!("{word} {o} {h} radius {radius} phase {phase} from {s} {e}")
            }
            Self::Glider { is_bounded } => {
                let ends = if *is_bounded { "" } else { " unbounded" };
                format!("{word} {} on {} {}{ends}", p[0], p[1], p[2])
            }
            Self::Hinge(ratio) => format!("{word} {} on {} {} at {ratio}", p[0], p[1], p[2]),
            Self::Multiple(ratio) | Self::Cog { ratio, .. } => {
                format!("{word} {} {}, {} {} ratio {ratio}", p[0], p[1], p[2], p[3])
            }
            Self::Distance(range) => {
                format!("{word} {} to {} {}{}", p[0], p[1], p[2], range.text(-far, far))
            }
            Self::Rigid(_) => {
                let mut text = word.to_owned();
                p.iter().for_each(|p| write!(text, " {p}").expect("a string takes all"));
                text
            }
            Self::Symmetric => format!("{word} {} {} about {} {}", p[0], p[1], p[2], p[3]),
            Self::Belt { radii: [first, second], .. } => {
                let (ratio, way) =
                    ((second / first).abs(), if *second < 0.0 { " crossed" } else { "" });
                format!("{word} {} {}, {} {} ratio {ratio}{way}", p[0], p[1], p[2], p[3])
            }
            Self::Rack { radius, is_said: true, .. } => {
                let radius = radius.abs();
                format!("{word} {} {} on {} {} radius {radius}", p[0], p[1], p[2], p[3])
            }
            Self::Rack { .. } => format!("{word} {} {} on {} {}", p[0], p[1], p[2], p[3]),
        }
    }
}

/// The angle from one segment to another against a range, angles a period apart being one.
fn turn<T: Number>(x: &[Place<T>], range: Range, period: f64) -> Equation<T> {
    if is_one_place(x[0], x[1]) || is_one_place(x[2], x[3]) {
        return idle();
    }
    let theta = angle_between(minus(x[1], x[0]), minus(x[3], x[2]));
    let half = 0.5 * (range.hi - range.lo);
    let off = wrapped(theta.value() - range.lo - half, period);
    let outside = if range.is_exact() { off } else { (off.abs() - half).max(0.0) * off.signum() };
    if outside == 0.0 && !range.is_exact() {
        return idle();
    }
    active(theta + T::constant(outside - theta.value()))
}

fn glider<T: Number>(x: &[Place<T>], is_bounded: bool) -> Vec<Equation<T>> {
    let v = minus(x[2], x[1]);
    let held = |at: Place<T>| minus(x[0], at).map(active).into();
    if is_one_place(x[1], x[2]) {
        return held([0, 1].map(|k| (x[1][k] + x[2][k]) * T::constant(0.5)));
    }
    let along = dot(values(v), minus(values(x[0]), values(x[1])));
    if is_bounded && along < 0.0 {
        held(x[1])
    } else if is_bounded && along > dot(values(v), values(v)) {
        held(x[2])
    } else {
        vec![active(cross(v, minus(x[0], x[1])) / norm(v))]
    }
}

/// The two points farthest apart keep their distance, each other its place in their frame.
fn rigid<T: Number>(x: &[Place<T>], made_at: &[Place]) -> Vec<Equation<T>> {
    let [i, j] = farthest_pair(made_at);
    let length = norm(minus(made_at[j], made_at[i]));
    let v = minus(x[j], x[i]);
    let mut all = vec![active(norm(v) - T::constant(length))];
    for k in (0..x.len()).filter(|k| *k != i && *k != j) {
        let at = place_in_frame(made_at[k], made_at[i], made_at[j]);
        all.extend(minus(minus(x[k], x[i]), times(v, at)).map(active));
    }
    all
}
