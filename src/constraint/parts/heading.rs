//! Where a motor points.

use super::geometry::Vector;
use super::turns::Turns;

/// All that time changes of a motor.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Heading {
    /// How far it has turned since it was made.
    pub(crate) turned: Turns,
    /// Where the driven point belongs, from the centre, if the angle is measured from the x axis.
    pub(crate) target: Vector,
}

impl Heading {
    /// Where the driven point belongs, from the centre, if the angle is measured from the x axis.
    pub const fn target(self) -> Vector {
        self.target
    }

    /// Whether another is the same to the bit.
    pub fn is_same(&self, other: Self) -> bool {
        let bits = |heading: Self| {
            let [whole, hi, lo] = heading.turned.to_numbers();
            [whole, hi, lo, heading.target.x, heading.target.y].map(f64::to_bits)
        };
        bits(*self) == bits(other)
    }
}
