//! The motions that change no row.

use super::projector::Projector;
use super::system::{ConstraintSystem, UnitRows};
use crate::constraint::{PointIdx, Vector};
use nalgebra::DVector;

/// How all points move in the one free motion of those that hang together with `point`: a
/// displacement of length 1 in the metric of the weights, for each point of the scene; none if
/// there is no such motion, or more than one.
///
/// Its sign is arbitrary: who follows a motion turns it to go on as before. Where the rate of
/// a motor along it changes its sign, the motor is at a dead point.
pub fn motion_of(scene: &ConstraintSystem, point: PointIdx) -> Option<Vec<Vector>> {
    let (rows, _) = scene.rows(0.0);
    let holds = |island: &UnitRows| island.points.binary_search(&point).is_ok();
    let island = rows.islands().into_iter().find(holds)?;
    let mut projector = Projector::of(&island);
    if projector.nullity() != 1 {
        return None;
    }
    let motion = motions(&mut projector, island.n_unknowns(), 1).pop()?;
    Some(scene.displacements(&island.points, motion.as_slice()))
}

/// Orthonormal motions that change no row, chosen at random.
pub fn motions(
    projector: &mut Projector,
    n_unknowns: usize,
    n_motions: usize,
) -> Vec<DVector<f64>> {
    let mut random = Random::new();
    let mut motions: Vec<DVector<f64>> = Vec::new();
    while motions.len() < n_motions {
        let mut y: Vec<f64> = (0..n_unknowns).map(|_| random.next()).collect();
        projector.onto_motions(&mut y);
        let mut y = DVector::from_vec(y);
        for _ in 0..2 {
            for v in &motions {
                y.axpy(-v.dot(&y), v, 1.0);
            }
        }
        match y.try_normalize(1e-6) {
            Some(y) => motions.push(y),
            None => break,
        }
    }
    motions
}

/// A reproducible source of numbers in [-1, 1) (`SplitMix64`).
pub struct Random(u64);

impl Random {
    /// Always the same.
    pub fn new() -> Self {
        Self(0)
    }

    /// The next number.
    pub fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}
