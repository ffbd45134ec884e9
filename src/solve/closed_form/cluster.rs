//! Points that bars and `rigid` constraints tie together to bodies.
//!
//! A body grows from a triangle of bars, from a `rigid` constraint, or from a bar with a hinge on it: a
//! point on two of its points by bars is part of it, and so are the points of a `rigid` constraint or a
//! hinge two of which are. What the shape is follows from the lengths, but for the side on which each
//! point is of the two that it hangs on.

use super::length::bar;
use crate::constraint::{Constraint, ConstraintKind as _, Hinge, Point, PointIdx, Vector};
use crate::interrupt::tick;
use crate::solve::frame::decomposition::Part;

/// Two bars that meet in a flatter angle than this, as its sine, do not hold a point: what is off in
/// their lengths is so many times as much in its place.
const FLAT: f64 = 1e-2;

/// A point with more bars and plates than this is of no body: each body on it looks at them all.
const MOST_AT_A_POINT: usize = 200;

/// What growing past a bar or a plate takes, in ticks.
const GROWN: usize = 20;

/// A point, and the two that say on which side of them it is: 1 or -1.
type Side = ([PointIdx; 3], f64);

/// Points that keep their shape.
#[derive(Default)]
pub(super) struct Cluster {
    /// The points, ascending, with where each is in a frame of their own.
    pub points: Vec<(PointIdx, Vector)>,
    /// On which side each point is that has two.
    pub sides: Vec<Side>,
    /// The constraints that hold points of it and no others.
    pub constraints: Vec<u32>,
}

impl Cluster {
    /// Where a point of it is in its frame.
    pub fn place(&self, p: PointIdx) -> Option<Vector> {
        let k = self.points.binary_search_by_key(&p, |(q, _)| *q).ok()?;
        Some(self.points[k].1)
    }
}

/// On which side of the way from `a` to `b` a point is.
pub(super) fn side([p, a, b]: [PointIdx; 3], x: &[Point]) -> f64 {
    let [p, a, b] = [p, a, b].map(|k| x[k as usize]);
    if (b - a).cross(p - a) < 0.0 { -1.0 } else { 1.0 }
}

/// A bar from a point.
struct Bar {
    to: PointIdx,
    length: f64,
    constraint: u32,
}

/// The bars, hinges and `rigid` constraints of an island, by the points that they hold.
pub(super) struct Net<'a> {
    constraints: &'a [Constraint],
    x: &'a [Point],
    /// By the points that they lead to, for each point.
    bars: Vec<Vec<Bar>>,
    plates: Vec<Vec<u32>>,
    /// Whether a constraint lies within a cluster.
    pub is_inside: Vec<bool>,
    /// Whether more points would be of a cluster if bars had other lengths: two hold them, but hardly.
    pub is_by_lengths: bool,
    /// Whether some point has too many bars.
    is_crowded: bool,
    /// Where the points of the cluster are that grows; none for the others.
    place: Vec<Option<Vector>>,
    /// The bars from points of it that lead to each other point.
    hits: Vec<Vec<(PointIdx, f64)>>,
}

impl<'a> Net<'a> {
    /// Those of these constraints that are in some parts.
    pub fn new(constraints: &'a [Constraint], x: &'a [Point], parts: &[Part]) -> Self {
        let n = x.len();
        let lists = || (0..n).map(|_| Vec::new()).collect();
        let mut net = Self {
            constraints,
            x,
            bars: (0..n).map(|_| Vec::new()).collect(),
            plates: lists(),
            is_inside: vec![false; constraints.len()],
            is_by_lengths: false,
            is_crowded: false,
            place: vec![None; n],
            hits: (0..n).map(|_| Vec::new()).collect(),
        };
        for &c in parts.iter().flat_map(|part| &part.constraints) {
            let constraint = &constraints[c as usize];
            if let Some(([a, b], length)) = bar(constraint) {
                net.bars[a as usize].push(Bar { to: b, length, constraint: c });
                net.bars[b as usize].push(Bar { to: a, length, constraint: c });
            } else if plate(constraint).is_some() {
                constraint.points().iter().for_each(|&p| net.plates[p as usize].push(c));
            }
        }
        net.bars.iter_mut().for_each(|bars| bars.sort_by_key(|bar| (bar.to, bar.constraint)));
        let n_at = net.bars.iter().zip(&net.plates).map(|(bars, plates)| bars.len() + plates.len());
        net.is_crowded = n_at.max().is_some_and(|most| most > MOST_AT_A_POINT);
        net
    }

