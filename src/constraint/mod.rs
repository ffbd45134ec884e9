//! The constraints of section 3 of the paper and what goes beyond them, one file each.
//!
//! Every file defines the struct, its points, the residual (the paper's `f`), the correction
//! (the paper's `A_a`, weighted and exact: `f(x + d) = 0`), the linearised rows, and the same
//! equations over jets. Nothing here knows names, settings or files, looks at another
//! constraint, or allocates.

mod bounds;
pub mod geometry;
mod jet;
mod length;
mod row;

pub use bounds::Bounds;
pub use geometry::{Point, Vector};
pub use jet::{Jet, Real};
pub use length::Length;
pub use row::{PointIdx, Row};

/// What every constraint answers.
///
/// `x` are the positions, `w` the inverse masses of all points (0: frozen); both are indexed
/// by [`PointIdx`].
pub trait Relation {
    /// The points it holds, in the order of its statement.
    fn points(&self) -> &[PointIdx];

    /// How many rows `jacobian` gives and values `equations` gives, whatever the pose.
    fn n_rows(&self) -> usize;

    /// The paper's `f` after clamping, in its own unit: 0 where satisfied, signed where a
    /// sign makes sense, else the norm.
    fn residual(&self, x: &[Point]) -> f64;

    /// The paper's `A_a`: for each point that is not frozen a displacement `d`, such that
    /// `f(x + d) = 0` and the weighted norm of `d` is least (or, for large turns, nearly so).
    fn correct(&self, x: &[Point], w: &[f64], move_by: &mut impl FnMut(PointIdx, Vector));

    /// The rows of the Jacobian at `x`, exactly `n_rows` of them.
    fn jacobian(&self, x: &[Point], row: &mut impl FnMut(Row));

    /// The values `f` of the rows over any number type, exactly `n_rows` of them, 0 for an
    /// inactive row. `field(k, v)` gives the number for the constraint's own value `v`.
    fn equations<T: Real>(
        &self,
        x: &impl Fn(PointIdx) -> Place<T>,
        field: &impl Fn(Field, f64) -> T,
        equation: &mut impl FnMut(T),
    );

    /// Called when a frame begins, with the positions the last one ended with.
    fn begin_frame(&mut self, _x: &[Point], _dt: f64) {}

    /// Called with a pose that was accepted as converged: angles are unwrapped from here on.
    fn accept(&mut self, _x: &[Point]) {}
}

/// A value of a constraint that an expression may drive.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Field {
    /// The least value of the measured quantity.
    Lo,
    /// The greatest value of the measured quantity.
    Hi,
    /// The horizontal coordinate of a fixed place.
    X,
    /// The vertical coordinate of a fixed place.
    Y,
    /// The radius of a motor.
    Radius,
    /// The angular speed of a motor, radians per time unit.
    Speed,
    /// The angle of a motor at its start, radians.
    Phase,
    /// The ratio of a hinge or of a cog wheel pair.
    Ratio,
}

/// A position whose coordinates are any kind of number.
#[derive(Debug, Clone, Copy)]
pub struct Place<T> {
    /// The horizontal coordinate.
    pub x: T,
    /// The vertical coordinate.
    pub y: T,
}

impl<T: Real> std::ops::Sub for Place<T> {
    type Output = Self;
    fn sub(self, o: Self) -> Self {
        Self { x: self.x - o.x, y: self.y - o.y }
    }
}

impl<T: Real> Place<T> {
    /// The length of this difference.
    pub fn norm(self) -> T {
        (self.x * self.x + self.y * self.y).sqrt()
    }
}

/// The excess of a measured value over its bounds, over any number type.
fn excess<T: Real>(bounds: Bounds, f: T, field: &impl Fn(Field, f64) -> T) -> T {
    if bounds.is_equality() {
        f - field(Field::Lo, bounds.lo)
    } else if f.value() < bounds.lo {
        f - field(Field::Lo, bounds.lo)
    } else if f.value() > bounds.hi {
        f - field(Field::Hi, bounds.hi)
    } else {
        T::constant(0.0)
    }
}

/// The unit vector and the distance from `a` to `b`; (1, 0) for points that coincide, a
/// fixed choice that keeps runs reproducible and lets a rod leave length 0.
fn direction(a: Point, b: Point) -> (Vector, f64) {
    let v = b - a;
    let l = v.norm();
    if l > 0.0 { (v / l, l) } else { (Vector::new(1.0, 0.0), 0.0) }
}
