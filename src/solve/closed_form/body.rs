//! Where the points of a body are, two of which are known, or one that it swings about.

use super::abreast::{Abreast, Places, Poses, put_each};
use super::cluster::{self, Cluster};
use super::found::larger;
use super::length::{Length, Timed, Values, bar};
use crate::constraint::{Constraint, Hinge, Point, PointIdx, Vector};

/// A body whose ends are this part of its size apart, or less, is not known by them.
const SHORT: f64 = 1e-3;

/// Two points that are to keep their distance.
pub(super) struct Bar {
    points: [PointIdx; 2],
    length: Length,
    /// The square of the length, and half of one over the length.
    square: f64,
    half_inverse: f64,
}

impl Bar {
    /// A bar of that length.
    pub fn new(points: [PointIdx; 2], length: Length) -> Self {
        let now = length.now;
        Self { points, length, square: now * now, half_inverse: 0.5 / now }
    }

    /// Takes in how long it is in this frame.
    pub fn drive(&mut self, values: &Values) {
        self.length.drive(values);
        *self = Self::new(self.points, self.length);
    }

    /// The length.
    pub fn length_mut(&mut self) -> &mut Length {
        &mut self.length
    }

    /// Checks it in each frame.
    #[inline(always)]
    pub fn check<const N: usize>(&self, x: &(impl Poses<N> + ?Sized), abreast: &mut Abreast<N>) {
        let [a, b] = self.points.map(|p| x.get(p));
        let off = |l: usize, square: f64, half_inverse: f64| {
            ((b.at(l) - a.at(l)).norm_squared() - square) * half_inverse
        };
        if N > 1 && self.length.is_timed() {
            let Timed { now, .. } = self.length.each(&abreast.lengths);
            abreast.check_each(|l| off(l, now[l] * now[l], 0.5 / now[l]));
        } else {
            abreast.check_each(|l| off(l, self.square, self.half_inverse));
        }
    }
}

/// What says where a body is.
enum Held {
    /// Two points.
    At([PointIdx; 2]),
    /// One, about which it swings no farther than it has to.
    About(PointIdx),
}

/// A point that a body carries along.
struct Carried {
    to: PointIdx,
    /// Where it is, seen from the point that is known first: as a multiple of the way from there to
    /// the second, or on a body that was never turned.
    arm: Vector,
    /// How many times the way of each of the two it goes at most.
    parts: [f64; 2],
    /// Its mass.
    mass: f64,
}

/// Points that keep their shape, some of which are found from the others.
pub(super) struct Body {
    held: Held,
    carried: Vec<Carried>,
    /// Each of its bars.
    bars: Vec<Bar>,
    /// Each point of a `rigid` constraint or a hinge, two others, and where it is as a multiple of the way from one
    /// to the other.
    plates: Vec<([PointIdx; 3], Vector)>,
    /// On which side of two others each of its points is.
    sides: Vec<([PointIdx; 3], f64)>,
    /// One over the most that a point is farther away than the two that are known, squared.
    least_side_squared: f64,
    /// How far apart two of its points are at least.
    pub extent: f64,
}

