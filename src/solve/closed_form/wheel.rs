//! Where the marker of a wheel is that another turns, or a line that it rolls along.

use super::abreast::{Abreast, Places, Poses};
use crate::constraint::{Cog, Constraint, Counts, Point, PointIdx, Rack, Vector};

/// A frame may turn a wheel, the wheel that turns it, and the line of their centres by less than half a
/// turn; this is somewhat less, radians.
pub(super) const MOST: f64 = 3.0;

/// Where a marker is in each frame, how far it went at most, and how far that is off; not a number where it is not
/// told.
pub(super) type Told<const N: usize> = (Places<N>, [f64; N], [f64; N]);

/// A point at a given distance from the centre of its wheel, at the angle that a wheel in mesh, a belt, or a
/// rack leaves it.
pub(super) struct Wheel {
    /// The point that is found.
    to: PointIdx,
    /// The centre and the marker of the one wheel, those of the other or the ends of the line.
    points: [PointIdx; 4],
    /// Whether it is the marker of the other.
    pub(super) is_second: bool,
    /// The distance from its centre.
    pub(super) radius: f64,
    /// The constraint that turns it.
    pub(super) by: u32,
    /// Its number among the wheels of its island.
    pub(super) k: u32,
}

impl Wheel {
    /// A point at the distance `radius` from another, which the constraint of number `c` turns; none
    /// where it does not. It is the wheel of number `k`.
    pub fn new(
        to: PointIdx,
        from: PointIdx,
        radius: f64,
        (c, by): (u32, &Constraint),
        k: u32,
    ) -> Option<Self> {
        let (points, is_second) = match by {
            Constraint::Cog(cog) => (cog.points, cog.points[3] == to),
            Constraint::Rack(rack) => (rack.points, false),
            _ => return None,
        };
        let own = if is_second { [points[2], points[3]] } else { [points[0], points[1]] };
        let is_once = points.iter().filter(|&&p| p == to).count() == 1;
        let is_sound = is_once && own == [from, to] && radius > 0.0;
        is_sound.then_some(Self { to, points, is_second, radius, by: c, k })
    }

    /// Puts the marker where it belongs, if that is told without counting turns anew.
    #[inline(always)]
    pub fn run<const N: usize>(
        &self,
        x: &mut (impl Poses<N> + ?Sized),
        constraints: &[Constraint],
        abreast: &mut Abreast<N>,
    ) {
        let places = self.points.map(|p| x.get(p));
        let ways = self.points.map(|p| abreast.ways[p as usize]);
        let (at, way, off) = if N == 1 {
            self.run_one(&places, &ways, constraints)
        } else {
            self.run_each(&places, &ways, constraints, &mut abreast.counts[self.k as usize])
        };
        x.put(self.to, at);
        abreast.ways[self.to as usize] = way;
        abreast.check_each(|l| off[l]);
    }

    /// The same in one frame by itself, the constraints being as they were before it.
    fn run_one<const N: usize>(
        &self,
        places: &[Places<N>; 4],
        ways: &[[f64; N]; 4],
        constraints: &[Constraint],
    ) -> Told<N> {
        let places = places.each_ref().map(|places| places.at(0));
        let ways = ways.each_ref().map(|ways| ways[0]);
        let found = match &constraints[self.by as usize] {
            Constraint::Cog(cog) => self.marker(cog, places, ways),
            Constraint::Rack(rack) => self.rim_point(rack, places, ways),
            _ => None,
        };
        let (at, way, off) = found.unwrap_or((places[0], 0.0, f64::NAN));
        (Places::all(at), [way; N], [off; N])
    }

    /// Where the marker is, how far it went at most, and how far that is off.
    fn marker(
        &self,
        cog: &Cog,
        mut places: [Point; 4],
        ways: [f64; 4],
    ) -> Option<(Point, f64, f64)> {
        let own = if self.is_second { 3 } else { 1 };
        let turned = |from: usize, to: usize| turned(places, ways, [from, to]);
        let angle = cog.marker_angle(self.is_second, places)?;
        let line = if cog.mesh().follows_centres() { turned(0, 2) } else { 0.0 };
        let other = if self.is_second { turned(0, 1) } else { turned(2, 3) };
        let own_turn = cog.mesh().most_turned(self.is_second, other, line);
        // False for what is not a number.
        let is_told = [line, other, own_turn].iter().all(|turn| (0.0..MOST).contains(turn));
        let at = places[own - 1] + Vector::polar(self.radius, angle);
        places[own] = at;
        let off = cog.value_at(places)? * self.radius;
        is_told.then_some((at, ways[own - 1] + self.radius * own_turn, off))
    }

    /// The same of a wheel on a rack.
    fn rim_point(
        &self,
        rack: &Rack,
        mut places: [Point; 4],
        ways: [f64; 4],
    ) -> Option<(Point, f64, f64)> {
        let angle = rack.rim_angle(places)?;
        let line = turned(places, ways, [2, 3]);
        // How far it rolls: what the centre and the line go past each other.
        let rolled = ways[0] + ways[2] + (places[0].distance(places[2]) + ways[0] + ways[2]) * line;
        let own_turn = line + rolled / rack.radius().abs();
        places[1] = places[0] + Vector::polar(self.radius, angle);
        let off = rack.value_at(places)?;
        let is_told = [line, own_turn].iter().all(|turn| (0.0..MOST).contains(turn));
        is_told.then_some((places[1], ways[0] + self.radius * own_turn, off))
    }
}

/// How far the wheels of a constraint have turned.
pub(super) fn counts(of: &Constraint) -> Counts {
    match of {
        Constraint::Cog(cog) => cog.counts(),
        Constraint::Rack(rack) => rack.counts(),
        _ => Counts::default(),
    }
}

/// The wheels of a constraint have turned so far.
pub(super) fn set_counts(of: &mut Constraint, counts: Counts) {
    match of {
        Constraint::Cog(cog) => cog.set_counts(counts),
        Constraint::Rack(rack) => rack.set_counts(counts),
        _ => {}
    }
}

/// By how much the vector from one place to another turned at most: by no more than its ends went over
/// what is left of its length.
fn turned(places: [Point; 4], ways: [f64; 4], [from, to]: [usize; 2]) -> f64 {
    let way = ways[from] + ways[to];
    if way == 0.0 { 0.0 } else { way / (places[from].distance(places[to]) - way) }
}
