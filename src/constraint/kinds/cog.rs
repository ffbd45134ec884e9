//! The cog wheel constraint, section 3.10, as an equation between angles.
//!
//! The paper states it between velocities, which have to be integrated and drift. The same
//! condition integrates in closed form: with the centre line at alpha and the wheels at
//! theta1 and theta2, `theta1 - alpha` and `r (alpha - theta2)` grow alike.
//!
//! A belt is beyond the paper, and the same equation: see [`Contact`].

use super::orientation::turning;
use crate::constraint::parts::gearing::Gearing;
use crate::constraint::parts::geometry::has_direction;
use crate::constraint::parts::mesh::{Counts, Mesh};
use crate::constraint::{
    Activity, Carried, ConstraintKind, Culprit, Declared, Field, Flag, Flaw, Given, Point,
    PointIdx, Quantity, Real, Refusal, Row, Stateful, Traits, Vec2, Vector,
};

/// Two wheels in mesh, or with a belt around them: `theta1 - (1 + r) alpha + r theta2 = K`, in
/// radians.
///
/// theta1 and theta2 are the angles of the markers seen from their centres, alpha that of
/// the second centre seen from the first, r the second radius over the first, negative for
/// wheels that turn the same way: one inside the other, or in an open belt. K is what it was at creation. Angles are counted on beyond
/// half a turn from the last accepted pose, so a frame may turn each by less than that.
///
/// While a marker lies on its centre the constraint asks for nothing; while the centres lie
/// on each other alpha stays as it was.
#[derive(Debug, Clone, PartialEq)]
pub struct Cog {
    /// Centre and marker of the one wheel, centre and marker of the other.
    pub points: [PointIdx; 4],
    gearing: Gearing,
    contact: Contact,
    mesh: Mesh,
}

/// How one wheel turns the other.
///
/// A belt does so at any distance. Where its runs leave the wheels turns with the line of centres,
/// so on the first wheel `r1 (dtheta1 - dalpha)` of it passes into the one run and out of the other,
/// and on the second `r2 (dtheta2 - dalpha)` out of the one and into the other. An open belt that
/// keeps the lengths of its runs, or changes both alike, has these equal; a crossed one has them
/// opposite. That is the mesh of a wheel inside the other, and that of one beside the other.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Contact {
    /// Tooth in tooth.
    Mesh,
    /// A belt whose runs do not meet.
    OpenBelt,
    /// A belt whose runs cross between the wheels.
    CrossedBelt,
}

/// The vectors whose angles the constraint compares: x1 to x2, x1 to x3, x3 to x4.
struct Spokes([Vector; 3]);

impl Spokes {
    /// Where each points, radians; none for a line of centres that has no part.
    fn directions(&self) -> [Option<f64>; 3] {
        self.0.map(|v| (v != Vector::ZERO).then(|| v.angle()))
    }
}

impl Contact {
    /// The ratio r of the equation.
    fn ratio(self, gearing: &Gearing) -> f64 {
        match self {
            Self::Mesh | Self::CrossedBelt => gearing.ratio(),
            Self::OpenBelt => -gearing.ratio(),
        }
    }
}

impl Cog {
    /// Wheels in mesh as they stand.
    pub fn new(points: [PointIdx; 4], ratio: f64, x: &[Point]) -> Self {
        Self::geared(points, Gearing::of(ratio), Contact::Mesh, x)
    }

    /// Wheels with a belt around them, as they stand; the ratio is above 0.
    pub fn belt(points: [PointIdx; 4], ratio: f64, is_crossed: bool, x: &[Point]) -> Self {
        let contact = if is_crossed { Contact::CrossedBelt } else { Contact::OpenBelt };
        Self::geared(points, Gearing::of(ratio), contact, x)
    }

    fn geared(points: [PointIdx; 4], gearing: Gearing, contact: Contact, x: &[Point]) -> Self {
        let [x1, x2, x3, x4] = points.map(|p| x[p as usize]);
        let angles = [x2 - x1, x3 - x1, x4 - x3].map(Vector::angle);
        Self { points, gearing, contact, mesh: Mesh::new(contact.ratio(&gearing), angles) }
    }

    /// How the wheels are held together.
    pub const fn contact(&self) -> Contact {
        self.contact
    }

    fn places(&self, x: &[Point]) -> [Point; 4] {
        self.points.map(|p| x[p as usize])
    }

    /// The equation between the wheels.
    pub(crate) const fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// How far the wheels have turned.
    pub(crate) const fn counts(&self) -> Counts {
        self.mesh.counts()
    }

