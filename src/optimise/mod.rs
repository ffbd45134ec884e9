//! Searching for the best numbers: in a box, of a function that is worked out by running something.
//!
//! All numbers lie between 0 and 1; who asks knows what these stand for. A function may have no value
//! somewhere: what does not run is no candidate. Every search begins at the same places, so the same
//! function gives the same bits.

mod least_squares;
mod minimum;
mod starts;

pub use least_squares::least_squares;
pub use minimum::minimum;

/// The best that was found.
#[derive(Debug, Clone, PartialEq)]
pub struct Best {
    /// Where, each from 0 to 1.
    pub at: Vec<f64>,
    /// The value there; of least squares the sum of squares.
    pub value: f64,
}

/// Whether a value is better than the best so far.
fn is_better(value: f64, best: Option<&Best>) -> bool {
    best.is_none_or(|best| value < best.value)
}
