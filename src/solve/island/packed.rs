//! What is remembered of many islands in one column of numbers: a command in which a thousand move
//! keeps them at the cost of a copy.

use super::Island;
use super::known_sides::KnownSides;
use super::snapshot::{Exact, Fingerprint, Snapshot};
use crate::constraint::Point;
use crate::solve::frame::decomposition::Side;
use crate::solve::report::Status;

/// Snapshots of islands that were under way, one behind the other.
#[derive(Debug, Clone, Default)]
pub(crate) struct Packed {
    words: Vec<u64>,
}

/// How many words there are before those of the points.
const HEADER: usize = 7;

/// What is true of an island, a bit each.
const HAS_DEGREE: u64 = 1;
const IS_SMOOTH: u64 = 2;
const IS_EDITED: u64 = 4;
const IS_AWAKE: u64 = 8;
const HAS_OLD_SIDES: u64 = 16;
/// How many bits that are.
const N_FLAGS: u32 = 5;

const fn flag(is: bool, bit: u64) -> u64 {
    if is { bit } else { 0 }
}

/// Two numbers in a word.
const fn both(upper: usize, lower: u64) -> u64 {
    (upper as u64) << 32 | lower
}

impl Packed {
    /// Room for so many words.
    pub fn with_capacity(n_words: usize) -> Self {
        Self { words: Vec::with_capacity(n_words) }
    }

    /// The length of the column.
    pub fn n_words(&self) -> usize {
        self.words.len()
    }

    /// The bytes it keeps.
    pub fn n_bytes(&self) -> usize {
        size_of_val(&*self.words)
    }

    /// Gives room back.
    pub fn shrink_to_fit(&mut self) {
        self.words.shrink_to_fit();
    }

    /// Appends what is remembered of an island, and gives where it begins; none if that is more than
    /// words are kept of here.
    pub fn push(&mut self, island: &Island) -> Option<u32> {
        let is_under_way = island.status == Status::Converged
            && !island.is_new
            && island.feasible.is_none()
            && island.spectrum.is_none()
            && island.inputs.is_empty()
            && !island.is_watched();
        let at = u32::try_from(self.words.len()).ok()?;
        if !is_under_way {
            return None;
        }
        let (are_old, sides) = island.block_sides();
        let Fingerprint { structure, inputs, pose } = island.fingerprint();
        let n_past = island.history.n_past();
        let flags = flag(island.has_degree, HAS_DEGREE)
            | flag(island.is_smooth(), IS_SMOOTH)
            | flag(island.is_edited, IS_EDITED)
            | flag(island.is_awake, IS_AWAKE)
            | flag(are_old, HAS_OLD_SIDES);
        let header: [u64; HEADER] = [
            both(island.n_free, (n_past as u64) << N_FLAGS | flags),
            both(sides.len(), u64::from(island.n_evaluations)),
            island.residual.to_bits(),
            island.probed_at.to_bits(),
            structure,
            inputs,
            pose,
        ];
        self.words.reserve(HEADER + 2 * (n_past * island.n_free + sides.len()));
        self.words.extend_from_slice(&header);
        for p in (1..=n_past).flat_map(|k| island.history.past(k)) {
            self.words.extend_from_slice(&[p.x.to_bits(), p.y.to_bits()]);
        }
        sides.for_each(|it| {
            self.words.extend_from_slice(&[it.sine.to_bits(), u64::from(it.other)]);
        });
        debug_assert_eq!(self.get(at), Snapshot::of(island), "what is kept is what there was");
        Some(at)
    }

    /// The snapshot that begins there.
    pub fn get(&self, at: u32) -> Snapshot {
        let (header, rest) = self.words[at as usize..].split_at(HEADER);
        let (n_free, flags) = ((header[0] >> 32) as usize, header[0]);
        let n_past = (flags as u32 >> N_FLAGS) as usize;
        let (past, rest) = rest.split_at(2 * n_free * n_past);
        let sides = &rest[..2 * (header[1] >> 32) as usize];
        let number = f64::from_bits;
        let point = |p: &[u64; 2]| Point::new(number(p[0]), number(p[1]));
        let side = |s: &[u64; 2]| Side { sine: number(s[0]), other: s[1] as u32 };
        Snapshot {
            n_free,
            status: Status::Converged,
            residual: number(header[2]),
            probed_at: number(header[3]),
            has_degree: flags & HAS_DEGREE != 0,
            is_smooth: flags & IS_SMOOTH != 0,
            is_edited: flags & IS_EDITED != 0,
            is_awake: flags & IS_AWAKE != 0,
            fingerprint: Fingerprint { structure: header[4], inputs: header[5], pose: header[6] },
            past: past.as_chunks::<2>().0.iter().map(point).collect(),
            feasible: Box::default(),
            direction: Box::default(),
            exact: Some(Exact {
                is_new: false,
                n_evaluations: header[1] as u32,
                sides: KnownSides {
                    blocks: sides.as_chunks::<2>().0.iter().map(side).collect(),
                    are_old: flags & HAS_OLD_SIDES != 0,
                    watched: None,
                },
                inputs: None,
            }),
        }
    }
}
