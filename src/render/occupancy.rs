//! What of a page is covered: a coarse raster that tells where a name can stand.

use super::figure::{Figure, Layer, Outline};
use super::labels::Area;
use super::page::Page;
use crate::constraint::{Point, Vector};
use crate::interrupt::tick;

/// Width of a cell, px.
const CELL: f64 = 2.0;

/// How much it disturbs when letters lie on something.
pub const OVER_LINE: u32 = 1;
/// On a mark, or a line that only carries one.
const OVER_MARK: u32 = 3;
/// On a symbol.
pub const OVER_PART: u32 = 8;

/// A page in cells, each with the worst that lies there.
#[derive(Debug, Clone)]
pub struct Occupancy {
    n_columns: usize,
    n_rows: usize,
    cells: Vec<u8>,
}

/// What noting a line takes, in ticks.
const LINE: usize = 50;

impl Occupancy {
    /// A page with nothing on it.
    pub fn new(page: &Page) -> Self {
        let (width, height) = page.size();
        let (n_columns, n_rows) = ((width / CELL).ceil() as usize, (height / CELL).ceil() as usize);
        Self { n_columns, n_rows, cells: vec![0; n_columns * n_rows] }
    }

    /// Notes where a figure has lines.
    pub fn add(&mut self, figure: &Figure, mark: f64) {
        for shape in &figure.shapes {
            let weight = match (figure.layer, shape.class.is_solid()) {
                (Layer::Trace, _) | (_, false) => OVER_LINE,
                (Layer::Mark | Layer::Construction, true) => OVER_MARK,
                _ => OVER_PART,
            };
            let half = shape.class.half_width() * mark;
            let mut line = |a: Point, b: Point| {
                tick(LINE);
                self.add_line(figure.placement.place(a), figure.placement.place(b), half, weight);
            };
            match &shape.outline {
                Outline::Path(path) | Outline::GrowingPath { path, .. } => path.flatten(&mut line),
                Outline::Circle { centre, radius } => {
                    let n = (0.8 * radius).clamp(8.0, 96.0).round();
                    let on =
                        |k: f64| *centre + Vector::polar(*radius, k / n * std::f64::consts::TAU);
                    (0..n as u32).for_each(|k| line(on(f64::from(k)), on(f64::from(k) + 1.0)));
                }
                Outline::Text { .. } => {}
            }
        }
    }

    /// Notes that an area is taken.
    pub fn add_area(&mut self, area: Area) {
        self.fill(area, OVER_PART);
    }

    /// How much letters in an area would disturb; none if it is not all on the page.
    pub fn cost(&self, area: Area) -> Option<u32> {
        let Area { lo, hi } = area;
        let (width, height) = (self.n_columns as f64 * CELL, self.n_rows as f64 * CELL);
        if lo.x < 0.0 || lo.y < 0.0 || hi.x > width || hi.y > height {
            return None;
        }
        tick(LINE);
        let mut cost = 0;
        self.each_cell(area, |idx| cost += u32::from(self.cells[idx]));
        Some(cost)
    }

    fn add_line(&mut self, a: Point, b: Point, half: f64, weight: u32) {
        let n = (a.distance(b) / CELL).ceil().max(1.0);
        // Longer than any line on a page: it leads off it, and where to does not matter.
        if n > 1e4 {
            return;
        }
        for k in 0..=n as u32 {
            let middle = a + (b - a) * (f64::from(k) / n);
            self.fill(Area::around(middle, Vector::new(half, half)), weight);
        }
    }

    fn fill(&mut self, area: Area, weight: u32) {
        let mut cells = std::mem::take(&mut self.cells);
        self.each_cell(area, |idx| cells[idx] = cells[idx].max(weight as u8));
        self.cells = cells;
    }

    fn each_cell(&self, area: Area, mut visit: impl FnMut(usize)) {
        let Area { lo, hi } = area;
        let range = |lo: f64, hi: f64, n: usize| {
            let from = (lo / CELL).floor().max(0.0) as usize;
            from..((hi / CELL).floor() + 1.0).clamp(0.0, n as f64) as usize
        };
        let columns = range(lo.x, hi.x, self.n_columns);
        for row in range(lo.y, hi.y, self.n_rows) {
            columns.clone().for_each(|column| visit(row * self.n_columns + column));
        }
    }
}
