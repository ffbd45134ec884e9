//! What every kind of constraint answers.

use crate::constraint::{Field, Point, PointIdx, Real, Row, Traits, Vec2, Vector};

/// What every constraint answers. A kind says too whether it is [`Stateful`] or [`Stateless`].
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
    fn get(&self, field: Field) -> Option<f64>;

    /// Sets a value; false if this kind has no such field. Wheels and motors go on from
    /// where they stand.
    fn set(&mut self, field: Field, value: f64) -> bool;

    /// The longest length that it asks for, 0 if none: a scene is at least as large. Asked
    /// wherever a live value changes, so not one of the traits.
    fn nominal_length(&self) -> f64;

    /// What sort of a constraint it is.
    fn traits(&self) -> Traits;

    /// All that tells it from another one of its kind that holds the same points, to the bit:
    /// what is remembered of a pose holds as long as this is the same. To be written by taking
    /// the struct apart without `..`, so that no part is forgotten.
    fn content(&self, word: &mut impl FnMut(u64));

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

/// What a constraint carries on beyond its values, see [`Carried`](super::Carried). A kind that
/// carries nothing is [`Stateless`] instead.
pub trait Stateful {
    /// The numbers that running changes beyond the points: how far a motor has turned, the
    /// turns a wheel has made. None where there are no such.
    fn state(&self) -> Option<Vec<f64>>;

    /// Brings back a state that `state` gave.
    fn set_state(&mut self, state: &[f64]);

    /// The numbers taken from the pose at creation that its statement does not say: the shape
    /// of a rigid body, the constant of a mesh. Empty where there are none.
    fn captured(&self) -> Vec<f64>;

    /// Brings back the numbers that `captured` gave.
    fn set_captured(&mut self, captured: &[f64]);

    /// Called when it is switched on again: it goes on from the pose as it is now.
    fn pick_up(&mut self, x: &[Point]);

    /// Goes `dt` on in time; whether that changed anything.
    fn advance(&mut self, dt: f64) -> bool;

    /// Called with a pose that counts, from which what is carried goes on: one that was accepted
    /// as converged, and for what displacements stand for, whatever a frame ended with.
    fn accept(&mut self, x: &[Point]);
}

/// A kind that is the same whatever came before, and says all of itself in its statement.
pub trait Stateless {}

impl<T: Stateless> Stateful for T {
    fn state(&self) -> Option<Vec<f64>> {
        None
    }

    fn set_state(&mut self, _state: &[f64]) {}

    fn captured(&self) -> Vec<f64> {
        Vec::new()
    }

    fn set_captured(&mut self, _captured: &[f64]) {}

    fn pick_up(&mut self, _x: &[Point]) {}

    fn advance(&mut self, _dt: f64) -> bool {
        false
    }

    fn accept(&mut self, _x: &[Point]) {}
}
