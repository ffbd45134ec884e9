//! The points, as columns of numbers.

use super::{NameText, PointId};
use crate::constraint::Point;

/// Everything about the points; a handle is an index into each column.
#[derive(Debug, Clone, Default)]
pub struct Points {
    /// Positions now.
    pub(super) at: Vec<Point>,
    /// Positions when the clock left 0, or at birth for a point made later.
    pub(super) start: Vec<Point>,
    pub(super) is_frozen: Vec<bool>,
    /// How strongly a point resists being moved; 1 where the user did not say, and beyond the end.
    weight: Vec<f64>,
    /// None for a point that was deleted.
    pub(super) name: Vec<Option<NameText>>,
    pub(super) n_alive: usize,
}

/// All that makes one point.
#[derive(Debug, Clone)]
pub struct PointRecord {
    /// Its name.
    pub name: NameText,
    /// Where it is.
    pub at: Point,
    /// Where `reset` puts it.
    pub start: Point,
    /// Whether no constraint may move it.
    pub is_frozen: bool,
    /// How strongly it resists being moved.
    pub weight: f64,
}

impl Points {
    /// How many there are.
    pub fn len(&self) -> usize {
        self.n_alive
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.n_alive == 0
    }

    /// Roughly how many bytes they hold.
    pub(super) fn n_bytes(&self) -> usize {
        size_of_val(&*self.at)
            + size_of_val(&*self.start)
            + size_of_val(&*self.is_frozen)
            + size_of_val(&*self.weight)
            + size_of_val(&*self.name)
    }

    /// The positions of all handles given out so far; entries of deleted points mean nothing.
    pub fn column(&self) -> &[Point] {
        &self.at
    }

    /// Where a point is.
    pub fn at(&self, id: PointId) -> Point {
        self.at[id.idx()]
    }

    /// Where `reset` puts it.
    pub fn start(&self, id: PointId) -> Point {
        self.start[id.idx()]
    }

    /// Where `reset` puts all handles given out so far.
    pub fn start_column(&self) -> &[Point] {
        &self.start
    }

    /// Whether no constraint may move it.
    pub fn is_frozen(&self, id: PointId) -> bool {
        self.is_frozen[id.idx()]
    }

    /// Whether it exists; what has a handle from before a `clear` may ask.
    pub fn is_alive(&self, id: PointId) -> bool {
        self.name.get(id.idx()).is_some_and(Option::is_some)
    }

    /// How strongly it resists being moved, against 1 for an ordinary point.
    pub fn weight(&self, id: PointId) -> f64 {
        self.weight.get(id.idx()).copied().unwrap_or(1.0)
    }

    /// Sets how strongly it resists being moved; gives what that was.
    pub(super) fn set_weight(&mut self, id: PointId, weight: f64) -> f64 {
        if id.idx() >= self.weight.len() {
            if weight == 1.0 {
                return 1.0;
            }
            self.weight.resize(id.idx() + 1, 1.0);
        }
        std::mem::replace(&mut self.weight[id.idx()], weight)
    }

    /// Forgets the weights of all but the first `n` handles.
    pub(super) fn cut_weights(&mut self, n: usize) {
        self.weight.truncate(n);
    }

    /// The inverse masses of all points by handle; 0 for what is frozen and what is no more.
    pub fn inverse_masses(&self) -> Vec<f64> {
        let all = (0..self.column().len()).map(PointId::new);
        all.map(|id| if self.is_alive(id) { self.inverse_mass(id) } else { 0.0 }).collect()
    }

    /// The inverse mass `w` of the formulas: 0 for a frozen point.
    pub fn inverse_mass(&self, id: PointId) -> f64 {
        if self.is_frozen[id.idx()] { 0.0 } else { 1.0 / self.weight(id) }
    }

    /// Its name.
    pub fn name(&self, id: PointId) -> &str {
        self.name_text(id)
    }

    pub(super) fn name_text(&self, id: PointId) -> &NameText {
        self.name[id.idx()].as_ref().expect("a handle of a living point")
    }

    /// The living points, in order of creation.
    pub fn ids(&self) -> impl DoubleEndedIterator<Item = PointId> + '_ {
        self.name.iter().enumerate().filter_map(|(k, name)| name.as_ref().map(|_| PointId::new(k)))
    }

    pub(super) fn insert(&mut self, id: PointId, record: PointRecord) {
        let k = id.idx();
        if k >= self.at.len() {
            self.at.resize(k + 1, Point::ORIGIN);
            self.start.resize(k + 1, Point::ORIGIN);
            self.is_frozen.resize(k + 1, false);
            self.name.resize(k + 1, None);
        }
        self.at[k] = record.at;
        self.start[k] = record.start;
        self.is_frozen[k] = record.is_frozen;
        self.set_weight(id, record.weight);
        self.name[k] = Some(record.name);
        self.n_alive += 1;
    }

    pub(super) fn remove(&mut self, id: PointId) -> PointRecord {
        let k = id.idx();
        self.n_alive -= 1;
        PointRecord {
            name: self.name[k].take().expect("a handle of a living point"),
            at: self.at[k],
            start: self.start[k],
            is_frozen: self.is_frozen[k],
            weight: self.weight(id),
        }
    }
}
