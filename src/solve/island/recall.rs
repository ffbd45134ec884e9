//! What the solver remembered of the islands that a command touches, so that this alone is brought
//! back when the command is taken back.

use std::sync::Arc;

use super::Island;
use super::memory::snapshot_of;
use super::packed::{OlderPlaces, Packed, Row};
use super::snapshot::Snapshot;
use crate::solve::settings::Settings;
use crate::world::marks::Marks;
use crate::world::{Places, PointId, World};

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

/// What was remembered of some islands, each filed under its first free point.
#[derive(Debug, Clone, Default)]
pub struct Recall {
    packed: Packed,
    /// Those of which more is to be kept, one by one.
    kept: Vec<(PointId, Kept)>,
    /// The settings of the last call then.
    pub(crate) settings: Option<Settings>,
}

impl Recall {
    /// What brings this back, of islands in the order of their first points.
    pub(crate) fn new(kept: Vec<(PointId, Kept)>, settings: Option<Settings>) -> Self {
        Self { kept, settings, ..Self::default() }
    }

    /// Roughly how many bytes it holds.
    pub fn n_bytes(&self) -> usize {
        let kept = self.kept.iter().map(|it| size_of_val(it) + it.1.n_bytes as usize);
        size_of::<Self>() + self.packed.n_bytes() + kept.sum::<usize>()
    }

    /// What it is filed under.
    fn firsts(&self) -> impl Iterator<Item = PointId> {
        let packed = self.packed.rows().iter().map(|row| row.first);
        packed.chain(self.kept.iter().map(|(first, _)| *first))
    }

    /// What was remembered, in the order of the first points.
    pub(crate) fn iter(&self) -> impl Iterator<Item = (PointId, Kept)> {
        let packed = self.packed.rows().iter().map(|row| (row.first, Noted::Packed(row)));
        let kept = self.kept.iter().map(|(first, kept)| (*first, Noted::Kept(kept)));
        let mut islands: Vec<(PointId, Noted)> = packed.chain(kept).collect();
        islands.sort_by_key(|(first, _)| *first);
        islands.into_iter().map(|(first, noted)| match noted {
            Noted::Packed(row) => (first, Some(Arc::new(self.packed.get(row))).into()),
            Noted::Kept(kept) => (first, kept.clone()),
        })
    }
}

/// Where it is kept.
enum Noted<'a> {
    Packed(&'a Row),
    Kept(&'a Kept),
}

/// Notes what is remembered of islands before it changes.
#[derive(Debug, Default)]
pub(crate) struct Notes {
    /// What was noted; none while nobody asks.
    recall: Option<Recall>,
    firsts: Marks,
    /// The islands that the last command let move, and how much room what was noted of them took: often the
    /// same move again.
    last: (Packed, usize),
    older: OlderPlaces,
    /// Whether the command that is about to end let time pass.
    has_run: bool,
}

impl Notes {
    /// From here on the first changes are noted; gives what was noted for who asked before.
    pub fn begin(&mut self, settings: Option<Settings>) -> Option<Recall> {
        self.firsts.begin();
        let (last, n_words) = &self.last;
        let packed = Packed::beside(last, *n_words, self.older.clone());
        self.recall.replace(Recall { packed, kept: Vec::new(), settings })
    }

    /// What was noted; `outer` goes on noting.
    pub fn end(&mut self, outer: Option<Recall>) -> Option<Recall> {
        let mut recall = std::mem::replace(&mut self.recall, outer)?;
        recall.packed.shrink_to_fit();
        recall.kept.shrink_to_fit();
        self.firsts.begin();
        match &self.recall {
            None if std::mem::take(&mut self.has_run) => {
                self.last = (recall.packed.without_words(), recall.packed.n_words());
            }
            None => {}
            Some(outer) => outer.firsts().for_each(|first| {
                self.firsts.mark(first.idx());
            }),
        }
        Some(recall)
    }

    /// Whether anyone asks.
    pub fn is_on(&self) -> bool {
        self.recall.is_some()
    }

    /// A command that is about to end noted where points were when it began.
    pub fn note_places(&mut self, places: Places) {
        self.has_run = true;
        let [last, before, _] = std::mem::take(&mut self.older);
        self.older = [places, last, before];
    }

    /// An island is about to change.
    pub fn note(&mut self, island: &Island) {
        self.note_at(island, usize::MAX);
    }

    /// An island is about to be visited: the world knows where among the places of the command before
    /// those of its points are.
    #[inline]
    pub fn note_visit(&mut self, island: &Island, world: &World) {
        self.note_at(island, world.noted_place(island.points[0]));
    }

    #[inline]
    fn note_at(&mut self, island: &Island, place: usize) {
        let first = island.points[0];
        if let Some(recall) = &mut self.recall
            && self.firsts.mark(first.idx())
        {
            if island.is_blank {
                return recall.kept.push((first, Kept::default()));
            }
            // What was asked for since the last visit is shared.
            let is_shared = island.remembered.get().is_some();
            if is_shared || !recall.packed.push(island, place) {
                recall.kept.push((first, Some(snapshot_of(island)).into()));
            }
        }
    }

    /// What is remembered under a point is about to change.
    pub fn note_as(&mut self, first: PointId, kept: Kept) {
        if let Some(recall) = &mut self.recall
            && self.firsts.mark(first.idx())
        {
            recall.kept.push((first, kept));
        }
    }
}
