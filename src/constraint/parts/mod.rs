//! What the kinds are made of.

pub mod bounds;
pub mod carried_crank;
pub mod content;
pub(crate) mod directions;
pub(crate) mod drive;
pub mod function;
pub mod gearing;
pub mod geometry;
pub mod heading;
pub mod jet;
pub mod line;
pub mod linear;
pub(crate) mod mesh;
pub mod program;
pub mod row;
pub(crate) mod sines;
pub mod turns;
pub mod two_rows;
pub mod vec2;
pub mod winding;
