//! What sort of a constraint one is, for those who treat all of a sort alike.

use crate::constraint::{Bounds, Field};

/// Coordinates and values of constraints are no larger: products of four of them are still
/// numbers. Nothing that is built comes near it, and what runs away to there is lost anyway.
pub const LARGEST: f64 = 1e60;

/// What a constraint says of itself besides its equations. There are no defaults: a kind that
/// forgets to answer does not compile.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Traits {
    /// The word of the command language that states it.
    pub word: &'static str,
    /// The unit of its residual.
    pub quantity: Quantity,
    /// The interval that its measured value has to lie in, if it is stated by one.
    pub bounds: Option<Bounds>,
    /// What of it binds at a pose at which it is met.
    pub activity: Activity,
    /// How many of its rows bind at every pose, for any one of its points. Two of them, of
    /// whatever constraints, determine a point.
    pub n_firm_rows: usize,
    /// Whether its rows are linear in each point, so that one step places a point exactly.
    pub is_linear: bool,
    /// Whether it counts the angles of wheels.
    pub is_wheel: bool,
    /// What it carries on from pose to pose.
    pub carried: Carried,
    /// The words that its statement has to say besides its points and values.
    pub flags: &'static [Flag],
    /// What is wrong with its values.
    pub flaw: Option<Flaw>,
}

/// What a residual is measured in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// Length units.
    Length,
    /// Radians.
    Angle,
    /// Whatever unit its expression has.
    Number,
}

/// What of a constraint binds at a pose at which it is met.
///
/// Two different things are asked of this. Whether a constraint acts on one side only, so that
/// the set of rows that bind depends on the pose, is `!= Always`: an end stop is such. Whether a
/// constraint that is met lets go of its points altogether, so that none of its rows has to be
/// kept, is `== Outside`: a glider between end stops stays on its line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Activity {
    /// The same rows, whatever the pose.
    Always,
    /// Some rows, whatever the pose; others only beyond an end stop.
    AtStops,
    /// Nothing: an inequality, which acts outside of its bounds only.
    Outside,
}

impl Activity {
    /// That of a single row with these bounds.
    pub(super) fn within(bounds: Bounds) -> Self {
        if bounds.is_equality() { Self::Always } else { Self::Outside }
    }
}

/// What a constraint carries on from pose to pose, and what moves it on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Carried {
    /// Nothing: it asks for the same whatever came before.
    Nothing,
    /// An angle that the clock turns on.
    ByClock,
    /// Angles, counted on from each pose that is accepted.
    ByPose,
    /// The pose at which a frame began: displacements since then stand for velocities. How long
    /// the frame is matters, and a motion in smaller steps is another one.
    ByFrame,
}

/// A word of a statement that stands for no value.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Flag {
    /// One wheel runs inside of the other.
    Inside,
    /// A belt crosses between its wheels.
    Crossed,
    /// The ends of a segment stop nothing.
    Unbounded,
}

/// Values that no pose could have.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Flaw {
    /// The lower bound lies above the upper one.
    EmptyRange,
    /// No angle within one turn ever leaves the range.
    WiderThanATurn,
    /// No length is so small.
    NegativeLength,
    /// No radius is so small.
    NegativeRadius,
    /// A circle of radius 0, or less.
    NoRadius,
    /// No wheel rolls on that.
    ZeroRadius,
    /// Wheels, one of which would have the radius 0.
    ZeroRatio,
    /// Wheels of which one would have a negative radius; a belt says otherwise how they turn.
    NegativeBeltRatio,
    /// A number of teeth of the first wheel that no wheel has.
    FirstTeeth,
    /// The same of the second wheel.
    SecondTeeth,
    /// Lengths, of which one would be 0 or less.
    RatioNotAboveZero,
}

impl Flaw {
    /// The value that is wrong; of a range, the upper one.
    pub const fn field(self) -> Field {
        match self {
            Self::EmptyRange | Self::WiderThanATurn | Self::NegativeLength => Field::Hi,
            Self::NegativeRadius | Self::ZeroRadius | Self::NoRadius => Field::Radius,
            Self::ZeroRatio | Self::RatioNotAboveZero | Self::NegativeBeltRatio => Field::Ratio,
            Self::FirstTeeth => Field::FirstTeeth,
            Self::SecondTeeth => Field::SecondTeeth,
        }
    }

    /// What it is, with its article.
    pub const fn noun(self) -> &'static str {
        match self {
            Self::EmptyRange => "an empty range",
            Self::WiderThanATurn => "a range of angles wider than one turn",
            Self::NegativeLength => "a negative length",
            Self::NegativeRadius => "a negative radius",
            Self::NoRadius => "a circle without size",
            Self::ZeroRadius => "a radius of 0",
            Self::ZeroRatio => "a ratio of 0",
            Self::NegativeBeltRatio => "a negative ratio",
            Self::FirstTeeth | Self::SecondTeeth => "an impossible number of teeth",
            Self::RatioNotAboveZero => "a ratio of lengths that is not above 0",
        }
    }

    /// That of bounds.
    pub(super) fn of_range(bounds: Bounds) -> Option<Self> {
        (bounds.lo > bounds.hi).then_some(Self::EmptyRange)
    }
}
