//! What is remembered of many islands in one column of numbers: a command in which a thousand move
//! keeps them at the cost of a copy.
//!
//! Of the last three poses of an island two are those that the command before kept, where each command
//! lets one frame pass: these are not kept again.

use std::sync::Arc;

use super::Island;
use super::known_sides::KnownSides;
use super::snapshot::{Exact, Fingerprint, Snapshot};
use crate::constraint::Point;
use crate::solve::frame::decomposition::Side;
use crate::solve::report::Status;

/// The last poses of islands, one behind the other.
pub(crate) type Poses = Arc<Vec<Point>>;

/// Snapshots of islands that were under way, one behind the other.
#[derive(Debug, Clone, Default)]
pub(crate) struct Packed {
    words: Vec<u64>,
    /// The last pose of each.
    poses: Poses,
    /// The same of the command before, and of the one before that.
    older: [Poses; 2],
}

/// How many words there are before those of the points.
const HEADER: usize = 7;

/// What is true of an island, a bit each.
const HAS_DEGREE: u64 = 1;
const IS_SMOOTH: u64 = 2;
const IS_EDITED: u64 = 4;
const IS_AWAKE: u64 = 8;
const HAS_OLD_SIDES: u64 = 16;
/// The poses before its last are those of the commands before.
const SHARES: u64 = 32;
/// How many bits that are, how many the number of its past poses has, and that of its points.
const N_FLAGS: u32 = 6;
const PAST_BITS: u32 = 2;
const FREE_BITS: u32 = 32 - N_FLAGS - PAST_BITS;

const fn flag(is: bool, bit: u64) -> u64 {
    if is { bit } else { 0 }
}

/// Two numbers in a word.
const fn both(upper: usize, lower: u64) -> u64 {
    (upper as u64) << 32 | lower
}

/// Whether two poses are the same to the bit.
fn are_same_places(a: &[Point], b: &[Point]) -> bool {
    let bits = |p: &Point| [p.x.to_bits(), p.y.to_bits()];
    a.iter().map(bits).eq(b.iter().map(bits))
}

impl Packed {
    /// With as much room as another one took; `older` are the poses of the commands before.
    pub fn like((n_words, n_poses): (usize, usize), older: [Poses; 2]) -> Self {
        let poses = Arc::new(Vec::with_capacity(n_poses));
        Self { words: Vec::with_capacity(n_words), poses, older }
    }

    /// How much room it takes: words and poses.
    pub fn len(&self) -> (usize, usize) {
        (self.words.len(), self.poses.len())
    }

    /// The poses for the command that comes next.
    pub fn poses(&self) -> [Poses; 2] {
        [self.poses.clone(), self.older[0].clone()]
    }

    /// The bytes that it alone keeps.
    pub fn n_bytes(&self) -> usize {
        size_of_val(&*self.words) + size_of_val(&**self.poses)
    }

    /// Gives room back.
    pub fn shrink_to_fit(&mut self) {
        self.words.shrink_to_fit();
        if let Some(poses) = Arc::get_mut(&mut self.poses) {
            poses.shrink_to_fit();
        }
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
        let n_free = island.n_free;
        let at = i32::try_from(self.words.len()).ok()? as u32;
        let first = u32::try_from(self.poses.len()).ok()? as usize;
        let poses = Arc::get_mut(&mut self.poses)?;
        if !is_under_way || n_free >> FREE_BITS > 0 {
            return None;
        }
        let (are_old, sides) = island.block_sides();
        let Fingerprint { structure, inputs, pose } = island.fingerprint();
        let n_past = island.history.n_past();
        let is_there = |k: usize| {
            let kept = self.older.get(k - 2).and_then(|older| older.get(first..first + n_free));
            kept.is_some_and(|kept| are_same_places(kept, island.history.past(k)))
        };
        let shares = (2..=n_past).all(is_there);
        let flags = flag(island.has_degree, HAS_DEGREE)
            | flag(shares, SHARES)
            | flag(island.is_smooth(), IS_SMOOTH)
            | flag(island.is_edited, IS_EDITED)
            | flag(island.is_awake, IS_AWAKE)
            | flag(are_old, HAS_OLD_SIDES);
        let header: [u64; HEADER] = [
            both(first, ((n_free << PAST_BITS | n_past) as u64) << N_FLAGS | flags),
            both(sides.len(), u64::from(island.n_evaluations)),
            island.residual.to_bits(),
            island.probed_at.to_bits(),
            structure,
            inputs,
            pose,
        ];
        self.words.extend_from_slice(&header);
        if n_past > 0 {
            poses.extend_from_slice(island.history.past(1));
        }
        for p in (2..=n_past).filter(|_| !shares).flat_map(|k| island.history.past(k)) {
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
        let (first, flags) = ((header[0] >> 32) as usize, header[0]);
        let counts = flags as u32 >> N_FLAGS;
        let (n_free, n_past) = ((counts >> PAST_BITS) as usize, (counts & 3) as usize);
        let shares = flags & SHARES != 0;
        let n_own = if shares { 0 } else { n_past.saturating_sub(1) };
        let (own, rest) = rest.split_at(2 * n_free * n_own);
        let sides = &rest[..2 * (header[1] >> 32) as usize];
        let number = f64::from_bits;
        let point = |p: &[u64; 2]| Point::new(number(p[0]), number(p[1]));
        let side = |s: &[u64; 2]| Side { sine: number(s[0]), other: s[1] as u32 };
        let columns = std::iter::once(&self.poses).chain(&self.older);
        let kept = columns.take(if shares { n_past } else { n_past.min(1) });
        let kept = kept.flat_map(|poses| &poses[first..first + n_free]).copied();
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
            past: kept.chain(own.as_chunks::<2>().0.iter().map(point)).collect(),
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
