//! Handles of what a world holds, in the order in which it was made. One is given out again only where
//! nothing can have it any more.

macro_rules! id {
    ($(#[$doc:meta])* $name:ident) => {
        $(#[$doc])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub struct $name(pub u32);

        impl $name {
            /// The handle of the column entry `idx`.
            pub fn new(idx: usize) -> Self {
                Self(u32::try_from(idx).expect("a world holds fewer than 2^32 of a kind"))
            }

            /// The entry in the columns.
            pub const fn idx(self) -> usize {
                self.0 as usize
            }
        }
    };
}

id!(
    /// A point.
    PointId
);
id!(
    /// A constraint.
    ConstraintId
);
id!(
    /// A parameter.
    ParameterId
);

id!(
    /// A measure.
    MeasureId
);

/// Anything that has a name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Entity {
    /// A point.
    Point(PointId),
    /// A constraint.
    Constraint(ConstraintId),
    /// A parameter.
    Parameter(ParameterId),
    /// A measure.
    Measure(MeasureId),
}

impl Entity {
    /// What it is, for a message.
    pub const fn noun(self) -> &'static str {
        match self {
            Self::Point(_) => "point",
            Self::Constraint(_) => "constraint",
            Self::Parameter(_) => "parameter",
            Self::Measure(_) => "measure",
        }
    }
}
