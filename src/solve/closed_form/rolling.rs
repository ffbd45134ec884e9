//! Where the marker of a wheel is in frames side by side, each of which counts turns on from the one before.
//!
//! All but the counts is the same in each frame, and done for all at once; the wheel's own count, which a frame
//! needs of the one before, is taken not to change, and where it does the frames behind are found again.

#![allow(
    clippy::needless_range_loop,
    reason = "one loop over all frames, that vectors are made of"
)]

use super::abreast::Places;
use super::found::plain_length;
use super::wheel::{MOST, Told, Wheel};
use crate::constraint::{
    Cog, Constraint, Counts, Mesh, Rack, Vector, Winding, directions, sines_and_cosines,
};

/// What turns a wheel.
trait Turner<const N: usize> {
    /// Which of the counts is that of the wheel.
    fn own(&self) -> usize;
    /// What whole turns contribute to the equation before a frame, where those of the wheel are that many.
    fn wound(&self, l: usize, n_turns: i64) -> f64;
    /// Where the marker belongs in a frame, radians.
    fn angle(&self, l: usize, wound: f64) -> f64;
    /// The angles that markers have which are there, radians, in (-pi, pi].
    fn directions(&self, arms: &[[f64; N]; 2]) -> [f64; N];
    /// How far a marker is off in a frame whose angle, counted on, is that; length units.
    fn off(&self, l: usize, wound: f64, angle: f64) -> f64;
    /// The counts after a frame, where that of the wheel is `own`.
    fn counts(&self, l: usize, own: Winding) -> Counts;
}

/// Another wheel, in mesh or by a belt.
struct ByWheel<'a, const N: usize> {
    mesh: &'a Mesh,
    is_second: bool,
    radius: f64,
    /// What whole turns contribute before the first frame, and before another with the same turns.
    wound: [f64; 2],
    /// These turns.
    turns: [i64; 3],
    /// The other wheel's direction and that of the line of centres: counted on in each frame, and after it.
    angles: [[f64; N]; 2],
    after: [[Winding; N]; 2],
}

/// A line.
struct ByRack<'a, const N: usize> {
    rack: &'a Rack,
    /// The line.
    line: [[f64; N]; 2],
    /// Its direction, and how far along it the centre stands.
    angle: [f64; N],
    s: [f64; N],
}

impl Wheel {
    /// Puts the marker where it belongs in each frame.
    #[inline(always)]
    pub(super) fn run_each<const N: usize>(
        &self,
        places: &[Places<N>; 4],
        ways: &[[f64; N]; 4],
        constraints: &[Constraint],
        counts: &mut [Counts; N],
    ) -> Told<N> {
        match &constraints[self.by as usize] {
            Constraint::Cog(cog) => self.mark_each(cog, places, ways, counts),
            Constraint::Rack(rack) => self.roll_each(rack, places, ways, counts),
            _ => (places[0], [0.0; N], [f64::NAN; N]),
        }
    }

    #[inline(always)]
    fn mark_each<const N: usize>(
        &self,
        cog: &Cog,
        places: &[Places<N>; 4],
        ways: &[[f64; N]; 4],
        counts: &mut [Counts; N],
    ) -> Told<N> {
        let mesh = cog.mesh();
        let (i, other) = if self.is_second { (0, [0, 1]) } else { (2, [2, 3]) };
        let centre = if self.is_second { 2 } else { 0 };
        let start = counts[N - 1];
        let turns = [0, 1, 2].map(|k| start.lifted[k].turns);
        let mut by = ByWheel {
            mesh,
            is_second: self.is_second,
            radius: self.radius,
            wound: [start.wound, mesh.wound_by(turns)],
            turns,
            angles: [[0.0; N], [start.lifted[1].angle; N]],
            after: [[start.lifted[i]; N], [start.lifted[1]; N]],
        };
        let mut is_told = [true; N];
        let mut turned = [[0.0; N]; 2];
        let of_centres = (1, start.lifted[1], [0, 2]);
        let followed = [(0, start.lifted[i], other), of_centres];
        for (k, mut winding, [from, to]) in followed {
            if k == 1 && !mesh.follows_centres() {
                continue;
            }
            let arms = between(&places[from], &places[to]);
            let towards = directions(&arms[0], &arms[1]);
            for l in 0..N {
                by.angles[k][l] = winding.near(towards[l]);
                winding.follow(towards[l]);
                by.after[k][l] = winding;
            }
            turned[k] = turned_each(places, ways, [from, to]);
            and_apart(&mut is_told, &places[from], &places[to]);
        }
        let mut way = [0.0; N];
        for l in 0..N {
            let own_turn = mesh.most_turned(self.is_second, turned[0][l], turned[1][l]);
            is_told[l] &= (turned[0][l] >= 0.0) & (turned[0][l] < MOST);
            is_told[l] &= (turned[1][l] >= 0.0) & (turned[1][l] < MOST);
            is_told[l] &= (own_turn >= 0.0) & (own_turn < MOST);
            way[l] = ways[centre][l] + self.radius * own_turn;
        }
        let (at, off) = self.put_each(&by, &places[centre], is_told, counts);
        (at, way, off)
    }

