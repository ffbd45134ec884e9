//! The glider constraint, section 3.8: a point on a line, between end stops.

use super::{Field, Place, Point, PointIdx, Real, Relation, Row, Vector};

/// The first point lies on the segment between the second and the third, or on their line.
#[derive(Debug, Clone, PartialEq)]
pub struct Glider {
    /// The point, then the two that span the line.
    pub points: [PointIdx; 3],
    /// Whether the segment's ends stop it.
    pub bounded: bool,
}

// STUB
impl Relation for Glider {
    fn points(&self) -> &[PointIdx] { &self.points }
    fn points_mut(&mut self) -> &mut [PointIdx] { &mut self.points }
    fn n_rows(&self) -> usize { 2 }
    fn residual(&self, _x: &[Point]) -> f64 { 0.0 }
    fn correct(&self, _x: &[Point], _w: &[f64], _move_by: &mut impl FnMut(PointIdx, Vector)) {}
    fn jacobian(&self, _x: &[Point], row: &mut impl FnMut(Row)) { for _ in 0..self.n_rows() { row(Row::inactive(&self.points[..3.min(self.points.len())])); } }
    fn equations<T: Real>(&self, _x: &impl Fn(PointIdx) -> Place<T>, _field: &impl Fn(Field, f64) -> T, equation: &mut impl FnMut(T)) { for _ in 0..self.n_rows() { equation(T::constant(0.0)); } }
}
