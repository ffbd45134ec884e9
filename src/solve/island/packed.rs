//! What is remembered of many islands in one column of numbers: a command in which a thousand move
//! keeps them at the cost of a few numbers each.
//!
//! Of an island that is under way little changes from command to command. Its last poses are those at
//! which the commands before began, where each lets one frame pass: these are kept already, for the world.
//! On which side it is its pose tells, and how it is put together stays the same.

use super::Island;
use super::known_sides::KnownSides;
use super::snapshot::{Exact, Fingerprint, Snapshot};
use crate::constraint::Point;
use crate::solve::frame::decomposition::Side;
use crate::solve::report::Status;
use crate::world::Places;
use crate::world::PointId;
use crate::world::repeated::Repeated;

/// Snapshots of islands that were under way, one behind the other.
#[derive(Debug, Clone, Default)]
pub(crate) struct Packed {
    rows: Repeated<Row>,
    /// What changes from frame to frame, and what only some have.
    words: Vec<u64>,
    /// Where points were when the commands before began, the last first.
    older: OlderPlaces,
}

/// Where points were when the last commands began, the last first, as far as these moved them.
pub(crate) type OlderPlaces = [Places; 3];

/// What is mostly the same when the next command begins.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Row {
    /// The first free point.
    pub first: PointId,
    /// Where its words begin.
    at: u32,
    /// Where its points are among the older places.
    place: u32,
    n_free: u32,
    n_past: u32,
    n_sides: u32,
    n_evaluations: u32,
    structure: u64,
    probed_at: f64,
    flags: Flags,
}

/// What is true of an island.
#[derive(Debug, Clone, Copy, PartialEq)]
#[allow(clippy::struct_excessive_bools, reason = "each is a fact of its own")]
struct Flags {
    has_degree: bool,
    is_smooth: bool,
    is_edited: bool,
    is_awake: bool,
    has_old_sides: bool,
    /// Its past poses are among the older places.
    has_shared_past: bool,
}

/// How many words of each there are before those of its past and its sides.
const HEADER: usize = 3;

/// Whether places are the same to the bit.
fn are_same_places(a: &[Point], b: &[Point]) -> bool {
    let bits = |p: &Point| [p.x.to_bits(), p.y.to_bits()];
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| bits(a) == bits(b))
}

impl Packed {
    /// With as much room as another one took, beside which it is likely to be much the same.
    pub fn beside(other: &Self, n_words: usize, older: OlderPlaces) -> Self {
        let words = Vec::with_capacity(n_words);
        Self { rows: Repeated::beside(&other.rows), words, older }
    }

    /// The islands, in the order in which they came.
    pub(super) fn rows(&self) -> &[Row] {
        &self.rows
    }

    /// The same rows without what changes.
    pub fn without_words(&self) -> Self {
        Self { rows: self.rows.clone(), ..Self::default() }
    }

    /// How many words it keeps.
    pub fn n_words(&self) -> usize {
        self.words.len()
    }

    /// The bytes that it alone keeps.
    pub fn n_bytes(&self) -> usize {
        size_of_val(&*self.words) + self.rows.n_bytes()
    }

    /// Gives room back.
    pub fn shrink_to_fit(&mut self) {
        self.words.shrink_to_fit();
        self.rows.shrink_to_fit();
    }

    /// Appends what is remembered of an island; false if that is more than is kept here. Its points
    /// are likely to be at that place among the older ones.
    pub fn push(&mut self, island: &Island, place: usize) -> bool {
        let is_under_way = island.status == Status::Converged
            && !island.is_new
            && island.feasible.is_none()
            && island.spectrum.is_none()
            && island.inputs.is_empty()
            && !island.is_watched();
        let Ok(at) = u32::try_from(self.words.len()) else { return false };
        if !is_under_way {
            return false;
        }
        let Fingerprint { structure, inputs, pose } = island.fingerprint();
        self.words.extend_from_slice(&[island.residual.to_bits(), inputs, pose]);
        let (n_free, n_past) = (island.n_free, island.history.n_past());
        let is_there = |k: usize| {
            let there = self.older[k - 1].get(place..place.saturating_add(n_free));
            there.is_some_and(|there| are_same_places(there, island.history.past(k)))
        };
        let has_shared_past = (1..=n_past).all(is_there);
        if !has_shared_past {
            for p in (1..=n_past).flat_map(|k| island.history.past(k)) {
                self.words.extend_from_slice(&[p.x.to_bits(), p.y.to_bits()]);
            }
        }
        let (has_old_sides, sides) = island.block_sides();
        let n_sides = sides.len() as u32;
        sides.for_each(|it| {
            self.words.extend_from_slice(&[it.sine.to_bits(), u64::from(it.other)]);
        });
        self.rows.push(Row {
            first: island.points[0],
            at,
            place: if has_shared_past { place as u32 } else { 0 },
            n_free: n_free as u32,
            n_past: n_past as u32,
            n_sides,
            n_evaluations: island.n_evaluations,
            structure,
            probed_at: island.probed_at,
            flags: Flags {
                has_degree: island.has_degree,
                is_smooth: island.is_smooth(),
                is_edited: island.is_edited,
                is_awake: island.is_awake,
                has_old_sides,
                has_shared_past,
            },
        });
        debug_assert_eq!(
            self.rows.last().map(|row| self.get(row)),
            Some(Snapshot::of(island)),
            "what is kept is what there was"
        );
        true
    }

    /// The snapshot that a row is of.
    pub(super) fn get(&self, row: &Row) -> Snapshot {
        let (header, rest) = self.words[row.at as usize..].split_at(HEADER);
        let (n_free, n_past, flags) = (row.n_free as usize, row.n_past as usize, row.flags);
        let n_own = if flags.has_shared_past { 0 } else { n_past };
        let (own, rest) = rest.split_at(2 * n_free * n_own);
        let sides = rest[..2 * row.n_sides as usize].as_chunks::<2>().0;
        let number = f64::from_bits;
        let past = if flags.has_shared_past {
            let place = row.place as usize;
            let older = self.older[..n_past].iter().flat_map(|there| &there[place..place + n_free]);
            older.copied().collect()
        } else {
            let point = |p: &[u64; 2]| Point::new(number(p[0]), number(p[1]));
            own.as_chunks::<2>().0.iter().map(point).collect()
        };
        let side = |s: &[u64; 2]| Side { sine: number(s[0]), other: s[1] as u32 };
        Snapshot {
            n_free,
            status: Status::Converged,
            residual: number(header[0]),
            probed_at: row.probed_at,
            has_degree: flags.has_degree,
            is_smooth: flags.is_smooth,
            is_edited: flags.is_edited,
            is_awake: flags.is_awake,
            fingerprint: Fingerprint {
                structure: row.structure,
                inputs: header[1],
                pose: header[2],
            },
            past,
            feasible: Box::default(),
            direction: Box::default(),
            exact: Some(Exact {
                is_new: false,
                n_evaluations: row.n_evaluations,
                sides: KnownSides {
                    blocks: sides.iter().map(side).collect(),
                    are_old: flags.has_old_sides,
                    watched: None,
                },
                inputs: None,
            }),
        }
    }
}
