//! How numbers and names are written in files for machines.

use crate::render::text::printable;

/// Digits after the point of a mm: a millionth.
pub const PLACES: usize = 6;

/// A name as XML has it.
pub fn escaped(name: &str) -> String {
    printable(name).replace('&', "&amp;").replace('<', "&lt;").replace('"', "&quot;")
}
