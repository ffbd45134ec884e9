//! The values of a constraint, by name.

/// A value of a constraint that an expression may drive, in the order in which `save` writes
/// several of one constraint.
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
    /// The angle of a motor at its start, radians.
    Phase,
    /// The angular speed of a motor, radians per time unit.
    Speed,
    /// The ratio of a hinge, of a cog wheel pair or of two lengths.
    Ratio,
    /// The teeth of the first of two wheels, where they are geared by these.
    FirstTeeth,
    /// The teeth of the second.
    SecondTeeth,
    /// What is measured: the number, or the horizontal coordinate of the vector.
    Value,
    /// The vertical coordinate of the vector that is measured.
    ValueY,
    /// What something measured is compared with.
    Wanted,
    /// How far something is beyond its end stop.
    Beyond,
    /// What the values that are measured on the pose are given from outside, by its place.
    Input(u16),
}

impl Field {
    /// All that a statement may give.
    pub const ALL: [Self; 14] = [
        Self::Lo,
        Self::Hi,
        Self::X,
        Self::Y,
        Self::Radius,
        Self::Phase,
        Self::Speed,
        Self::Ratio,
        Self::FirstTeeth,
        Self::SecondTeeth,
        Self::Value,
        Self::ValueY,
        Self::Wanted,
        Self::Beyond,
    ];

    /// Whether it says how two wheels are geared.
    pub const fn is_of_gearing(self) -> bool {
        matches!(self, Self::Ratio | Self::FirstTeeth | Self::SecondTeeth)
    }
}
