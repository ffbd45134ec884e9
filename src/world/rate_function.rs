//! The values of the functions of moving points: what follows from velocities and accelerations.

use super::Value;
use super::arithmetic::finite;
use crate::constraint::{Real, Vec2};
use crate::diag::{Diagnostic, Span};
use crate::errors;
use crate::terms::Function;

/// Two angular velocities that differ by less than this part are the same: far above what rounding
/// leaves of them, and far below what anyone could tell apart on a drawing.
const SAME: f64 = 1e-10;

/// A point with its derivatives in time.
#[derive(Debug, Clone, Copy)]
pub(super) struct MovingPoint<T> {
    pub at: Vec2<T>,
    pub velocity: Vec2<T>,
    pub acceleration: Vec2<T>,
}

/// The value of a function of moving points.
///
/// # Errors
/// Where there is none: of points that coincide, of what does not turn or move.
pub(super) fn rate<T: Real>(
    function: Function,
    points: &[MovingPoint<T>],
    span: Span,
) -> Result<Value<T>, Diagnostic> {
    let value = match function {
        Function::Velocity => Value::Vector(points[0].velocity),
        Function::Acceleration => Value::Vector(points[0].acceleration),
        Function::Omega => Value::Number(turning(points[0], points[1], span)?.0),
        Function::Alpha => Value::Number(turning(points[0], points[1], span)?.1),
        Function::InstantCentre => Value::Vector(instant_centre(points, span)?),
        Function::Curvature => Value::Number(curvature(points[0], span)?),
        _ => unreachable!("`{}` is no function of moving points", function.name()),
    };
    finite(value, span)
}

/// Angular velocity and acceleration of the direction from one point to another.
fn turning<T: Real>(
    a: MovingPoint<T>,
    b: MovingPoint<T>,
    span: Span,
) -> Result<(T, T), Diagnostic> {
    let r = b.at - a.at;
    let (v, acceleration) = (b.velocity - a.velocity, b.acceleration - a.acceleration);
    let square = r.dot(r);
    if square.value() == 0.0 {
        return Err(Diagnostic::error(
            errors::NO_DIRECTION,
            "two points coincide, so there is no direction",
        )
        .at(span, "no angle"));
    }
    let omega = r.cross(v) / square;
    let stretching = T::constant(2.0) * r.dot(v) / square;
    Ok((omega, r.cross(acceleration) / square - stretching * omega))
}

/// The point at which the bodies that hold two lines have the same velocity.
fn instant_centre<T: Real>(points: &[MovingPoint<T>], span: Span) -> Result<Vec2<T>, Diagnostic> {
    let &[a, b, c, d] = points else { unreachable!("two lines have four ends") };
    let (omega, other) = (turning(a, b, span)?.0, turning(c, d, span)?.0);
    let difference = omega - other;
    let largest = omega.value().abs().max(other.value().abs());
    if difference.value().abs() <= SAME * largest {
        let why = if largest == 0.0 { "neither turns now" } else { "both turn alike now" };
        return Err(Diagnostic::error(errors::NO_DIRECTION, "these bodies have no instant centre")
            .at(span, why)
            .help("where nothing drives a mechanism it stands still, and has none"));
    }
    // v_A + omega J (P - A) = v_C + other J (P - C), with J a quarter turn.
    let v = a.velocity - c.velocity;
    let lever = a.at.scale(omega) - c.at.scale(other);
    let at = lever + Vec2 { x: -v.y, y: v.x };
    Ok(Vec2 { x: at.x / difference, y: at.y / difference })
}

/// The curvature of the path of a point, the inverse of its radius.
fn curvature<T: Real>(p: MovingPoint<T>, span: Span) -> Result<T, Diagnostic> {
    let square = p.velocity.dot(p.velocity);
    if square.value() == 0.0 {
        return Err(Diagnostic::error(
            errors::NO_DIRECTION,
            "the point stands still, so its path has no curvature",
        )
        .at(span, "its velocity is 0"));
    }
    Ok(p.velocity.cross(p.acceleration) / (square * square.sqrt()))
}
