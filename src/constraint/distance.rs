//! The distance of a point to a line.

use super::{Bounds, Field, Place, Point, PointIdx, Real, Relation, Row, Vector};

/// The signed distance of the first point to the line from the second to the third lies in
/// `bounds`.
#[derive(Debug, Clone, PartialEq)]
pub struct Distance {
    /// The point, then the two that span the line.
    pub points: [PointIdx; 3],
    /// The allowed distances, length units, positive on the left.
    pub bounds: Bounds,
}

// STUB
impl Relation for Distance {
    fn points(&self) -> &[PointIdx] { &self.points }
    fn points_mut(&mut self) -> &mut [PointIdx] { &mut self.points }
    fn n_rows(&self) -> usize { 1 }
    fn residual(&self, _x: &[Point]) -> f64 { 0.0 }
    fn correct(&self, _x: &[Point], _w: &[f64], _move_by: &mut impl FnMut(PointIdx, Vector)) {}
    fn jacobian(&self, _x: &[Point], row: &mut impl FnMut(Row)) { for _ in 0..self.n_rows() { row(Row::inactive(&self.points[..3.min(self.points.len())])); } }
    fn equations<T: Real>(&self, _x: &impl Fn(PointIdx) -> Place<T>, _field: &impl Fn(Field, f64) -> T, equation: &mut impl FnMut(T)) { for _ in 0..self.n_rows() { equation(T::constant(0.0)); } }
}
