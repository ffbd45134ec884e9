//! Pictures in characters, two pixels each, for who looks at a mechanism in a terminal.

use super::chart::{Chart, ChartAxis};
use super::figure::{Figure, Key, Layer, Outline};
use super::scene::Scene;
use super::view::View;
use crate::constraint::Point;
use crate::diag::format_rounded;
use crate::interrupt::tick;

/// What a pixel belongs to; a terminal may give each a colour.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Ink {
    /// Wheels, and what others slide or roll on.
    Guide,
    /// A path, or a line of a chart, by its number.
    Path(usize),
    /// Bars and bodies.
    Body,
    /// Motors.
    Drive,
    /// Points.
    Joint,
}

/// A character: an upper and a lower pixel, or a letter in their place.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Cell {
    /// The upper pixel.
    pub upper: Option<Ink>,
    /// The lower pixel.
    pub lower: Option<Ink>,
    /// What is written over them.
    pub letter: Option<char>,
}

impl Cell {
    /// The character, without its colours.
    pub const fn char(self) -> char {
        match (self.letter, self.upper, self.lower) {
            (Some(letter), ..) => letter,
            (None, Some(_), Some(_)) => '\u{2588}',
            (None, Some(_), None) => '\u{2580}',
            (None, None, Some(_)) => '\u{2584}',
            (None, None, None) => ' ',
        }
    }
}

/// The least rows of a chart above the names of its lines.
const LEAST_ROWS: usize = 6;

/// A picture in characters.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Sketch {
    n_columns: usize,
    cells: Vec<Cell>,
}

/// What drawing a dot takes, in ticks.
const DOT: usize = 5;

/// Left of a chart, for the numbers of its axis.
const GUTTER: usize = 11;

impl Sketch {
    /// A scene in at most so many columns and rows.
    ///
    /// ```
    /// use linkwork::render::{Scene, Sketch};
    /// use linkwork::Session;
    ///
    /// let mut session = Session::new();
    /// session.run("point A = (0, 0), B = (4, 0); length A B")?;
    /// let lines = Sketch::of(&Scene::new(session.world()), 40, 12).lines();
    /// assert!(lines.len() <= 12 && lines.iter().any(|line| line.contains(['\u{2580}', '\u{2584}'])));
    /// # Ok::<(), linkwork::Diagnostic>(())
    /// ```
    pub fn of(scene: &Scene, n_columns: usize, n_rows: usize) -> Self {
        let view = View::of([scene]);
        let (width, height) = view.page().size();
        let pixel = (width / n_columns as f64).max(height / (2 * n_rows) as f64);
        let mut sketch = Self::blank(n_columns, n_rows);
        let figures = view.figures_of(scene);
        for figure in &figures {
            sketch.draw(figure, pixel);
        }
        figures.iter().for_each(|figure| sketch.write_names(figure, pixel));
        sketch.trim();
        sketch
    }

    /// The lines of a chart in so many columns and rows.
    pub fn of_chart(chart: &Chart, n_columns: usize, n_rows: usize) -> Self {
        let n_rows = n_rows.max(chart.series.len() + LEAST_ROWS);
        let mut sketch = Self::blank(n_columns.max(2 * GUTTER), n_rows);
        let data = || chart.series.iter().flat_map(|series| &series.data);
        let x = Range::of(&chart.x, data().map(|datum| datum.x));
        let y = Range::of(&chart.y, data().map(|datum| datum.y));
        // Below are the numbers of the axis and the names of the lines.
        let (right, bottom) = (sketch.n_columns - 1, sketch.n_rows() - 2 - chart.series.len());
        for series in &chart.series {
            tick(DOT * series.data.len());
            let places: Vec<Option<Point>> = series
                .data
                .iter()
                .map(|datum| {
                    let (along, up) = (x.share(datum.x)?, y.share(datum.y)?);
                    let left = GUTTER as f64;
                    let column = left + along * (right as f64 - left);
                    Some(Point::new(column + 0.5, (1.0 - up) * (2 * bottom + 1) as f64 + 0.5))
                })
                .collect();
            for pair in places.windows(2) {
                if let [Some(a), Some(b)] = *pair {
                    sketch.line(a, b, Ink::Path(series.look));
                }
            }
            places.iter().flatten().for_each(|&p| sketch.line(p, p, Ink::Path(series.look)));
        }
        let [x_lo, x_hi] = x.ends().map(format_rounded);
        let [y_lo, y_hi] = y.ends().map(format_rounded);
        sketch.write(0, (GUTTER - 1).saturating_sub(y_hi.chars().count()), &y_hi);
        sketch.write(bottom, (GUTTER - 1).saturating_sub(y_lo.chars().count()), &y_lo);
        sketch.write(bottom + 1, GUTTER, &x_lo);
        let end = sketch.n_columns.saturating_sub(x_hi.chars().count());
        sketch.write(bottom + 1, end, &x_hi);
        let middle = (GUTTER + sketch.n_columns).saturating_sub(chart.x.label.chars().count()) / 2;
        sketch.write(bottom + 1, middle, &chart.x.label);
        for (k, series) in chart.series.iter().enumerate() {
            let row = bottom + 2 + k;
            for column in GUTTER..GUTTER + 3 {
                sketch.cells[row * sketch.n_columns + column].upper = Some(Ink::Path(series.look));
            }
            sketch.write(row, GUTTER + 4, &series.name);
        }
        sketch
    }

    fn blank(n_columns: usize, n_rows: usize) -> Self {
        Self { n_columns, cells: vec![Cell::default(); n_columns * n_rows] }
    }

    fn n_rows(&self) -> usize {
        self.cells.len() / self.n_columns.max(1)
    }

