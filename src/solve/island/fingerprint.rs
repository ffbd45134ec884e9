//! Whether an island is what it was: its structure, its inputs and its pose, hashed.

use super::Island;
use super::snapshot::Fingerprint;
use super::structure::Structure;
use crate::constraint::{Constraint, ConstraintKind};

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
        let mut inputs = Hasher::default();
        self.w.iter().for_each(|w| inputs.add(w.to_bits()));
        self.constraints.iter().for_each(|c| c.content(&mut |word| inputs.add(word)));
        let mut pose = Hasher::default();
        for (p, at) in self.x.iter().enumerate() {
            let hasher = if p < self.n_free { &mut pose } else { &mut inputs };
            hasher.add(at.x.to_bits());
            hasher.add(at.y.to_bits());
        }
        Fingerprint { structure, inputs: inputs.0, pose: pose.0 }
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
