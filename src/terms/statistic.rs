//! What a measure keeps of its values: what an expression may ask of it behind a dot.

/// What of the values of a measure is asked for: `d.max`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Statistic {
    /// The least value.
    Min,
    /// The greatest value.
    Max,
    /// How far these two are apart.
    Span,
    /// The mean over time.
    Mean,
    /// The first value.
    First,
    /// The last value.
    Last,
    /// The time of the least value.
    AtMin,
    /// The time of the greatest value.
    AtMax,
    /// How many frames gave one.
    Count,
}

impl Statistic {
    /// All of them, in the order of the reference.
    pub const ALL: [Self; 9] = [
        Self::Min,
        Self::Max,
        Self::Span,
        Self::Mean,
        Self::First,
        Self::Last,
        Self::AtMin,
        Self::AtMax,
        Self::Count,
    ];

    /// How it is asked for.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Min => "min",
            Self::Max => "max",
            Self::Span => "span",
            Self::Mean => "mean",
            Self::First => "first",
            Self::Last => "last",
            Self::AtMin => "at_min",
            Self::AtMax => "at_max",
            Self::Count => "count",
        }
    }

    /// The one that a word asks for.
    pub fn named(word: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|statistic| statistic.word() == word)
    }
}
