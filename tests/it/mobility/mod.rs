//! What can move, how far, and why not, on mechanisms whose answers are known.

mod analysis;
mod drivers;
mod explain;
mod limits;