    /// The clusters of a part.
    pub fn clusters(&mut self, part: &Part) -> Vec<Cluster> {
        let mut all = Vec::new();
        if self.is_crowded {
            return all;
        }
        for &c in part.constraints.iter().filter(|&&c| is_rigid(&self.constraints[c as usize])) {
            if let Some(plate) = plate(&self.constraints[c as usize]).filter(|_| !self.is_taken(c))
            {
                all.push(self.grow(plate.places));
            }
        }
        for &c in &part.constraints {
            if let Some(([a, b], length)) = bar(&self.constraints[c as usize])
                && !self.is_taken(c)
                && (self.is_of_a_triangle(a, b) || self.is_hinged(a, b))
            {
                let cluster = self.grow(vec![(a, Vector::ZERO), (b, Vector::new(length, 0.0))]);
                if cluster.points.len() > 2 {
                    all.push(cluster);
                } else {
                    cluster.constraints.iter().for_each(|&c| self.is_inside[c as usize] = false);
                }
            }
        }
        all
    }

    /// Whether a hinge ties a third point to both.
    fn is_hinged(&self, a: PointIdx, b: PointIdx) -> bool {
        let ties = |&&c: &&u32| self.constraints[c as usize].points().contains(&b);
        self.plates[a as usize].iter().filter(ties).any(|&c| !self.is_taken(c))
    }

    fn is_taken(&self, c: u32) -> bool {
        self.is_inside[c as usize]
    }

    /// Whether a third point has bars to both.
    fn is_of_a_triangle(&self, a: PointIdx, b: PointIdx) -> bool {
        let [a, b] = [a, b].map(|p| &self.bars[p as usize]);
        let (few, many) = if a.len() < b.len() { (a, b) } else { (b, a) };
        let free = |bar: &&Bar| !self.is_taken(bar.constraint);
        few.iter().filter(free).any(|bar| {
            let first = many.partition_point(|other| other.to < bar.to);
            many[first..].iter().take_while(|other| other.to == bar.to).any(|other| free(&other))
        })
    }

    /// All that hangs firmly on some points whose places are known.
    fn grow(&mut self, seed: Vec<(PointIdx, Vector)>) -> Cluster {
        let mut cluster = Cluster::default();
        let mut met = Vec::new();
        for (p, at) in seed {
            self.add(p, at, &mut cluster);
        }
        let mut next = 0;
        while let Some(&(p, _)) = cluster.points.get(next) {
            next += 1;
            tick(GROWN * (self.bars[p as usize].len() + self.plates[p as usize].len()));
            for k in 0..self.bars[p as usize].len() {
                let Bar { to, length, constraint } = self.bars[p as usize][k];
                if self.place[to as usize].is_some() || self.is_taken(constraint) {
                    continue;
                }
                let two = self.hits[to as usize].iter().find_map(|&(other, other_length)| {
                    self.meet(to, [other, p], [other_length, length])
                });
                if let Some((at, side)) = two {
                    cluster.sides.push(side);
                    self.add(to, at, &mut cluster);
                } else {
                    met.push(to);
                    self.hits[to as usize].push((p, length));
                }
            }
            for k in 0..self.plates[p as usize].len() {
                self.add_plate(self.plates[p as usize][k], &mut cluster);
            }
        }
        self.close(&mut cluster);
        for p in met {
            let hits = &mut self.hits[p as usize];
            let is_held = hits.iter().any(|(other, _)| *other != hits[0].0);
            self.is_by_lengths |= is_held && self.place[p as usize].is_none();
            hits.clear();
        }
        cluster.points.iter().for_each(|&(p, _)| self.place[p as usize] = None);
        cluster.points.sort_by_key(|(p, _)| *p);
        cluster
    }

    fn add(&mut self, p: PointIdx, at: Vector, cluster: &mut Cluster) {
        self.place[p as usize] = Some(at);
        cluster.points.push((p, at));
    }

