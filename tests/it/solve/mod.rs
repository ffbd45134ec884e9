//! The solver on mechanisms whose answers are known.

mod blocks;
mod bodies;
mod closed_form;
mod edits;
mod hands;
mod hard;
mod live_ratio;
mod live_values;
mod memory;
mod motion;
mod rates;
mod replaced;
mod settings;
