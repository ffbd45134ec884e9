//! Whether an island is what it was: its structure, its inputs and its pose, hashed.

use super::Island;
use super::snapshot::Fingerprint;
use super::structure::Structure;
use crate::constraint::{Constraint, ConstraintKind, Point};

/// The FNV-1a hash, a word at a time: the same on every machine, today and tomorrow.
struct Hasher(u64);

impl Default for Hasher {
    fn default() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }
}

impl Hasher {
    fn add(&mut self, word: u64) {
        self.0 = (self.0 ^ word).wrapping_mul(0x0100_0000_01b3);
        // Words differ most in their upper bits, which the product alone never moves down.
        self.0 ^= self.0 >> 29;
    }

    fn add_place(&mut self, at: Point) {
        self.add(at.x.to_bits());
        self.add(at.y.to_bits());
    }
}

/// What the residuals of a constraint depend on besides its points.
pub(crate) fn of_content(constraint: &Constraint) -> u64 {
    let mut content = Hasher::default();
    constraint.content(&mut |word| content.add(word));
    content.0
}

impl Island {
    /// What later results depend on besides what is remembered.
    pub fn fingerprint(&self) -> Fingerprint {
        let structure = *self.structure.get_or_init(|| self.hash_of_structure());
        let still = *self.still.get_or_init(|| self.hash_of_still());
        debug_assert_eq!(still, self.hash_of_still(), "what stands still was changed unnoticed");
        let (mut inputs, mut pose) = (Hasher(still), Hasher::default());
        let moving = self.moving.iter().map(|&c| &self.constraints[c as usize]);
        moving.for_each(|c| c.content(&mut |word| inputs.add(word)));
        self.x[..self.n_free].iter().for_each(|at| pose.add_place(*at));
        Fingerprint { structure, inputs: inputs.0, pose: pose.0 }
    }

    /// Of what drives it that which mostly stays as it is.
    fn hash_of_still(&self) -> u64 {
        let mut still = Hasher::default();
        self.w.iter().for_each(|w| still.add(w.to_bits()));
        for (c, constraint) in self.constraints.iter().enumerate() {
            if self.moving.binary_search(&(c as u32)).is_err() {
                constraint.content(&mut |word| still.add(word));
            }
        }
        self.x[self.n_free..].iter().for_each(|at| still.add_place(*at));
        still.0
    }

    fn hash_of_structure(&self) -> u64 {
        let mut structure = Hasher::default();
        structure.add(self.n_free as u64);
        for (c, constraint) in self.constraints.iter().enumerate() {
            let rho = self.own_rho.get(c).copied().flatten();
            Structure { constraint, rho }.words(|p| p).for_each(|word| structure.add(word));
        }
        structure.0
    }
}