    /// Its rows, from the top.
    pub fn rows(&self) -> impl Iterator<Item = &[Cell]> {
        self.cells.chunks(self.n_columns.max(1))
    }

    /// Its rows without colours.
    pub fn lines(&self) -> Vec<String> {
        let line = |row: &[Cell]| row.iter().map(|cell| cell.char()).collect::<String>();
        self.rows().map(|row| line(row).trim_end().to_owned()).collect()
    }

    fn draw(&mut self, figure: &Figure, pixel: f64) {
        let ink = match figure.layer {
            Layer::Plate | Layer::Bar | Layer::Slider => Ink::Body,
            Layer::Rail | Layer::Wheel => Ink::Guide,
            Layer::Trace => match figure.key {
                Key::Trace(number) => Ink::Path(number),
                _ => Ink::Path(0),
            },
            Layer::Drive => Ink::Drive,
            Layer::Joint => Ink::Joint,
            // Remarks are finer than a character.
            Layer::Construction | Layer::Ground | Layer::Mark | Layer::Legend => return,
        };
        let place = |local: Point| {
            let at = figure.placement.place(local);
            Point::new(at.x / pixel, at.y / pixel)
        };
        for shape in &figure.shapes {
            match &shape.outline {
                Outline::Path(path) | Outline::GrowingPath { path, .. } => {
                    path.flatten(&mut |a, b| self.line(place(a), place(b), ink));
                }
                Outline::Circle { centre, radius } if *radius < pixel => {
                    self.line(place(*centre), place(*centre), ink);
                }
                Outline::Circle { centre, radius } => {
                    let mut circle = super::path::Path::default();
                    circle.circle(*radius);
                    let about = |p: Point| *centre + p.to_vector();
                    circle.flatten(&mut |a, b| self.line(place(about(a)), place(about(b)), ink));
                }
                Outline::Text { .. } => {}
            }
        }
    }

    /// Writes the names of points where no other name stands.
    fn write_names(&mut self, figure: &Figure, pixel: f64) {
        if figure.layer != Layer::Joint {
            return;
        }
        for shape in &figure.shapes {
            let Outline::Text { at, text } = &shape.outline else { continue };
            let at = figure.placement.place(*at);
            let n = text.chars().count();
            let column = (at.x / pixel - 0.5 * n as f64).round().max(0.0) as usize;
            let row = (0.5 * at.y / pixel - 0.7).round().max(0.0) as usize;
            let first = row * self.n_columns + column;
            let fits = column + n <= self.n_columns && row < self.n_rows();
            if fits && self.cells[first..first + n].iter().all(|cell| cell.letter.is_none()) {
                self.write(row, column, text);
            }
        }
    }

    fn write(&mut self, row: usize, column: usize, text: &str) {
        for (k, letter) in text.chars().enumerate().take(self.n_columns - column) {
            self.cells[row * self.n_columns + column + k].letter = Some(letter);
        }
    }

    /// Draws a line between two places, in pixels.
    fn line(&mut self, a: Point, b: Point, ink: Ink) {
        let n = (2.0 * a.distance(b)).ceil().clamp(1.0, 4.0 * (self.cells.len() as f64)) as u32;
        tick(DOT * n as usize);
        for k in 0..=n {
            let p = a + (b - a) * (f64::from(k) / f64::from(n));
            self.dot(p, ink);
        }
    }

    /// What lies above keeps its place.
    fn dot(&mut self, p: Point, ink: Ink) {
        if !(p.x >= 0.0 && p.y >= 0.0) {
            return;
        }
        let (column, line) = (p.x as usize, p.y as usize);
        if column < self.n_columns
            && let Some(cell) = self.cells.get_mut(line / 2 * self.n_columns + column)
        {
            let pixel = if line.is_multiple_of(2) { &mut cell.upper } else { &mut cell.lower };
            *pixel = (*pixel).max(Some(ink));
        }
    }

    /// Leaves out empty rows above and below.
    fn trim(&mut self) {
        let is_empty = |row: &[Cell]| row.iter().all(|cell| *cell == Cell::default());
        let n_above = self.rows().take_while(|row| is_empty(row)).count();
        let n_below =
            self.cells.chunks(self.n_columns).rev().take_while(|row| is_empty(row)).count();
        let end = (self.n_rows() - n_below).max(n_above);
        self.cells = self.cells[n_above * self.n_columns..end * self.n_columns].to_vec();
    }
}

/// What of the numbers an axis shows.
struct Range {
    is_log: bool,
    lo: f64,
    hi: f64,
}

impl Range {
    fn of(axis: &ChartAxis, data: impl Iterator<Item = f64>) -> Self {
        let is_log = axis.is_log;
        let has_place = |value: &f64| value.is_finite() && (!is_log || *value > 0.0);
        let data = data.filter(has_place);
        let (lo, hi) =
            data.fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), v| (lo.min(v), hi.max(v)));
        if lo > hi { Self { is_log, lo: 1.0, hi: 2.0 } } else { Self { is_log, lo, hi } }
    }

    fn ends(&self) -> [f64; 2] {
        [self.lo, self.hi]
    }

    /// Where a number lies, from 0 to 1; none if it has no place.
    fn share(&self, value: f64) -> Option<f64> {
        let scale = |v: f64| if self.is_log { libm::log10(v) } else { v };
        let (lo, hi) = (scale(self.lo), scale(self.hi));
        let share = (scale(value) - lo) / (hi - lo);
        if share.is_finite() {
            return Some(share.clamp(0.0, 1.0));
        }
        // All in one place.
        (hi <= lo && value == self.lo).then_some(0.5)
    }
}
