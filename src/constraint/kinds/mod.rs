//! Every kind of constraint, in one table.

mod aligned;
mod cog;
mod cog_velocity;
mod coincidence;
mod coordinate;
mod curve;
mod distance;
mod equal;
mod equivalence;
mod glider;
mod hinge;
mod hold;
mod length;
mod measured;
mod motor;
mod orientation;
mod rack;
mod rigid;
mod symmetric;
mod touch;

pub use aligned::{Aligned, AxisDirection};
pub use cog::{Cog, Contact};
pub use cog_velocity::CogVelocity;
pub use coincidence::Coincidence;
pub use coordinate::Coordinate;
pub use curve::Curve;
pub use distance::Distance;
pub use equal::Equal;
pub use equivalence::Equivalence;
pub use glider::Glider;
pub use hinge::Hinge;
pub use hold::Hold;
pub use length::Length;
pub use measured::Measured;
pub use motor::Motor;
pub use orientation::{Orientation, Period};
pub use rack::Rack;
pub use rigid::Rigid;
pub use symmetric::Symmetric;
pub use touch::{Sort, Stops, Touch};

use std::borrow::Cow;

use super::{
    ConstraintKind, Declared, Field, Given, Point, PointIdx, Real, Refusal, Row, Stateful, Traits,
    Vec2, Vector,
};

/// Hands a call on to whatever kind a constraint is of.
macro_rules! each {
    ($self:ident [$($Name:ident)*] $c:ident => $call:expr) => {
        match $self {
            $(Self::$Name($c) => $call,)*
            Self::Measured($c) => $call,
        }
    };
}

macro_rules! define {
    ($($Name:ident ($Held:ty),)*) => {
        /// A constraint of any kind.
        #[derive(Debug, Clone, PartialEq)]
        pub enum Constraint {
            $(
                #[doc = concat!("See [`", stringify!($Name), "`](super::", stringify!($Name), ").")]
                $Name($Held),
            )*
            /// One of these kinds, with values that are measured on the pose.
            Measured(Box<Measured>),
        }

        /// The kinds of constraint; their order is the order of evaluation.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum Kind {
            $(
                #[doc = concat!("See [`", stringify!($Name), "`](super::", stringify!($Name), ").")]
                $Name,
            )*
        }

        impl Kind {
            /// Every kind, in order.
            pub const ALL: &'static [Self] = &[$(Self::$Name),*];

            /// The kind that a word of the command language states.
            pub fn stated_by(word: &str) -> Option<Self> {
                $(
                    if $Name::WORDS.contains(&word) {
                        return Some(Self::$Name);
                    }
                )*
                None
            }

            /// Makes a constraint of this kind.
            ///
            /// # Errors
            /// Points or a pose that allow none.
            pub fn declare(self, given: &Given) -> Result<Constraint, Refusal> {
                match self {
                    $(Self::$Name => $Name::declare(given).map(Constraint::from),)*
                }
            }
        }

        $(
            impl From<$Name> for Constraint {
                fn from(c: $Name) -> Self {
                    Self::$Name(c.into())
                }
            }
        )*

        impl From<Measured> for Constraint {
            fn from(c: Measured) -> Self {
                Self::Measured(c.into())
            }
        }

        impl ConstraintKind for Constraint {
            fn points(&self) -> &[PointIdx] {
                each!(self [$($Name)*] c => c.points())
            }
            fn points_mut(&mut self) -> &mut [PointIdx] {
                each!(self [$($Name)*] c => c.points_mut())
            }
            fn n_rows(&self) -> usize {
                each!(self [$($Name)*] c => c.n_rows())
            }
            fn residual(&self, x: &[Point]) -> f64 {
                each!(self [$($Name)*] c => c.residual(x))
            }
            fn correct(
                &self,
                x: &[Point],
                w: &[f64],
                move_by: &mut impl FnMut(PointIdx, Vector),
            ) {
                each!(self [$($Name)*] c => c.correct(x, w, move_by))
            }
            fn jacobian(&self, x: &[Point], row: &mut impl FnMut(Row)) {
                each!(self [$($Name)*] c => c.jacobian(x, row))
            }
            fn equations<T: Real>(
                &self,
                x: &impl Fn(PointIdx) -> Vec2<T>,
                field: &impl Fn(Field, f64) -> T,
                equation: &mut impl FnMut(T),
            ) {
                each!(self [$($Name)*] c => c.equations(x, field, equation))
            }
            fn get(&self, field: Field) -> Option<f64> {
                each!(self [$($Name)*] c => c.get(field))
            }
            fn set(&mut self, field: Field, value: f64) -> bool {
                each!(self [$($Name)*] c => c.set(field, value))
            }
            fn nominal_length(&self) -> f64 {
                each!(self [$($Name)*] c => c.nominal_length())
            }
            fn traits(&self) -> Traits {
                each!(self [$($Name)*] c => c.traits())
            }
            fn content(&self, word: &mut impl FnMut(u64)) {
                each!(self [$($Name)*] c => c.content(word))
            }
            fn violation(&self, x: &[Point], w: &[f64]) -> f64 {
                each!(self [$($Name)*] c => c.violation(x, w))
            }
        }

        impl Constraint {
            /// Its kind.
            pub const fn kind(&self) -> Kind {
                match self {
                    $(Self::$Name(_) => Kind::$Name,)*
                    Self::Measured(c) => c.base().kind(),
                }
            }

            /// See [`Stateful::state`].
            pub fn state(&self) -> Option<Vec<f64>> {
                each!(self [$($Name)*] c => c.state())
            }

            /// See [`Stateful::set_state`].
            pub fn set_state(&mut self, state: &[f64]) {
                each!(self [$($Name)*] c => c.set_state(state))
            }

            /// See [`Stateful::captured`].
            pub fn captured(&self) -> Vec<f64> {
                each!(self [$($Name)*] c => c.captured())
            }

            /// See [`Stateful::set_captured`].
            pub fn set_captured(&mut self, captured: &[f64]) {
                each!(self [$($Name)*] c => c.set_captured(captured))
            }

            /// See [`Stateful::pick_up`].
            pub fn pick_up(&mut self, x: &[Point]) {
                each!(self [$($Name)*] c => c.pick_up(x))
            }

            /// See [`Stateful::advance`].
            pub fn advance(&mut self, dt: f64) -> bool {
                each!(self [$($Name)*] c => c.advance(dt))
            }

            /// See [`Stateful::accept`].
            pub fn accept(&mut self, x: &[Point]) {
                each!(self [$($Name)*] c => c.accept(x))
            }
        }
    };
}

