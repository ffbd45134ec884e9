//! What a user prefers.

use crate::solve::Settings;
use crate::world::Extremes;

/// Everything that `set` sets but the length of a frame, which belongs to the clock.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Preferences {
    /// How the solver works.
    pub solve: Settings,
    /// What happens where a motor cannot go on.
    pub dead_points: AtDeadPoint,
    /// A ghost of the mechanism is kept every so many frames.
    pub expose_every: Option<u64>,
    /// Whether extremes of measures are looked for between frames.
    pub measures: Extremes,
    /// How much is said of a run at its end.
    pub receipt: Receipt,
    /// Whether each edit is followed by a solution.
    pub is_live: bool,
}

/// How much is said of a run at its end.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Receipt {
    /// The time now, the frames, how exact they are.
    #[default]
    Short,
    /// How it was solved, and at what price.
    Long,
}

impl Receipt {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Short, Self::Long];

    /// The word of the command language.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Short => "short",
            Self::Long => "long",
        }
    }
}

/// What happens where a motor cannot go on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum AtDeadPoint {
    /// The run ends with the last frame that was solved.
    Stop,
    /// The motor turns on; the points stay as near as they can until they can follow again.
    #[default]
    Hold,
    /// The motor turns back.
    Reverse,
}

impl AtDeadPoint {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Stop, Self::Hold, Self::Reverse];

    /// The word of the command language.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Stop => "stop",
            Self::Hold => "hold",
            Self::Reverse => "reverse",
        }
    }
}
