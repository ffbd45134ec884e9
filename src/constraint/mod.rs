//! The constraints of section 3 of the paper and what goes beyond them, one file each.
//!
//! Every file of `kinds` defines the struct, its points, the residual (the paper's `f`), the
//! correction (the paper's `A_a`, weighted and exact: `f(x + d) = 0`), the linearised rows, the
//! same equations over jets, and what the kind says of itself ([`Traits`]). Nothing here knows names, settings or files, looks at another
//! constraint, or allocates while relaxing.
//!
//! ```
//! use linkwork::constraint::{Bounds, Constraint, Length, Point, ConstraintKind};
//!
//! let mut x = [Point::new(0.0, 0.0), Point::new(5.0, 0.0)];
//! let w = [0.0, 1.0]; // the first point is frozen
//! let rod = Constraint::from(Length { points: [0, 1], bounds: Bounds::exactly(3.0) });
//! assert_eq!(rod.residual(&x), 2.0);
//!
//! rod.correct(&x.clone(), &w, &mut |point, d| x[point as usize] += d);
//! assert_eq!(x[1], Point::new(3.0, 0.0));
//! ```

mod constraint_kind;
mod field;
mod given;
mod kinds;
mod parts;
mod traits;

pub use constraint_kind::{ConstraintKind, Stateful, Stateless};
pub use field::Field;
pub use given::{Culprit, Declared, Given, Refusal};
pub use kinds::*;
pub use parts::bounds::Bounds;
pub(crate) use parts::directions::directions;
pub(crate) use parts::function::{length, limited_argument, power, value_of};
#[doc(hidden)]
pub use parts::geometry;
pub use parts::geometry::{Point, Vector};
pub use parts::heading::Heading;
#[doc(hidden)]
pub use parts::jet::{Jet, Real};
pub(crate) use parts::mesh::{Counts, Mesh};
#[doc(hidden)]
pub use parts::program::{Operation, Program, Register};
pub use parts::row::PointIdx;
#[doc(hidden)]
pub use parts::row::Row;
pub(crate) use parts::sines::sines_and_cosines;
pub use parts::turns::Turns;
pub use parts::vec2::Vec2;
pub(crate) use parts::winding::Winding;
pub use traits::{Activity, Carried, Flag, Flaw, LARGEST, Quantity, Traits};
