//! What a mechanism is drawn as, one file each: the points it hangs on, the room it takes,
//! how it is drawn.

mod angle;
mod arrows;
mod axis_mark;
mod bar;
mod construction;
mod cord;
mod crank;
mod cross;
mod dimension;
mod draw;
mod joint;
mod link;
mod multiple;
mod plate;
mod rail;
mod ring;
mod rod;
mod symbol;
mod symmetry;
mod teeth;
mod telescope;
mod ticks;
mod train;
mod web;

pub use angle::Angle;
pub use arrows::Arrows;
pub use axis_mark::AxisMark;
pub use construction::Construction;
pub use cord::Cord;
pub use crank::{Crank, Sense};
pub use cross::Cross;
pub use dimension::Dimension;
pub use joint::{Joint, Support};
pub use link::Link;
pub use multiple::Multiple;
pub use plate::Plate;
pub use rail::Rail;
pub use ring::Ring;
pub use rod::Rod;
pub use symbol::{Symbol, SymbolForm};
pub use symmetry::Symmetry;
pub use telescope::Telescope;
pub use ticks::Ticks;
pub use train::{Gears, Train};
pub use web::Web;