    /// They have turned so far.
    pub(crate) const fn set_counts(&mut self, counts: Counts) {
        self.mesh.set_counts(counts);
    }

    /// The angle at which the marker of the first or the second wheel belongs while everything else is
    /// at these places; none while the marker of the other has none.
    pub fn marker_angle(&self, is_second: bool, [x1, x2, x3, x4]: [Point; 4]) -> Option<f64> {
        let (i, from, to) = if is_second { (0, x1, x2) } else { (2, x3, x4) };
        if !has_direction(from, to) {
            return None;
        }
        let other = self.mesh.angle(i, Some((to - from).angle()));
        let centres = self.alpha_counts(x1, x3).then(|| (x3 - x1).angle());
        Some(self.mesh.angle_from(is_second, other, self.mesh.angle(1, centres)))
    }

    /// What is left of the equation at these places, radians; none while a marker has no angle.
    pub fn value_at(&self, places: [Point; 4]) -> Option<f64> {
        self.spokes_at(places).map(|spokes| self.value(&spokes))
    }

    /// None while a marker has no angle.
    fn spokes(&self, x: &[Point]) -> Option<Spokes> {
        let [a, b, c, d] = self.points;
        if a == d && b == c {
            // Each marker is the other's centre: one segment, on which nothing can turn.
            return None;
        }
        self.spokes_at(self.places(x))
    }

    fn spokes_at(&self, [x1, x2, x3, x4]: [Point; 4]) -> Option<Spokes> {
        let centres = if self.alpha_counts(x1, x3) { x3 - x1 } else { Vector::ZERO };
        (has_direction(x1, x2) && has_direction(x3, x4)).then_some(Spokes([
            x2 - x1,
            centres,
            x4 - x3,
        ]))
    }

    /// Whether the line of centres has a part in the equation.
    fn alpha_counts(&self, x1: Point, x3: Point) -> bool {
        self.mesh.follows_centres() && has_direction(x1, x3)
    }

    fn value(&self, spokes: &Spokes) -> f64 {
        let directions = spokes.directions();
        self.mesh.value(std::array::from_fn(|i| self.mesh.angle(i, directions[i])))
    }

    fn row(&self, spokes: &Spokes) -> Row<'static> {
        let [a, b, c, d] = self.points;
        let [v12, v13, v34] = spokes.0;
        let r = self.mesh.ratio();
        let (p1, p2) = (turning(v12), turning(v34) * r);
        let p_alpha = if v13 == Vector::ZERO { v13 } else { turning(v13) * (1.0 + r) };
        Row::new(self.value(spokes))
            .with(a, p_alpha - p1)
            .with(b, p1)
            .with(c, -p_alpha - p2)
            .with(d, p2)
    }
}

impl Declared for Cog {
    const WORDS: &'static [&'static str] = &["cog", "belt"];

    fn declare(given: &Given) -> Result<Self, Refusal> {
        let points = given.pairs()?;
        let contact = match (given.word, given.has(Flag::Crossed)) {
            ("belt", false) => Contact::OpenBelt,
            ("belt", true) => Contact::CrossedBelt,
            _ => Contact::Mesh,
        };
        if contact != Contact::Mesh && points[0] == points[2] {
            return Err(Refusal {
                message: "a belt goes around two centres",
                at: Culprit::Point(1, 0),
                label: "the same centre again",
                help: Some("to fix wheels on one shaft together, write `rigid`"),
            });
        }
        Ok(Self::geared(points, Gearing::given(given), contact, given.x))
    }
}

impl ConstraintKind for Cog {
    fn points(&self) -> &[PointIdx] {
        &self.points
    }

    fn points_mut(&mut self) -> &mut [PointIdx] {
        &mut self.points
    }

    fn n_rows(&self) -> usize {
        1
    }

    fn residual(&self, x: &[Point]) -> f64 {
        self.spokes(x).map_or(0.0, |spokes| self.value(&spokes))
    }

    /// Exact to first order, as the centres' line turns with the centres: a few repeats
    /// reach rounding.
    fn correct(&self, x: &[Point], w: &[f64], move_by: &mut impl FnMut(PointIdx, Vector)) {
        if let Some(spokes) = self.spokes(x) {
            self.row(&spokes).correct(w, move_by);
        }
    }

    fn jacobian(&self, x: &[Point], row: &mut impl FnMut(Row)) {
        row(self.spokes(x).map_or_else(|| Row::inactive(&self.points), |s| self.row(&s)));
    }

