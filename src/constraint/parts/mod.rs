//! What the kinds are made of.

pub mod bounds;
pub mod content;
pub mod function;
pub mod geometry;
pub mod jet;
pub mod line;
pub mod linear;
pub mod program;
pub mod row;
pub mod turns;
pub mod vec2;
pub mod winding;
