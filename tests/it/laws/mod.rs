//! Laws over random input: what holds for every scene, session, text and matrix.

mod constraint;
mod lang;
mod linalg;
mod scenes;
mod session;
mod solve;
