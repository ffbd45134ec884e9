//! The largest eigenvalue of the coupling of rows, by power iteration: what decides how large
//! a step of a first-order method may be.

use super::rows::{Equations, Rows, add_row, dot_row};
use crate::world::PointId;

/// Iterations from a cold start; measured to come within a few percent on meshes.
pub(crate) const COLD: u32 = 15;
/// The estimate grows toward the eigenvalue from below: what is left of it, on meshes.
pub(crate) const MARGIN: f64 = 1.02;

/// A direction that leans toward the eigenvector, carried from frame to frame.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Spectrum {
    /// The direction, (x, y) for each free point.
    v: Vec<f64>,
    scratch: Vec<f64>,
    /// Whether it was iterated before.
    is_warm: bool,
}

impl Spectrum {
    /// A start for these points: arbitrary, always the same, and along no symmetry. It depends
    /// on how many there are and not on their handles, which a saved session gives anew.
    pub fn new(points: &[PointId]) -> Self {
        let v: Vec<f64> = (0..2 * points.len() as u32).map(noise).collect();
        Self { scratch: vec![0.0; v.len()], v, is_warm: false }
    }

    /// One that was carried over.
    pub fn from_direction(v: Vec<f64>) -> Self {
        Self { scratch: vec![0.0; v.len()], v, is_warm: true }
    }

    /// The direction, for keeping; nothing if it is no more than a start.
    pub fn direction(&self) -> &[f64] {
        if self.is_warm { &self.v } else { &[] }
    }

    /// Forgets the direction: it may have lost what leans toward an eigenvector that was not the
    /// largest then.
    pub fn forget(&mut self) {
        (0..).zip(&mut self.v).for_each(|(k, v)| *v = noise(k));
        self.is_warm = false;
    }

    /// The largest eigenvalue of `J^T R J`, an estimate with a margin; `weight` gives R by row.
    pub fn largest(
        &mut self,
        equations: &Equations,
        rows: &Rows,
        weight: impl Fn(usize) -> f64,
    ) -> f64 {
        let n = if self.is_warm { 1 } else { COLD };
        let mut largest = 0.0;
        for _ in 0..n {
            self.scratch.fill(0.0);
            for (r, (_, unknowns, gradient, _)) in rows.iter(equations).enumerate() {
                let along = dot_row(&self.v, unknowns, gradient);
                add_row(&mut self.scratch, unknowns, gradient, weight(r) * along);
            }
            let norm = self.scratch.iter().map(|a| a * a).sum::<f64>().sqrt();
            let before = self.v.iter().map(|a| a * a).sum::<f64>().sqrt();
            // Rows that all ask for nothing, or overflow: keep the direction.
            if !(norm > 0.0 && norm.is_finite() && before > 0.0) {
                return largest;
            }
            largest = norm / before;
            self.v.iter_mut().zip(&self.scratch).for_each(|(v, s)| *v = s / norm);
        }
        self.is_warm = true;
        MARGIN * largest
    }
}

/// A number in (-1, 1) that depends on `n` alone and looks random.
pub(crate) fn noise(n: u32) -> f64 {
    // SplitMix64: any bijection that mixes all bits would do.
    let mut z = (u64::from(n) + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^= z >> 31;
    (z >> 11) as f64 / (1u64 << 52) as f64 - 1.0
}