// How a constraint holds each kind. Large ones are held in
// a box, so that a bar takes no more room than a bar. A new kind is one more line, at the end.
define! {
    Coordinate (Coordinate),
    Coincidence (Coincidence),
    Equivalence (Equivalence),
    Equal (Equal),
    Length (Length),
    Orientation (Orientation),
    Motor (Motor),
    Glider (Glider),
    Hinge (Hinge),
    Cog (Box<Cog>),
    CogVelocity (Box<CogVelocity>),
    Distance (Distance),
    Rigid (Rigid),
    Rack (Rack),
    Aligned (Aligned),
    Symmetric (Symmetric),
    Hold (Hold),
    Curve (Curve),
    Touch (Box<Touch>),
}

impl Constraint {
    /// The constraint as it is stated, whether or not its values are measured on the pose; what is
    /// measured is as it was when it was made.
    pub const fn stated(&self) -> &Self {
        match self {
            Self::Measured(c) => c.base(),
            _ => self,
        }
    }

    /// The same, to be carried on.
    pub const fn stated_mut(&mut self) -> &mut Self {
        match self {
            Self::Measured(c) => c.base_mut(),
            _ => self,
        }
    }

    /// The constraint as it is stated, with its values as they are at a pose.
    pub fn at(&self, x: &[Point]) -> Cow<'_, Self> {
        match self {
            Self::Measured(c) => Cow::Owned(c.at(x)),
            _ => Cow::Borrowed(self),
        }
    }

    /// The circles and arcs that its statement names, by their handles.
    pub fn curves(&self) -> &[u32] {
        match self.stated() {
            Self::Touch(c) => c.curves(),
            _ => &[],
        }
    }

    /// Whether a value is measured on the pose.
    pub fn measures(&self, field: Field) -> bool {
        matches!(self, Self::Measured(c) if c.is_measured(field))
    }

    /// The values it has.
    pub fn fields(&self) -> impl Iterator<Item = Field> + use<> {
        let n_inputs = match self {
            Self::Measured(c) => c.n_inputs() as u16,
            _ => 0,
        };
        Field::ALL.into_iter().chain((0..n_inputs).map(Field::Input))
    }

    /// Renumbers its points.
    pub fn map_points(&mut self, mut renumber: impl FnMut(PointIdx) -> PointIdx) {
        for p in self.points_mut() {
            *p = renumber(*p);
        }
        if let Self::Measured(c) = self {
            c.share_points();
        }
    }

    /// Gives it other points, as many as it has.
    pub fn set_points(&mut self, points: &[PointIdx]) {
        self.points_mut().copy_from_slice(points);
        if let Self::Measured(c) = self {
            c.share_points();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bar_is_small() {
        assert_eq!([size_of::<Length>(), size_of::<Constraint>()], [24, 64]);
    }
}
