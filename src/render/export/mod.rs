//! Files for machines, in true size: strokes for plotters, parts for cutters.

mod dxf;
mod parts;
mod plotter;
mod rounded;
mod sheet;

pub use dxf::dxf;
pub use parts::{Cut, Part, PartFlaw, parts, svg as parts_svg};
pub use plotter::strokes;
pub use sheet::{Placed, lay_out};
