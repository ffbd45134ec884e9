//! A rigid body.

use super::{Field, Place, Point, PointIdx, Real, Relation, Row, Vector};

/// Points that keep the shape they had.
#[derive(Debug, Clone, PartialEq)]
pub struct Rigid {
    /// The points, each once.
    points: Box<[PointIdx]>,
    shape: Box<[Vector]>,
}

impl Rigid {
    /// A body of these points as they stand; a point given twice counts once.
    pub fn new(points: &[PointIdx], x: &[Point]) -> Self {
        Self { points: points.into(), shape: points.iter().map(|&p| x[p as usize].to_vector()).collect() }
    }
}

// STUB
impl Relation for Rigid {
    fn points(&self) -> &[PointIdx] { &self.points }
    fn points_mut(&mut self) -> &mut [PointIdx] { &mut self.points }
    fn n_rows(&self) -> usize { (2 * self.points.len()).saturating_sub(3) }
    fn residual(&self, _x: &[Point]) -> f64 { 0.0 }
    fn correct(&self, _x: &[Point], _w: &[f64], _move_by: &mut impl FnMut(PointIdx, Vector)) {}
    fn jacobian(&self, _x: &[Point], row: &mut impl FnMut(Row)) { for _ in 0..self.n_rows() { row(Row::inactive(&self.points[..3.min(self.points.len())])); } }
    fn equations<T: Real>(&self, _x: &impl Fn(PointIdx) -> Place<T>, _field: &impl Fn(Field, f64) -> T, equation: &mut impl FnMut(T)) { for _ in 0..self.n_rows() { equation(T::constant(0.0)); } }
}
