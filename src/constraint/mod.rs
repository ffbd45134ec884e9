//! The constraints of section 3 of the paper and what goes beyond them, one file each.
//!
//! Every file defines the struct, its points, the residual (the paper's `f`), the correction
//! (the paper's `A_a`, weighted and exact: `f(x + d) = 0`), the linearised rows, and the same
//! equations over jets. Nothing here knows names, settings or files, looks at another
//! constraint, or allocates while relaxing.
//!
//! ```
//! use linkwork::constraint::{Bounds, Constraint, Length, Point, ConstraintKind};
//!
//! let mut x = [Point::new(0.0, 0.0), Point::new(5.0, 0.0)];
//! let w = [0.0, 1.0]; // the first point is frozen
//! let rod = Constraint::from(Length { points: [0, 1], bounds: Bounds::exactly(3.0) });
//! assert_eq!(rod.residual(&x), 2.0);
//!
//! rod.correct(&x.clone(), &w, &mut |point, d| x[point as usize] += d);
//! assert_eq!(x[1], Point::new(3.0, 0.0));
//! ```

mod kinds;
mod parts;

pub use kinds::cog::Cog;
pub use kinds::cog_velocity::CogVelocity;
pub use kinds::coincidence::Coincidence;
pub use kinds::coordinate::Coordinate;
pub use kinds::distance::Distance;
pub use kinds::equal::Equal;
pub use kinds::equivalence::Equivalence;
pub use kinds::glider::Glider;
pub use kinds::hinge::Hinge;
pub use kinds::length::Length;
pub use kinds::motor::{Heading, Motor};
pub use kinds::orientation::{Orientation, Period};
pub use kinds::rack::Rack;
pub use kinds::rigid::Rigid;
pub use kinds::{Constraint, Kind};
pub use parts::bounds::Bounds;
#[doc(hidden)]
pub use parts::geometry;
pub use parts::geometry::{Point, Vector};
#[doc(hidden)]
pub use parts::jet::{Jet, Real};
pub use parts::row::PointIdx;
#[doc(hidden)]
pub use parts::row::Row;
pub use parts::turns::Turns;
pub use parts::vec2::Vec2;

/// What every constraint answers.
///
/// `x` are the positions, `w` the inverse masses of all points (0: frozen); both are indexed
/// by [`PointIdx`].
pub trait ConstraintKind {
    /// The points it holds, in the order of its statement.
    fn points(&self) -> &[PointIdx];

    /// The same, to renumber them.
    fn points_mut(&mut self) -> &mut [PointIdx];

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
        x: &impl Fn(PointIdx) -> Vec2<T>,
        field: &impl Fn(Field, f64) -> T,
        equation: &mut impl FnMut(T),
    );

    /// A value an expression may drive; none if this kind has no such field.
    fn get(&self, _field: Field) -> Option<f64> {
        None
    }

    /// Sets a value; false if this kind has no such field. Wheels and motors go on from
    /// where they stand.
    fn set(&mut self, _field: Field, _value: f64) -> bool {
        false
    }

    /// Called when a frame begins, with the positions the last one ended with: a motor
    /// turns on by `dt` here.
    fn begin_frame(&mut self, _x: &[Point], _dt: f64) {}

    /// The numbers that running changes beyond the points: how far a motor has turned, the
    /// turns a wheel has made. None where there are no such.
    fn state(&self) -> Option<Vec<f64>> {
        None
    }

    /// Brings back a state that `state` gave.
    fn set_state(&mut self, _state: &[f64]) {}

    /// The numbers taken from the pose at creation that its statement does not say: the shape
    /// of a rigid body, the constant of a mesh. Empty where there are none.
    fn captured(&self) -> Vec<f64> {
        Vec::new()
    }

    /// Brings back the numbers that `captured` gave.
    fn set_captured(&mut self, _captured: &[f64]) {}

    /// Called when it is switched on again: it goes on from the pose as it is now.
    fn pick_up(&mut self, _x: &[Point]) {}

    /// Goes `dt` on in time; whether that changed anything.
    fn advance(&mut self, _dt: f64) -> bool {
        false
    }

    /// Called with a pose that was accepted as converged: angles are unwrapped from here on.
    fn accept(&mut self, _x: &[Point]) {}

    /// The distance to satisfaction, length units: the norm over its rows of `|f| / |grad f|`
    /// in the metric of the weights, which does not depend on the axes. A row that holds
    /// frozen points only is measured with weights 1, one without a gradient by `|f|` itself,
    /// so that nothing unsatisfied is 0.
    fn violation(&self, x: &[Point], w: &[f64]) -> f64 {
        let mut norm = 0.0;
        self.jacobian(x, &mut |row| norm = Vector::new(norm, row.distance(w)).norm());
        norm
    }
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
    /// The radius of a motor or of a wheel on a rack.
    Radius,
    /// The angular speed of a motor, radians per time unit.
    Speed,
    /// The angle of a motor at its start, radians.
    Phase,
    /// The ratio of a hinge or of a cog wheel pair.
    Ratio,
}

impl Field {
    /// All of them.
    pub const ALL: [Self; 8] =
        [Self::Lo, Self::Hi, Self::X, Self::Y, Self::Radius, Self::Speed, Self::Phase, Self::Ratio];
}

/// The excess of a measured value over its bounds, over any number type.
fn excess<T: Real>(bounds: Bounds, f: T, field: &impl Fn(Field, f64) -> T) -> T {
    if bounds.is_equality() || f.value() < bounds.lo {
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
