//! The solver on mechanisms whose answers are known.

mod bodies;
mod closed_form;
mod hands;
mod hard;
mod live_ratio;
mod live_values;
mod memory;
mod motion;
mod rates;
mod replaced;
mod settings;
