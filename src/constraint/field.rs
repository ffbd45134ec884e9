//! The values of a constraint, by name.

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
    /// The ratio of a hinge, of a cog wheel pair or of two lengths.
    Ratio,
    /// The teeth of the first of two wheels, where they are geared by these.
    FirstTeeth,
    /// The teeth of the second.
    SecondTeeth,
}

impl Field {
    /// All of them.
    pub const ALL: [Self; 10] = [
        Self::Lo,
        Self::Hi,
        Self::X,
        Self::Y,
        Self::Radius,
        Self::Speed,
        Self::Phase,
        Self::Ratio,
        Self::FirstTeeth,
        Self::SecondTeeth,
    ];

    /// Whether it says how two wheels are geared.
    pub const fn is_of_gearing(self) -> bool {
        matches!(self, Self::Ratio | Self::FirstTeeth | Self::SecondTeeth)
    }
}
