//! The hinge constraint, section 3.9: a point that divides a segment in a fixed ratio.

use crate::constraint::parts::content::add_all;
use crate::constraint::parts::linear::Linear;
use crate::constraint::{
    Activity, Carried, ConstraintKind, Declared, Field, Given, Point, PointIdx, Quantity, Real,
    Refusal, Row, Stateless, Traits, Vec2, Vector,
};

/// The first point is `A + ratio (B - A)` for the second and third, A and B.
#[derive(Debug, Clone, PartialEq)]
pub struct Hinge {
    /// The point, then A and B.
    pub points: [PointIdx; 3],
    /// The paper's mu: 0 at A, 1 at B; outside 0..1 beyond the ends.
    pub ratio: f64,
}

impl Hinge {
    fn value(&self, x: &[Point]) -> Vector {
        value(self.points.map(|p| x[p as usize]), self.ratio)
    }
}

/// The left side of `x1 - (1 - mu) x2 - mu x3 = 0`. Its shortest correction obeys the law of
/// the lever, `mu d2 = (1 - mu) d3`; the printed d2 and d3 are swapped.
pub(crate) fn linear(points: [PointIdx; 3], mu: f64) -> Linear {
    let [p, a, b] = points;
    Linear::new().with_real(p, 1.0).with_real(a, mu - 1.0).with_real(b, -mu)
}

/// The value of the same.
pub(crate) fn value([x1, x2, x3]: [Point; 3], mu: f64) -> Vector {
    // From the nearer end, so that mu = 1 is exactly that end.
    if mu <= 0.5 { (x1 - x2) - (x3 - x2) * mu } else { (x1 - x3) - (x2 - x3) * (1.0 - mu) }
}

impl Declared for Hinge {
    const WORDS: &'static [&'static str] = &["hinge"];

    fn declare(given: &Given) -> Result<Self, Refusal> {
        let ratio = given.value(Field::Ratio).unwrap_or_default();
        Ok(Self { points: given.point_and_pair()?, ratio })
    }
}

impl Stateless for Hinge {}

impl ConstraintKind for Hinge {
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
        self.value(x).norm()
    }

    fn correct(&self, x: &[Point], w: &[f64], move_by: &mut impl FnMut(PointIdx, Vector)) {
        linear(self.points, self.ratio).correct(self.value(x), w, move_by);
    }

    fn jacobian(&self, x: &[Point], row: &mut impl FnMut(Row)) {
        linear(self.points, self.ratio).rows(self.value(x), row);
    }

    fn equations<T: Real>(
        &self,
        x: &impl Fn(PointIdx) -> Vec2<T>,
        field: &impl Fn(Field, f64) -> T,
        equation: &mut impl FnMut(T),
    ) {
        let [x1, x2, x3] = self.points.map(x);
        let g = (x1 - x2) - (x3 - x2).scale(field(Field::Ratio, self.ratio));
        equation(g.x);
        equation(g.y);
    }

    fn get(&self, field: Field) -> Option<f64> {
        (field == Field::Ratio).then_some(self.ratio)
    }

    fn set(&mut self, field: Field, value: f64) -> bool {
        if field == Field::Ratio {
            self.ratio = value;
        }
        field == Field::Ratio
    }

    fn nominal_length(&self) -> f64 {
        0.0
    }

    fn traits(&self) -> Traits {
        Traits {
            word: "hinge",
            quantity: Quantity::Length,
            bounds: None,
            activity: Activity::Always,
            n_firm_rows: 2,
            is_linear: true,
            is_wheel: false,
            carried: Carried::Nothing,
            flags: &[],
            flaw: None,
        }
    }

    fn content(&self, word: &mut impl FnMut(u64)) {
        let Self { points: _, ratio } = self;
        add_all([*ratio], word);
    }
}
