//! How values are written.

use crate::diag::{format_digits, format_number};
use crate::terms::Unit;
use crate::world::Value;

/// A value as `print` writes it.
pub(crate) fn format_value(value: Value) -> String {
    match value {
        Value::Number(n) => format_number(n),
        Value::Vector(v) => format!("({}, {})", format_number(v.x), format_number(v.y)),
    }
}

/// A value for readers, a number in a unit that is not the number's own.
pub(crate) fn format_value_in(value: Value, unit: Unit) -> String {
    match value {
        Value::Number(n) if unit != Unit::None => {
            // Fifteen digits are what a product of two numbers keeps.
            format!("{}{}", format_digits(n / unit.scale(), 15), unit.suffix())
        }
        value => format_value(value),
    }
}
