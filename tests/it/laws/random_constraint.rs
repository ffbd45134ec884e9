//! Random constraints of every kind, among points that do not satisfy them.

use linkwork::constraint::{
    Aligned, AxisDirection, Bounds, Cog, CogVelocity, Coincidence, Constraint, ConstraintKind,
    Curve, Distance, Equal, Equivalence, Field, Flag, Given, Glider, Hinge, Hold, Kind, Length,
    Motor, Orientation, Period, Point, PointIdx, Rack, Rigid, Row, Symmetric, Vector,
};
use linkwork::lang::catalogue::{ConstraintWord, Slot};
use proptest::prelude::*;

use super::random_measure::measured;
use super::random_touch::touch;

/// Points of a scene.
pub const N_POINTS: usize = 6;

/// Turns, stretches and shifts the plane.
#[derive(Debug, Clone, Copy)]
pub struct Similarity {
    pub angle: f64,
    pub scale: f64,
    pub shift: Vector,
}

impl Similarity {
    pub const NONE: Self = Self { angle: 0.0, scale: 1.0, shift: Vector::ZERO };

    fn vector(self, v: Vector) -> Vector {
        v.rotate(self.angle) * self.scale
    }

    fn point(self, p: Point) -> Point {
        (self.vector(p.to_vector()) + self.shift).to_point()
    }

    pub fn points(self, x: &[Point]) -> Vec<Point> {
        x.iter().map(|&p| self.point(p)).collect()
    }
}

/// One constraint among points that do not satisfy it.
#[derive(Debug, Clone)]
pub struct Scene {
    pub kind: Kind,
    /// Positions, and those at which wheels and bodies were made.
    pub x: Vec<Point>,
    pub before: Vec<Point>,
    pub w: Vec<f64>,
    pub points: Vec<PointIdx>,
    /// Numbers in -1..1 and a choice among variants of the kind.
    pub numbers: [f64; 3],
    pub variant: u8,
    /// Whether its values are measured on points, those of the constraint among them.
    pub is_measured: bool,
}

impl Scene {
    /// The constraint, as it would have been stated in the plane so moved.
    pub fn constraint(&self, by: Similarity) -> Constraint {
        if self.kind == Kind::Touch {
            return touch(self, by);
        }
        let plain = self.plain(by);
        if self.is_measured { measured(self, plain, by) } else { plain }
    }