impl Body {
    /// A body some of whose points are known; `mass` is that of the others. None where they do not
    /// say where it is.
    pub fn new(
        cluster: &Cluster,
        constraints: &[Constraint],
        is_known: impl Fn(PointIdx) -> bool,
        mass: impl Fn(PointIdx) -> f64,
    ) -> Option<Self> {
        let all = || cluster.points.iter().copied();
        let mut known = all().filter(|&(p, _)| is_known(p));
        let (first, from) = known.next()?;
        let away = |at: Vector| (at - from).norm_squared();
        let second = known.max_by(|one, two| away(one.1).total_cmp(&away(two.1)));
        let way = second.map_or(Vector::new(1.0, 0.0), |(_, at)| at - from);
        let carried = all().filter(|&(p, _)| !is_known(p)).map(|(to, at)| {
            let arm = (at - from).over(way);
            let parts = [(Vector::new(1.0, 0.0) - arm).norm(), arm.norm()];
            Carried { to, arm, parts, mass: mass(to) }
        });
        let carried: Vec<Carried> = carried.collect();
        let farthest = carried.iter().map(|carried| carried.parts[1]).fold(0.0, larger);
        let is_sound = farthest.is_finite() && (second.is_none() || farthest < 1.0 / SHORT);
        let least_side = if second.is_some() { 1.0 / farthest.max(1.0) } else { 1.0 };
        let (mut bars, mut plates) = (Vec::new(), Vec::new());
        for &c in &cluster.constraints {
            match &constraints[c as usize] {
                Constraint::Hinge(Hinge { points, ratio }) => {
                    plates.push((*points, Vector::new(*ratio, 0.0)));
                }
                Constraint::Rigid(rigid) => {
                    let (ends, length) = rigid.frame()?;
                    bars.push(Bar::new(ends, Length::fixed(length)));
                    plates.extend(rigid.others().map(|(p, zeta)| ([p, ends[0], ends[1]], zeta)));
                }
                constraint => {
                    let (ends, length) = bar(constraint)?;
                    bars.push(Bar::new(ends, Length::fixed(length)));
                }
            }
        }
        let extent = all().map(|(_, at)| away(at)).fold(0.0, f64::max).sqrt();
        is_sound.then(|| Self {
            held: second.map_or(Held::About(first), |(second, _)| Held::At([first, second])),
            carried,
            bars,
            plates,
            sides: cluster.sides.clone(),
            least_side_squared: least_side * least_side,
            extent,
        })
    }

    /// Whether it has the same shape at a pose that counts, and is not mirrored in part.
    pub fn fits(&self, x: &[Point]) -> bool {
        self.sides.iter().all(|&(points, side)| cluster::side(points, x) == side)
    }

    /// The points that it finds.
    pub fn finds(&self) -> impl Iterator<Item = PointIdx> + '_ {
        self.carried.iter().map(|carried| carried.to)
    }

    /// Puts its points where they belong, and checks all that holds it together.
    pub fn run<const N: usize>(&self, x: &mut (impl Poses<N> + ?Sized), abreast: &mut Abreast<N>) {
        let (from, along, ways) = match self.held {
            Held::At([first, second]) => {
                let [from, to] = [first, second].map(|p| x.get(p));
                let ways = [first, second].map(|p| abreast.ways[p as usize]);
                (from, std::array::from_fn(|l| to.at(l) - from.at(l)), ways)
            }
            Held::About(pivot) => {
                let from = x.get(pivot);
                // How far they went is not said: nothing follows from where they are.
                (from, self.swing(x, &from), [[0.0; N]; 2])
            }
        };
        for Carried { to, arm, parts, .. } in &self.carried {
            put_each(*to, x, abreast, |l| {
                let at = from.at(l) + along[l].times(*arm);
                (at, parts[0] * ways[0][l] + parts[1] * ways[1][l], 0.0)
            });
        }
        self.bars.iter().for_each(|bar| bar.check(x, abreast));
        for (points, zeta) in &self.plates {
            let [p, a, b] = points.map(|p| x.get(p));
            abreast.check_each(|l| {
                let off = (p.at(l) - a.at(l)) - (b.at(l) - a.at(l)).times(*zeta);
                larger(off.x.abs(), off.y)
            });
        }
        abreast.note_side(self.least_side_squared);
    }

    /// How it is turned in each frame, so that its points go no farther than they have to from where
    /// they were: the sum of the squares of their ways, times their masses, is least.
    fn swing<const N: usize>(&self, x: &(impl Poses<N> + ?Sized), from: &Places<N>) -> [Vector; N] {
        let mut turned = [Vector::ZERO; N];
        for l in 0..N {
            let mut turn = Vector::ZERO;
            for Carried { to, arm, mass, .. } in &self.carried {
                // Each frame goes on from the one before.
                let last = match l.checked_sub(1) {
                    Some(last) => from.at(last) + turned[last].times(*arm),
                    None => x.get(*to).at(N - 1),
                };
                turn += (last - from.at(l)).times_conj(*arm) * *mass;
            }
            turned[l] = turn / turn.norm();
        }
        turned
    }
}