    fn equations<T: Real>(
        &self,
        x: &impl Fn(PointIdx) -> Vec2<T>,
        _field: &impl Fn(Field, f64) -> T,
        equation: &mut impl FnMut(T),
    ) {
        let [x1, x2, x3, x4] = self.points.map(x);
        let value = |p: Vec2<T>| p.value().to_point();
        if !(has_direction(value(x1), value(x2)) && has_direction(value(x3), value(x4))) {
            return equation(T::constant(0.0));
        }
        let counted = |i: usize, v: Vec2<T>| {
            let direction = v.angle();
            let angle = self.mesh.angle(i, Some(direction.value()));
            direction + T::constant(angle - direction.value())
        };
        let (theta1, theta2) = (counted(0, x2 - x1), counted(2, x4 - x3));
        let alpha = if self.alpha_counts(value(x1), value(x3)) {
            counted(1, x3 - x1)
        } else {
            T::constant(self.mesh.angle(1, None))
        };
        let sum = (theta1 - alpha) + T::constant(self.mesh.ratio()) * (theta2 - alpha);
        equation(sum + T::constant(self.mesh.rest()));
    }

    fn get(&self, field: Field) -> Option<f64> {
        self.gearing.get(field)
    }

    fn set(&mut self, field: Field, value: f64) -> bool {
        let is_known = self.gearing.set(field, value);
        let ratio = self.contact.ratio(&self.gearing);
        if ratio != self.mesh.ratio() {
            self.mesh.change_gear(ratio);
        }
        is_known
    }

    fn nominal_length(&self) -> f64 {
        0.0
    }

    fn traits(&self) -> Traits {
        Traits {
            word: if self.contact == Contact::Mesh { "cog" } else { "belt" },
            quantity: Quantity::Angle,
            bounds: None,
            activity: Activity::Always,
            n_firm_rows: 1,
            is_linear: false,
            is_wheel: true,
            carried: Carried::ByPose,
            flags: match self.contact {
                Contact::Mesh => self.gearing.flags(),
                Contact::OpenBelt => &[],
                Contact::CrossedBelt => &[Flag::Crossed],
            },
            flaw: match self.contact {
                Contact::OpenBelt | Contact::CrossedBelt if self.gearing.ratio() < 0.0 => {
                    Some(Flaw::NegativeBeltRatio)
                }
                _ => self.gearing.flaw(),
            },
        }
    }

    fn content(&self, word: &mut impl FnMut(u64)) {
        // All that matters of the gearing and the contact is the ratio of the equation.
        let Self { points: _, gearing: _, contact: _, mesh } = self;
        mesh.content(word);
    }
}

impl Stateful for Cog {
    fn state(&self) -> Option<Vec<f64>> {
        Some(self.mesh.state())
    }

    fn set_state(&mut self, state: &[f64]) {
        self.mesh.set_state(state);
    }

    fn captured(&self) -> Vec<f64> {
        vec![self.mesh.captured()]
    }

    fn set_captured(&mut self, captured: &[f64]) {
        if let &[k] = captured {
            self.mesh.set_captured(k);
        }
    }

    /// Wheels of which one has no direction mesh as before.
    fn pick_up(&mut self, x: &[Point]) {
        if self.spokes(x).is_some() {
            *self = Self::geared(self.points, self.gearing, self.contact, x);
        }
    }

    fn advance(&mut self, _dt: f64) -> bool {
        false
    }

