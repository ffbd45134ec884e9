//! What the solver remembered of the islands that a command touches, so that this alone is brought
//! back when the command is taken back.

use std::sync::Arc;

use super::Island;
use super::memory::snapshot_of;
use super::packed::{Packed, Poses};
use super::snapshot::Snapshot;
use crate::solve::settings::Settings;
use crate::world::PointId;
use crate::world::marks::Marks;

/// What is remembered under a point: nothing where no island begins with it, or where what it
/// remembers does not count.
#[derive(Debug, Clone, Default)]
pub(crate) struct Kept {
    pub snapshot: Option<Arc<Snapshot>>,
    /// Roughly how many bytes that holds.
    n_bytes: u32,
}

impl From<Option<Arc<Snapshot>>> for Kept {
    fn from(snapshot: Option<Arc<Snapshot>>) -> Self {
        let n_bytes = snapshot.as_ref().map_or(0, |snapshot| snapshot.n_bytes());
        Self { snapshot, n_bytes: u32::try_from(n_bytes).unwrap_or(u32::MAX) }
    }
}

/// Where in a list of many it is: in the column, or, with the highest bit, among those that are kept one
/// by one.
#[derive(Debug, Clone, Copy)]
struct Noted(u32);

const IS_KEPT: u32 = 1 << 31;

/// What was remembered of some islands, each filed under its first free point, in their order.
#[derive(Debug, Clone, Default)]
pub struct Recall {
    islands: Vec<(PointId, Noted)>,
    kept: Vec<Kept>,
    packed: Packed,
    /// The settings of the last call then.
    pub(crate) settings: Option<Settings>,
}

impl Recall {
    /// What brings this back, of islands in the order of their first points.
    pub(crate) fn new(islands: Vec<(PointId, Kept)>, settings: Option<Settings>) -> Self {
        let mut recall = Self { settings, ..Self::default() };
        islands.into_iter().for_each(|(first, kept)| recall.keep(first, kept));
        recall
    }

    /// Roughly how many bytes it holds.
    pub fn n_bytes(&self) -> usize {
        let kept = self.kept.iter().map(|kept| size_of_val(kept) + kept.n_bytes as usize);
        size_of::<Self>()
            + size_of_val(&*self.islands)
            + self.packed.n_bytes()
            + kept.sum::<usize>()
    }

    fn keep(&mut self, first: PointId, kept: Kept) {
        self.islands.push((first, Noted(self.kept.len() as u32 | IS_KEPT)));
        self.kept.push(kept);
    }

    /// What was remembered, in the order of the first points.
    pub(crate) fn iter(&self) -> impl Iterator<Item = (PointId, Kept)> {
        self.islands.iter().map(|&(first, Noted(at))| {
            if at & IS_KEPT == 0 {
                (first, Some(Arc::new(self.packed.get(at))).into())
            } else {
                (first, self.kept[(at & !IS_KEPT) as usize].clone())
            }
        })
    }
}

/// Notes what is remembered of islands before it changes.
#[derive(Debug, Default)]
pub(crate) struct Notes {
    /// What was noted; none while nobody asks.
    recall: Option<Recall>,
    firsts: Marks,
    /// How many islands changed last, and how much room that took.
    n_last: (usize, (usize, usize)),
    /// The poses that the last commands kept.
    older: [Poses; 2],
}

impl Notes {
    /// From here on the first changes are noted; gives what was noted for who asked before.
    pub fn begin(&mut self, settings: Option<Settings>) -> Option<Recall> {
        self.firsts.begin();
        // As many as changed last often change again.
        let (n_islands, room) = self.n_last;
        let islands = Vec::with_capacity(n_islands);
        let packed = Packed::like(room, self.older.clone());
        self.recall.replace(Recall { islands, kept: Vec::new(), packed, settings })
    }

    /// What was noted; `outer` goes on noting.
    pub fn end(&mut self, outer: Option<Recall>) -> Option<Recall> {
        let mut recall = std::mem::replace(&mut self.recall, outer)?;
        recall.packed.shrink_to_fit();
        self.n_last = (recall.islands.len(), recall.packed.len());
        if recall.packed.len().1 > 0 {
            self.older = recall.packed.poses();
        }
        // Of what was noted twice the first counts; a stable order keeps it in front.
        recall.islands.sort_by_key(|(first, _)| *first);
        recall.islands.dedup_by_key(|(first, _)| *first);
        recall.islands.shrink_to_fit();
        recall.kept.shrink_to_fit();
        // What the outer one noted since it began was marked in a round that is over.
        self.firsts.begin();
        Some(recall)
    }

    /// Whether anyone asks.
    pub fn is_on(&self) -> bool {
        self.recall.is_some()
    }

    /// An island is about to change.
    #[inline]
    pub fn note(&mut self, island: &Island) {
        if let Some(recall) = &mut self.recall
            && self.firsts.mark(island.points[0].idx())
        {
            if island.is_blank {
                return recall.keep(island.points[0], Kept::default());
            }
            // What was asked for since the last visit is shared.
            let is_shared = island.remembered.get().is_some();
            let packed = if is_shared { None } else { recall.packed.push(island) };
            match packed {
                Some(at) => recall.islands.push((island.points[0], Noted(at))),
                None => recall.keep(island.points[0], Some(snapshot_of(island)).into()),
            }
        }
    }

    /// What is remembered under a point is about to change.
    pub fn note_as(&mut self, first: PointId, kept: Kept) {
        if let Some(recall) = &mut self.recall
            && self.firsts.mark(first.idx())
        {
            recall.keep(first, kept);
        }
    }
}
