//! Planar mechanisms: a command language, a session and a batch interpreter.

pub mod constraint;
pub mod diag;
pub mod lang;
pub mod render;
pub mod world;