    /// The same with values of its own.
    #[allow(clippy::match_wildcard_for_single_variants, reason = "a new kind comes there too")]
    fn plain(&self, by: Similarity) -> Constraint {
        let p = &self.points;
        let [n0, n1, n2] = self.numbers;
        let before = by.points(&self.before);
        let (three, four) = ([p[0], p[1], p[2]], [p[0], p[1], p[2], p[3]]);
        let length = |n: f64| (4.0 * n.abs() + 0.1) * by.scale;
        let bounds = |lo: f64, hi: f64| match self.variant {
            0 | 1 => Bounds::exactly(lo),
            2 => Bounds { lo: lo.min(hi), hi: lo.max(hi) },
            3 => Bounds { lo: f64::NEG_INFINITY, hi },
            _ => Bounds { lo, hi: f64::INFINITY },
        };
        match self.kind {
            Kind::Coincidence => Coincidence { points: [p[0], p[1]] }.into(),
            Kind::Equivalence => Equivalence { points: four }.into(),
            Kind::Equal => {
                let bounds = bounds(4.0 * n0 * by.scale, 4.0 * n1 * by.scale);
                let ratio = if n2 > 0.0 { 1.0 } else { 0.3 - 2.0 * n2 };
                Equal { points: four, bounds, ratio }.into()
            }
            Kind::Length => {
                Length { points: [p[0], p[1]], bounds: bounds(length(n0), length(n1)) }.into()
            }
            Kind::Orientation => {
                let period = if n2 > 0.0 { Period::Whole } else { Period::Half };
                let bounds = bounds(3.0 * n0, 3.0 * n1);
                Orientation { points: four, bounds, period, side: 0.0 }.into()
            }
            Kind::Motor => {
                let at = |phase: f64| Motor::new([p[0], p[1]], length(n0), phase, n2);
                let mut motor = Constraint::from(if self.is_between_links() {
                    at(3.0 * n1).between([p[2], p[3]])
                } else {
                    at(3.0 * n1 + by.angle)
                });
                motor.advance(1.0);
                motor
            }
            Kind::Glider => Glider { points: three, bounded: self.variant > 0 }.into(),
            Kind::Hinge => Hinge { points: three, ratio: 1.5 * n0 + 0.5 }.into(),
            Kind::Cog => match self.variant {
                3 => self.by_teeth(&before),
                4 => Cog::belt(four, self.ratio().abs(), n1 > 0.0, &before).into(),
                _ => Cog::new(four, self.ratio(), &before).into(),
            },
            Kind::CogVelocity => CogVelocity::new(four, self.ratio(), &before).into(),
            Kind::Distance => {
                let bounds = bounds(2.0 * n0 * by.scale, 2.0 * n1 * by.scale);
                Distance { points: three, bounds }.into()
            }
            Kind::Rigid => {
                let n_points = 2 + usize::from(self.variant);
                Rigid::new(&p[..n_points.min(p.len())], &before).into()
            }
            Kind::Rack if self.variant < 3 => Rack::new(four, &before).into(),
            Kind::Rack => Rack::with_radius(four, length(n0), &before).into(),
            Kind::Symmetric => Symmetric { points: four }.into(),
            // Turned in any other way it would be no statement of the language.
            Kind::Aligned => {
                assert_eq!(by.angle, 0.0, "an axis stays one");
                let all = [AxisDirection::Horizontal, AxisDirection::Vertical];
                Aligned { points: [p[0], p[1]], direction: all[usize::from(n0 > 0.0)] }.into()
            }
            Kind::Curve => match self.variant {
                0 => Curve::Circle { points: [p[0]], radius: length(n0) }.into(),
                1 => Curve::Through { points: [p[0], p[1]] }.into(),
                _ => Curve::Arc { points: three }.into(),
            },
            Kind::Hold if n2 > 0.5 => {
                Hold::Vector { value: Vector::ZERO, target: Vector::ZERO }.into()
            }
            Kind::Hold => {
                Hold::Number { value: 0.0, bounds: bounds(length(n0), length(n1)) }.into()
            }
            kind => self.declared(kind, by),
        }
    }

    /// Wheels geared by teeth, about in the ratio.
    fn by_teeth(&self, before: &[Point]) -> Constraint {
        const FIRST: f64 = 20.0;
        let second = (FIRST * self.ratio().abs()).round().max(1.0);
        let values = [(Field::FirstTeeth, FIRST), (Field::SecondTeeth, second)];
        let groups = [self.points[..2].to_vec(), self.points[2..4].to_vec()];
        let flags: &[Flag] = if self.numbers[1] > 0.0 { &[Flag::Inside] } else { &[] };
        let (word, bounds) = ("cog", None);
        let is_restored = false;
        let given = Given {
            word,
            groups: &groups,
            bounds,
            values: &values,
            flags,
            curves: &[],
            x: before,
            is_restored,
        };
        // A wheel of one point only cannot be stated.
        let points = [0, 1, 2, 3].map(|k| self.points[k]);
        let other = |_| Cog::new(points, self.ratio(), before).into();
        Kind::Cog.declare(&given).unwrap_or_else(other)
    }

    /// A constraint of a kind with nothing special about it: as its statement would make it.
    fn declared(&self, kind: Kind, by: Similarity) -> Constraint {
        let is_of_kind =
            |word: &&ConstraintWord| Kind::stated_by(word.pattern().entry.keyword) == Some(kind);
        let word = ConstraintWord::ALL.iter().find(is_of_kind).expect("a word states it");
        let mut points = self.points.iter().copied();
        let groups = word.pattern().slots.iter().filter_map(|slot| match slot {
            Slot::Points(n) => Some(points.by_ref().take(*n).collect()),
            Slot::AllPoints => Some(points.by_ref().collect()),
            Slot::Line(_) => Some(points.by_ref().take(2).collect()),
            _ => None,
        });
        let groups: Vec<Vec<PointIdx>> = groups.collect();
        let [n0, n1, n2] = self.numbers;
        let place = by.point(Point::new(4.0 * n0, 4.0 * n1));
        let values = [
            (Field::X, place.x),
            (Field::Y, place.y),
            (Field::Radius, (4.0 * n0.abs() + 0.1) * by.scale),
            (Field::Phase, 3.0 * n1 + by.angle),
            (Field::Speed, n2),
            (Field::Ratio, self.ratio()),
        ];
        let before = by.points(&self.before);
        let word = word.pattern().entry.keyword;
        let given = Given {
            word,
            groups: &groups,
            bounds: None,
            values: &values,
            flags: &[],
            curves: &[],
            x: &before,
            is_restored: false,
        };
        kind.declare(&given).expect("points that are apart")
    }

