//! The units that a number can be typed in.

use std::f64::consts::{PI, TAU};

/// The suffix of a number.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Unit {
    /// No suffix.
    None,
    /// Degrees.
    Deg,
    /// Radians.
    Rad,
    /// Turns.
    Rev,
    /// Turns per minute.
    Rpm,
    /// Seconds.
    S,
    /// Milliseconds.
    Ms,
}

impl Unit {
    /// Every suffix, [`Unit::None`] left out.
    pub const ALL: [Self; 6] = [Self::Deg, Self::Rad, Self::Rev, Self::Rpm, Self::S, Self::Ms];

    /// How it is written.
    pub const fn suffix(self) -> &'static str {
        match self {
            Self::None => "",
            Self::Deg => "deg",
            Self::Rad => "rad",
            Self::Rev => "rev",
            Self::Rpm => "rpm",
            Self::S => "s",
            Self::Ms => "ms",
        }
    }

    /// What a number with it is multiplied by.
    pub const fn scale(self) -> f64 {
        match self {
            Self::None | Self::Rad | Self::S => 1.0,
            Self::Deg => PI / 180.0,
            Self::Rev => TAU,
            Self::Rpm => TAU / 60.0,
            Self::Ms => 1e-3,
        }
    }
}
