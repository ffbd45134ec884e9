//! Many runs of one script, each with other values: the grid, and one variant of it.

mod grid;
mod run;
mod table;
mod variant;

pub use grid::{Axis, Grid, Shard, parse_axis};
pub use run::{Refusal, Sweep};
pub use table::{Columns, picture_sheet};
pub use variant::{Failure, SweepScript, Variant};