    /// Where bars from two points of the cluster put a third; none where they hardly hold it.
    fn meet(&self, p: PointIdx, others: [PointIdx; 2], [l, m]: [f64; 2]) -> Option<(Vector, Side)> {
        let [Some(a), Some(b)] = others.map(|q| self.place[q as usize]) else { return None };
        let e = b - a;
        let apart_squared = e.norm_squared();
        let squared = ((l + m) * (l + m) - apart_squared) * (apart_squared - (l - m) * (l - m));
        // False for what is not a number, and for two bars to one point.
        let is_firm = squared > (2.0 * FLAT * l * m) * (2.0 * FLAT * l * m);
        if !is_firm {
            return None;
        }
        let points = [p, others[0], others[1]];
        let side = side(points, self.x);
        let half = 0.5 / apart_squared;
        let along = 0.5 + (l * l - m * m) * half;
        let at = a + e * along + e.perp() * (side * squared.sqrt() * half);
        Some((at, (points, side)))
    }

    /// Adds the points of a `rigid` constraint or a hinge, once two of them are in the cluster.
    fn add_plate(&mut self, c: u32, cluster: &mut Cluster) {
        let Some(plate) = plate(&self.constraints[c as usize]).filter(|_| !self.is_taken(c)) else {
            return;
        };
        let known = || {
            let placed = |&(p, own): &(PointIdx, Vector)| Some((self.place[p as usize]?, own));
            plate.places.iter().filter_map(placed)
        };
        let Some((a, own_a)) = known().next() else { return };
        let far = |own: Vector| (own - own_a).norm_squared();
        let Some((b, own_b)) = known().max_by(|one, two| far(one.1).total_cmp(&far(two.1))) else {
            return;
        };
        let farthest = plate.places.iter().map(|(_, own)| far(*own)).fold(0.0, f64::max);
        // One point, or two that are as good as one, do not say how it lies.
        if far(own_b) <= FLAT * FLAT * farthest {
            return;
        }
        let turn = (b - a).over(own_b - own_a);
        // Bars may put both in one place.
        self.is_by_lengths |= a == b;
        let turn = if plate.has_size { turn / turn.norm() } else { turn };
        for &(p, own) in &plate.places {
            if self.place[p as usize].is_none() {
                self.add(p, a + (own - own_a).times(turn), cluster);
            }
        }
    }

    /// Takes in what holds points of the cluster alone.
    fn close(&mut self, cluster: &mut Cluster) {
        let Self { constraints, bars, plates, is_inside, place, .. } = self;
        for &(p, _) in &cluster.points {
            let bars = bars[p as usize].iter().map(|bar| bar.constraint);
            for c in bars.chain(plates[p as usize].iter().copied()) {
                let is_within = || {
                    let mut points = constraints[c as usize].points().iter();
                    points.all(|&q| place[q as usize].is_some())
                };
                if !is_inside[c as usize] && is_within() {
                    is_inside[c as usize] = true;
                    cluster.constraints.push(c);
                }
            }
        }
    }
}

/// Points whose places two of them tell.
struct Plate {
    /// Where they are in a frame of their own.
    places: Vec<(PointIdx, Vector)>,
    /// Whether that says how far they are apart, too.
    has_size: bool,
}

/// What a `rigid` constraint that is more than a bar, or a hinge, says of its points.
fn plate(constraint: &Constraint) -> Option<Plate> {
    match constraint {
        Constraint::Rigid(rigid) if rigid.points().len() > 2 => {
            let plate = Plate { places: rigid.places().collect(), has_size: true };
            // Points in one place have no frame.
            plate.places.iter().any(|(_, at)| *at != Vector::ZERO).then_some(plate)
        }
        Constraint::Hinge(Hinge { points: [p, a, b], ratio }) => {
            let own = |along| Vector::new(along, 0.0);
            let places = vec![(*p, own(*ratio)), (*a, own(0.0)), (*b, own(1.0))];
            (p != a && p != b && a != b).then_some(Plate { places, has_size: false })
        }
        _ => None,
    }
}

/// Whether it is one from which a body grows by itself.
fn is_rigid(constraint: &Constraint) -> bool {
    matches!(constraint, Constraint::Rigid(_))
}
