//! Labels beside their places, none on another and few on lines.

use super::sheet::{Anchor, Sheet, Stroke, TextStyle, polyline};
use crate::constraint::{Point, Vector};
use crate::interrupt::tick;
use crate::render::labels::{Area, BOLD, cheapest, direction, directions, even_width, text_width};

/// What is written, and how.
#[derive(Debug, Clone, Copy)]
pub struct ChartLabel<'a> {
    /// The words.
    pub text: &'a str,
    /// Size of letters, px.
    pub size: f64,
    /// Whether the letters are bold.
    pub is_bold: bool,
    /// Their colour.
    pub colour: &'a str,
    /// Where it would best stand.
    pub preference: Preference,
    /// Whether it must be seen, and may therefore stand farther off.
    pub must: bool,
}

impl ChartLabel<'_> {
    /// How wide it is at most, px.
    fn width(&self) -> f64 {
        let even = even_width(self.text, self.size);
        if self.is_bold { even.max(BOLD * self.size * text_width(self.text)) } else { even }
    }
}

/// Where a label would best stand.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Preference {
    /// Close to a mark, anywhere around.
    NearMark,
    /// Behind the end of a line.
    BehindEnd,
}

/// What is taken up already.
pub struct LabelPlacer {
    page: Area,
    taken: Vec<Area>,
    marks: Vec<Point>,
    /// Places along the lines, close together.
    lines: Vec<Point>,
}

/// Free space around a mark, px.
const MARK: f64 = 5.0;
/// Places along a line are this far apart, px.
const STEP: f64 = 4.0;
/// From this distance on a thin line leads from label to place, px.
const FAR: f64 = 20.0;
/// How far labels may stand off, px, those that must be seen and the others.
const FARTHER: [f64; 9] = [7.0, 11.0, 18.0, 28.0, 42.0, 60.0, 85.0, 115.0, 150.0];
const CLOSE: [f64; 2] = [6.0, 10.0];
/// A label that need not be seen is left out rather than to cost more.
const MOST_COST: f64 = 4.0;

impl LabelPlacer {
    /// Nothing yet on a page with these bounds.
    pub const fn within(page: Area) -> Self {
        Self { page, taken: Vec::new(), marks: Vec::new(), lines: Vec::new() }
    }

    /// Notes a mark, which no label may cover.
    pub fn avoid_mark(&mut self, at: Point) {
        self.marks.push(at);
    }

    /// Notes a line, of which labels are to cover little.
    pub fn avoid_line(&mut self, places: &[Point]) {
        for ends in places.windows(2) {
            let way = ends[1] - ends[0];
            let n = (way.norm() / STEP).ceil().clamp(1.0, 1000.0);
            tick(20 + n as usize);
            self.lines.extend((0..n as u32).map(|k| ends[0] + way * (f64::from(k) / n)));
        }
    }

    /// Writes a label beside `at` where it covers no other and no mark, and as little of lines
    /// as possible; not at all where there is no such place.
    pub fn place(&mut self, at: Point, label: ChartLabel, sheet: &mut Sheet) {
        let Some((cost, area)) = cheapest(self.candidates(at, label)) else { return };
        if !label.must && cost > MOST_COST {
            return;
        }
        self.taken.push(area);
        let nearest = area.nearest(at);
        if nearest.distance(at) > FAR {
            let stroke = Stroke { width: 0.6, ..Stroke::thin(label.colour) };
            sheet.line(&polyline(&[at, nearest]), stroke);
        }
        let base_line = area.middle() + Vector::new(0.0, 0.36 * label.size);
        let style = TextStyle { size: label.size, anchor: Anchor::Middle, colour: label.colour };
        sheet.write_over_lines(base_line, label.text, label.is_bold, style);
    }

    /// The areas where a label can stand, each with its cost.
    fn candidates(&self, at: Point, label: ChartLabel) -> impl Iterator<Item = (f64, Area)> {
        let half = Vector::new(0.5 * label.width(), 0.5 * label.size);
        let distances: &[f64] = if label.must { &FARTHER } else { &CLOSE };
        let places = distances.iter().flat_map(|&d| directions().map(move |k| (d, k)));
        places.filter_map(move |(distance, k)| {
            let phi = direction(f64::from(k));
            let e = Vector::polar(1.0, phi);
            // The nearest edge of the label is at that distance; y goes down.
            let middle =
                Point::new(at.x + e.x * (distance + half.x), at.y - e.y * (distance + half.y));
            let area = Area::around(middle, half);
            let preferred = match label.preference {
                Preference::NearMark => -0.3 * libm::cos(phi - 0.785),
                Preference::BehindEnd => -1.5 * e.x,
            };
            Some((self.covered(&area)? + preferred + 0.12 * distance, area))
        })
    }

    /// How much of lines an area covers; none if it covers what must not be.
    fn covered(&self, area: &Area) -> Option<f64> {
        let page = &self.page;
        let is_inside = area.lo.x >= page.lo.x + 2.0
            && area.hi.x <= page.hi.x + 14.0
            && area.lo.y >= page.lo.y - 4.0
            && area.hi.y <= page.hi.y - 2.0;
        let is_free = is_inside
            && self.taken.iter().all(|other| !area.meets(other, 1.5))
            && self.marks.iter().all(|mark| !area.holds(*mark, MARK));
        tick(self.taken.len() + self.marks.len() + self.lines.len());
        is_free.then(|| self.lines.iter().filter(|place| area.holds(**place, 0.5)).count() as f64)
    }
}
