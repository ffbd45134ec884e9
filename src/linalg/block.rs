//! The 2 x 2 blocks of numbers that couple two points, and the pivots on the diagonal.

/// What couples two points, by rows: (later, earlier) in elimination order.
pub type Block = [f64; 4];

/// What a factorisation found on the diagonal of D in L D L^T.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pivots {
    /// How many pivots are negative: as many as there are negative eigenvalues (Sylvester).
    pub n_negative: usize,
    /// The least pivot.
    pub smallest: f64,
    /// The greatest pivot.
    pub largest: f64,
}

impl Pivots {
    /// No pivots yet.
    pub const NONE: Self =
        Self { n_negative: 0, smallest: f64::INFINITY, largest: f64::NEG_INFINITY };

    /// Takes note of a pivot and returns its reciprocal. A pivot of exactly 0, an unknown that
    /// nothing acts on, gets reciprocal 0: what nothing acts on does not move.
    #[inline]
    pub fn note(&mut self, d: f64) -> f64 {
        self.n_negative += usize::from(d < 0.0);
        self.smallest = if d < self.smallest { d } else { self.smallest };
        self.largest = if d > self.largest { d } else { self.largest };
        if d == 0.0 { 0.0 } else { 1.0 / d }
    }
}
