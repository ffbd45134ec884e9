//! A wheel that rolls along a line.

use super::winding::Winding;
use super::{Field, Place, Point, PointIdx, Real, Relation, Row, Vector};

/// A wheel rolls along a line without slip.
#[derive(Debug, Clone, PartialEq)]
pub struct Rack {
    /// Centre and rim point of the wheel, two points of the line.
    pub points: [PointIdx; 4],
    radius: f64,
    k: f64,
    lifted: Winding,
}

impl Rack {
    /// A wheel as it stands.
    pub fn new(points: [PointIdx; 4], _x: &[Point]) -> Self {
        Self { points, radius: 0.0, k: 0.0, lifted: Winding::default() }
    }
}

// STUB
impl Relation for Rack {
    fn points(&self) -> &[PointIdx] { &self.points }
    fn points_mut(&mut self) -> &mut [PointIdx] { &mut self.points }
    fn n_rows(&self) -> usize { 1 }
    fn residual(&self, _x: &[Point]) -> f64 { 0.0 }
    fn correct(&self, _x: &[Point], _w: &[f64], _move_by: &mut impl FnMut(PointIdx, Vector)) {}
    fn jacobian(&self, _x: &[Point], row: &mut impl FnMut(Row)) { for _ in 0..self.n_rows() { row(Row::inactive(&self.points[..3.min(self.points.len())])); } }
    fn equations<T: Real>(&self, _x: &impl Fn(PointIdx) -> Place<T>, _field: &impl Fn(Field, f64) -> T, equation: &mut impl FnMut(T)) { for _ in 0..self.n_rows() { equation(T::constant(0.0)); } }
}
