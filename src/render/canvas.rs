//! The canvas: collects the figures of a picture while its symbols are drawn.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::figure::{Figure, Key, Layer, Placement};
use super::page::Page;
use crate::constraint::{Point, PointIdx, Vector};
use crate::interrupt::tick;

/// What the drawing of a figure takes, in ticks.
const FIGURE: usize = 200;

/// Where the name of each point stands, from the point, px. A point that is missing here
/// goes without.
pub type Lettering = BTreeMap<PointIdx, Vector>;

/// Takes the figures of one symbol after the other.
#[derive(Debug)]
pub struct Canvas<'a> {
    /// The page.
    pub page: &'a Page,
    /// Where the points are, by handle.
    pub at: &'a [Point],
    /// Where names go.
    pub lettering: &'a Lettering,
    figures: Vec<Figure>,
    key: Key,
    n_of_key: u16,
    is_off: bool,
    note: Option<Arc<str>>,
}

impl<'a> Canvas<'a> {
    /// An empty page.
    pub fn new(page: &'a Page, at: &'a [Point], lettering: &'a Lettering) -> Self {
        Self {
            page,
            at,
            lettering,
            figures: Vec::new(),
            key: Key::Legend,
            n_of_key: 0,
            is_off: false,
            note: None,
        }
    }

    /// What follows belongs to `key`.
    pub fn begin(&mut self, key: Key, is_off: bool, note: Option<Arc<str>>) {
        if key != self.key {
            self.n_of_key = 0;
        }
        (self.key, self.is_off, self.note) = (key, is_off, note);
    }

    /// Begins a figure.
    pub fn figure(&mut self, layer: Layer, placement: Placement) -> &mut Figure {
        tick(FIGURE);
        let part = self.n_of_key;
        self.n_of_key += 1;
        self.figures.push(Figure {
            layer,
            key: self.key,
            part,
            is_off: self.is_off,
            is_unmet: false,
            note: self.note.clone(),
            placement,
            shapes: Vec::new(),
        });
        self.figures.last_mut().expect("just pushed")
    }

    /// Where a point lies on the page.
    pub fn px(&self, p: PointIdx) -> Point {
        self.page.px(self.at[p as usize])
    }

    /// A size of marks on this page, px.
    pub fn size(&self, full: f64) -> f64 {
        full * self.page.mark()
    }

    /// The figures, from the bottom up.
    pub fn finish(mut self) -> Vec<Figure> {
        self.figures.sort_by_key(Figure::order);
        self.figures
    }
}
