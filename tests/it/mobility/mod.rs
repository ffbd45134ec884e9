//! What can move, how far, and why not, on mechanisms whose answers are known.

mod analysis;
mod explain;
mod limits;
