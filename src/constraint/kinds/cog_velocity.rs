//! The cog wheel constraint of section 3.10 as printed: between velocities.
//!
//! Kept to show its drift; [`crate::constraint::Cog`] is the same condition without.

use crate::constraint::parts::content::add_all;
use crate::constraint::parts::gearing::Gearing;
use crate::constraint::parts::geometry::has_direction;
use crate::constraint::parts::linear::Linear;
use crate::constraint::{
    Activity, Carried, ConstraintKind, Declared, Field, Given, Point, PointIdx, Quantity, Real,
    Refusal, Row, Stateful, Traits, Vec2, Vector,
};

/// In one frame the two wheels move alike where they touch.
///
/// Displacements since the frame began stand for velocities, and the matrices `A_i` of the
/// paper's appendix are those of the pose it began with: the explicit Euler scheme. Wheels
/// with ratio -1 have no point of contact, and a marker on its centre shows no rotation:
/// the constraint asks for nothing then.
#[derive(Debug, Clone, PartialEq)]
pub struct CogVelocity {
    /// Centre and marker of the one wheel, centre and marker of the other.
    pub points: [PointIdx; 4],
    gearing: Gearing,
    /// Where the points were when the frame began.
    previous: [Point; 4],
}

impl CogVelocity {
    /// Wheels in mesh, at rest as they stand.
    pub fn new(points: [PointIdx; 4], ratio: f64, x: &[Point]) -> Self {
        Self::geared(points, Gearing::of(ratio), x)
    }

    fn geared(points: [PointIdx; 4], gearing: Gearing, x: &[Point]) -> Self {
        Self { points, gearing, previous: points.map(|p| x[p as usize]) }
    }

    /// The complex coefficients `1 - A1, A1, A2 - 1, -A2` of the displacements.
    fn coefficients(&self) -> Option<[Vector; 4]> {
        let [x1, x2, x3, x4] = self.previous;
        let r = self.gearing.ratio();
        if r == -1.0 || !has_direction(x1, x2) || !has_direction(x3, x4) {
            return None;
        }
        // The point of contact t = (r x1 + x3) / (r + 1), from either centre.
        let centres = x3 - x1;
        let a1 = (centres / (r + 1.0)).over(x2 - x1);
        let a2 = (centres * (-r / (r + 1.0))).over(x4 - x3);
        let one = Vector::new(1.0, 0.0);
        Some([one - a1, a1, a2 - one, -a2])
    }

    fn linear(&self, coefficients: [Vector; 4]) -> Linear {
        self.points.iter().zip(coefficients).fold(Linear::new(), |sum, (&p, c)| sum.with(p, c))
    }

    /// How much farther the first wheel has moved at the point of contact.
    fn value(&self, coefficients: [Vector; 4], x: &[Point]) -> Vector {
        let mut sum = Vector::ZERO;
        for ((p, before), c) in self.points.into_iter().zip(self.previous).zip(coefficients) {
            sum += (x[p as usize] - before).times(c);
        }
        sum
    }
}

impl Declared for CogVelocity {
    const WORDS: &'static [&'static str] = &[];

    fn declare(given: &Given) -> Result<Self, Refusal> {
        Ok(Self::geared(given.pairs()?, Gearing::given(given), given.x))
    }
}

impl ConstraintKind for CogVelocity {
    fn points(&self) -> &[PointIdx] {
        &self.points
    }

    fn points_mut(&mut self) -> &mut [PointIdx] {
        &mut self.points
    }

    fn n_rows(&self) -> usize {
        2
    }

    fn residual(&self, x: &[Point]) -> f64 {
        self.coefficients().map_or(0.0, |c| self.value(c, x).norm())
    }

    fn correct(&self, x: &[Point], w: &[f64], move_by: &mut impl FnMut(PointIdx, Vector)) {
        // The printed (I - A)^-1 has a pole where a marker passes the point of contact; the
        // shortest displacement has none.
        if let Some(c) = self.coefficients() {
            self.linear(c).correct(self.value(c, x), w, move_by);
        }
    }

    fn jacobian(&self, x: &[Point], row: &mut impl FnMut(Row)) {
        if let Some(c) = self.coefficients() {
            self.linear(c).rows(self.value(c, x), row);
        } else {
            row(Row::inactive(&self.points));
            row(Row::inactive(&self.points));
        }
    }

