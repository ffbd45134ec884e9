//! Points that bars and `rigid` constraints tie together to bodies.
//!
//! A body grows from a triangle of bars, or from a `rigid` constraint: a point on two of its points
//! by bars is part of it, and so is a `rigid` constraint two of whose points are. What the shape is
//! follows from the lengths, but for the side on which each point is of the two that it hangs on.

use crate::constraint::{Constraint, ConstraintKind as _, Point, PointIdx, Rigid, Vector};
use crate::solve::frame::decomposition::Part;

/// Two bars that meet in a flatter angle than this, as its sine, do not hold a point: what is off in
/// their lengths is so many times as much in its place.
const FLAT: f64 = 1e-2;

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

/// The bars and `rigid` constraints of an island, by the points that they hold.
pub(super) struct Net<'a> {
    constraints: &'a [Constraint],
    x: &'a [Point],
    /// By the points that they lead to, for each point.
    bars: Vec<Vec<Bar>>,
    plates: Vec<Vec<u32>>,
    /// Whether a constraint lies within a cluster.
    pub is_inside: Vec<bool>,
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
        net
    }

    /// The clusters of a part.
    pub fn clusters(&mut self, part: &Part) -> Vec<Cluster> {
        let mut all = Vec::new();
        for &c in &part.constraints {
            if let Some(plate) = plate(&self.constraints[c as usize]).filter(|_| !self.is_taken(c))
            {
                let seed: Vec<_> = plate.places().collect();
                all.push(self.grow(seed));
            }
        }
        for &c in &part.constraints {
            if let Some(([a, b], length)) = bar(&self.constraints[c as usize])
                && !self.is_taken(c)
                && self.is_of_a_triangle(a, b)
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
        met.iter().for_each(|&p| self.hits[p as usize].clear());
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

    /// Adds the points of a `rigid` constraint, once two of them are in the cluster.
    fn add_plate(&mut self, c: u32, cluster: &mut Cluster) {
        let Some(plate) = plate(&self.constraints[c as usize]).filter(|_| !self.is_taken(c)) else {
            return;
        };
        let known = || {
            let placed = |(p, own): (PointIdx, Vector)| Some((self.place[p as usize]?, own));
            plate.places().filter_map(placed)
        };
        let Some((a, own_a)) = known().next() else { return };
        let far = |(_, own): &(Vector, Vector)| (*own - own_a).norm_squared();
        let Some((b, own_b)) = known().max_by(|one, two| far(one).total_cmp(&far(two))) else {
            return;
        };
        let others: Vec<_> =
            plate.places().filter(|(p, _)| self.place[*p as usize].is_none()).collect();
        // None for two points in one place.
        let Some(turn) = (b - a).over(own_b - own_a).unit().filter(|turn| turn.is_finite()) else {
            return;
        };
        let longest =
            others.iter().map(|(_, own)| (*own - own_a).norm_squared()).fold(0.0, f64::max);
        if far(&(b, own_b)) < FLAT * FLAT * longest {
            return;
        }
        for (p, own) in others {
            self.add(p, a + (own - own_a).times(turn), cluster);
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

/// The ends and the length of a bar.
pub(super) fn bar(constraint: &Constraint) -> Option<([PointIdx; 2], f64)> {
    match constraint {
        Constraint::Length(bar) => {
            let [a, b] = bar.points;
            let is_bar = bar.bounds.is_equality() && bar.bounds.lo > 0.0 && a != b;
            is_bar.then_some((bar.points, bar.bounds.lo))
        }
        _ => None,
    }
}

/// A `rigid` constraint that is more than a bar.
fn plate(constraint: &Constraint) -> Option<&Rigid> {
    match constraint {
        Constraint::Rigid(rigid) if rigid.points().len() > 2 => {
            // Points in one place have no frame.
            rigid.places().any(|(_, at)| at != Vector::ZERO).then_some(rigid)
        }
        _ => None,
    }
}
