//! Files for machines, in true size: strokes for plotters, parts for cutters.

mod dxf;
mod lines;
mod members;
mod notation;
mod outlines;
mod parts;
mod plotter;
mod rounded;
mod sheet;

pub use dxf::dxf;
pub use outlines::outlines;
pub use parts::{Cut, Part, PartFlaw, parts};
pub use plotter::Strokes;
pub use sheet::{Placed, lay_out};
