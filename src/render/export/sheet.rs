//! Parts laid side by side on a sheet.

use super::parts::Part;
use crate::constraint::Vector;
use crate::interrupt::tick;

/// Between two parts, and from a part to the edge, mm.
const GAP: f64 = 3.0;

/// What the placing of a part takes, in ticks.
const PART: usize = 100;

/// Parts where they lie.
#[derive(Debug, Clone, PartialEq)]
pub struct Placed {
    /// The parts.
    pub parts: Vec<Part>,
    /// Width and height of the sheet, mm; its lower left corner is the origin.
    pub size: [f64; 2],
}

/// Lays parts in rows, from the lower left corner on, in their order: a sheet about as wide as it is
/// high, or as wide as the longest part.
pub fn lay_out(parts: Vec<Part>) -> Placed {
    let extent = |part: &Part| {
        let [lo, hi] = part.outline.bounds();
        hi - lo
    };
    let area: f64 = parts.iter().map(extent).map(|v| (v.x + GAP) * (v.y + GAP)).sum();
    let longest = parts.iter().map(|part| extent(part).x).fold(0.0, f64::max);
    let room = area.sqrt().max(longest);
    let (mut x, mut y, mut row) = (GAP, GAP, 0.0_f64);
    let mut widest = 0.0_f64;
    let mut placed = Vec::with_capacity(parts.len());
    for part in parts {
        tick(PART + part.holes.len());
        let size = extent(&part);
        if x > GAP && x + size.x > GAP + room {
            (x, y, row) = (GAP, y + row + GAP, 0.0);
        }
        let [lo, _] = part.outline.bounds();
        let by = Vector::new(x - lo.x, y - lo.y);
        let holes = part.holes.iter().map(|&hole| hole + by).collect();
        placed.push(Part { outline: part.outline.shifted(by), holes, ..part });
        widest = widest.max(x + size.x);
        row = row.max(size.y);
        x += size.x + GAP;
    }
    Placed { parts: placed, size: [widest + GAP, y + row + GAP] }
}
