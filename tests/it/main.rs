//! What the library and the program promise, as one crate: a test is a line in a module, not a
//! binary of its own.

mod architecture;
mod golden;
mod hard_cases;
mod laws;
mod long_texts;
mod mobility;
mod program;
mod readme;
mod render;
mod reproducible;
mod scripts;
mod solve;
mod study;
mod support;
mod work;
