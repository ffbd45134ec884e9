//! From constraints to positions: the paper's method and what goes beyond it.

pub mod linear;
pub mod mobility;
