//! Every kind of constraint, in one table.

use super::{
    Cog, CogVelocity, Coincidence, Coordinate, Distance, Equal, Equivalence, Field, Glider, Hinge,
    Length, Motor, Orientation, Place, Point, PointIdx, Rack, Real, Relation, Rigid, Row, Vector,
};

/// Hands the table of kinds to a macro: the place among the batches, the kind, how a
/// [`Constraint`] holds it, its word in the command language. Large ones are held in a box, so
/// that a bar takes no more room than a bar. A new kind is one more line, at the end.
macro_rules! with_kinds {
    ($then:ident) => {
        $then! {
            coordinate Coordinate (Coordinate) "coordinate",
            coincidence Coincidence (Coincidence) "coincidence",
            equivalence Equivalence (Equivalence) "equivalence",
            equal Equal (Equal) "equal",
            length Length (Length) "length",
            orientation Orientation (Orientation) "orientation",
            motor Motor (Motor) "motor",
            glider Glider (Glider) "glider",
            hinge Hinge (Hinge) "hinge",
            cog Cog (Box<Cog>) "cog",
            cog_velocity CogVelocity (Box<CogVelocity>) "cog",
            distance Distance (Distance) "distance",
            rigid Rigid (Rigid) "rigid",
            rack Rack (Rack) "rack",
        }
    };
}
pub(super) use with_kinds;

/// The methods of [`Relation`] that only look, for an enum with one variant a kind.
macro_rules! reads {
    ($vis:vis [$($Name:ident)*]) => {
        /// See [`Relation::points`].
        $vis fn points(&self) -> &[PointIdx] {
            match self { $(Self::$Name(c) => c.points(),)* }
        }
        /// See [`Relation::n_rows`].
        $vis fn n_rows(&self) -> usize {
            match self { $(Self::$Name(c) => c.n_rows(),)* }
        }
        /// See [`Relation::residual`].
        $vis fn residual(&self, x: &[Point]) -> f64 {
            match self { $(Self::$Name(c) => c.residual(x),)* }
        }
        /// See [`Relation::correct`].
        $vis fn correct(&self, x: &[Point], w: &[f64], move_by: &mut impl FnMut(PointIdx, Vector)) {
            match self { $(Self::$Name(c) => c.correct(x, w, move_by),)* }
        }
        /// See [`Relation::jacobian`].
        $vis fn jacobian(&self, x: &[Point], row: &mut impl FnMut(Row)) {
            match self { $(Self::$Name(c) => c.jacobian(x, row),)* }
        }
        /// See [`Relation::equations`].
        $vis fn equations<T: Real>(
            &self,
            x: &impl Fn(PointIdx) -> Place<T>,
            field: &impl Fn(Field, f64) -> T,
            equation: &mut impl FnMut(T),
        ) {
            match self { $(Self::$Name(c) => c.equations(x, field, equation),)* }
        }
        /// See [`Relation::get`].
        $vis fn get(&self, field: Field) -> Option<f64> {
            match self { $(Self::$Name(c) => c.get(field),)* }
        }
        /// See [`Relation::state`].
        $vis fn state(&self) -> Option<Vec<f64>> {
            match self { $(Self::$Name(c) => c.state(),)* }
        }
        /// See [`Relation::captured`].
        $vis fn captured(&self) -> Vec<f64> {
            match self { $(Self::$Name(c) => c.captured(),)* }
        }
        /// See [`Relation::violation`].
        $vis fn violation(&self, x: &[Point], w: &[f64]) -> f64 {
            match self { $(Self::$Name(c) => c.violation(x, w),)* }
        }
    };
}

/// The methods of [`Relation`] that change something.
macro_rules! writes {
    ($vis:vis [$($Name:ident)*]) => {
        /// See [`Relation::points_mut`].
        $vis fn points_mut(&mut self) -> &mut [PointIdx] {
            match self { $(Self::$Name(c) => c.points_mut(),)* }
        }
        /// See [`Relation::set`].
        $vis fn set(&mut self, field: Field, value: f64) -> bool {
            match self { $(Self::$Name(c) => c.set(field, value),)* }
        }
        /// See [`Relation::set_state`].
        $vis fn set_state(&mut self, state: &[f64]) {
            match self { $(Self::$Name(c) => c.set_state(state),)* }
        }
        /// See [`Relation::set_captured`].
        $vis fn set_captured(&mut self, captured: &[f64]) {
            match self { $(Self::$Name(c) => c.set_captured(captured),)* }
        }
        /// See [`Relation::pick_up`].
        $vis fn pick_up(&mut self, x: &[Point]) {
            match self { $(Self::$Name(c) => c.pick_up(x),)* }
        }
        /// See [`Relation::advance`].
        $vis fn advance(&mut self, dt: f64) -> bool {
            match self { $(Self::$Name(c) => c.advance(dt),)* }
        }
        /// See [`Relation::begin_frame`].
        $vis fn begin_frame(&mut self, x: &[Point], dt: f64) {
            match self { $(Self::$Name(c) => c.begin_frame(x, dt),)* }
        }
        /// See [`Relation::accept`].
        $vis fn accept(&mut self, x: &[Point]) {
            match self { $(Self::$Name(c) => c.accept(x),)* }
        }
    };
}

macro_rules! define {
    ($($batch:ident $Name:ident ($Held:ty) $word:literal,)*) => {
        /// A constraint of any kind.
        #[derive(Debug, Clone, PartialEq)]
        pub enum Constraint {
            $(
                #[doc = concat!("See [`", stringify!($Name), "`](super::", stringify!($Name), ").")]
                $Name($Held),
            )*
        }

        /// A constraint of any kind, borrowed.
        #[derive(Debug, Clone, Copy)]
        pub enum ConstraintRef<'a> {
            $(
                #[doc = concat!("See [`", stringify!($Name), "`](super::", stringify!($Name), ").")]
                $Name(&'a $Name),
            )*
        }

        /// A constraint of any kind, borrowed for a change.
        #[derive(Debug)]
        pub enum ConstraintMut<'a> {
            $(
                #[doc = concat!("See [`", stringify!($Name), "`](super::", stringify!($Name), ").")]
                $Name(&'a mut $Name),
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

        impl Relation for Constraint {
            reads!([$($Name)*]);
            writes!([$($Name)*]);
        }

        impl ConstraintRef<'_> {
            reads!(pub [$($Name)*]);
        }

        impl ConstraintMut<'_> {
            writes!(pub [$($Name)*]);
        }

        impl Constraint {
            /// Its kind.
            pub const fn kind(&self) -> Kind {
                match self {
                    $(Self::$Name(_) => Kind::$Name,)*
                }
            }

            /// The same, borrowed.
            pub fn as_ref(&self) -> ConstraintRef<'_> {
                match self {
                    $(Self::$Name(c) => ConstraintRef::$Name(c),)*
                }
            }

            /// Renumbers its points.
            pub fn map_points(&mut self, mut renumber: impl FnMut(PointIdx) -> PointIdx) {
                for p in self.points_mut() {
                    *p = renumber(*p);
                }
            }
        }

        impl ConstraintRef<'_> {
            /// Its kind.
            pub const fn kind(&self) -> Kind {
                match self {
                    $(Self::$Name(_) => Kind::$Name,)*
                }
            }

            /// A copy of its own.
            pub fn to_constraint(&self) -> Constraint {
                match self {
                    $(Self::$Name(c) => (*c).clone().into(),)*
                }
            }
        }
    };
}
with_kinds!(define);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bar_is_small() {
        assert_eq!([size_of::<Length>(), size_of::<Constraint>()], [24, 64]);
    }
}
