//! Arithmetic on values: operators and functions, with errors that point at their place.

use super::Value;
use crate::constraint::{Real, Vec2, length, limited_argument, power, value_of};
use crate::diag::{Diagnostic, Span, format_number};
use crate::errors;
use crate::terms::{Function, Operator};

/// The value itself if it is finite.
///
/// # Errors
/// Where it is not.
pub fn finite<T: Real>(value: Value<T>, span: Span) -> Result<Value<T>, Diagnostic> {
    if value.is_finite() {
        Ok(value)
    } else {
        Err(Diagnostic::error(errors::NO_VALUE, "this has no finite value").at(span, "overflows"))
    }
}

/// The result of an operator between values whose shapes fit.
///
/// # Errors
/// A division by zero, a power without a real value, an overflow; `span` is the place of the
/// operation, `right` that of its second operand.
pub fn operate<T: Real>(
    operator: Operator,
    a: Value<T>,
    b: Value<T>,
    span: Span,
    right: Span,
) -> Result<Value<T>, Diagnostic> {
    use Value::{Number, Vector};
    let value = match (operator, a, b) {
        (Operator::Add, Number(a), Number(b)) => Number(a + b),
        (Operator::Subtract, Number(a), Number(b)) => Number(a - b),
        (Operator::Multiply, Number(a), Number(b)) => Number(a * b),
        (Operator::Add, Vector(a), Vector(b)) => Vector(a + b),
        (Operator::Subtract, Vector(a), Vector(b)) => Vector(a - b),
        (Operator::Multiply, Number(k), Vector(v)) | (Operator::Multiply, Vector(v), Number(k)) => {
            Vector(v.scale(k))
        }
        (Operator::Divide, _, Number(b)) if b.value() == 0.0 => {
            return Err(
                Diagnostic::error(errors::NO_VALUE, "division by zero").at(right, "this is 0")
            );
        }
        (Operator::Divide, Number(a), Number(b)) => Number(a / b),
        (Operator::Divide, Vector(v), Number(b)) => Vector(Vec2 { x: v.x / b, y: v.y / b }),
        (Operator::Power, Number(a), Number(b)) => Number(power(a, b).ok_or_else(|| {
            let what = if a.value() == 0.0 {
                "0 to a negative power"
            } else {
                "a negative number to a power that is not whole"
            };
            Diagnostic::error(errors::NO_VALUE, "this power has no value").at(span, what)
        })?),
        _ => unreachable!("shapes are checked when a formula is bound"),
    };
    finite(value, span)
}

/// The value of a function, rates of points excepted.
///
/// # Errors
/// Outside the function's domain.
pub fn call<T: Real>(
    function: Function,
    arguments: &[Value<T>],
    span: Span,
) -> Result<Value<T>, Diagnostic> {
    use Value::{Number, Vector};
    let number = |k: usize| arguments[k].number();
    let vector = |k: usize| arguments[k].vector();
    let value = match function {
        Function::Norm => Number(length(vector(0))),
        Function::Dot => Number(vector(0).dot(vector(1))),
        Function::Cross => Number(vector(0).cross(vector(1))),
        Function::Rotate => {
            let phi = number(1);
            Vector(vector(0).times(Vec2 { x: phi.cos(), y: phi.sin() }))
        }
        Function::Polar => {
            let phi = number(1);
            Vector(Vec2 { x: phi.cos(), y: phi.sin() }.scale(number(0)))
        }
        Function::Midpoint => Vector((vector(0) + vector(1)).scale(T::constant(0.5))),
        Function::Distance => Number(length(vector(1) - vector(0))),
        Function::DistanceToLine => {
            let (p, a, b) = (vector(0), vector(1), vector(2));
            let l = length(b - a);
            if l.value() == 0.0 {
                return Err(Diagnostic::error(
                    errors::NO_DIRECTION,
                    "the two points of the line coincide",
                )
                .at(span, "no line to measure from"));
            }
            Number((b - a).cross(p - a) / l)
        }
        Function::Angle | Function::Turn => {
            let v = vector(1) - vector(0);
            angle(v.x, v.y, span)?
        }
        Function::AngleBetween | Function::TurnBetween => {
            let (u, v) = (vector(1) - vector(0), vector(3) - vector(2));
            angle(u.dot(v), u.cross(v), span)?
        }
        Function::Clamp => Number(clamp([0, 1, 2].map(number), span)?),
        _ if function.is_rate() => unreachable!("rates are not functions of values"),
        _ => {
            let mut few = [T::constant(0.0); 4];
            let value = if let Some(few) = few.get_mut(..arguments.len()) {
                few.iter_mut().zip(arguments).for_each(|(n, argument)| *n = argument.number());
                value_of(function, few)
            } else {
                value_of(function, &arguments.iter().map(|a| a.number()).collect::<Vec<T>>())
            };
            Number(value.ok_or_else(|| {
                let given = number(limited_argument(function)).value();
                let at = format_number(given);
                Diagnostic::error(
                    errors::NO_VALUE,
                    format!("`{}` has no value at {at}", function.name()),
                )
                .at(span, "outside its domain")
            })?)
        }
    };
    finite(value, span)
}

fn angle<T: Real>(x: T, y: T, span: Span) -> Result<Value<T>, Diagnostic> {
    if x.value() == 0.0 && y.value() == 0.0 {
        return Err(Diagnostic::error(
            errors::NO_DIRECTION,
            "two points coincide, so there is no direction",
        )
        .at(span, "no angle"));
    }
    Ok(Value::Number(y.atan2(x)))
}

/// x, but no less than the least and no more than the greatest.
fn clamp<T: Real>([x, lo, hi]: [T; 3], span: Span) -> Result<T, Diagnostic> {
    if lo.value() > hi.value() {
        let [lo, hi] = [lo, hi].map(|end| format_number(end.value()));
        return Err(Diagnostic::error(errors::NO_VALUE, "`clamp` has an empty range")
            .at(span, format!("its least value, {lo}, is above its greatest, {hi}")));
    }
    Ok(match x.value() {
        v if v < lo.value() => lo,
        v if v > hi.value() => hi,
        _ => x,
    })
}