    fn accept(&mut self, x: &[Point]) {
        if let Some(spokes) = self.spokes(x) {
            self.mesh.follow(spokes.directions());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{PI, TAU};

    /// Wheels on frozen centres after the first has made `i` of `n` parts of a turn.
    fn pair(i: i64, n: i64, (first, second): (i64, i64)) -> [Point; 4] {
        let spoke = |k: i64| {
            Vector::polar(1.0, (k.rem_euclid(n * second) as f64) * TAU / (n * second) as f64)
        };
        let (o1, o2) = (Point::new(1.0, 2.0), Point::new(5.0, 3.0));
        [o1, o1 + spoke(i * second), o2, o2 + spoke(-i * first)]
    }

    #[test]
    fn external_wheels_turn_opposite_ways_and_return() {
        // Teeth 12 and 36: the second turns a third as far, the other way.
        let mut cog = Cog::new([0, 1, 2, 3], 3.0, &pair(0, 36, (1, 3)));
        let there = 0..36 * 20_000;
        for i in there.clone().chain(there.rev()) {
            let x = pair(i, 36, (1, 3));
            assert!(cog.residual(&x).abs() < 1e-13, "frame {i}: {}", cog.residual(&x));
            cog.accept(&x);
        }
    }

    #[test]
    fn a_ratio_without_teeth_keeps_its_digits() {
        let ratio = std::f64::consts::SQRT_2;
        let x = |i: i32| {
            let theta = f64::from(i) * 0.1;
            let [o1, o2] = [Point::ORIGIN, Point::new(3.0, 0.0)];
            [o1, o1 + Vector::polar(1.0, theta * ratio), o2, o2 + Vector::polar(1.0, -theta)]
        };
        let mut cog = Cog::new([0, 1, 2, 3], ratio, &x(0));
        for i in 0..100_000 {
            assert!(cog.residual(&x(i)).abs() < 1e-11);
            cog.accept(&x(i));
        }
    }

    #[test]
    fn a_planet_in_a_frozen_ring_turns_three_times_back() {
        // Ratio -1/4: theta2 = -3 alpha, a rosette of four leaves.
        let x = |i: i64| {
            let [alpha, theta] = [i, -3 * i].map(|k| (k.rem_euclid(360) as f64).to_radians());
            let centre = Point::ORIGIN + Vector::polar(0.75, alpha);
            [Point::ORIGIN, Point::new(1.0, 0.0), centre, centre + Vector::polar(0.25, theta)]
        };
        let mut cog = Cog::new([0, 1, 2, 3], -0.25, &x(0));
        for i in (0..360_000).chain((0..360_000).rev()) {
            assert!(cog.residual(&x(i)).abs() < 1e-13, "frame {i}");
            cog.accept(&x(i));
        }
    }

    #[test]
    fn concentric_wheels_of_ratio_minus_one_turn_together() {
        let x = |phi: f64| {
            [
                Point::ORIGIN,
                Vector::polar(1.0, phi).to_point(),
                Point::ORIGIN,
                Vector::polar(2.0, phi + 1.0).to_point(),
            ]
        };
        let cog = Cog::new([0, 1, 2, 3], -1.0, &x(0.0));
        assert!(cog.residual(&x(0.7)).abs() < 1e-15);
        cog.jacobian(&x(0.7), &mut |row| {
            assert!(row.is_active && row.norm_squared(&[1.0; 4]) > 0.0);
        });
    }

    /// The angle of the second wheel of a belt from how its material lies along both runs, which
    /// are taken up alike where the distance `d` changes.
    fn by_belt([r1, r2]: [f64; 2], is_crossed: bool, d: f64, phi: f64, theta1: f64) -> f64 {
        let (reach, turn) = if is_crossed { (r1 + r2, PI) } else { (r1 - r2, 0.0) };
        let leave = libm::acos(reach / d);
        let run = d * libm::sin(leave);
        // Marks are counted along the belt, counter-clockwise round the first wheel. A crossed
        // belt goes clockwise round the second.
        let sense = if is_crossed { -1.0 } else { 1.0 };
        let angle = |side: f64| {
            let at = phi + side * leave;
            let mark = r1 * (at - theta1) - side * run;
            at + side * turn - sense * mark / r2
        };
        0.5 * (angle(1.0) + angle(-1.0))
    }

    #[test]
    fn a_belt_turns_its_wheels_as_its_runs_say() {
        for is_crossed in [false, true] {
            for radii in [[1.0, 2.0], [2.0, 0.5], [1.0, 1.0]] {
                let x = |i: i32| {
                    let t = f64::from(i) * 0.05;
                    let (d, phi) = (6.0 + libm::sin(0.3 * t), 0.7 * t + 0.4 * libm::sin(t));
                    let o2 = Vector::polar(d, phi).to_point();
                    let theta2 = by_belt(radii, is_crossed, d, phi, 1.3 * t);
                    let rims = [Vector::polar(1.0, 1.3 * t), Vector::polar(1.0, theta2)];
                    [Point::ORIGIN, Point::ORIGIN + rims[0], o2, o2 + rims[1]]
                };
                let ratio = radii[1] / radii[0];
                let mut belt = Cog::belt([0, 1, 2, 3], ratio, is_crossed, &x(0));
                for i in 0..1000 {
                    let f = belt.residual(&x(i));
                    assert!(f.abs() < 1e-12, "{radii:?} crossed {is_crossed}, frame {i}: {f}");
                    belt.accept(&x(i));
                }
            }
        }
    }

    #[test]
    fn a_gear_change_is_no_jump() {
        let mut cog = Cog::new([0, 1, 2, 3], 3.0, &pair(0, 36, (1, 3)));
        (0..100).for_each(|i| cog.accept(&pair(i, 36, (1, 3))));
        let x = pair(99, 36, (1, 3));
        assert!(cog.set(Field::Ratio, 5.0));
        assert!(cog.residual(&x).abs() < 1e-14);
    }
}
