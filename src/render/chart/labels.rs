//! Labels beside their places, none on another and few on lines.

use std::fmt::Write;

use super::look::number;
use super::{escaped, raw_text};

/// A place on the page, px.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Spot {
    pub x: f64,
    pub y: f64,
}

/// What is written, and how.
#[derive(Debug, Clone, Copy)]
pub(super) struct Wording<'a> {
    pub text: &'a str,
    pub size: f64,
    pub is_bold: bool,
    pub colour: &'a str,
}

/// Where a label prefers to stand.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Anchor {
    /// Close to a mark, anywhere around.
    Near,
    /// Behind the end of a line.
    End,
}

#[derive(Debug, Clone, Copy)]
struct Area {
    left: f64,
    top: f64,
    right: f64,
    bottom: f64,
}

/// How wide a text is, px, or a little less.
pub(super) fn width(text: &str, size: f64) -> f64 {
    LETTER * size * text.chars().count() as f64
}

/// What is taken up already.
pub(super) struct Labels {
    page: Area,
    taken: Vec<Area>,
    marks: Vec<Spot>,
    /// Places along the lines, close together.
    lines: Vec<Spot>,
}

/// Room around a mark, px.
const MARK: f64 = 5.0;
/// Places along a line are this far apart, px.
const STEP: f64 = 4.0;
/// The width of a letter in sizes of letters, a generous average.
const LETTER: f64 = 0.58;
/// From this distance on a thin line leads from label to place, px.
const FAR: f64 = 20.0;

impl Labels {
    /// Nothing yet on a page with these bounds.
    pub fn within(left: f64, top: f64, right: f64, bottom: f64) -> Self {
        let page = Area { left, top, right, bottom };
        Self { page, taken: Vec::new(), marks: Vec::new(), lines: Vec::new() }
    }

    pub fn avoid_mark(&mut self, at: Spot) {
        self.marks.push(at);
    }

    pub fn avoid_line(&mut self, spots: &[Spot]) {
        for ends in spots.windows(2) {
            let (dx, dy) = (ends[1].x - ends[0].x, ends[1].y - ends[0].y);
            let n = (libm::hypot(dx, dy) / STEP).ceil().clamp(1.0, 1000.0);
            for k in 0..n as u32 {
                let t = f64::from(k) / n;
                self.lines.push(Spot { x: ends[0].x + t * dx, y: ends[0].y + t * dy });
            }
        }
    }

    /// Writes a label beside `at` where it covers no other and no mark, and as little of lines
    /// as possible; not at all where there is no such place. One that must be seen may stand
    /// farther off.
    pub fn place(
        &mut self,
        at: Spot,
        wording: Wording,
        anchor: Anchor,
        must: bool,
        svg: &mut String,
    ) {
        let (w, h) = (width(wording.text, wording.size), wording.size);
        let distances: &[f64] = if must {
            &[7.0, 11.0, 18.0, 28.0, 42.0, 60.0, 85.0, 115.0, 150.0]
        } else {
            &[6.0, 10.0]
        };
        let mut best: Option<(f64, Area)> = None;
        for &distance in distances {
            for k in 0..16 {
                let phi = f64::from(k) * std::f64::consts::TAU / 16.0;
                let (c, s) = (libm::cos(phi), libm::sin(phi));
                // The nearest edge of the label is at that distance.
                let (x, y) = (at.x + c * (distance + 0.5 * w), at.y - s * (distance + 0.5 * h));
                let area = Area {
                    left: x - 0.5 * w,
                    top: y - 0.5 * h,
                    right: x + 0.5 * w,
                    bottom: y + 0.5 * h,
                };
                let Some(covered) = self.covered(&area) else { continue };
                let preferred = match anchor {
                    Anchor::Near => -0.3 * libm::cos(phi - 0.785),
                    Anchor::End => -1.5 * c,
                };
                let cost = covered + preferred + 0.12 * distance;
                if best.as_ref().is_none_or(|(least, _)| cost < *least - 1e-9) {
                    best = Some((cost, area));
                }
            }
        }
        let Some((cost, area)) = best else { return };
        if !must && cost > 4.0 {
            return;
        }
        self.taken.push(area);
        let (x, y) = (0.5 * (area.left + area.right), 0.5 * (area.top + area.bottom));
        let (nx, ny) = (at.x.clamp(area.left, area.right), at.y.clamp(area.top, area.bottom));
        if libm::hypot(nx - at.x, ny - at.y) > FAR {
            // Writing to a string cannot fail.
            let _ = writeln!(
                svg,
                "<path d=\"M{} {}L{} {}\" stroke=\"{}\" stroke-width=\"0.6\" fill=\"none\"/>",
                number(at.x),
                number(at.y),
                number(nx),
                number(ny),
                wording.colour
            );
        }
        let words = escaped(wording.text);
        let weight = if wording.is_bold { " font-weight=\"bold\"" } else { "" };
        // A rim of paper keeps lines off the letters.
        let words = format!(
            "<tspan{weight} stroke=\"#fff\" stroke-width=\"3\" stroke-linejoin=\"round\" \
             paint-order=\"stroke\">{words}</tspan>"
        );
        raw_text(svg, x, y + 0.36 * wording.size, wording.size, "middle", wording.colour, &words);
    }

    /// How much of lines an area covers; none if it covers what must not be.
    fn covered(&self, area: &Area) -> Option<f64> {
        let page = &self.page;
        let is_inside = area.left >= page.left + 2.0
            && area.right <= page.right + 14.0
            && area.top >= page.top - 4.0
            && area.bottom <= page.bottom - 2.0;
        let is_free = is_inside
            && self.taken.iter().all(|other| !area.meets(other, 1.5))
            && self.marks.iter().all(|mark| !area.holds(*mark, MARK));
        is_free.then(|| self.lines.iter().filter(|spot| area.holds(**spot, 0.5)).count() as f64)
    }
}

impl Area {
    fn meets(&self, other: &Self, gap: f64) -> bool {
        self.left < other.right + gap
            && other.left < self.right + gap
            && self.top < other.bottom + gap
            && other.top < self.bottom + gap
    }

    fn holds(&self, spot: Spot, gap: f64) -> bool {
        (self.left - gap..=self.right + gap).contains(&spot.x)
            && (self.top - gap..=self.bottom + gap).contains(&spot.y)
    }
}
