//! The solver on mechanisms whose answers are known.

mod hard;
mod memory;
mod motion;
mod rates;
mod replaced;
