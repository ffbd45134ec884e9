//! The orientation constraint, section 3.6: the angle between two segments.

use super::{Bounds, Field, Place, Point, PointIdx, Real, Relation, Row, Vector};

/// Which angles count as the same.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Period {
    /// Those that differ by whole turns.
    Whole,
    /// Those that differ by half turns: parallel or antiparallel, whichever is nearer.
    Half,
}

/// The signed angle from the first segment to the second lies in `bounds`.
#[derive(Debug, Clone, PartialEq)]
pub struct Orientation {
    /// Start and end of the one segment, start and end of the other.
    pub points: [PointIdx; 4],
    /// The allowed angles, radians.
    pub bounds: Bounds,
    /// Which angles count as the same.
    pub period: Period,
    /// The side on which the angle was last accepted: -1, 1, or 0 before that.
    pub side: f64,
}

// STUB
impl Relation for Orientation {
    fn points(&self) -> &[PointIdx] { &self.points }
    fn points_mut(&mut self) -> &mut [PointIdx] { &mut self.points }
    fn n_rows(&self) -> usize { 1 }
    fn residual(&self, _x: &[Point]) -> f64 { 0.0 }
    fn correct(&self, _x: &[Point], _w: &[f64], _move_by: &mut impl FnMut(PointIdx, Vector)) {}
    fn jacobian(&self, _x: &[Point], row: &mut impl FnMut(Row)) { for _ in 0..self.n_rows() { row(Row::inactive(&self.points[..3.min(self.points.len())])); } }
    fn equations<T: Real>(&self, _x: &impl Fn(PointIdx) -> Place<T>, _field: &impl Fn(Field, f64) -> T, equation: &mut impl FnMut(T)) { for _ in 0..self.n_rows() { equation(T::constant(0.0)); } }
}
