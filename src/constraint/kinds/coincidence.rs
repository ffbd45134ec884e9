//! The coincidence constraint, section 3.2: two points in one place.

use crate::constraint::parts::linear::Linear;
use crate::constraint::{ConstraintKind, Field, Point, PointIdx, Real, Row, Vec2, Vector};

/// Two points lie in one place.
#[derive(Debug, Clone, PartialEq)]
pub struct Coincidence {
    /// The points.
    pub points: [PointIdx; 2],
}

impl Coincidence {
    fn linear(&self) -> Linear {
        let [a, b] = self.points;
        Linear::new().with_real(a, 1.0).with_real(b, -1.0)
    }

    fn value(&self, x: &[Point]) -> Vector {
        let [x1, x2] = self.points.map(|p| x[p as usize]);
        x1 - x2
    }
}

impl ConstraintKind for Coincidence {
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
        self.linear().correct(self.value(x), w, move_by);
    }

    fn jacobian(&self, x: &[Point], row: &mut impl FnMut(Row)) {
        self.linear().rows(self.value(x), row);
    }

    fn equations<T: Real>(
        &self,
        x: &impl Fn(PointIdx) -> Vec2<T>,
        _field: &impl Fn(Field, f64) -> T,
        equation: &mut impl FnMut(T),
    ) {
        let [x1, x2] = self.points.map(x);
        let g = x1 - x2;
        equation(g.x);
        equation(g.y);
    }
}