    fn equations<T: Real>(
        &self,
        x: &impl Fn(PointIdx) -> Vec2<T>,
        _field: &impl Fn(Field, f64) -> T,
        equation: &mut impl FnMut(T),
    ) {
        let mut sum = Vec2::constant(Vector::ZERO);
        if let Some(c) = self.coefficients() {
            for ((p, before), c) in self.points.into_iter().zip(self.previous).zip(c) {
                let moved = x(p) - Vec2::constant(before.to_vector());
                sum = sum + moved.times(Vec2::constant(c));
            }
        }
        equation(sum.x);
        equation(sum.y);
    }

    fn get(&self, field: Field) -> Option<f64> {
        self.gearing.get(field)
    }

    fn set(&mut self, field: Field, value: f64) -> bool {
        self.gearing.set(field, value)
    }

    fn nominal_length(&self) -> f64 {
        0.0
    }

    fn traits(&self) -> Traits {
        Traits {
            word: "cog",
            quantity: Quantity::Length,
            bounds: None,
            activity: Activity::Always,
            // Depends on how its points moved, not only on where they are.
            n_firm_rows: 0,
            is_linear: false,
            is_wheel: true,
            carried: Carried::ByFrame,
            flags: self.gearing.flags(),
            flaw: self.gearing.flaw(),
        }
    }

    fn content(&self, word: &mut impl FnMut(u64)) {
        let Self { points: _, gearing, previous } = self;
        gearing.content(word);
        previous.iter().for_each(|&Point { x, y }| add_all([x, y], word));
    }
}

impl Stateful for CogVelocity {
    fn state(&self) -> Option<Vec<f64>> {
        Some(self.previous.iter().flat_map(|p| [p.x, p.y]).collect())
    }

    fn set_state(&mut self, state: &[f64]) {
        if let (&[x1, x2, x3, x4], []) = state.as_chunks::<2>()
            && state.iter().all(|v| v.is_finite())
        {
            self.previous = [x1, x2, x3, x4].map(|[x, y]| Point::new(x, y));
        }
    }

    fn captured(&self) -> Vec<f64> {
        Vec::new()
    }

    fn set_captured(&mut self, _captured: &[f64]) {}

    fn pick_up(&mut self, x: &[Point]) {
        self.accept(x);
    }

    fn advance(&mut self, _dt: f64) -> bool {
        false
    }

    fn accept(&mut self, x: &[Point]) {
        self.previous = self.points.map(|p| x[p as usize]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::constraint::Cog;

    /// The paper's planet, its centre led around a frozen ring; how far off the marker's
    /// angle is after one revolution, and how far out the marker.
    fn planet(cog: &mut (impl ConstraintKind + Stateful), frames: u32) -> (f64, f64) {
        let centre = |i: u32| {
            Vector::polar(0.75, f64::from(i % frames) * std::f64::consts::TAU / f64::from(frames))
                .to_point()
        };
        let mut x = [Point::ORIGIN, Point::new(1.0, 0.0), centre(0), Point::new(1.0, 0.0)];
        for i in 1..=frames {
            x[2] = centre(i);
            for _ in 0..8 {
                let mut d = Vector::ZERO;
                cog.correct(&x, &[0.0, 0.0, 0.0, 1.0], &mut |_, v| d += v);
                x[3] += d;
            }
            cog.accept(&x);
        }
        let spoke = x[3] - x[2];
        (spoke.angle().abs(), spoke.norm() / 0.25)
    }

    #[test]
    fn the_printed_form_drifts_and_the_angles_do_not() {
        let points = [0, 1, 2, 3];
        let x = [Point::ORIGIN, Point::new(1.0, 0.0), Point::new(0.75, 0.0), Point::new(1.0, 0.0)];
        let (angle, radius) = planet(&mut CogVelocity::new(points, -0.25, &x), 360);
        assert!(angle > 0.02 && radius > 1.5, "{angle} {radius}");
        // Four times the frames, a sixteenth of the drift.
        let (finer, _) = planet(&mut CogVelocity::new(points, -0.25, &x), 1440);
        assert!((angle / finer - 16.0).abs() < 1.0, "{angle} {finer}");
        let (angle, _) = planet(&mut Cog::new(points, -0.25, &x), 360);
        assert!(angle < 1e-13, "{angle}");
    }
}
