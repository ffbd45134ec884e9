//! The cog wheel constraint, section 3.10, as an equation between angles.

use super::winding::Winding;
use super::{Field, Place, Point, PointIdx, Real, Relation, Row, Vector};

/// Two wheels in mesh.
#[derive(Debug, Clone, PartialEq)]
pub struct Cog {
    /// Centre and marker of the one wheel, centre and marker of the other.
    pub points: [PointIdx; 4],
    ratio: f64,
    lifted: [Winding; 3],
    k: f64,
}

impl Cog {
    /// Wheels in mesh as they stand.
    pub fn new(points: [PointIdx; 4], ratio: f64, _x: &[Point]) -> Self {
        Self { points, ratio, lifted: [Winding::default(); 3], k: 0.0 }
    }
}

// STUB
impl Relation for Cog {
    fn points(&self) -> &[PointIdx] { &self.points }
    fn points_mut(&mut self) -> &mut [PointIdx] { &mut self.points }
    fn n_rows(&self) -> usize { 1 }
    fn residual(&self, _x: &[Point]) -> f64 { 0.0 }
    fn correct(&self, _x: &[Point], _w: &[f64], _move_by: &mut impl FnMut(PointIdx, Vector)) {}
    fn jacobian(&self, _x: &[Point], row: &mut impl FnMut(Row)) { for _ in 0..self.n_rows() { row(Row::inactive(&self.points[..3.min(self.points.len())])); } }
    fn equations<T: Real>(&self, _x: &impl Fn(PointIdx) -> Place<T>, _field: &impl Fn(Field, f64) -> T, equation: &mut impl FnMut(T)) { for _ in 0..self.n_rows() { equation(T::constant(0.0)); } }
}
