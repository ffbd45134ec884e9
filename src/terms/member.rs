//! The members of things: what an expression may ask of a thing behind a dot.

/// What of a thing is asked for: `crank.angle`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Member {
    /// The angle of a motor with its phase, going on past a half turn.
    Angle,
    /// What a constraint measures now.
    Value,
    /// By how much a constraint is missed, with its sign.
    Residual,
    /// The radius of a circle or an arc.
    Radius,
}

impl Member {
    /// Every member, in the order of the reference.
    pub const ALL: [Self; 4] = [Self::Angle, Self::Value, Self::Residual, Self::Radius];

    /// How it is asked for.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Angle => "angle",
            Self::Value => "value",
            Self::Residual => "residual",
            Self::Radius => "radius",
        }
    }

    /// The member that a word asks for.
    pub fn named(word: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|member| member.word() == word)
    }

    /// Whether it follows from the constraints, so that none of them can be made of it.
    pub const fn follows(self) -> bool {
        matches!(self, Self::Residual)
    }
}
