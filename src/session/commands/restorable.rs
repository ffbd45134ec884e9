//! What `restore` brings back: `save` writes it by the same words.

use crate::world::{PointId, World};

/// The version of what `save` writes: one more where an older program would read it wrong.
pub const VERSION: f64 = 1.0;

/// A piece of state that no other statement can bring back.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Restorable {
    /// Frame, time of a frame, and the frame and time at which that took its value.
    Clock,
    /// Where `reset` puts a point.
    Start,
    /// What running changes of a constraint.
    State,
    /// The state that `reset` brings back.
    FirstState,
    /// What a constraint took from the pose at its creation.
    Captured,
    /// How far something has turned: its number of points, these by number, then whole turns and
    /// angle, and those that `reset` brings back.
    Turn,
    /// The values of a driven constraint.
    Values,
    /// The places of a trace.
    Trace,
    /// The places of a trace that missed the tolerance, by index.
    Missed,
    /// That a trace grows no more.
    Ended,
    /// What a measure has kept.
    Measure,
    /// A ghost: number of a point, its place, and so on.
    Ghost,
    /// What the solver remembers.
    Memory,
    /// The version of the file.
    Version,
    /// Whether what follows was there before: 1 or 0.
    Past,
    /// How far the next statement came, which was stopped. Journals have it, and no saved file.
    Stop,
}

impl Restorable {
    /// All of them.
    const ALL: [Self; 16] = [
        Self::Clock,
        Self::Start,
        Self::State,
        Self::FirstState,
        Self::Captured,
        Self::Turn,
        Self::Values,
        Self::Trace,
        Self::Missed,
        Self::Ended,
        Self::Measure,
        Self::Ghost,
        Self::Memory,
        Self::Version,
        Self::Past,
        Self::Stop,
    ];

    /// Its word in the statement.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Clock => "clock",
            Self::Start => "start",
            Self::State => "state",
            Self::FirstState => "firststate",
            Self::Captured => "captured",
            Self::Turn => "turn",
            Self::Values => "values",
            Self::Trace => "trace",
            Self::Missed => "missed",
            Self::Ended => "ended",
            Self::Measure => "measure",
            Self::Ghost => "ghost",
            Self::Memory => "memory",
            Self::Version => "version",
            Self::Past => "past",
            Self::Stop => "stop",
        }
    }

    /// What is meant by a word.
    pub fn named(word: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|what| what.word() == word)
    }
}

/// The living points in order: a saved world numbers them so.
pub fn ordinals(world: &World) -> Vec<PointId> {
    world.points().ids().collect()
}
