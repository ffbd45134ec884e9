//! Planar mechanisms: a command language, a session and a batch interpreter.

#[cfg(feature = "terminal")]
pub mod cli;
pub mod constraint;
pub mod diag;
pub mod lang;
pub mod linalg;
pub mod mobility;
pub mod render;
#[cfg(feature = "terminal")]
mod repl;
pub mod session;
pub mod solve;
pub mod study;
pub mod world;
