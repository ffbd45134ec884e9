//! The cog wheel constraint as printed.

use super::{Field, Place, Point, PointIdx, Real, Relation, Row, Vector};

/// Two wheels in mesh.
#[derive(Debug, Clone, PartialEq)]
pub struct CogVelocity {
    /// Centre and marker of the one wheel, centre and marker of the other.
    pub points: [PointIdx; 4],
    ratio: f64,
    previous: [Point; 4],
}

impl CogVelocity {
    /// Wheels in mesh, at rest as they stand.
    pub fn new(points: [PointIdx; 4], ratio: f64, x: &[Point]) -> Self {
        Self { points, ratio, previous: points.map(|p| x[p as usize]) }
    }
}

// STUB
impl Relation for CogVelocity {
    fn points(&self) -> &[PointIdx] { &self.points }
    fn points_mut(&mut self) -> &mut [PointIdx] { &mut self.points }
    fn n_rows(&self) -> usize { 2 }
    fn residual(&self, _x: &[Point]) -> f64 { 0.0 }
    fn correct(&self, _x: &[Point], _w: &[f64], _move_by: &mut impl FnMut(PointIdx, Vector)) {}
    fn jacobian(&self, _x: &[Point], row: &mut impl FnMut(Row)) { for _ in 0..self.n_rows() { row(Row::inactive(&self.points[..3.min(self.points.len())])); } }
    fn equations<T: Real>(&self, _x: &impl Fn(PointIdx) -> Place<T>, _field: &impl Fn(Field, f64) -> T, equation: &mut impl FnMut(T)) { for _ in 0..self.n_rows() { equation(T::constant(0.0)); } }
}
