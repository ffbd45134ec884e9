//! Laws over random input: what holds for every scene, session, text and matrix.

mod claims;
mod constraint;
mod journal;
mod lang;
mod linalg;
mod ongoing;
mod random_command;
mod random_constraint;
mod random_measure;
mod random_scene;
pub mod random_session;
mod random_touch;
mod scenes;
mod session;
mod solve;
mod steadfast;