    pub fn ratio(&self) -> f64 {
        match self.variant {
            0 => -1.0,
            1 => -0.25,
            _ => 3.0 * self.numbers[0],
        }
    }

    /// Whether it is a motor that measures its angle from a direction among the points.
    pub fn is_between_links(&self) -> bool {
        self.kind == Kind::Motor && self.variant > 2
    }

    /// Whether one correction is exact wherever it starts.
    pub fn is_exact(&self) -> bool {
        let is_closed = !matches!(
            self.kind,
            Kind::Cog
                | Kind::Rack
                | Kind::Distance
                | Kind::Symmetric
                | Kind::Hold
                | Kind::Curve
                | Kind::Touch
        );
        is_closed && !self.is_between_links() && !self.is_measured && !self.has_repeats()
    }

    pub fn has_repeats(&self) -> bool {
        (1..self.points.len()).any(|i| self.points[..i].contains(&self.points[i]))
    }

    /// The length against which an error is small, in the unit of the residual.
    pub fn size(&self, c: &Constraint) -> f64 {
        let coordinates = self.x.iter().chain(&self.before).map(|p| p.x.abs().max(p.y.abs()));
        let size = coordinates.fold(10.0, f64::max);
        match c.stated() {
            Constraint::Orientation(_) => 1.0,
            Constraint::Cog(_) => 1.0 + self.ratio().abs(),
            // Far from its contact a marker is a long lever.
            Constraint::CogVelocity(_) => {
                size * (1.0 + rows(c, &self.x).iter().map(largest).fold(0.0, f64::max))
            }
            _ => size,
        }
    }
}

pub fn largest(row: &Row) -> f64 {
    row.terms().map(|(_, g)| g.norm()).fold(0.0, f64::max)
}

/// Scenes of every kind: points within 10, weights 1e-2..1e2 with `frozen` of them 0, each
/// constraint among `n_places` of the points.
pub fn scenes(frozen: f64, n_places: usize) -> impl Strategy<Value = Scene> {
    let places = proptest::collection::vec((-10.0..10.0, -10.0..10.0), N_POINTS);
    let shifts = proptest::collection::vec((-1.0..1.0, -1.0..1.0), N_POINTS);
    let weights = proptest::collection::vec((0.0..1.0, -2.0..2.0), N_POINTS);
    let points = if n_places < N_POINTS {
        proptest::collection::vec(0..n_places as PointIdx, N_POINTS).boxed()
    } else {
        Just((0..N_POINTS as PointIdx).collect::<Vec<_>>()).prop_shuffle().boxed()
    };
    let kinds = proptest::sample::select(Kind::ALL);
    let numbers = proptest::array::uniform3(-1.0..1.0);
    let variants = (0..5u8, any::<bool>());
    (kinds, places, shifts, weights, points, numbers, variants).prop_map(
        move |(kind, places, shifts, weights, points, numbers, (variant, is_measured))| {
            let x: Vec<Point> = places.iter().map(|&(x, y)| Point::new(x, y)).collect();
            let before = x.iter().zip(shifts).map(|(&p, (x, y))| p + Vector::new(x, y)).collect();
            let weight = |(u, e): (f64, f64)| if u < frozen { 0.0 } else { 10f64.powf(e) };
            let w = weights.into_iter().map(weight).collect();
            // Points that are one have no distance and no direction that could be measured.
            let are_apart = |[i, j]: [usize; 2]| {
                let [a, b] = [points[i], points[j]].map(|p| p as usize);
                x[a].distance(x[b]) > 0.5
            };
            let n = N_POINTS;
            let is_measured = is_measured && are_apart([n - 1, n - 2]) && are_apart([n - 3, n - 4]);
            Scene { kind, x, before, w, points, numbers, variant, is_measured }
        },
    )
}

/// The rows of a constraint.
pub fn rows(c: &Constraint, x: &[Point]) -> Vec<Row<'static>> {
    let mut all = Vec::new();
    c.jacobian(x, &mut |row| all.push(Row { further: row.further.to_vec().leak(), ..row }));
    all
}
