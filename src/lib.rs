//! Planar mechanisms: a command language, a session and a batch interpreter.

pub mod constraint;
pub mod solve;