    #[inline(always)]
    fn roll_each<const N: usize>(
        &self,
        rack: &Rack,
        places: &[Places<N>; 4],
        ways: &[[f64; N]; 4],
        counts: &mut [Counts; N],
    ) -> Told<N> {
        let line = between(&places[2], &places[3]);
        let centre = between(&places[2], &places[0]);
        let turn = turned_each(places, ways, [2, 3]);
        let mut is_told = [true; N];
        and_apart(&mut is_told, &places[2], &places[3]);
        let (mut s, mut way) = ([0.0; N], [0.0; N]);
        for l in 0..N {
            let along = Vector::new(line[0][l], line[1][l]);
            let towards = Vector::new(centre[0][l], centre[1][l]);
            s[l] = along.dot(towards) / plain_length(along);
            // How far it rolls: what the centre and the line go past each other.
            let past = ways[0][l] + ways[2][l];
            let rolled = past + (plain_length(towards) + past) * turn[l];
            let own_turn = turn[l] + rolled / rack.radius().abs();
            is_told[l] &= (turn[l] >= 0.0) & (turn[l] < MOST);
            is_told[l] &= (own_turn >= 0.0) & (own_turn < MOST);
            way[l] = ways[0][l] + self.radius * own_turn;
        }
        let by = ByRack { rack, line, angle: directions(&line[0], &line[1]), s };
        let (at, off) = self.put_each(&by, &places[0], is_told, counts);
        (at, way, off)
    }

    /// Where the marker is in each frame, and how far that is off; not a number where it is not told.
    #[inline(always)]
    fn put_each<const N: usize>(
        &self,
        by: &impl Turner<N>,
        centre: &Places<N>,
        is_told: [bool; N],
        counts: &mut [Counts; N],
    ) -> (Places<N>, [f64; N]) {
        let mut own = counts[N - 1].lifted[by.own()];
        let (mut all, mut off) = (*centre, [f64::NAN; N]);
        let mut first = 0;
        while first < N {
            let n_turns = own.turns;
            let (mut wound, mut angles) = ([0.0; N], [0.0; N]);
            for l in 0..N {
                wound[l] = by.wound(l, n_turns);
            }
            for l in 0..N {
                angles[l] = by.angle(l, wound[l]);
            }
            let [sines, cosines] = sines_and_cosines(&angles);
            let mut at = *centre;
            for l in 0..N {
                at.x[l] += self.radius * cosines[l];
                at.y[l] += self.radius * sines[l];
            }
            let towards = by.directions(&between(centre, &at));
            let mut is_sound = is_told;
            and_apart(&mut is_sound, centre, &at);
            while first < N && own.turns == n_turns {
                let l = first;
                all.set(l, at.at(l));
                if is_sound[l] {
                    off[l] = by.off(l, wound[l], own.near(towards[l]));
                }
                own.follow(towards[l]);
                counts[l] = by.counts(l, own);
                first += 1;
            }
        }
        (all, off)
    }
}

impl<const N: usize> ByWheel<'_, N> {
    /// What whole turns contribute to the equation, after those of the other wheel and of the line of centres in a
    /// frame, where those of the wheel are that many.
    #[inline(always)]
    fn wound_after(&self, l: usize, n_turns: i64) -> f64 {
        let [other, centres] = [self.after[0][l].turns, self.after[1][l].turns];
        let [one, two] = if self.is_second { [other, n_turns] } else { [n_turns, other] };
        let [first, line, second] = self.turns;
        let is_still = (one == first) & (centres == line) & (two == second);
        if is_still { self.wound[1] } else { self.mesh.wound_by([one, centres, two]) }
    }
}

