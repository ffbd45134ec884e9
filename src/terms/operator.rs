//! The arithmetic operations.

use super::Unit;

/// An operation of two operands.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Operator {
    /// `a + b`
    Add,
    /// `a - b`
    Subtract,
    /// `a * b`
    Multiply,
    /// `a / b`
    Divide,
    /// `a^b`
    Power,
}

impl Operator {
    /// The sign in the language.
    pub const fn sign(self) -> &'static str {
        match self {
            Self::Add => "+",
            Self::Subtract => "-",
            Self::Multiply => "*",
            Self::Divide => "/",
            Self::Power => "^",
        }
    }

    /// The unit that a result is best said in, from those of the operands: half of `90deg` is
    /// `45deg`.
    pub fn unit(self, left: Unit, right: Unit) -> Unit {
        match self {
            Self::Add | Self::Subtract if left == right => left,
            Self::Add | Self::Subtract | Self::Multiply if left == Unit::None => right,
            Self::Add | Self::Subtract | Self::Multiply | Self::Divide if right == Unit::None => {
                left
            }
            _ => Unit::None,
        }
    }
}
