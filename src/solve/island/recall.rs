//! What the solver remembered of the islands that a command touches, so that this alone is brought
//! back when the command is taken back.

use std::sync::Arc;

use super::Island;
use super::memory::snapshot_of;
use super::snapshot::Snapshot;
use crate::solve::settings::Settings;
use crate::world::PointId;
use crate::world::marks::Marks;

/// What was remembered of some islands, each filed under its first free point: nothing where there
/// was no island that began with it.
#[derive(Debug, Clone, Default)]
pub struct Recall {
    pub(crate) islands: Vec<(PointId, Option<Arc<Snapshot>>)>,
    /// The settings of the last call then.
    pub(crate) settings: Option<Settings>,
}

impl Recall {
    /// Roughly how many bytes it holds.
    pub fn n_bytes(&self) -> usize {
        let snapshots = self.islands.iter().filter_map(|(_, snapshot)| snapshot.as_ref());
        size_of::<Self>()
            + size_of_val(&*self.islands)
            + snapshots.map(|snapshot| snapshot.n_bytes()).sum::<usize>()
    }
}

/// Notes what is remembered of islands before it changes.
#[derive(Debug, Default)]
pub(crate) struct Notes {
    /// What was noted; none while nobody asks.
    recall: Option<Recall>,
    firsts: Marks,
}

impl Notes {
    /// From here on the first changes are noted; gives what was noted for who asked before.
    pub fn begin(&mut self, settings: Option<Settings>) -> Option<Recall> {
        self.firsts.begin();
        self.recall.replace(Recall { islands: Vec::new(), settings })
    }

    /// What was noted; `outer` goes on noting.
    pub fn end(&mut self, outer: Option<Recall>) -> Option<Recall> {
        let mut recall = std::mem::replace(&mut self.recall, outer)?;
        // Of what was noted twice the first counts; a stable order keeps it in front.
        recall.islands.sort_by_key(|(first, _)| *first);
        recall.islands.dedup_by_key(|(first, _)| *first);
        recall.islands.shrink_to_fit();
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
            recall.islands.push((island.points[0], Some(snapshot_of(island))));
        }
    }

    /// What is remembered under a point is about to change.
    pub fn note_as(&mut self, first: PointId, snapshot: Option<Arc<Snapshot>>) {
        if let Some(recall) = &mut self.recall
            && self.firsts.mark(first.idx())
        {
            recall.islands.push((first, snapshot));
        }
    }
}