impl<const N: usize> Turner<N> for ByWheel<'_, N> {
    #[inline(always)]
    fn own(&self) -> usize {
        if self.is_second { 2 } else { 0 }
    }

    #[inline(always)]
    fn wound(&self, l: usize, n_turns: i64) -> f64 {
        if l == 0 { self.wound[0] } else { self.wound_after(l - 1, n_turns) }
    }

    #[inline(always)]
    fn angle(&self, l: usize, wound: f64) -> f64 {
        self.mesh.angle_where(wound, self.is_second, self.angles[0][l], self.angles[1][l])
    }

    #[inline(always)]
    fn directions(&self, [x, y]: &[[f64; N]; 2]) -> [f64; N] {
        directions(x, y)
    }

    #[inline(always)]
    fn off(&self, l: usize, wound: f64, angle: f64) -> f64 {
        let [other, alpha] = [self.angles[0][l], self.angles[1][l]];
        let angles = if self.is_second { [other, alpha, angle] } else { [angle, alpha, other] };
        self.mesh.value_where(wound, angles) * self.radius
    }

    #[inline(always)]
    fn counts(&self, l: usize, own: Winding) -> Counts {
        let [other, centres] = [self.after[0][l], self.after[1][l]];
        let lifted = if self.is_second { [other, centres, own] } else { [own, centres, other] };
        Counts { lifted, wound: self.wound_after(l, own.turns) }
    }
}

impl<const N: usize> Turner<N> for ByRack<'_, N> {
    #[inline(always)]
    fn own(&self) -> usize {
        0
    }

    #[inline(always)]
    fn wound(&self, _l: usize, n_turns: i64) -> f64 {
        self.rack.wound_by(n_turns)
    }

    #[inline(always)]
    fn angle(&self, l: usize, wound: f64) -> f64 {
        self.angle[l] + self.rack.theta(wound, self.s[l])
    }

    #[inline(always)]
    fn directions(&self, [x, y]: &[[f64; N]; 2]) -> [f64; N] {
        let (mut dots, mut crosses) = ([0.0; N], [0.0; N]);
        for l in 0..N {
            let (line, arm) =
                (Vector::new(self.line[0][l], self.line[1][l]), Vector::new(x[l], y[l]));
            (dots[l], crosses[l]) = (line.dot(arm), line.cross(arm));
        }
        directions(&dots, &crosses)
    }

    #[inline(always)]
    fn off(&self, l: usize, wound: f64, angle: f64) -> f64 {
        self.rack.value_where(wound, self.s[l], angle)
    }

    #[inline(always)]
    fn counts(&self, _l: usize, own: Winding) -> Counts {
        Counts::of_one(own)
    }
}

/// The ways from some places to others.
#[inline(always)]
fn between<const N: usize>(from: &Places<N>, to: &Places<N>) -> [[f64; N]; 2] {
    let mut ways = [[0.0; N]; 2];
    for l in 0..N {
        (ways[0][l], ways[1][l]) = (to.x[l] - from.x[l], to.y[l] - from.y[l]);
    }
    ways
}

/// Whether two places are far enough apart to have a direction; no where their distance cannot be held.
#[inline(always)]
fn and_apart<const N: usize>(all: &mut [bool; N], a: &Places<N>, b: &Places<N>) {
    for l in 0..N {
        let larger = |one: f64, two: f64| if one > two { one } else { two };
        let largest =
            larger(larger(a.x[l].abs(), a.y[l].abs()), larger(b.x[l].abs(), b.y[l].abs()));
        let far = plain_length(Vector::new(b.x[l] - a.x[l], b.y[l] - a.y[l]));
        all[l] &= far > 4.0 * f64::EPSILON * largest;
    }
}

/// By how much the vector from one place to another turned at most in each frame.
#[inline(always)]
fn turned_each<const N: usize>(
    places: &[Places<N>; 4],
    ways: &[[f64; N]; 4],
    [from, to]: [usize; 2],
) -> [f64; N] {
    let (a, b) = (&places[from], &places[to]);
    let mut all = [0.0; N];
    for l in 0..N {
        let way = ways[from][l] + ways[to][l];
        let turned = way / (plain_length(Vector::new(b.x[l] - a.x[l], b.y[l] - a.y[l])) - way);
        all[l] = if way == 0.0 { 0.0 } else { turned };
    }
    all
}
