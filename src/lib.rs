//! Planar mechanisms: a command language, a session and a batch interpreter.

pub mod cli;
pub mod constraint;
pub mod diag;
pub mod lang;
pub mod linalg;
pub mod mobility;
pub mod render;
pub mod repl;
pub mod session;
pub mod solve;
pub mod study;
pub mod world;
