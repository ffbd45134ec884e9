//! What commands do to a mechanism that moves, and which thing a name means.

mod hosts;
mod names;
mod picture_hash;
mod saved;
mod start_and_switch;
mod undo;
mod verdict;
