//! Every kind of constraint, in one table.

pub mod cog;
pub mod cog_velocity;
pub mod coincidence;
pub mod coordinate;
pub mod distance;
pub mod equal;
pub mod equivalence;
pub mod glider;
pub mod hinge;
pub mod length;
pub mod motor;
pub mod orientation;
pub mod rack;
pub mod rigid;

use super::{
    Cog, CogVelocity, Coincidence, ConstraintKind, Coordinate, Distance, Equal, Equivalence, Field,
    Glider, Hinge, Length, Motor, Orientation, Point, PointIdx, Rack, Real, Rigid, Row, Vec2,
    Vector,
};

/// Hands a call on to whatever kind a constraint is of.
macro_rules! each {
    ($self:ident [$($Name:ident)*] $c:ident => $call:expr) => {
        match $self { $(Self::$Name($c) => $call,)* }
    };
}

macro_rules! define {
    ($($Name:ident ($Held:ty) $word:literal,)*) => {
        /// A constraint of any kind.
        #[derive(Debug, Clone, PartialEq)]
        pub enum Constraint {
            $(
                #[doc = concat!("See [`", stringify!($Name), "`](super::", stringify!($Name), ").")]
                $Name($Held),
            )*
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

            /// The word of the command language that states it. `parallel` and
            /// `perpendicular` state an orientation too.
            pub const fn word(self) -> &'static str {
                match self {
                    $(Self::$Name => $word,)*
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
            fn state(&self) -> Option<Vec<f64>> {
                each!(self [$($Name)*] c => c.state())
            }
            fn set_state(&mut self, state: &[f64]) {
                each!(self [$($Name)*] c => c.set_state(state))
            }
            fn captured(&self) -> Vec<f64> {
                each!(self [$($Name)*] c => c.captured())
            }
            fn set_captured(&mut self, captured: &[f64]) {
                each!(self [$($Name)*] c => c.set_captured(captured))
            }
            fn violation(&self, x: &[Point], w: &[f64]) -> f64 {
                each!(self [$($Name)*] c => c.violation(x, w))
            }
            fn pick_up(&mut self, x: &[Point]) {
                each!(self [$($Name)*] c => c.pick_up(x))
            }
            fn advance(&mut self, dt: f64) -> bool {
                each!(self [$($Name)*] c => c.advance(dt))
            }
            fn begin_frame(&mut self, x: &[Point], dt: f64) {
                each!(self [$($Name)*] c => c.begin_frame(x, dt))
            }
            fn accept(&mut self, x: &[Point]) {
                each!(self [$($Name)*] c => c.accept(x))
            }
        }

        impl Constraint {
            /// Its kind.
            pub const fn kind(&self) -> Kind {
                match self {
                    $(Self::$Name(_) => Kind::$Name,)*
                }
            }

            /// Renumbers its points.
            pub fn map_points(&mut self, mut renumber: impl FnMut(PointIdx) -> PointIdx) {
                for p in self.points_mut() {
                    *p = renumber(*p);
                }
            }
        }
    };
}

// How a constraint holds each kind, and the word of the command language. Large ones are held in
// a box, so that a bar takes no more room than a bar. A new kind is one more line, at the end.
define! {
    Coordinate (Coordinate) "coordinate",
    Coincidence (Coincidence) "coincidence",
    Equivalence (Equivalence) "equivalence",
    Equal (Equal) "equal",
    Length (Length) "length",
    Orientation (Orientation) "orientation",
    Motor (Motor) "motor",
    Glider (Glider) "glider",
    Hinge (Hinge) "hinge",
    Cog (Box<Cog>) "cog",
    CogVelocity (Box<CogVelocity>) "cog",
    Distance (Distance) "distance",
    Rigid (Rigid) "rigid",
    Rack (Rack) "rack",
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bar_is_small() {
        assert_eq!([size_of::<Length>(), size_of::<Constraint>()], [24, 64]);
    }
}
